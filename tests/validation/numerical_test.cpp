// The numerical family: every row of the quick suite passes, and every fault planted under it is caught.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>

#include "validation/convergence.hpp"
#include "validation/families.hpp"
#include "validation/suite.hpp"

namespace xpr {

/// Google Test's name for a parameter: by default its bytes, pointers and all.
void PrintTo(const Case& one, std::ostream* out) { *out << one.info.id; }
void PrintTo(Verdict verdict, std::ostream* out) { *out << to_string(verdict); }

namespace {

class NumericalCase : public testing::TestWithParam<Case> {};

TEST_P(NumericalCase, passes_every_row_and_says_what_it_claims) {
  const Case& one = GetParam();
  EXPECT_FALSE(one.info.claim.empty());
  EXPECT_FALSE(one.info.physics.empty());
  EXPECT_FALSE(one.info.truth.empty());
  EXPECT_FALSE(one.info.grades_metric);
  const Lab lab(SuiteSize::quick);
  for (const Row& row : one.run(lab)) {
    EXPECT_EQ(row.verdict, Verdict::pass) << row.label << ": error " << row.error << ", tolerance " << row.tolerance;
  }
}

INSTANTIATE_TEST_SUITE_P(all, NumericalCase, testing::ValuesIn(numerical_cases()), [](const auto& each) {
  std::string name = each.param.info.id.substr(each.param.info.id.find('/') + 1);
  for (char& c : name) c = c == '-' ? '_' : c;
  return name;
});

TEST(NumericalFaults, are_all_caught) {
  const std::vector<Fault> planted = numerical_faults();
  const std::vector<Case> all = numerical_cases();
  for (const FaultResult& result : run_self_test(planted, all, SuiteSize::quick)) {
    EXPECT_TRUE(result.caught) << result.id << " by " << result.case_id << ": " << result.row << " error "
                               << result.error << " tolerance " << result.tolerance << "; " << result.note;
  }
}

TEST(NumericalFaults, leave_no_case_without_a_negative_control) {
  const std::vector<Fault> planted = numerical_faults();
  for (const Case& one : numerical_cases()) {
    EXPECT_TRUE(std::any_of(planted.begin(), planted.end(), [&](const Fault& f) { return f.case_id == one.info.id; }))
        << one.info.id;
  }
}

TEST(Convergence, order_of_a_power_law_is_its_power) {
  EXPECT_DOUBLE_EQ(order_between(0.1, 1e-4, 0.05, 6.25e-6), 4.0);
  const std::vector<double> settings = {1e-2, 1e-3, 1e-4};
  const std::vector<double> errors = {3e-4, 3e-6, 3e-8};
  EXPECT_NEAR(fitted_slope(settings, errors), 2.0, 1e-12);  // round-off of six logarithms
}

TEST(Convergence, rungs_below_round_off_are_not_read) {
  const std::vector<double> settings = {0.4, 0.2, 0.1, 0.05};
  const std::vector<double> errors = {1.6e-3, 1e-4, 6.25e-6, 5e-6};  // order 4, then a floor
  const std::vector<double> floors(4, 5e-8);
  const CleanOrder clean = clean_order(std::span(settings).first(3), std::span(errors).first(3), floors);
  EXPECT_NEAR(clean.order, 4.0, 1e-12);
  EXPECT_NEAR(clean.change, 0.0, 1e-12);
  const std::vector<double> high_floors(4, 5e-7);
  EXPECT_DOUBLE_EQ(clean_order(settings, errors, high_floors).setting2, 0.2);
}

TEST(Convergence, classes_tell_monotone_oscillatory_and_divergent_ladders_apart) {
  const auto ladder = [](double c0, double c1, double c2) {
    return std::vector<Rung>{{0.4, {c0, 2.0 * c0}}, {0.2, {c1, 2.0 * c1}}, {0.1, {c2, 2.0 * c2}}};
  };
  EXPECT_EQ(convergence_class(ladder(1.0, 1.25, 1.3), 2, 1e-12), ConvergenceClass::monotone);
  EXPECT_EQ(convergence_class(ladder(1.0, 1.25, 1.2), 2, 1e-12), ConvergenceClass::oscillatory);
  EXPECT_EQ(convergence_class(ladder(1.0, 1.25, 2.0), 2, 1e-12), ConvergenceClass::divergent);
  EXPECT_EQ(convergence_class(ladder(1.0, 1.25, 1.25), 2, 1e-12), ConvergenceClass::round_off);
  EXPECT_EQ(convergence_class(ladder(1.0, 1.25, 1.3), 1, 1e-12), ConvergenceClass::unknown);
}

TEST(Convergence, richardson_bounds_the_error_of_a_power_law) {
  // f = 1 + h^2: the error at h = 0.1 is 0.01, Richardson's estimate of it (0.04 - 0.01) / 3.
  const std::vector<Rung> ladder = {{0.2, {1.04}}, {0.1, {1.01}}};
  EXPECT_NEAR(richardson_error(ladder, 1, 2.0), 1.25 * 0.01, 1e-12);
}

}  // namespace
}  // namespace xpr
