// One battery for every method: order, dense output, error estimate, cost, time reversal.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "integrators/step_control.hpp"
#include "integrators/stepper.hpp"
#include "test_flows.hpp"

namespace xpr {
namespace {

using test::Kepler;
using test::KeplerOrbit;

std::unique_ptr<Stepper> stepper_for(const MethodCard& card, const Flow& flow = Kepler{}, double tol = 1e-8) {
  return make_stepper(card.id, flow, test::settings_with_tolerance(tol));
}

/// bulirsch_stoer chooses order and step itself: nothing formal to observe.
bool has_formal_order(const MethodCard& card) { return card.id != "odeint:bulirsch-stoer"; }

/// Root mean square error over orbits and components after lambda = 2 in `steps` equal steps.
double error_after(const MethodCard& card, int steps) {
  double sum = 0.0;
  for (const KeplerOrbit& orbit : test::orbits) {
    const auto stepper = stepper_for(card);
    PhaseState<double> y = orbit.at(0.0);
    const double h = 2.0 / steps;
    for (int i = 0; i < steps; ++i) y = stepper->step(y, h).y;
    const double error = test::distance(y, orbit.at(2.0));
    sum += error * error;
  }
  return std::sqrt(sum);
}

/// Steps so small that the leading term rules, so large that round-off does not.
int coarse_steps(const MethodCard& card) {
  return card.order <= 2 ? 400 : card.order <= 4 ? 100 : card.order == 5 ? 160 : card.order == 6 ? 40 : 16;
}

TEST(Methods, have_their_formal_order) {
  for (const MethodCard& card : methods()) {
    if (!has_formal_order(card)) continue;
    const int n = coarse_steps(card);
    const double observed = test::observed_order(error_after(card, n), error_after(card, 2 * n));
    // A tenth where the regime is clean; order 8 has few steps between truncation and round-off.
    EXPECT_NEAR(observed, card.order, card.order < 8 ? 0.1 : 0.35) << card.id;
  }
}

TEST(Methods, have_dense_output_of_their_dense_order) {
  for (const MethodCard& card : methods()) {
    if (!has_formal_order(card)) continue;
    const auto worst = [&](double h) {
      double sum = 0.0;
      for (const KeplerOrbit& orbit : test::orbits) {
        const auto stepper = stepper_for(card);
        (void)stepper->step(orbit.at(0.0), h);
        for (const double theta : {0.2, 0.5, 0.8}) {
          const double error = test::distance(stepper->interpolate(theta), orbit.at(theta * h));
          sum += error * error;
        }
      }
      return std::sqrt(sum);
    };
    const double h = card.dense_order >= 7 ? 0.3 : 0.05;
    // Over one step the error is of one order more. Tao's mean starts with equal copies: one more still.
    const double observed = test::observed_order(worst(h), worst(h / 2)) - 1.0;
    EXPECT_GT(observed, card.dense_order - 0.2) << card.id;
  }
}

TEST(Methods, interpolate_both_ends_of_their_step) {
  for (const MethodCard& card : methods()) {
    const auto stepper = stepper_for(card);
    const PhaseState<double> begin = test::orbits[1].at(0.0);
    const PhaseState<double> end = stepper->step(begin, 0.1).y;
    // Both ends of the interpolant are taken as they are; the last bit may go in sums with zero.
    EXPECT_LT(test::largest_difference(stepper->interpolate(0.0), begin), 1e-15) << card.id;
    EXPECT_LT(test::largest_difference(stepper->interpolate(1.0), end), 1e-15) << card.id;
    EXPECT_EQ(stepper->begin_rate().c, Kepler{}(begin).c) << card.id;
    EXPECT_EQ(stepper->end_rate().c, Kepler{}(end).c) << card.id;
  }
}

TEST(AdaptiveMethods, have_error_estimates_that_shrink_as_they_say) {
  for (const MethodCard& card : methods()) {
    EXPECT_EQ(card.adaptive, card.error_power > 0) << card.id;
    if (!card.adaptive || !has_formal_order(card)) continue;
    const auto estimate = [&](double h) {
      double sum = 0.0;
      for (const KeplerOrbit& orbit : test::orbits) sum += stepper_for(card)->step(orbit.at(0.0), h).error_norm;
      return sum;
    };
    const double h = card.error_power > 5 ? 0.2 : 0.05;
    EXPECT_NEAR(test::observed_order(estimate(h), estimate(h / 2)), card.error_power, 0.25) << card.id;
  }
}

TEST(AdaptiveMethods, measure_errors_in_units_of_the_tolerance) {
  for (const MethodCard& card : methods()) {
    if (!card.adaptive || !has_formal_order(card)) continue;
    const PhaseState<double> y = test::orbits[2].at(0.0);
    const double loose = stepper_for(card, Kepler{}, 1e-6)->step(y, 0.1).error_norm;
    const double tight = stepper_for(card, Kepler{}, 1e-9)->step(y, 0.1).error_norm;
    EXPECT_NEAR(tight / loose, 1000.0, 1e-6) << card.id;
  }
}

TEST(AdaptiveMethods, do_not_grade_components_without_a_tolerance) {
  for (const MethodCard& card : methods()) {
    if (!card.adaptive || !has_formal_order(card)) continue;
    StepperSettings settings;
    settings.error_scale.absolute.fill(std::numeric_limits<double>::infinity());
    EXPECT_EQ(make_stepper(card.id, Kepler{}, settings)->step(test::orbits[0].at(0.0), 0.5).error_norm, 0.0) << card.id;
  }
}

TEST(Methods, take_a_flow_that_gives_no_number_for_no_success) {
  const Flow broken = [](const PhaseState<double>& y) {
    PhaseState<double> rate = Kepler{}(y);
    rate[6] = std::nan("");
    return rate;
  };
  for (const MethodCard& card : methods()) {
    const StepOutcome outcome = stepper_for(card, broken)->step(test::orbits[0].at(0.0), 0.1);
    const bool finite = std::isfinite(outcome.y[6]) && std::isfinite(outcome.y[2]);
    EXPECT_FALSE(finite && outcome.converged && outcome.error_norm <= 1.0) << card.id;
    EXPECT_FALSE(card.adaptive && outcome.error_norm <= 1.0) << card.id;
  }
}

long cost_of_steps(std::string_view id, int steps) {
  const auto stepper = make_stepper(id, Kepler{}, test::settings_with_tolerance(1e-8));
  PhaseState<double> y = test::orbits[0].at(0.0);
  for (int i = 0; i < steps; ++i) y = stepper->step(y, 0.01).y;
  return stepper->evaluations();
}

TEST(Methods, cost_as_many_evaluations_as_their_stages) {
  EXPECT_EQ(cost_of_steps("euler", 10), 10);
  EXPECT_EQ(cost_of_steps("midpoint", 10), 20);
  EXPECT_EQ(cost_of_steps("heun2", 10), 20);
  EXPECT_EQ(cost_of_steps("rk4", 10), 40);
  EXPECT_EQ(cost_of_steps("rkf45", 10), 60);
  EXPECT_EQ(cost_of_steps("dopri54", 10), 61) << "first same as last";
  EXPECT_EQ(cost_of_steps("dop853", 10), 120);
  EXPECT_EQ(cost_of_steps("tao2", 10), 40);
  EXPECT_EQ(cost_of_steps("odeint:dopri5", 10), 61);
  EXPECT_EQ(cost_of_steps("odeint:rkf78", 10), 130);
}

TEST(Methods, begin_a_rejected_step_again_for_nothing) {
  const auto stepper = make_stepper("dopri54", Kepler{}, test::settings_with_tolerance(1e-8));
  const PhaseState<double> y = test::orbits[0].at(0.0);
  (void)stepper->step(y, 0.5);
  const PhaseState<double> again = stepper->step(y, 0.25).y;
  EXPECT_EQ(stepper->evaluations(), 13);
  EXPECT_EQ(again.c, stepper_for(method_card("dopri54"))->step(y, 0.25).y.c);
}

TEST(Methods, repeat_a_step_to_the_bit_whatever_was_tried_between) {
  for (const MethodCard& card : methods()) {
    const auto stepper = stepper_for(card);
    PhaseState<double> y = test::orbits[2].at(0.0);
    for (int i = 0; i < 5; ++i) y = stepper->step(y, 0.05).y;
    const PhaseState<double> once = stepper->step(y, 0.05).y;
    (void)stepper->step(y, 0.02);
    EXPECT_EQ(stepper->step(y, 0.05).y.c, once.c) << card.id;
  }
}

/// After n steps forth and n back, how far from the start.
double reversal_error(const MethodCard& card, double h) {
  const auto stepper = stepper_for(card);
  const PhaseState<double> start = test::orbits[2].at(0.0);
  PhaseState<double> y = start;
  for (int i = 0; i < 20; ++i) y = stepper->step(y, h).y;
  for (int i = 0; i < 20; ++i) y = stepper->step(y, -h).y;
  return test::largest_difference(y, start);
}

TEST(SymplecticMethods, retrace_their_steps_to_round_off) {
  for (const MethodCard& card : methods()) {
    if (!card.symplectic) continue;
    // 40 steps, each with a few roundings of numbers of size 1, stretched by the shear of the orbit (about 3 per turn).
    EXPECT_LT(reversal_error(card, 0.1), 2e-13) << card.id;
  }
}

TEST(OtherMethods, do_not_retrace_their_steps) {
  for (const char* id : {"euler", "midpoint", "heun2", "rk4", "rkf45", "dopri54"}) {
    EXPECT_GT(reversal_error(method_card(id), 0.1), 1e-9) << id;
  }
}

TEST(DormandPrince, agrees_with_odeint_step_by_step) {
  const auto ours = make_stepper("dopri54", Kepler{}, test::settings_with_tolerance(1e-8));
  const auto theirs = make_stepper("odeint:dopri5", Kepler{}, test::settings_with_tolerance(1e-8));
  for (const KeplerOrbit& orbit : test::orbits) {
    for (const double h : {0.01, 0.1, 0.4}) {
      const PhaseState<double> y = orbit.at(1.0);
      const StepOutcome a = ours->step(y, h);
      const StepOutcome b = theirs->step(y, h);
      // Sums of seven terms of size h |f| < 1 in another order: a few units in the last place.
      EXPECT_LT(test::largest_difference(a.y, b.y), 2e-15) << h;
      // The estimate is a small difference of such sums, in units of tol = 1e-8.
      EXPECT_NEAR(a.error_norm, b.error_norm, 1e-15 / 1e-8 + 1e-12 * b.error_norm) << h;
      EXPECT_LT(test::largest_difference(ours->end_rate(), theirs->end_rate()), 1e-14) << h;
    }
  }
}

TEST(BulirschStoer, keeps_an_accepted_step_within_the_tolerance) {
  const auto stepper = make_stepper("odeint:bulirsch-stoer", Kepler{}, test::settings_with_tolerance(1e-9));
  PhaseState<double> y = test::orbits[2].at(0.0);
  double lambda = 0.0;
  double h = 0.1;
  int accepted = 0;
  while (lambda < 6.0 && accepted < 1000) {
    const StepOutcome outcome = stepper->step(y, h);
    if (outcome.error_norm <= 1.0) {
      y = outcome.y;
      lambda += h;
      ++accepted;
    }
    h = outcome.next_step;
  }
  EXPECT_LT(accepted, 60);
  // A dozen steps of 1e-9 each, stretched by the orbit.
  EXPECT_LT(test::largest_difference(y, test::orbits[2].at(lambda)), 1e-7);
}

TEST(StepControl, takes_roots_by_square_roots) {
  EXPECT_EQ(inverse_root(256.0, 8), 0.5) << "x^(-1/8)";
  EXPECT_EQ(inverse_root(65536.0, 5), 0.125) << "x^(-3/16), near x^(-1/5)";
}

TEST(StepControl, shortens_and_lengthens_within_bounds) {
  EXPECT_NEAR(step_factor(1.0, 5), 0.9, 1e-15);
  EXPECT_NEAR(step_factor(1.0 / 256.0, 8), 1.8, 1e-15);
  EXPECT_EQ(step_factor(1e30, 5), 0.2);
  EXPECT_EQ(step_factor(0.0, 5), 5.0);
  EXPECT_EQ(step_factor(std::nan(""), 5), 0.1);
  EXPECT_EQ(step_factor(std::numeric_limits<double>::infinity(), 8), 0.1);
}

TEST(StepControl, foresees_errors_that_grow_and_ignores_those_that_fall) {
  // With equal steps whose errors grow from 0.1 to 0.4 the next is foreseen to be 1.6: shorter by 1.6^(-1/8) than the
  // safety factor alone.
  const auto last = StepMemory<double>::of(2.0, 0.1);
  EXPECT_NEAR(step_factor_foreseen(2.0, 0.4, last, 8), 0.9 * std::pow(1.6, -1.0 / 8.0), 1e-15);
  // The same error from a step half as long as the last: twice as much of it a length, so half as long again.
  EXPECT_NEAR(step_factor_foreseen(1.0, 0.1, last, 8), 0.5 * 0.9 * std::pow(0.1, -1.0 / 8.0), 1e-15);
  // Errors that fall, and a first step, are left to the plain controller.
  EXPECT_EQ(step_factor_foreseen(2.0, 0.05, last, 8), step_factor(0.05, 8));
  EXPECT_EQ(step_factor_foreseen(2.0, 0.4, StepMemory<double>{}, 8), step_factor(0.4, 8));
}

TEST(StepControl, begins_with_a_step_that_is_accepted) {
  for (const double tol : {1e-4, 1e-8, 1e-12}) {
    const PhaseState<double> y = test::orbits[2].at(0.0);
    const ErrorScale scale = test::settings_with_tolerance(tol).error_scale;
    const double h = initial_step(Kepler{}, scale, y, Kepler{}(y), 5);
    const double error = stepper_for(method_card("dopri54"), Kepler{}, tol)->step(y, h).error_norm;
    EXPECT_LE(error, 1.0) << tol;
    EXPECT_GT(error, 1e-6) << tol << ": not wastefully short";
  }
}

TEST(MakeStepper, names_the_nearest_method) {
  try {
    (void)make_stepper("dopri45", Kepler{}, {});
    FAIL() << "no exception";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("dopri54"), std::string::npos) << error.what();
  }
}

TEST(TaoStepper, refuses_a_coupling_that_is_not_positive) {
  StepperSettings settings;
  settings.tao_omega = 0.0;
  EXPECT_THROW((void)make_stepper("tao2", Kepler{}, settings), std::invalid_argument);
}

}  // namespace
}  // namespace xpr
