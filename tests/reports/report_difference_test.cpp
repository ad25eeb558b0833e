#include "reports/report_difference.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string_view>
#include <vector>

#include "core/io/errors.hpp"
#include "core/io/hdf5_file.hpp"

namespace xpr {
namespace {

struct Stored {
  std::string label;
  std::int64_t verdict;
  double value, error;
};

/// A report directory with one case.
std::filesystem::path report_of(const std::string& name, const std::vector<Stored>& rows, const std::string& hash) {
  const std::filesystem::path directory = std::filesystem::path(testing::TempDir()) / ("xpr-difference-" + name);
  std::filesystem::create_directories(directory);
  Hdf5File file = Hdf5File::create(directory / "report.h5");
  std::vector<std::string> labels;
  std::vector<std::int64_t> verdicts;
  std::vector<double> values, errors, tolerances;
  for (const Stored& row : rows) {
    labels.push_back(row.label);
    verdicts.push_back(row.verdict);
    values.push_back(row.value);
    errors.push_back(row.error);
    tolerances.push_back(0.5);
  }
  constexpr std::array<std::string_view, 2> names{"pass", "fail"};
  file.write("/cases/kerr/shadow/label", labels, {});
  file.write_enum("/cases/kerr/shadow/verdict", verdicts, names, {});
  file.write("/cases/kerr/shadow/value", values, {});
  file.write("/cases/kerr/shadow/error", errors, {});
  file.write("/cases/kerr/shadow/tolerance", tolerances, {});
  file.make_group("/provenance");
  file.set_attribute("/provenance", "report_hash", hash);
  file.set_attribute("/provenance", "rays_hash", "rays");
  file.close();
  return directory;
}

TEST(ReportDifference, names_verdicts_rows_and_numbers_that_moved) {
  const auto before =
      report_of("before", {{"a", 0, 1.0, 0.1}, {"b", 0, 2.0, 0.1}, {"c", 0, 3.0, 0.1}, {"a", 0, 9.0, 0.0}}, "x");
  const auto after =
      report_of("after", {{"a", 1, 1.5, 0.6}, {"b", 0, 2.25, -0.2}, {"a", 0, 9.0, 0.0}, {"d", 0, 4.0, 0.0}}, "y");
  const ReportDifference difference = compare_reports(before, after);
  EXPECT_EQ(difference.rows, 3);
  EXPECT_EQ(difference.gone, std::vector<std::string>{"kerr/shadow: c"});
  EXPECT_EQ(difference.added, std::vector<std::string>{"kerr/shadow: d"});
  ASSERT_EQ(difference.verdicts.size(), 1U);
  EXPECT_EQ(difference.verdicts[0].row, "kerr/shadow: a");
  EXPECT_EQ(difference.verdicts[0].verdict_after, "fail");
  EXPECT_DOUBLE_EQ(difference.verdicts[0].error_after, 1.2);
  ASSERT_EQ(difference.values.size(), 1U);
  EXPECT_EQ(difference.values[0].value_after, 2.25);
  EXPECT_DOUBLE_EQ(difference.values[0].error_after, 0.4);
  EXPECT_FALSE(difference.same_verdicts());
  const std::string text = difference_text(difference, 10);
  EXPECT_NE(text.find("the rays are the same, bit for bit"), std::string::npos);
  EXPECT_NE(text.find("kerr/shadow: a: pass -> fail"), std::string::npos);
}

TEST(ReportDifference, equal_reports_are_the_same) {
  const auto report = report_of("same", {{"a", 0, 1.0, 0.1}}, "x");
  const ReportDifference difference = compare_reports(report, report);
  EXPECT_TRUE(difference.same_verdicts());
  EXPECT_TRUE(difference.values.empty());
  EXPECT_EQ(difference_text(difference, 10), "the same: report_hash x, 1 rows\n");
}

TEST(ReportDifference, a_folder_without_a_report_is_named) {
  const std::filesystem::path empty = std::filesystem::path(testing::TempDir()) / "xpr-difference-none";
  std::filesystem::create_directories(empty);
  EXPECT_FALSE(has_report(empty));
  try {
    (void)compare_reports(empty, empty);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("a report directory holds report.h5 or paper.h5"), std::string::npos);
  }
}

}  // namespace
}  // namespace xpr
