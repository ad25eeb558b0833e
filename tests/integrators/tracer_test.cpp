// The tracer: every status, stops and events located exactly, orders and tolerances kept through them.
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "integrators/root.hpp"
#include "rays.hpp"

namespace xpr {
namespace {

using test::isotropic_ray;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TraceSettings with_method(std::string_view method, double tol = 1e-10, double step = 0.01) {
  TraceSettings settings;
  settings.method = method;
  settings.tol = tol;
  settings.step = step;
  return settings;
}

std::unique_ptr<Spacetime> flat() { return make_spacetime("minkowski", "cartesian"); }
std::unique_ptr<Spacetime> schwarzschild() { return make_spacetime("schwarzschild", "isotropic"); }

TEST(BracketedRoot, finds_roots_to_the_last_places) {
  const auto cubic = [](double x) { return x * x * x - 2.0; };
  // The root is exact to the bracket's 4 units in the last place.
  EXPECT_NEAR(bracketed_root(cubic, 0.0, 2.0, -2.0, 6.0), std::cbrt(2.0), 2e-15);
  const auto steep = [](double x) { return x < 1e-9 ? -1.0 : 1e-3; };
  EXPECT_NEAR(bracketed_root(steep, 0.0, 1.0, -1.0, 1e-3), 1e-9, 1e-23);
  int calls = 0;
  const auto counted = [&](double x) { return ++calls, std::sin(x); };
  EXPECT_NEAR(bracketed_root(counted, 3.0, 3.5, std::sin(3.0), std::sin(3.5)), std::numbers::pi, 2e-15);
  EXPECT_LT(calls, 12);
}

TEST(TraceRay, goes_straight_in_flat_space_and_stops_on_the_sphere) {
  const auto space = flat();
  for (const MethodCard& card : methods()) {
    TraceSettings settings = with_method(card.id, 1e-10, 0.5);
    settings.r_max = 100.0;
    const PhaseState<double> start = isotropic_ray(*space, {0.0, -3.0, 4.0, 1.0}, {0.0, 0.6, 0.8, 0.0});
    const RayEnd end = trace_ray(*space, start, 1, settings);
    EXPECT_EQ(end.status, Status::escaped) << card.id;
    // x(s) = x_0 + s v on |x| = 100: s^2 + 2 (x_0 . v) s + |x_0|^2 - 100^2 = 0 with x_0 . v = 1.4, |x_0|^2 = 26.
    const double s = -1.4 + std::sqrt(1.4 * 1.4 - 26.0 + 1e4);
    // Round-off of numbers of size 100 over 200 steps of up to a dozen additions: 2400 times 7e-15 at the very worst.
    EXPECT_NEAR(end.lambda, s, 1e-12) << card.id;
    EXPECT_NEAR(end.y[1], -3.0 + 0.6 * s, 5e-12) << card.id;
    EXPECT_NEAR(end.y[2], 4.0 + 0.8 * s, 5e-12) << card.id;
    EXPECT_NEAR(end.y[0], s, 5e-12) << card.id;
  }
}

TEST(TraceRay, ends_in_every_status) {
  const auto hole = schwarzschild();
  const auto space = flat();
  const PhaseState<double> inward = isotropic_ray(*hole, {0.0, -50.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 0.0});
  const PhaseState<double> passing = isotropic_ray(*hole, {0.0, -50.0, 10.0, 0.0}, {0.0, 1.0, 0.0, 0.0});
  TraceSettings settings;
  settings.r_min = 2.1;
  settings.r_max = 60.0;
  const auto status = [&](const Spacetime& s, const PhaseState<double>& y, const TraceSettings& t,
                          std::span<const Event> events = {}) { return trace_ray(s, y, 1, t, events).status; };
  EXPECT_EQ(status(*hole, inward, settings), Status::captured);
  EXPECT_EQ(status(*hole, passing, settings), Status::escaped);

  const Event wall{.name = "wall",
                   .g = [](const Spacetime&, const PhaseState<double>& y, int) { return y[1] + 20.0; },
                   .terminal = true,
                   .status = Status::hit};
  EXPECT_EQ(status(*hole, passing, settings, std::span(&wall, 1)), Status::hit);

  const auto wormhole = make_spacetime("ellis", "proper-distance");
  TraceSettings through;
  through.l_min = -30.0;
  through.l_max = 30.0;
  const PhaseState<double> falling{{0.0, 20.0, std::numbers::pi / 2, 0.0}, {-1.0, -1.0, 0.0, 0.0}};
  EXPECT_EQ(status(*wormhole, falling, through), Status::crossed);

  TraceSettings few = settings;
  few.max_steps = 3;
  EXPECT_EQ(status(*hole, passing, few), Status::max_steps);
  TraceSettings brief = settings;
  brief.lambda_max = 1.0;
  const RayEnd at_limit = trace_ray(*hole, passing, 1, brief);
  EXPECT_EQ(at_limit.status, Status::max_affine);
  EXPECT_EQ(at_limit.lambda, 1.0);

  PhaseState<double> broken = passing;
  broken[6] = nan;
  EXPECT_EQ(status(*hole, broken, settings), Status::not_finite);
  // The implicit iteration does not settle with a step of most of a turn.
  TraceSettings huge = with_method("gl4", 1e-10, 5.0);
  huge.max_steps = 10;
  const auto medium = test::fisheye();
  EXPECT_EQ(status(*medium, test::fisheye_rays(*medium)[0], huge), Status::step_underflow);

  const PhaseState<double> outside{{0.0, nan, 0.0, 0.0}, {-1.0, 1.0, 0.0, 0.0}};
  EXPECT_EQ(status(*space, outside, settings), Status::not_finite);
  const auto areal = make_spacetime("schwarzschild", "areal");
  const PhaseState<double> below{{0.0, -1.0, std::numbers::pi / 2, 0.0}, {-1.0, 1.0, 0.0, 0.0}};
  EXPECT_EQ(status(*areal, below, settings), Status::outside_domain);

  // Coarse Euler steps leave the cone for good.
  TraceSettings coarse = with_method("euler", 1e-10, 0.5);
  EXPECT_EQ(status(*medium, test::fisheye_rays(*medium)[0], coarse), Status::constraint_violated);
}

TEST(TraceRay, ends_inside_the_domain_when_the_path_leaves_it) {
  // Inside the horizon r = 1 - lambda on this ray, and the chart ends at r = 0.
  const auto areal = make_spacetime("schwarzschild", "areal");
  const PhaseState<double> inward{{0.0, 1.0, std::numbers::pi / 2, 0.0}, {-1.0, 1.0, 0.0, 0.0}};
  const RayEnd end = trace_ray(*areal, inward, 1, with_method("rk4", 1e-8, 0.013));
  EXPECT_EQ(end.status, Status::outside_domain);
  EXPECT_TRUE(areal->inside_domain(end.y.x()));
  // The last step's stages lie on both sides of the singularity; the interpolant through its ends is good to this.
  EXPECT_NEAR(end.lambda, 1.0, 1e-5);
  EXPECT_NEAR(end.y[1], 0.0, 1e-12);
}

TEST(TraceRay, treats_a_start_beyond_a_stop_by_where_it_goes) {
  const auto space = flat();
  TraceSettings settings;
  settings.r_max = 10.0;
  const auto trace = [&](double x, double y, double direction) {
    return trace_ray(*space, isotropic_ray(*space, {0.0, x, y, 0.0}, {0.0, direction, 0.0, 0.0}), 1, settings);
  };
  const RayEnd gone = trace(20.0, 0.0, 1.0);
  EXPECT_EQ(gone.status, Status::escaped);
  EXPECT_EQ(gone.lambda, 0.0);
  const RayEnd through = trace(20.0, 0.0, -1.0);
  EXPECT_EQ(through.status, Status::escaped);
  EXPECT_NEAR(through.y[1], -10.0, 1e-13) << "in at +10, out at -10";
  EXPECT_EQ(trace(10.0, 0.0, 1.0).lambda, 0.0);
  EXPECT_NEAR(trace(10.0, 0.0, -1.0).y[1], -10.0, 1e-13);
  EXPECT_EQ(trace(20.0, 15.0, -1.0).status, Status::escaped) << "never inside: escaped once it goes outward";
  settings.r_max.reset();
  settings.r_min = 5.0;
  EXPECT_EQ(trace(3.0, 0.0, -1.0).status, Status::captured);
}

/// g = |x| - radius.
Event ball(double radius) {
  return {.name = "ball", .g = [radius](const Spacetime& chart, const PhaseState<double>& y, int) {
            return chart.radius(y.x()) - radius;
          }};
}

TEST(Events, are_found_twice_within_one_step) {
  const auto space = flat();
  const double b = 0.6;
  const PhaseState<double> start = isotropic_ray(*space, {0.0, -500.0, b, 0.0}, {0.0, 1.0, 0.0, 0.0});
  const Event unit_ball = ball(1.0);
  for (const MethodCard& card : methods()) {
    // One step of 1000 across a ball of radius 1.
    TraceSettings settings = with_method(card.id, 1e-10, 1000.0);
    settings.lambda_max = 1000.0;
    const RayEnd end = trace_ray(*space, start, 1, settings, std::span(&unit_ball, 1));
    ASSERT_EQ(end.hits.size(), 2U) << card.id;
    EXPECT_NEAR(end.hits[0].y[1], -0.8, 1e-12) << card.id;
    EXPECT_NEAR(end.hits[1].y[1], 0.8, 1e-12) << card.id;
    EXPECT_NEAR(end.hits[0].lambda, 499.2, 1e-12) << card.id;
  }
}

TEST(Events, are_found_when_the_ray_grazes_and_not_when_it_misses) {
  const auto space = flat();
  const Event unit_ball = ball(1.0);
  const auto hits = [&](double b) {
    const PhaseState<double> start = isotropic_ray(*space, {0.0, -7.0, b, 0.0}, {0.0, 1.0, 0.0, 0.0});
    TraceSettings settings;
    settings.lambda_max = 14.0;
    return trace_ray(*space, start, 1, settings, std::span(&unit_ball, 1)).hits;
  };
  // A chord of half-length sqrt(2e-9): the dip of |x| - 1 below zero is 1e-9.
  const auto grazing = hits(1.0 - 1e-9);
  ASSERT_EQ(grazing.size(), 2U);
  // The location is as ill-conditioned as sqrt: round-off 1e-16 of |x| over a slope of 4.5e-5.
  EXPECT_NEAR(grazing[1].y[1], std::sqrt(2e-9 - 1e-18), 1e-10);
  EXPECT_TRUE(hits(1.0 + 1e-9).empty());
}

TEST(Events, keep_to_their_direction) {
  const auto space = flat();
  const PhaseState<double> start = isotropic_ray(*space, {0.0, -5.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 0.0});
  for (const int direction : {-1, +1}) {
    Event one_way = ball(1.0);
    one_way.direction = direction;
    TraceSettings settings;
    settings.lambda_max = 10.0;
    const RayEnd end = trace_ray(*space, start, 1, settings, std::span(&one_way, 1));
    ASSERT_EQ(end.hits.size(), 1U);
    EXPECT_NEAR(end.hits[0].y[1], direction, 1e-13);
  }
}

TEST(Events, before_the_end_are_reported_in_order_and_none_after) {
  const auto space = flat();
  const PhaseState<double> start = isotropic_ray(*space, {0.0, -5.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 0.0});
  std::vector<Event> events;
  for (const double x : {3.0, -2.0, 1.0}) {
    events.push_back(
        {.name = "plane", .g = [x](const Spacetime&, const PhaseState<double>& y, int) { return y[1] - x; }});
  }
  events[2].terminal = true;
  const RayEnd end = trace_ray(*space, start, 1, {}, events);
  EXPECT_EQ(end.status, Status::crossed);
  ASSERT_EQ(end.hits.size(), 2U);
  EXPECT_EQ(end.hits[0].event, 1U);
  EXPECT_EQ(end.hits[1].event, 2U);
  EXPECT_NEAR(end.y[1], 1.0, 1e-14);
  EXPECT_EQ(end.lambda, end.hits[1].lambda);
}

TEST(Events, are_met_by_every_method_at_its_own_order) {
  const auto medium = test::fisheye();
  for (const MethodCard& card : methods()) {
    if (card.adaptive) continue;
    // The turn ends in the middle of a step, whatever the step.
    const double h = card.order >= 6 ? 0.11 : card.order >= 4 ? 0.05 : 0.01;
    const double coarse = test::turn_error(*medium, with_method(card.id, 1e-10, h));
    const double fine = test::turn_error(*medium, with_method(card.id, 1e-10, h / 2));
    EXPECT_GT(std::log2(coarse / fine), card.order - 0.15) << card.id << " " << coarse << " " << fine;
  }
}

TEST(Tolerance, is_proportional_to_error) {
  const auto medium = test::fisheye();
  for (const MethodCard& card : methods()) {
    if (!card.adaptive) continue;
    // A turn ends where t = 2 pi: errors of t, which the norm leaves out unless asked, would be errors of the end.
    TraceSettings settings = with_method(card.id, 1e-6);
    settings.grade_time = true;
    const double loose = test::turn_error(*medium, settings);
    settings.tol = 1e-11;
    const double tight = test::turn_error(*medium, settings);
    // Five decades of tolerance. The estimate is of the lower order, so the error may fall a little faster.
    EXPECT_NEAR(std::log10(loose / tight) / 5.0, 1.0, 0.2) << card.id << " " << loose << " " << tight;
    EXPECT_LT(tight, 1e-9) << card.id;
  }
}

TEST(Interfaces, keep_the_order_of_every_method) {
  const auto lens = make_spacetime("luneburg", "cartesian");
  const PhaseState<double> start{{0.0, -2.0, 0.5, 0.2}, {-1.0, 1.0, 0.0, 0.0}};
  const Event focal_plane{.name = "focal plane",
                          .g = [](const Spacetime&, const PhaseState<double>& y, int) { return y[1] - 1.0; },
                          .terminal = true};
  for (const MethodCard& card : methods()) {
    if (card.adaptive) continue;
    // Parallel light meets on the far rim.
    const auto miss = [&](double h) {
      const RayEnd end = trace_ray(*lens, start, 1, with_method(card.id, 1e-10, h), std::span(&focal_plane, 1));
      return std::hypot(end.y[2], end.y[3]);
    };
    const double coarse = miss(0.02);
    const double fine = miss(0.0025);
    // Three halvings, so that where the rim falls in a step averages out; gl6 is at round-off from the start.
    EXPECT_TRUE(std::log2(coarse / fine) / 3.0 > card.order - 0.35 || fine < 1e-13) << card.id << " " << coarse << fine;
  }
}

TEST(Windings, are_counted_with_their_sign) {
  const auto medium = test::fisheye();
  for (const double sense : {+1.0, -1.0}) {
    const PhaseState<double> start = isotropic_ray(*medium, {0.0, 1.0, 0.0, 0.0}, {0.0, 0.1, sense, 0.0});
    TraceSettings settings;
    const Event turns{
        .name = "three turns",
        .g = [](const Spacetime&, const PhaseState<double>& y, int) { return y[0] - 6.0 * std::numbers::pi; },
        .terminal = true};
    EXPECT_EQ(trace_ray(*medium, start, 1, settings, std::span(&turns, 1)).windings, static_cast<int>(3 * sense));
  }
}

TEST(Atlas, carries_a_ray_through_the_throat) {
  const auto wormhole = make_spacetime("ellis", "isotropic");
  const PhaseState<double> start = isotropic_ray(*wormhole, {0.0, 20.0, 0.0, 0.0}, {0.0, -1.0, 0.02, 0.0});
  TraceSettings settings;
  settings.l_min = -30.0;
  for (const char* method : {"dopri54", "dop853", "gl6"}) {
    settings.method = method;
    settings.step = 0.05;
    const RayEnd end = trace_ray(*wormhole, start, 1, settings);
    EXPECT_EQ(end.status, Status::crossed) << method;
    EXPECT_EQ(end.sheet, -1) << method;
    EXPECT_NEAR(end.chart->proper_distance(end.y.x(), end.sheet).value(), -30.0, 1e-9) << method;
    // L_z = x p_y - y p_x is the same on both sides, to the tolerance times the lever arm.
    const double before = start[1] * start[6] - start[2] * start[5];
    EXPECT_NEAR(end.y[1] * end.y[6] - end.y[2] * end.y[5], before, 1e-7) << method;
  }
}

TEST(Observer, sees_every_step_and_the_path_between) {
  const auto medium = test::fisheye();
  const PhaseState<double> start = test::fisheye_rays(*medium)[0];
  const Event turn = test::one_turn();
  for (const char* method : {"dopri54", "dop853", "gl6", "rk4"}) {
    int seen = 0;
    double reached = 0.0;
    PhaseState<double> last = start;
    const RayEnd end =
        trace_ray(*medium, start, 1, with_method(method, 1e-10, 0.05), std::span(&turn, 1), [&](const StepView& step) {
          ++seen;
          EXPECT_EQ(step.begin.c, last.c) << method;
          EXPECT_NEAR(step.lambda - step.h, reached, 1e-14) << method;
          for (std::size_t i = 0; i < 8; ++i) {
            EXPECT_NEAR(step.at(0.0)[i], step.begin[i], 1e-14) << method;
            EXPECT_NEAR(step.at(1.0)[i], step.end[i], 1e-14) << method;
          }
          last = step.end;
          reached = step.lambda;
        });
    EXPECT_EQ(seen, end.steps) << method;
    EXPECT_EQ(last.c, end.y.c) << method;
  }
}

TEST(TraceRay, takes_a_planted_stepper_from_its_factory) {
  const auto medium = test::fisheye();
  TraceSettings settings;
  int made = 0;
  settings.stepper_factory = [&](std::string_view, const Flow& flow, const StepperSettings& s) {
    ++made;
    return make_stepper("rkf45", flow, s);
  };
  (void)test::turn_error(*medium, settings);
  EXPECT_EQ(made, 3);
}

TEST(TraceRay, gives_the_same_bits_again) {
  const auto hole = make_spacetime("kerr", "kerr-schild");
  const PhaseState<double> start{{0.0, 30.0, 5.0, 2.0}, {-1.0, -0.9, 0.1, 0.05}};
  for (const MethodCard& card : methods()) {
    if (card.separable_only) continue;
    TraceSettings settings = with_method(card.id, 1e-8, 0.1);
    settings.lambda_max = 20.0;
    EXPECT_EQ(trace_ray(*hole, start, 1, settings).y.c, trace_ray(*hole, start, 1, settings).y.c) << card.id;
  }
}

TEST(TraceRay, refuses_settings_that_make_no_sense) {
  const auto space = flat();
  const PhaseState<double> y = isotropic_ray(*space, {0.0, 1.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 0.0});
  const auto trace = [&](const TraceSettings& settings) { (void)trace_ray(*space, y, 1, settings); };
  EXPECT_THROW(trace(with_method("dopri5")), std::invalid_argument);
  EXPECT_THROW(trace(with_method("dopri54", 0.0)), std::invalid_argument);
  EXPECT_THROW(trace(with_method("dopri54", nan)), std::invalid_argument);
  EXPECT_THROW(trace(with_method("rk4", 1e-8, -0.1)), std::invalid_argument);
  TraceSettings negative;
  negative.max_steps = -1;
  EXPECT_THROW(trace(negative), std::invalid_argument);
  const auto hole = schwarzschild();
  EXPECT_THROW((void)trace_ray(*hole, y, 1, with_method("verlet")), std::invalid_argument) << "does not separate";
}

TEST(ErrorScale, grades_lengths_angles_and_momenta_in_their_units) {
  const auto areal = make_spacetime("schwarzschild", "areal");
  TraceSettings settings = with_method("dopri54", 1e-8);
  settings.length_unit = 3.0;
  const PhaseState<double> y{{0.0, 10.0, 1.0, 0.0}, {-2.0, 1.0, 0.5, 0.1}};
  const ErrorScale scale = error_scale(*areal, y, settings);
  EXPECT_TRUE(std::isinf(scale.absolute[0])) << "t is not graded";
  EXPECT_EQ(scale.absolute[1], 1e-8 * 3.0);
  EXPECT_EQ(scale.relative[1], 1e-8);
  EXPECT_EQ(scale.absolute[2], 1e-8);
  EXPECT_EQ(scale.relative[2], 0.0);
  EXPECT_EQ(scale.absolute[5], 1e-8 * 2.0);
  EXPECT_EQ(scale.absolute[6], 1e-8 * (2.0 * 3.0));
  EXPECT_EQ(scale.relative[6], 0.0);
  settings.grade_time = true;
  EXPECT_EQ(error_scale(*areal, y, settings).absolute[0], 1e-8 * 3.0);
}

TEST(Status, has_a_name_for_each_value) {
  for (std::size_t i = 0; i < status_names.size(); ++i) {
    EXPECT_EQ(to_string(static_cast<Status>(i)), status_names[i]);
    EXPECT_EQ(status_from_name(status_names[i]), static_cast<Status>(i));
  }
  EXPECT_FALSE(status_from_name("lost").has_value());
}

}  // namespace
}  // namespace xpr
