// First integrals in Mino time against everything that knows better: the Hamiltonian flow, and closed forms.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>

#include "first_integral_rays.hpp"
#include "integrators/tracer.hpp"
#include "metrics/catalogue.hpp"
#include "metrics/kerr_exact.hpp"
#include "metrics/kerr_ray_exact.hpp"
#include "metrics/schwarzschild.hpp"
#include "metrics/schwarzschild_exact.hpp"
#include "metrics/separable_charts.hpp"

namespace xpr {
namespace {

using test::angle_between;
using test::Dice;
using test::equatorial;
using test::kerr;
using test::screen_rays;
using test::settings_of;
using test::trace_one;

constexpr double turn = 2.0 * std::numbers::pi;

TEST(SeparatedLight, has_carters_radial_potential) {
  Dice dice;
  for (int i = 0; i < 200; ++i) {
    const double M = dice.between(0.5, 2.0), a = dice.between(-M, M), r = dice.between(1.0, 50.0);
    const double lambda = dice.between(-10.0, 10.0), eta = dice.between(-1.0, 60.0);
    const SeparatedPotentials p = separated_potentials(KerrParameters{.M = M, .a = a}.separated(), lambda, eta);
    const double expected = kerr_exact::radial_potential(M, a, {1.0, lambda, eta}, r);
    // Round-off of the largest terms, r^4 and r^2 (eta + lambda^2), in a dozen operations.
    const double size = std::pow(r, 4) + r * r * (60.0 + 100.0) + 2.0 * M * r * 200.0;
    EXPECT_NEAR(std::pow(r, 4) * p.radial(1.0 / r), expected, 4e-15 * size);
    // u'' = U'/2, by a central difference: h^2 U'''/12 and round-off / h are both below 1e-7 here.
    const double u = 1.0 / r, h = 1e-6;
    EXPECT_NEAR(p.radial_force(u), (p.radial(u + h) - p.radial(u - h)) / (4.0 * h), 1e-7);
  }
}

TEST(SeparatedCharts, come_back_from_every_chart) {
  Dice dice;
  for (const char* name : {"kerr-schild", "kerr-schild-outgoing", "boyer-lindquist"}) {
    const auto spacetime = make_spacetime("kerr", name, std::array{NamedValue{"a", 0.9}});
    const auto chart = separated_chart(*spacetime);
    ASSERT_TRUE(chart);
    for (const SeparatedState& ray : screen_rays(chart->light, 200, dice)) {
      const PhaseState<double> y = phase_state(*chart, ray, 0.7);
      EXPECT_LT(spacetime->null_residual(y), 1e-13) << name;
      EXPECT_EQ(y[4], -0.7 * ray.energy_sign);
      const SeparatedState back = separated_state(*chart, y);
      EXPECT_EQ(back.energy_sign, ray.energy_sign);
      // Components up to 1000 hold lengths of up to 12 to 1e-13; eta is a square of such.
      EXPECT_NEAR(back.lambda, ray.lambda, 4e-13);
      EXPECT_NEAR(back.eta, ray.eta, 1e-11);
      EXPECT_NEAR(back.u, ray.u, 1e-15);
      EXPECT_NEAR(back.u_rate, ray.u_rate, 4e-14);
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(back.n[i], ray.n[i], 2e-15) << name;
        EXPECT_NEAR(back.n_rate[i], ray.n_rate[i], 1e-12) << name;
      }
    }
  }
  EXPECT_FALSE(separated_chart(*make_spacetime("schwarzschild", "isotropic")));
  EXPECT_FALSE(separated_chart(*make_spacetime("ellis", "isotropic")));
}

/// What a Hamiltonian trace in a Kerr-Schild chart says about the same ray, in Boyer-Lindquist terms.
struct HamiltonianEnd {
  Status status;
  SeparatedState state;
  double swept_azimuth;
  double affine;
};

HamiltonianEnd trace_hamiltonian(const Spacetime& spacetime, const SeparatedChart& chart, const SeparatedState& ray,
                                 const FirstIntegralSettings& settings) {
  TraceSettings trace;
  trace.method = "dop853";
  trace.tol = 1e-14;
  trace.grade_time = true;
  trace.r_min = settings.r_min;
  trace.r_max = settings.r_max;
  const PhaseState<double> start = phase_state(chart, ray);
  const RayEnd end = trace_ray(spacetime, start, 1, trace);
  const double s = chart.kind == SeparatedChart::Kind::kerr_schild_ingoing ? 1.0 : -1.0;
  const auto offset = [&](const PhaseState<double>& y) {
    const double r = spacetime.radius(y.x());
    const KerrParameters hole = kerr(chart.light.spin);
    return std::atan2(y[2], y[1]) - std::atan2(s * chart.light.spin, r) - s * kerr_shift(hole, r).azimuth;
  };
  return {end.status, separated_state(chart, end.y), offset(end.y) - offset(start) + turn * end.windings, end.lambda};
}

/// How much closer than a tolerance two traces are: neighbouring rays part by this much for a change of 1 in lambda.
double condition(const SeparatedLight& light, const SeparatedState& ray, const FirstIntegralSettings& settings) {
  SeparatedState near = ray;
  const double h = 1e-7;
  const double c = std::hypot(ray.n[0], ray.n[1]);
  try {
    near = separated_start(light, ray.lambda + h, ray.eta, ray.energy_sign, ray.u, std::atan2(c, ray.n[2]),
                           ray.u_rate < 0.0, ray.n_rate[2] * ray.n[2] < 0.0 ? true : ray.n_rate[2] < 0.0);
  } catch (const std::domain_error&) {
    return 1e3;
  }
  const FirstIntegralEnd end = trace_one(light, ray, settings), moved = trace_one(light, near, settings);
  return std::abs(end.swept_azimuth - moved.swept_azimuth) / h;
}

TEST(FirstIntegrals, agree_with_the_hamiltonian_flow) {
  Dice dice;
  int traced = 0;
  for (const double a : {0.0, 0.6, 0.9, -0.9, 1.0}) {
    const SeparatedLight light = kerr(a).separated();
    for (const char* name : {"kerr-schild", "kerr-schild-outgoing"}) {
      const auto spacetime = make_spacetime("kerr", name, std::array{NamedValue{"a", a}});
      const SeparatedChart chart = *separated_chart(*spacetime);
      const bool ingoing = chart.kind == SeparatedChart::Kind::kerr_schild_ingoing;
      for (const SeparatedState& ray : screen_rays(light, 60, dice)) {
        // Each chart is regular for rays of one direction in time.
        if ((ray.energy_sign > 0.0) != ingoing) continue;
        FirstIntegralSettings settings = settings_of(kerr(a), 1000.5);
        settings.r_min = std::max(settings.r_min, 1.01);
        const HamiltonianEnd expected = trace_hamiltonian(*spacetime, chart, ray, settings);
        const FirstIntegralEnd end = trace_one(light, ray, settings);
        const double error = 1e-11 * std::max(1.0, condition(light, ray, settings));
        SCOPED_TRACE(fmt::format("a {} lambda {} eta {} r {} n_z {}", a, ray.lambda, ray.eta, 1.0 / ray.u, ray.n[2]));
        EXPECT_EQ(end.status, expected.status);
        // Specification I5: 1e-11, for rays whose own condition does not magnify the Hamiltonian's tolerance.
        EXPECT_NEAR(end.state.u, expected.state.u, 1e-13);
        EXPECT_LT(angle_between(end.state.n, expected.state.n), error);
        EXPECT_NEAR(end.swept_azimuth, expected.swept_azimuth, error);
        // t and the affine length grow to 2000; the tolerance is relative.
        EXPECT_NEAR(end.state.t, expected.state.t, 20.0 * error);
        EXPECT_NEAR(end.affine, expected.affine, 20.0 * error);
        ++traced;
      }
    }
  }
  EXPECT_GT(traced, 200);
}

/// The same ray for the closed form.
kerr_exact::KerrRay closed_form(double a, const SeparatedState& ray) {
  const double sine = std::hypot(ray.n[0], ray.n[1]);
  return {kerr_exact::RayHole{1.0, a},
          kerr_exact::RayMomentum{.r = 1.0 / ray.u,
                                  .theta = std::atan2(sine, ray.n[2]),
                                  .lambda = ray.lambda,
                                  .p_theta = (ray.n[0] * ray.n_rate[0] * ray.n[2] - sine * sine * ray.n_rate[2]) / sine,
                                  .radial_sign = ray.u_rate < 0.0 ? 1 : -1}};
}

TEST(FirstIntegrals, end_where_the_closed_form_says) {
  Dice dice;
  double worst_direction = 0.0, worst_azimuth = 0.0, worst_time = 0.0, worst_affine = 0.0;
  int escaped = 0, rays = 0;
  for (const double a : {0.0, 0.3, 0.9, 0.998, 1.0}) {
    const SeparatedLight light = kerr(a).separated();
    for (const SeparatedState& ray : screen_rays(light, 400, dice)) {
      FirstIntegralSettings settings = settings_of(kerr(a), 1000.5, 1e-13);
      settings.r_min = std::max(settings.r_min, 1.01);
      const FirstIntegralEnd end = trace_one(light, ray, settings);
      const kerr_exact::Arrival truth = closed_form(a, ray).at_end(1000.5, settings.r_min);
      SCOPED_TRACE(fmt::format("a {} lambda {} eta {} r {} n_z {}", a, ray.lambda, ray.eta, 1.0 / ray.u, ray.n[2]));
      ASSERT_TRUE(truth.reached);
      EXPECT_EQ(end.status, truth.fate == kerr_exact::Fate::escaped ? Status::escaped : Status::captured);
      // The closed form is of light that goes forward; traced back, azimuth and time are the negatives of its.
      const double e = ray.energy_sign;
      const std::array<double, 3> forward = truth.direction();
      const double direction = angle_between(end.state.n, {forward[0], e * forward[1], forward[2]});
      worst_direction = std::max(worst_direction, direction - truth.direction_error);
      worst_azimuth = std::max(worst_azimuth, std::abs(end.swept_azimuth - e * truth.phi.value) - truth.phi.error);
      worst_time = std::max(worst_time, std::abs(end.state.t - e * truth.time.value) - truth.time.error);
      worst_affine = std::max(worst_affine, std::abs(end.affine - truth.affine.value) - truth.affine.error);
      ++rays;
      escaped += end.status == Status::escaped ? 1 : 0;
    }
  }
  EXPECT_GT(rays, 1500);
  EXPECT_GT(escaped, 500);
  // The tolerance is 1e-13 a step; t and the affine length are of size 2000, and t has poles next to the horizon.
  EXPECT_LT(worst_direction, 1e-11);
  EXPECT_LT(worst_azimuth, 1e-11);
  EXPECT_LT(worst_time, 1e-9);
  EXPECT_LT(worst_affine, 1e-9);
  RecordProperty("worst_direction", fmt::format("{:.1e}", worst_direction));
  RecordProperty("worst_azimuth", fmt::format("{:.1e}", worst_azimuth));
  RecordProperty("worst_time", fmt::format("{:.1e}", worst_time));
  RecordProperty("worst_affine", fmt::format("{:.1e}", worst_affine));
}

/// Rays from anywhere outside the horizon, either way, near the axis and vortical ones (eta < 0) among them.
std::vector<SeparatedState> rays_from_anywhere(const KerrParameters& hole, double r_min, int count, Dice& dice) {
  const SeparatedLight light = hole.separated();
  std::vector<SeparatedState> rays;
  for (int i = 0; i < count; ++i) {
    const double r = i % 2 == 0 ? std::pow(10.0, dice.between(std::log10(1.01 * r_min), 3.0))
                                : r_min + std::pow(10.0, dice.between(-3.0, 0.5));
    double theta = std::acos(dice.between(-1.0, 1.0));
    if (i % 3 == 0) theta = std::pow(10.0, dice.between(-8.0, -1.0));
    const double sine = std::sin(theta), cosine = std::cos(theta), size = std::min(12.0, 0.9 * r);
    const double alpha = dice.between(-size, size), beta = dice.between(-size, size);
    double lambda = -alpha * sine;
    double eta = (alpha * alpha - hole.a * hole.a) * cosine * cosine + beta * beta;
    if (i % 5 == 0) {
      lambda = dice.between(-1.0, 1.0) * hole.a * sine * sine;
      eta = -dice() * std::pow(std::abs(hole.a) - std::abs(lambda), 2);
    }
    const bool outward = dice() < 0.3, theta_grows = dice() < 0.5;
    const double energy_sign = dice() < 0.5 ? 1.0 : -1.0;
    if (separated_potentials(light, lambda, eta).radial(1.0 / r) < 1e-12) continue;
    try {
      rays.push_back(separated_start(light, lambda, eta, energy_sign, 1.0 / r, theta, outward, theta_grows));
    } catch (const std::domain_error&) {
      continue;  // no light has these constants at this theta
    }
  }
  return rays;
}

TEST(FirstIntegrals, are_never_wrong_in_class_or_turns_however_coarse) {
  Dice dice;
  int traced = 0;
  for (const double a : {0.0, 0.5, -0.9, 0.998, 1.0}) {
    const double r_min = std::max(kerr(a).default_r_min(), 1.003);
    for (const SeparatedState& ray : rays_from_anywhere(kerr(a), r_min, 600, dice)) {
      FirstIntegralSettings settings{.tol = 1e-13, .r_min = r_min, .r_max = 1500.0};
      const kerr_exact::Arrival truth = closed_form(a, ray).at_end(settings.r_max, r_min);
      ASSERT_TRUE(truth.reached);
      SCOPED_TRACE(fmt::format("a {} lambda {} eta {} r {} n_z {}", a, ray.lambda, ray.eta, 1.0 / ray.u, ray.n[2]));
      for (const double tol : {1e-3, 1e-6, 1e-13}) {
        settings.tol = tol;
        const FirstIntegralEnd end = trace_one(kerr(a).separated(), ray, settings);
        EXPECT_EQ(end.status, truth.fate == kerr_exact::Fate::escaped ? Status::escaped : Status::captured) << tol;
        EXPECT_NEAR(end.swept_azimuth, ray.energy_sign * truth.phi.value, 3.0) << "half a turn: " << tol;
        ++traced;
        if (tol > 1e-9) continue;
        const std::array<double, 3> forward = truth.direction();
        // At a = M and r = 1.003 M the azimuth moves by 1/(r - M)^2 = 1e5 times the rounding of r and of the constants,
        // and light that lingers next to the horizon by more.
        EXPECT_LT(angle_between(end.state.n, {forward[0], ray.energy_sign * forward[1], forward[2]}),
                  (std::abs(a) < 0.99 ? 5e-12 : 1e-8) + truth.direction_error);
      }
    }
  }
  EXPECT_GT(traced, 5000);
}

TEST(FirstIntegrals, take_any_metric_whose_light_separates) {
  const SchwarzschildMass hole{.M = 2.0};
  const SeparatedState ray = equatorial(hole.separated(), 14.0, 0.0, false);
  FirstIntegralEnd end;
  trace_first_integrals(hole, std::span(&ray, 1), std::span(&end, 1),
                        {.tol = 1e-14, .r_min = hole.default_r_min(), .timed = false});
  EXPECT_EQ(end.status, Status::escaped);
  EXPECT_NEAR(end.swept_azimuth - std::numbers::pi, schwarzschild_exact::deflection(2.0, 14.0).value, 2e-13);
  EXPECT_TRUE(std::isnan(end.state.t) && std::isnan(end.affine)) << "not timed";
  // A charge Q adds Q^2 to Delta: the deflection to second order in M/b and Q/b is 4 M/b + (15 M^2 - 3 Q^2) pi/4b^2.
  const SeparatedLight charged{.mass = 1.0, .spin = 0.0, .charge_squared = 0.64};
  const double b = 1e4;
  const SeparatedState far = equatorial(charged, b, 0.0, false);
  trace_first_integrals(charged, std::span(&far, 1), std::span(&end, 1), {.tol = 1e-14, .r_min = 3.0});
  // What is left is of third order: 128/3 M^3/b^3 and terms like it.
  EXPECT_NEAR(end.swept_azimuth - std::numbers::pi, 4.0 / b + 0.25 * std::numbers::pi * (15.0 - 3.0 * 0.64) / (b * b),
              60.0 / (b * b * b));
}

TEST(FirstIntegrals, deflect_equatorial_light_from_infinity_as_the_elliptic_integrals_say) {
  for (const double a : {0.0, 0.5, 0.9, 1.0}) {
    for (const double b : {-100.0, -20.0, -8.0, -7.5, 5.5, 6.0, 12.0, 1000.0}) {
      const SeparatedLight light = kerr(a).separated();
      // From 1/r = 0 to 1/r = 0.
      const FirstIntegralSettings settings = settings_of(kerr(a), std::numeric_limits<double>::infinity(), 1e-14);
      const FirstIntegralEnd end = trace_one(light, equatorial(light, b, 0.0, false), settings);
      const ExactValue expected = kerr_exact::equatorial_deflection(1.0, a, b);
      EXPECT_EQ(end.status, Status::escaped);
      // A few tolerances, magnified by d(alpha)/d(b) times b near the critical ray: 40 at most on this list.
      EXPECT_NEAR(std::copysign(1.0, b) * end.swept_azimuth - std::numbers::pi, expected.value, 5e-13)
          << "a " << a << " b " << b;
    }
  }
}

TEST(FirstIntegrals, sweep_the_angle_and_take_the_time_between_radii_that_closed_forms_give) {
  for (const double a : {0.3, 0.9, 1.0}) {
    for (const double b : {-9.0, -3.0, 1.5, 7.0}) {
      const SeparatedLight light = kerr(a).separated();
      FirstIntegralSettings settings = settings_of(kerr(a), 300.0, 1e-14);
      settings.r_min = 2.5;
      const FirstIntegralEnd end = trace_one(light, equatorial(light, b, 1.0 / 40.0, false), settings);
      const bool back = std::abs(b) > 5.0;
      EXPECT_EQ(end.status, back ? Status::escaped : Status::captured);
      const double r_end = back ? 300.0 : 2.5;
      // A few tolerances in angle; t loses three digits to its size.
      EXPECT_NEAR(end.swept_azimuth, kerr_exact::equatorial_swept_angle(1.0, a, b, 40.0, r_end, back).value, 2e-13);
      EXPECT_NEAR(end.state.t, kerr_exact::equatorial_coordinate_time(1.0, a, b, 40.0, r_end, back).value, 3e-12);
    }
  }
}

TEST(FirstIntegrals, follow_principal_null_rays_to_the_horizon) {
  for (const double a : {0.5, 0.9, 1.0}) {
    const double theta = 0.7;
    const auto constants = kerr_exact::principal_null_constants(a, theta);
    const SeparatedLight light = kerr(a).separated();
    const double r_plus = kerr(a).horizon_radius();
    const double r_end = r_plus + (a < 1.0 ? 1e-6 : 1e-3);
    for (const bool outward : {false, true}) {
      FirstIntegralSettings settings{.tol = 1e-14, .r_min = outward ? 1.01 * r_plus : r_end, .r_max = 30.0};
      const double r_start = outward ? r_end : 30.0;
      settings.r_min = outward ? 0.5 * (r_end + r_plus) : r_end;
      const FirstIntegralEnd end = trace_one(light,
                                             separated_start(light, constants.angular_momentum, constants.carter, 1.0,
                                                             1.0 / r_start, theta, outward, true),
                                             settings);
      EXPECT_EQ(end.status, outward ? Status::escaped : Status::captured);
      // Theta has a double root here: round-off in the constants, 1e-16, moves theta by its root.
      EXPECT_NEAR(end.state.n[2], std::cos(theta), 2e-8);
      // r itself is rounded, by 2e-16, and dt/dr = (r^2 + a^2)/Delta.
      const double error = 1e-12 + 4e-16 * (r_end * r_end + a * a) / (r_end * (r_end - 2.0) + a * a);
      EXPECT_NEAR(std::abs(end.swept_azimuth), kerr_exact::principal_null_angle(1.0, a, r_end, 30.0).value, error);
      EXPECT_NEAR(end.state.t, kerr_exact::principal_null_time(1.0, a, r_end, 30.0).value, error);
      EXPECT_NEAR(end.affine, 30.0 - r_end, 1e-12);
    }
  }
}

TEST(FirstIntegrals, go_round_spherical_orbits) {
  struct Row {
    double a, r;
  };
  for (const auto [a, r] : {Row{0.9, 2.5}, Row{0.5, 3.2}, Row{1.0, 1.0 + std::sqrt(3.0)}, Row{1.0, 2.0}}) {
    const kerr_exact::SphericalOrbit orbit = kerr_exact::spherical_orbit(1.0, a, r);
    const SeparatedLight light = kerr(a).separated();
    FirstIntegralSettings settings = settings_of(kerr(a), 100.0, 1e-15);
    settings.mino_max = orbit.mino_period.value;
    const FirstIntegralEnd end = trace_one(
        light,
        separated_start(light, orbit.xi.value, orbit.eta.value, 1.0, 1.0 / r, 0.5 * std::numbers::pi, true, true),
        settings);
    // The orbit is unstable: an error in u grows by e^gamma every half oscillation, and the constants are rounded to
    // begin with, by 4e-15 in xi. They move u over one period by (that) e^(2 gamma).
    const double error = 2e-15 * std::exp(2.0 * orbit.lyapunov_half_orbit.value);
    EXPECT_EQ(end.status, Status::max_affine);
    EXPECT_EQ(end.mino_time, orbit.mino_period.value);
    EXPECT_NEAR(end.state.u, 1.0 / r, error);
    EXPECT_NEAR(end.state.n[2], 0.0, 10.0 * error);
    EXPECT_NEAR(end.swept_azimuth, orbit.azimuth.value, 10.0 * error) << a << " " << r;
    EXPECT_NEAR(end.state.t, orbit.time.value, 20.0 * error) << a << " " << r;
  }
}

TEST(FirstIntegrals, match_a_ray_that_two_independent_codes_agree_on) {
  // a = double(0.6), r = 50, theta = 1, L = 2, p_theta = 6, ingoing, back to r = 50: closed form and a Hamiltonian
  // integration, both at 40 digits, agree to 1e-33.
  const SeparatedLight light = kerr(0.6).separated();
  const SeparatedState start = separated_start(light, 2.0, 37.5440381403280533, 1.0, 0.02, 1.0, false, true);
  EXPECT_NEAR(-std::sin(1.0) * 6.0, start.n_rate[2], 1e-13);
  const FirstIntegralEnd end = trace_one(light, start, settings_of(kerr(0.6), 50.0, 1e-14));
  EXPECT_EQ(end.status, Status::escaped);
  // Ten tolerances; t and affine length are a hundred times larger.
  EXPECT_NEAR(std::acos(end.state.n[2]), 1.2812911704019574, 1e-13);
  EXPECT_NEAR(end.swept_azimuth, 3.58737316228051762, 1e-13);
  EXPECT_NEAR(end.state.t, 118.228672106212655, 1e-11);
  EXPECT_NEAR(end.affine, 102.455218678658406, 1e-11);
  EXPECT_NEAR(end.mino_time, 0.627716918138907188, 1e-14);
}

TEST(FirstIntegrals, go_straight_where_there_is_no_mass) {
  const SeparatedLight flat{.mass = 0.0, .spin = 0.0, .charge_squared = 0.0};
  const FirstIntegralSettings settings{.tol = 1e-13, .r_min = 1e-3, .r_max = 50.0};
  // The line x = -3 + s, y = 4, z = 0 has lambda = -4; it leaves r = 50 at x = sqrt(2500 - 16).
  SeparatedState start;
  start.lambda = -4.0;
  start.u = 0.2;
  start.u_rate = 0.2 * 3.0;
  start.n = {-0.6, 0.8, 0.0};
  start.n_rate = {5.0 * 0.64, 5.0 * 0.48, 0.0};
  start.eta = 0.0;
  const FirstIntegralEnd end = trace_one(flat, start, settings);
  const double x = std::sqrt(2500.0 - 16.0);
  EXPECT_EQ(end.status, Status::escaped);
  EXPECT_NEAR(end.state.n[0], x / 50.0, 1e-13);
  EXPECT_NEAR(end.state.n[1], 4.0 / 50.0, 1e-13);
  EXPECT_NEAR(end.swept_azimuth, std::atan2(4.0, x) - std::atan2(4.0, -3.0), 1e-13);
  EXPECT_NEAR(end.state.t, x + 3.0, 5e-12);
  EXPECT_NEAR(end.affine, x + 3.0, 5e-12);
}

}  // namespace
}  // namespace xpr
