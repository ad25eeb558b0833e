// Reference tables: read as they were written, and refused where a hand has changed them.
#include "core/io/reference_table.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "core/io/errors.hpp"
#include "temporary_directory.hpp"

namespace xpr {
namespace {

ReferenceTable sample() {
  return {.name = "sample",
          .quantity = "a number",
          .units = "b M; alpha rad",
          .origin = "computed",
          .method = "by hand",
          .digits = 5,
          .rank = "closed form",
          .cites = "Darwin1959",
          .maker = "nobody",
          .columns = {"b", "alpha"},
          .rows = {{"5.5", "2.5530e+00"}, {"8", "8.5873e-01"}}};
}

/// What the error says, or nothing where there is none.
std::string complaint(const std::string& text) {
  try {
    (void)parse_reference(text, "sample.csv");
    return {};
  } catch (const InputError& error) {
    return error.what();
  }
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(ReferenceTable, reads_what_it_writes) {
  const ReferenceTable table = parse_reference(reference_text(sample()), "sample.csv");
  EXPECT_EQ(reference_text(table), reference_text(sample()));
  EXPECT_EQ(table.digits, 5);
  EXPECT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[1][column_index(table, "alpha")], "8.5873e-01");
  EXPECT_THROW((void)column_index(table, "beta"), std::out_of_range);
}

TEST(ReferenceTable, names_the_hash_of_what_was_changed_by_hand) {
  const std::string text = reference_text(sample());
  for (const auto& [from, to] : {std::pair{"2.5530", "2.5531"},
                                 {"# digits: 5", "# digits: 6"},
                                 {"b,alpha", "b,beta"},
                                 {"# hash: xxh3-128 ", "# hash: xxh3-128 0"}}) {
    const std::string said = complaint(changed(text, from, to));
    EXPECT_NE(said.find("sample.csv: hash mismatch"), std::string::npos) << from << ": " << said;
  }
  EXPECT_NE(complaint(text + "9,1\n").find("hash mismatch"), std::string::npos);
  EXPECT_NE(complaint(text.substr(0, text.size() - 20)).find("hash mismatch"), std::string::npos);
}

TEST(ReferenceTable, refuses_what_is_no_table) {
  EXPECT_NE(complaint("b,alpha\n1,2\n").find("is no reference table"), std::string::npos);
  EXPECT_NE(complaint("").find("is no reference table"), std::string::npos);
  EXPECT_NE(complaint("# xprimeray reference table 1\nb\n").find("needs a line '# hash"), std::string::npos);
  ReferenceTable bad = sample();
  bad.rows[0].pop_back();
  EXPECT_THROW((void)reference_text(bad), std::invalid_argument);
  bad = sample();
  bad.rows[0][0] = "1,5";
  EXPECT_THROW((void)reference_text(bad), std::invalid_argument);
  bad = sample();
  bad.method = "";
  EXPECT_THROW((void)reference_text(bad), std::invalid_argument);
}

TEST(ReferenceTable, bears_the_name_of_its_file) {
  const testing::TemporaryDirectory folder;
  std::ofstream(folder.path() / "other.csv") << reference_text(sample());
  EXPECT_THROW((void)read_reference(folder.path() / "other.csv"), InputError);
  std::ofstream(folder.path() / "sample.csv") << reference_text(sample());
  EXPECT_EQ(read_reference(folder.path() / "sample.csv").name, "sample");
  EXPECT_EQ(reference_files(folder.path()).size(), 2U);
  EXPECT_THROW((void)read_reference(folder.path() / "none.csv"), InputError);
  EXPECT_THROW((void)reference_files(folder.path() / "none"), InputError);
}

}  // namespace
}  // namespace xpr
