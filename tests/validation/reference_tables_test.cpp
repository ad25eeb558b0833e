// The tables of reference_data/ are what their makers make, digit by digit.
#include <gtest/gtest.h>

#include <filesystem>

#include "core/io/errors.hpp"
#include "validation/truth/tables.hpp"

namespace xpr {
namespace {

const std::filesystem::path folder = std::filesystem::path(XPR_SOURCE_DIR) / "reference_data";

TEST(ReferenceTables, made_anew_agree_in_every_printed_digit) {
  for (const ReferenceMaker& maker : reference_makers()) {
    const ReferenceTable stored = read_reference(folder / (std::string(maker.name) + ".csv"));
    const auto difference = first_difference(stored, maker.make());
    EXPECT_FALSE(difference.has_value()) << maker.name << ": " << *difference;
  }
}

TEST(ReferenceTables, each_stands_in_the_folder_with_its_hash_its_rank_and_its_digits) {
  const auto files = reference_files(folder);
  EXPECT_GE(files.size(), reference_makers().size());
  for (const auto& file : files) {
    const ReferenceTable table = read_reference(file);
    EXPECT_NO_THROW((void)rank_of(table)) << file;
    EXPECT_GT(table.digits, 0) << file;
    EXPECT_FALSE(table.rows.empty()) << file;
  }
}

TEST(ReferenceTables, a_difference_is_named_by_row_and_column) {
  const ReferenceTable made = make_ellis_transit_angle();
  EXPECT_FALSE(first_difference(made, made).has_value());
  ReferenceTable stored = made;
  stored.rows[1][2].back() = stored.rows[1][2].back() == '1' ? '2' : '1';
  EXPECT_EQ(*first_difference(stored, made),
            "row 2, azimuth: " + stored.rows[1][2] + " stored, " + made.rows[1][2] + " computed");
  stored = made;
  stored.rows.pop_back();
  EXPECT_EQ(*first_difference(stored, made), "10 rows stored, 11 computed");
  stored = made;
  stored.method = "guessed";
  EXPECT_NE(first_difference(stored, made)->find("header, method: 'guessed' stored"), std::string::npos);
}

TEST(ReferenceTables, an_unknown_rank_names_the_nearest) {
  ReferenceTable table = make_ellis_transit_angle();
  EXPECT_EQ(rank_of(table), TruthRank::closed_form);
  table.rank = "close form";
  try {
    (void)rank_of(table);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'closed form'?"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace xpr
