#include "reports/digest.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sample_suite.hpp"

namespace xpr {
namespace {

Row row_with(double error, double tolerance) {
  Row row;
  row.reference = 1.0;
  row.value = 1.0 + error;
  row.tolerance = tolerance;
  judge(row);
  return row;
}

TEST(Digest, of_a_passing_suite_says_so_and_lists_no_failure) {
  const SuiteResult suite = passing_suite();
  const Digest found = digest(suite);
  EXPECT_EQ(found.outcome, Outcome::passed);
  EXPECT_EQ(found.sentence,
            "PASSED: all 98 graded rows lie within tolerance of their references; all 2 planted faults caught.");
  EXPECT_TRUE(found.failures.empty());
  EXPECT_TRUE(found.missed_faults.empty());
}

TEST(Digest, of_a_troubled_suite_counts_every_trouble) {
  const SuiteResult suite = troubled_suite();
  const Digest found = digest(suite);
  EXPECT_EQ(found.outcome, Outcome::error);
  EXPECT_EQ(found.counts.fail, 1);
  EXPECT_EQ(found.counts.error, 2);
  EXPECT_EQ(found.counts.inconclusive, 1);
  EXPECT_EQ(found.counts.skipped, 1);
  for (const char* said : {"1 of 99 graded rows out of tolerance", "2 of 99 graded rows not measured",
                           "1 of 99 graded rows undecided", "1 of 3 planted faults UNNOTICED", "1 row SKIPPED"}) {
    EXPECT_NE(found.sentence.find(said), std::string::npos) << said << " not in: " << found.sentence;
  }
}

TEST(Digest, puts_failures_before_errors_before_undecided_rows) {
  const SuiteResult suite = troubled_suite();
  const Digest found = digest(suite);
  ASSERT_EQ(found.failures.size(), 4U);
  EXPECT_EQ(found.failures[0].row->verdict, Verdict::fail);
  EXPECT_EQ(found.failures[1].row->verdict, Verdict::error);
  EXPECT_EQ(found.failures[2].row->verdict, Verdict::error);
  EXPECT_EQ(found.failures[3].row->verdict, Verdict::inconclusive);
}

TEST(Digest, of_skipped_rows_alone_is_not_a_pass) {
  SuiteResult suite;
  suite.cases.emplace_back().rows.emplace_back().verdict = Verdict::skipped;
  EXPECT_EQ(digest(suite).outcome, Outcome::nothing_graded);
  EXPECT_EQ(digest({}).sentence, "NOTHING GRADED: no row was graded.");
}

TEST(Digest, of_sweeps_alone_says_that_it_is_a_sweep) {
  SuiteResult suite;
  Sweep& sweep = suite.sweeps.emplace_back();
  sweep.quantity = "end state";
  for (const char* method : {"rk4", "rk4", "dopri54"}) sweep.points.emplace_back().method = method;
  EXPECT_EQ(digest(suite).outcome, Outcome::swept);
  EXPECT_EQ(digest(suite).sentence, "CONVERGENCE SWEEP: 1 quantity, 2 series, 3 points; nothing is graded.");
  // Beside rows that were to be graded and were not, sweeps are no excuse.
  suite.cases.emplace_back().rows.emplace_back().verdict = Verdict::skipped;
  EXPECT_EQ(digest(suite).outcome, Outcome::nothing_graded);
}

TEST(Digest, tells_the_tail_of_error_over_tolerance) {
  SuiteResult suite;
  CaseResult& result = suite.cases.emplace_back();
  // Errors 1/1024 to 150/1024 of a tolerance of 1: exact in binary. Nearest rank: p99 of 150 is the 149th.
  for (int k = 1; k <= 150; ++k) result.rows.push_back(row_with(k / 1024.0, 1.0));
  const RatioTail tail = digest(suite).families.at(0).tail;
  EXPECT_EQ(tail.rows, 150);
  EXPECT_EQ(tail.median, 75.5 / 1024.0);
  EXPECT_EQ(tail.p99, 149.0 / 1024.0);
  EXPECT_EQ(tail.max, 150.0 / 1024.0);
}

TEST(Digest, counts_an_error_that_is_not_finite_as_infinitely_bad) {
  EXPECT_EQ(error_over_tolerance(row_with(std::nan(""), 1.0)), std::numeric_limits<double>::infinity());
}

TEST(Digest, gives_no_numbers_to_rows_that_were_not_measured) {
  Row skipped;
  skipped.verdict = Verdict::skipped;
  skipped.tolerance = 1.0;
  EXPECT_FALSE(measured(skipped));
  EXPECT_TRUE(std::isnan(error_over_tolerance(skipped)));
  Row thrown;
  thrown.verdict = Verdict::error;
  EXPECT_FALSE(measured(thrown));
  thrown.reference = 2.0;
  thrown.tolerance = 1.0;
  EXPECT_FALSE(measured(thrown)) << "truth and tolerance were set before the ray broke off";
  EXPECT_TRUE(measured(row_with(0.0, 1.0)));
}

TEST(Digest, has_no_relative_error_where_the_reference_is_zero) {
  Row row = row_with(0.25, 1.0);
  EXPECT_EQ(relative_error(row), 0.25);
  row.reference = 0.0;
  EXPECT_TRUE(std::isnan(relative_error(row)));
}

TEST(Coverage, shows_what_nothing_grades_and_what_only_a_sweep_touches) {
  const SuiteResult suite = passing_suite();
  const Coverage matrix = coverage(suite, {{"minkowski", "cartesian"}, {"kerr", "kerr-schild"}}, {"rk4", "dop853"});
  ASSERT_EQ(matrix.charts[0].metric, "minkowski");
  for (const CoverageCell& cell : matrix.cells[0]) EXPECT_EQ(cell.counts.total() + cell.sweep_points, 0);
  EXPECT_EQ(matrix.cells[1][0].counts.total(), 0);
  EXPECT_EQ(matrix.cells[1][0].sweep_points, 6);
  EXPECT_EQ(matrix.cells[1][1].counts.pass, 24);
}

TEST(Coverage, counts_a_projected_method_under_its_method) {
  const Coverage matrix = coverage(passing_suite(), {{"kerr", "kerr-schild-outgoing"}}, {"dop853"});
  EXPECT_EQ(matrix.cells[0][0].counts.pass, 48);
  EXPECT_EQ(base_method("dop853+full"), "dop853");
}

}  // namespace
}  // namespace xpr
