#include "reports/report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <string>

#include "core/io/errors.hpp"
#include "core/io/hdf5_file.hpp"
#include "reports/case_table.hpp"
#include "reports/junit.hpp"
#include "sample_suite.hpp"

namespace xpr {
namespace {

namespace fs = std::filesystem;

/// A folder of this test alone.
class Reports : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder = fs::path(testing::TempDir()) / (std::string("xpr_reports_") + test->name());
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }

  std::string read(const fs::path& file) const {
    std::ifstream in(folder / file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  /// A figure "script" for the shell in place of Python; $3 is the folder to draw into ($1 is -B).
  FigureTools shell_script(const std::string& text) const {
    std::ofstream(folder / "python") << "#!/bin/sh\n" << text;
    fs::permissions(folder / "python", fs::perms::owner_all);
    std::ofstream(folder / "script.py") << "";
    return {.python = folder / "python", .script = folder / "script.py", .limit = std::chrono::seconds(20)};
  }
  std::set<std::string> entries() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
    return names;
  }

  fs::path folder;
};

TEST_F(Reports, hold_one_file_for_each_format) {
  write_report(sample_inputs(troubled_suite()), folder / "out");
  for (const char* name : {"report.md", "report.html", "report.h5", "junit.xml", "summary.json"}) {
    EXPECT_TRUE(fs::exists(folder / "out" / name)) << name;
  }
  EXPECT_EQ(entries(), std::set<std::string>{"out"}) << "something was left beside the report";
}

TEST_F(Reports, put_the_verdict_on_top_and_failures_before_every_table_of_rows) {
  write_report(sample_inputs(troubled_suite()), folder / "out");
  const std::string text = read("out/report.md");
  const auto at = [&text](const char* what) {
    const auto position = text.find(what);
    EXPECT_NE(position, std::string::npos) << what;
    return position;
  };
  EXPECT_LT(at("**ERROR: 1 of 99"), at("## How to reproduce"));
  EXPECT_LT(at("xprimeray validate --suite quick"), at("## Failures"));
  EXPECT_LT(at("## Failures"), at("## Skipped"));
  EXPECT_LT(at("## Skipped"), at("## Coverage"));
  EXPECT_LT(at("## Coverage"), at("## Every row, by family"));
  EXPECT_LT(at("| 2.1841001983279 | 2.1841001983209 | 7.0e-12 | 1.0e-12 | 7.0 | radian | **FAIL** |"),
            at("## Skipped"));
  EXPECT_NE(text.find("not graded"), std::string::npos);
  EXPECT_NE(text.find("**NOT CAUGHT**"), std::string::npos);
}

TEST_F(Reports, say_loudly_that_figures_are_missing) {
  const ReportOutcome outcome = write_report(sample_inputs(passing_suite()), folder / "out");
  ASSERT_EQ(outcome.figure_problems.size(), 1U);
  EXPECT_NE(outcome.figure_problems[0].find("NO FIGURES: no Python"), std::string::npos);
  EXPECT_NE(read("out/report.md").find("**NO FIGURES: no Python"), std::string::npos);
  EXPECT_NE(read("out/report.html").find("NO FIGURES: no Python"), std::string::npos);
  EXPECT_NE(read("out/summary.json").find("NO FIGURES: no Python"), std::string::npos);
}

TEST_F(Reports, keep_nothing_of_a_script_that_crashes) {
  ReportInputs inputs = sample_inputs(passing_suite());
  inputs.figure_tools = shell_script("mkdir $4; echo half >$4/a.svg; echo 'Boom: it broke' >&2; exit 7\n");
  const ReportOutcome outcome = write_report(inputs, folder / "out");
  ASSERT_EQ(outcome.figure_problems.size(), 1U);
  EXPECT_NE(outcome.figure_problems[0].find("status 7: Boom: it broke"), std::string::npos)
      << outcome.figure_problems[0];
  EXPECT_FALSE(fs::exists(folder / "out/figures"));
  EXPECT_FALSE(fs::exists(folder / "out/figures.log"));
  EXPECT_TRUE(fs::exists(folder / "out/report.md"));
}

TEST_F(Reports, survive_a_script_that_dies_of_a_signal) {
  ReportInputs inputs = sample_inputs(passing_suite());
  inputs.figure_tools = shell_script("kill -SEGV $$\n");
  EXPECT_NE(write_report(inputs, folder / "out").figure_problems.at(0).find("signal 11"), std::string::npos);
}

TEST_F(Reports, stop_a_script_that_hangs) {
  ReportInputs inputs = sample_inputs(passing_suite());
  inputs.figure_tools = shell_script("exec sleep 60\n");
  inputs.figure_tools.limit = std::chrono::seconds(0);
  EXPECT_NE(write_report(inputs, folder / "out").figure_problems.at(0).find("was stopped"), std::string::npos);
}

TEST_F(Reports, do_not_believe_an_index_that_lies_or_is_broken) {
  ReportInputs inputs = sample_inputs(passing_suite());
  inputs.figure_tools = shell_script(
      "mkdir $4; echo '{\"figures\": [{\"name\": \"a\", \"title\": \"A\", \"caption\": \"b\"}], \"problems\": [\"c: "
      "d\"]}' "
      ">$4/index.json\n");
  EXPECT_EQ(write_report(inputs, folder / "out").figure_problems.size(), 2U);
  inputs.figure_tools = shell_script("mkdir $4; echo '{\"fig' >$4/index.json\n");
  EXPECT_NE(write_report(inputs, folder / "out").figure_problems.at(0).find("index"), std::string::npos);
}

TEST_F(Reports, replace_an_earlier_report_and_nothing_else) {
  write_report(sample_inputs(troubled_suite()), folder / "out");
  std::ofstream(folder / "out/stale.txt") << "old";
  write_report(sample_inputs(passing_suite()), folder / "out");
  EXPECT_FALSE(fs::exists(folder / "out/stale.txt"));
  fs::create_directories(folder / "mine");
  std::ofstream(folder / "mine/thesis.tex") << "precious";
  EXPECT_THROW(check_report_directory(folder / "mine"), InputError);
  EXPECT_THROW(write_report(sample_inputs(passing_suite()), folder / "mine"), InputError);
  EXPECT_EQ(read("mine/thesis.tex"), "precious");
  EXPECT_THROW(check_report_directory(folder / "mine/thesis.tex/report"), InputError) << "a file is no folder";
  EXPECT_NO_THROW(check_report_directory(folder / "new/place/report")) << "folders on the way are made";
}

TEST_F(Reports, store_what_was_not_measured_as_nan) {
  write_report(sample_inputs(troubled_suite()), folder / "out");
  const Hdf5File file = Hdf5File::open(folder / "out/report.h5");
  const auto labels = file.read_strings("/cases/schwarzschild/deflection/label");
  const auto values = file.read_doubles("/cases/schwarzschild/deflection/value");
  const auto errors = file.read_doubles("/cases/schwarzschild/deflection/error");
  const auto verdicts = file.read_enum("/cases/schwarzschild/deflection/verdict");
  ASSERT_EQ(labels.size(), 22U);
  EXPECT_EQ(verdicts[3], "fail");
  for (const std::size_t row : {20U, 21U}) {
    EXPECT_TRUE(std::isnan(values[row])) << labels[row];
    EXPECT_TRUE(std::isnan(errors[row])) << labels[row];
  }
  EXPECT_EQ(verdicts[20], "error");
  EXPECT_EQ(verdicts[21], "skipped");
}

TEST(Hashes, change_with_any_number_and_not_with_time) {
  SuiteResult suite = passing_suite();
  const Hashes before = hashes(suite);
  suite.cases[1].seconds += 1.0;
  suite.sweeps[0].points[0].seconds_per_ray += 1.0;
  EXPECT_EQ(hashes(suite).report, before.report);
  EXPECT_EQ(hashes(suite).rays, before.rays);

  SuiteResult other_truth = suite;
  double& reference = other_truth.cases[1].rows[0].reference;
  reference = std::nextafter(reference, 10.0);
  EXPECT_NE(hashes(other_truth).report, before.report);
  EXPECT_EQ(hashes(other_truth).rays, before.rays) << "truth is no part of what transport put out";

  SuiteResult other_ray = suite;
  double& value = other_ray.cases[1].rows[0].value;
  value = std::nextafter(value, 10.0);
  EXPECT_NE(hashes(other_ray).report, before.report);
  EXPECT_EQ(hashes(other_ray).rays, before.rays) << "a closed form may have taken part in a row's value";
  other_ray.cases[1].transported = "the digest of other rays";
  EXPECT_NE(hashes(other_ray).rays, before.rays);
}

TEST(Datasets, give_every_unit_and_awkward_name_of_a_parameter_its_own_column) {
  SuiteResult suite;
  CaseResult& result = suite.cases.emplace_back();
  result.info.id = "odd/names";
  for (const RowParameter& parameter : {RowParameter{"b/M", 1.0, "1"}, RowParameter{"b/M", 2.0, "m"},
                                        RowParameter{"b_over_M", 3.0, "1"}, RowParameter{"value", 4.0, "1"}}) {
    Row& row = result.rows.emplace_back();
    row.parameters = {parameter};
  }
  std::set<std::string> paths;
  for (const Dataset& column : result_datasets(suite).columns) {
    EXPECT_TRUE(paths.insert(column.path).second) << column.path << " twice";
  }
  for (const char* name : {"b_over_M", "b_over_M_2", "b_over_M_3", "value"}) {
    EXPECT_TRUE(paths.contains(std::string("/cases/odd/names/parameter/") + name)) << name;
  }
}

TEST(CaseTable, says_once_what_all_rows_share_and_keeps_what_they_do_not) {
  const SuiteResult suite = passing_suite();
  const CaseTable shadow = case_table(suite.cases[2]);
  const auto has_fact = [&](const std::string& name, const std::string& text) {
    return std::find(shadow.facts.begin(), shadow.facts.end(), std::pair{name, text}) != shadow.facts.end();
  };
  EXPECT_TRUE(has_fact("method", "dop853+full"));
  EXPECT_TRUE(has_fact("why this tolerance", "tol times the condition of the path"));
  for (const char* title :
       {"value", "reference", "abs. error", "rel. error", "truth error", "tolerance", "rank", "verdict"}) {
    EXPECT_TRUE(std::any_of(shadow.table.columns.begin(), shadow.table.columns.end(), [&](const TableColumn& column) {
      return column.title == title;
    })) << title;
  }
  for (const auto& row : shadow.table.rows) EXPECT_EQ(row.size(), shadow.table.columns.size());
}

TEST(CaseTable, prints_value_and_reference_apart_where_they_differ) {
  const SuiteResult suite = troubled_suite();
  for (const CaseResult& result : suite.cases) {
    for (const Row& row : result.rows) {
      if (!measured(row) || row.value == row.reference) continue;
      EXPECT_NE(value_text(row), reference_text(row)) << row.label;
    }
  }
  Row skipped;
  skipped.verdict = Verdict::skipped;
  EXPECT_EQ(value_text(skipped), "na");
}

TEST(Junit, is_never_green_for_a_row_that_does_not_pass) {
  const std::string xml = junit_xml(troubled_suite());
  EXPECT_NE(xml.find("<testsuite name=\"schwarzschild/deflection\" tests=\"22\" failures=\"2\" errors=\"2\" "
                     "skipped=\"1\""),
            std::string::npos);
  EXPECT_NE(xml.find("<failure type=\"inconclusive\""), std::string::npos);
  EXPECT_NE(xml.find("no such chart: &lt;boyer &amp; lindquist&gt;"), std::string::npos);
  EXPECT_NE(xml.find("<failure type=\"not caught\""), std::string::npos);
}

}  // namespace
}  // namespace xpr
