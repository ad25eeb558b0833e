#include "validation/grading/hand_in.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "../core/temporary_directory.hpp"
#include "core/io/errors.hpp"

namespace xpr {
namespace {

using testing::message_of;
using testing::slurp;
using testing::spill;
using testing::TemporaryDirectory;

constexpr const char* header = "id,x0,x1,x2,x3\n";

class HandInFile : public ::testing::Test {
 protected:
  const ChallengeSet& set_ = challenge_set("kerr-core");
  TemporaryDirectory folder_;
  std::filesystem::path path_ = folder_ / "mine.csv";

  /// Rows of the first `count` rays.
  [[nodiscard]] std::string rows(int count, int from = 0) const {
    std::string text;
    for (int k = from; k < count; ++k) text += fmt::format("{},0,100,1.5,2.25\n", set_.first_id + k);
    return text;
  }
  [[nodiscard]] std::string refusal(const std::string& content, std::int64_t count = 6) const {
    spill(path_, content);
    return message_of<InputError>([&] { (void)read_hand_in(path_, set_, count, "boyer-lindquist"); });
  }
};

TEST_F(HandInFile, needs_no_more_than_events_in_any_order) {
  spill(path_, header + rows(6, 3) + rows(3));
  const HandIn hand_in = read_hand_in(path_, set_, 6, "boyer-lindquist");
  ASSERT_EQ(hand_in.rays.size(), 6U);
  EXPECT_FALSE(hand_in.has_status);
  EXPECT_FALSE(hand_in.has_momentum);
  EXPECT_EQ(hand_in.rays[5].end[3], 2.25);
  EXPECT_TRUE(std::isnan(hand_in.rays[5].end[4]));
  EXPECT_TRUE(std::isnan(hand_in.work));
}

TEST_F(HandInFile, takes_rows_of_nan) {
  spill(path_, header + rows(5) + fmt::format("{},nan,nan,inf,nan\n", set_.first_id + 5));
  EXPECT_TRUE(std::isnan(read_hand_in(path_, set_, 6, "boyer-lindquist").rays[5].end[1]));
}

TEST_F(HandInFile, averages_work) {
  spill(path_, "id,x0,x1,x2,x3,steps,rejected\n3000000,0,1,1,1,10,2\n3000001,0,1,1,1,20,4\n");
  const HandIn hand_in = read_hand_in(path_, set_, 2, "boyer-lindquist");
  EXPECT_EQ(hand_in.work, 18.0);
  EXPECT_EQ(hand_in.work_unit, "steps tried");
}

TEST_F(HandInFile, with_missing_rays_is_refused_and_they_are_named) {
  const std::string text = refusal(header + rows(2) + rows(6, 4));
  EXPECT_NE(text.find("2 of the 6 rays of 'kerr-core' are missing: 3000002, 3000003"), std::string::npos) << text;
  EXPECT_NE(text.find("a row of nan"), std::string::npos) << text;
}

TEST_F(HandInFile, with_a_ray_twice_is_refused) {
  EXPECT_NE(refusal(header + rows(6) + rows(1)).find("lines 2 and 8 have the same id 3000000"), std::string::npos);
}

TEST_F(HandInFile, with_unknown_ids_is_refused) {
  EXPECT_NE(refusal(std::string(header) + "17,0,1,1,1\n")
                .find("line 2: id 17 belongs to no set; those of 'kerr-core' are "
                      "3000000 to 3000005"),
            std::string::npos);
}

TEST_F(HandInFile, with_ids_of_another_set_is_refused_and_the_set_named) {
  EXPECT_NE(refusal(std::string(header) + "2000003,0,1,1,1\n").find("id 2000003 belongs to set 'schwarzschild-core'"),
            std::string::npos);
}

TEST_F(HandInFile, with_more_rays_than_asked_for_says_how_to_ask) {
  EXPECT_NE(refusal(header + rows(8)).find("--count"), std::string::npos);
}

TEST_F(HandInFile, with_wrong_columns_is_offered_the_right_ones) {
  EXPECT_NE(refusal("id,x0,x1,x2,xx3\n").find("did you mean 'x3'"), std::string::npos);
  EXPECT_NE(refusal("ray,t,r,theta,phi\n").find("columns are id, status, sheet, x0, x1, x2, x3"), std::string::npos);
  EXPECT_NE(refusal("id,x0,x1,x2\n").find("column 'x3' is missing, needs id,x0,x1,x2,x3"), std::string::npos);
  EXPECT_NE(refusal("id,x0,x1,x2,x3,p1\n3000000,0,1,1,1,1\n").find("come together"), std::string::npos);
}

TEST_F(HandInFile, that_ends_early_is_refused) {
  const std::string whole = header + rows(6);
  // Within a row, after a whole row, within the last field of a row but the last.
  EXPECT_NE(refusal(whole.substr(0, whole.size() - 12)).find("line 7: has"), std::string::npos);
  EXPECT_NE(refusal(header + rows(4)).find("all are at the end: was the file cut off"), std::string::npos);
  const std::string cut = header + rows(4);
  EXPECT_NE(refusal(cut.substr(0, cut.size() - 2)).find("ends in the middle of a line: was it cut off"),
            std::string::npos);
}

TEST_F(HandInFile, in_hdf5_that_ends_early_is_refused) {
  const std::filesystem::path whole = folder_ / "whole.h5";
  TableSchema schema = hand_in_schema();
  schema.columns = {schema.columns[0], schema.columns[3], schema.columns[4], schema.columns[5], schema.columns[6]};
  TableBlock block = empty_block(schema);
  block.rows = 6;
  for (std::int64_t k = 0; k < 6; ++k) {
    std::get<std::vector<std::int64_t>>(block.columns[0]).push_back(set_.first_id + k);
    for (std::size_t c = 1; c < 5; ++c) std::get<std::vector<double>>(block.columns[c]).push_back(1.0);
  }
  const std::vector<std::pair<std::string, std::string>> attributes{
      {"metric", "kerr"}, {"chart", "boyer-lindquist"}, {"parameters", R"({"M":1.0,"a":0.5})"}};
  const auto write = [&](std::size_t given) {
    const auto writer = create_table(whole, TableFormat::hdf5, schema, std::span(attributes).first(given));
    writer->write(block);
    writer->close();
  };
  const auto refused = [&](const std::filesystem::path& path, const char* chart) {
    return message_of<InputError>([&] { (void)read_hand_in(path, set_, 6, chart); });
  };
  write(2);
  EXPECT_EQ(read_hand_in(whole, set_, 6, "boyer-lindquist").rays.size(), 6U);
  // It says of what it is.
  EXPECT_NE(refused(whole, "kerr-schild").find("--chart says"), std::string::npos);
  const std::string content = slurp(whole);
  const std::filesystem::path cut = folder_ / "cut.h5";
  spill(cut, content.substr(0, content.size() / 2));
  EXPECT_NE(refused(cut, "boyer-lindquist").find("cut.h5"), std::string::npos);
  write(3);
  EXPECT_NE(refused(whole, "boyer-lindquist").find("with a = 0.5, set 'kerr-core' has a = 0.9"), std::string::npos);
}

}  // namespace
}  // namespace xpr
