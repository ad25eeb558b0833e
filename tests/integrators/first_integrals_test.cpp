// First integrals in Mino time: closed forms, the Hamiltonian flow on the same rays, the same bits at every width.
#include "integrators/first_integrals.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

#include "integrators/tracer.hpp"
#include "metrics/catalogue.hpp"
#include "metrics/kerr.hpp"
#include "metrics/kerr_exact.hpp"
#include "metrics/kerr_ray_exact.hpp"
#include "metrics/schwarzschild.hpp"
#include "metrics/separable_charts.hpp"

namespace xpr {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

KerrParameters kerr(double a) { return {.M = 1.0, .a = a}; }

FirstIntegralSettings settings_of(const KerrParameters& hole, double r_max, double tol = 1e-13) {
  return {.tol = tol, .r_min = hole.default_r_min(), .r_max = r_max};
}

FirstIntegralEnd trace_one(const SeparatedLight& light, const SeparatedState& ray,
                           const FirstIntegralSettings& settings) {
  FirstIntegralEnd end;
  trace_first_integrals(light, std::span(&ray, 1), std::span(&end, 1), settings);
  return end;
}

double angle_between(const std::array<double, 3>& v, const std::array<double, 3>& w) {
  const std::array cross{v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]};
  return std::atan2(std::hypot(cross[0], cross[1], cross[2]), v[0] * w[0] + v[1] * w[1] + v[2] * w[2]);
}

/// Reproducible numbers in [0, 1).
class Dice {
 public:
  double operator()() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state_ >> 11U) * 0x1p-53;
  }
  double between(double low, double high) { return low + (high - low) * (*this)(); }

 private:
  std::uint64_t state_ = 20240611;
};

/// Camera rays and their reverses on a screen of half-width 12, from r = 5 to 1000 at any inclination.
std::vector<SeparatedState> screen_rays(const SeparatedLight& light, int count, Dice& dice) {
  std::vector<SeparatedState> rays;
  for (int i = 0; i < count; ++i) {
    const double r = std::pow(10.0, dice.between(0.7, 3.0)), theta = std::acos(dice.between(-1.0, 1.0));
    const double size = std::min(12.0, 0.9 * r);
    const double alpha = dice.between(-size, size), beta = dice.between(-size, size);
    const double lambda = -alpha * std::sin(theta);
    const double eta = (alpha * alpha - light.spin * light.spin) * std::cos(theta) * std::cos(theta) + beta * beta;
    const SeparatedPotentials p = separated_potentials(light, lambda, eta);
    if (p.radial(1.0 / r) < 0.0) continue;
    rays.push_back(
        separated_start(light, lambda, eta, dice() < 0.5 ? 1.0 : -1.0, 1.0 / r, theta, dice() < 0.2, beta > 0.0));
  }
  return rays;
}

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
      const double sine = std::hypot(ray.n[0], ray.n[1]);
      const double theta_rate = (ray.n[0] * ray.n_rate[0] * ray.n[2] - sine * sine * ray.n_rate[2]) / sine;
      const kerr_exact::KerrRay exact({1.0, a}, kerr_exact::RayMomentum{.r = 1.0 / ray.u,
                                                                        .theta = std::atan2(sine, ray.n[2]),
                                                                        .lambda = ray.lambda,
                                                                        .p_theta = theta_rate,
                                                                        .radial_sign = ray.u_rate < 0.0 ? 1 : -1});
      const kerr_exact::Arrival truth = exact.at_end(1000.5, settings.r_min);
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

/// A ray in the equatorial plane, from r inward or outward.
SeparatedState equatorial(const SeparatedLight& light, double b, double u, bool outward) {
  return separated_start(light, b, 0.0, 1.0, u, 0.5 * std::numbers::pi, outward, true);
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

TEST(FirstIntegrals, pass_over_the_axis) {
  const SeparatedLight light = kerr(0.9).separated();
  const FirstIntegralSettings settings = settings_of(kerr(0.9), 100.0);
  const auto trace = [&](double lambda) {
    return trace_one(light, separated_start(light, lambda, 50.0, 1.0, 0.01, 1.0, false, false), settings);
  };
  // Through the axis, and close by on either side: the ends agree as lambda does, the azimuths differ by a turn.
  const FirstIntegralEnd through = trace(0.0);
  EXPECT_EQ(through.status, Status::escaped);
  for (const double lambda : {1e-3, 1e-6, 1e-9, 1e-13}) {
    const FirstIntegralEnd left = trace(lambda), right = trace(-lambda);
    EXPECT_LT(angle_between(left.state.n, through.state.n), lambda + 1e-12);
    EXPECT_LT(angle_between(right.state.n, through.state.n), lambda + 1e-12);
    EXPECT_NEAR(left.swept_azimuth - right.swept_azimuth, turn, 4.0 * lambda + 1e-12);
    EXPECT_NEAR(left.state.t, through.state.t, 10.0 * lambda + 1e-9);
  }
  // From the axis itself to the other side of it and away.
  const FirstIntegralEnd from =
      trace_one(light, separated_start(light, 0.0, 30.0, 1.0, 0.01, 0.0, false, true), settings);
  EXPECT_EQ(from.status, Status::escaped);
  const FirstIntegralEnd close =
      trace_one(light, separated_start(light, 1e-9, 30.0, 1.0, 0.01, 1e-8, false, true), settings);
  EXPECT_LT(std::abs(from.state.n[2] - close.state.n[2]), 1e-7);
}

TEST(FirstIntegrals, turn_time_and_drag_round_for_rays_traced_back) {
  const SeparatedLight light = kerr(0.8).separated();
  const FirstIntegralSettings settings = settings_of(kerr(0.8), 60.0);
  SeparatedState forward = separated_start(light, 3.0, 20.0, 1.0, 0.05, 1.2, false, true);
  const FirstIntegralEnd there = trace_one(light, forward, settings);
  ASSERT_EQ(there.status, Status::escaped);
  // The same light from its end: momentum and energy change sign, the constants do not.
  SeparatedState backward = there.state;
  backward.energy_sign = -1.0;
  backward.u_rate = -backward.u_rate;
  for (double& rate : backward.n_rate) rate = -rate;
  FirstIntegralSettings home = settings;
  home.r_max = 20.0;
  const FirstIntegralEnd back = trace_one(light, backward, home);
  EXPECT_EQ(back.status, Status::escaped);
  EXPECT_LT(back.state.u_rate, 0.0);
  // It first meets r = 20 on its way in, where nothing stops it, then on the way out: where `forward` is, reversed.
  EXPECT_LT(angle_between(back.state.n, forward.n), 1e-11);
  EXPECT_NEAR(back.swept_azimuth, -there.swept_azimuth, 1e-11);
  EXPECT_NEAR(back.state.t, 0.0, 1e-10);
}

/// The bits of everything that an end says.
std::vector<std::uint64_t> bits_of(const FirstIntegralEnd& end) {
  std::vector<std::uint64_t> bits{static_cast<std::uint64_t>(end.status), static_cast<std::uint64_t>(end.steps)};
  for (const double x :
       {end.swept_azimuth, end.mino_time, end.affine, end.state.t, end.state.u, end.state.u_rate, end.state.n[0],
        end.state.n[1], end.state.n[2], end.state.n_rate[0], end.state.n_rate[1], end.state.n_rate[2]}) {
    bits.push_back(std::isnan(x) ? 0 : std::bit_cast<std::uint64_t>(x));
  }
  return bits;
}

TEST(FirstIntegrals, give_the_same_bits_at_every_width_and_among_any_neighbours) {
  Dice dice;
  for (const double a : {0.0, 0.9, 1.0}) {
    const SeparatedLight light = kerr(a).separated();
    std::vector<SeparatedState> rays = screen_rays(light, 301, dice);
    rays[7].u = std::nan("");
    rays[8].n_rate[1] += 0.1;
    rays[9].u = 2.0;
    rays[10] = separated_start(light, 0.0, 20.0, -1.0, 0.02, 1.0, false, true);
    for (const bool timed : {false, true}) {
      for (const double tol : {1e-8, 1e-12}) {
        FirstIntegralSettings settings = settings_of(kerr(a), 900.0, tol);
        settings.r_min = std::max(settings.r_min, 1.01);
        settings.timed = timed;
        settings.lanes = 1;
        std::vector<FirstIntegralEnd> alone(rays.size());
        for (std::size_t i = 0; i < rays.size(); ++i) alone[i] = trace_one(light, rays[i], settings);
        EXPECT_EQ(alone[7].status, Status::not_finite);
        EXPECT_EQ(alone[8].status, Status::constraint_violated);
        EXPECT_EQ(alone[9].status, Status::outside_domain);
        for (const int lanes : {1, 2, 4, 8}) {
          settings.lanes = lanes;
          std::vector<FirstIntegralEnd> ends(rays.size());
          trace_first_integrals(light, rays, ends, settings);
          for (std::size_t i = 0; i < rays.size(); ++i) {
            ASSERT_EQ(bits_of(ends[i]), bits_of(alone[i])) << "a " << a << " lanes " << lanes << " ray " << i;
          }
        }
      }
    }
  }
}

TEST(FirstIntegrals, meet_stops_that_a_turning_ray_only_touches) {
  const SeparatedLight light = kerr(0.9).separated();
  const double b = 7.0, periapsis = kerr_exact::equatorial_periapsis(1.0, 0.9, b).value;
  for (const double gap : {1e-2, 1e-4, 1e-6, 1e-9}) {
    FirstIntegralSettings settings{.tol = 1e-13, .r_min = periapsis * (1.0 - gap), .r_max = 100.0};
    const SeparatedState ray = equatorial(light, b, 0.01, false);
    EXPECT_EQ(trace_one(light, ray, settings).status, Status::escaped) << gap;
    settings.r_min = periapsis * (1.0 + gap);
    const FirstIntegralEnd caught = trace_one(light, ray, settings);
    EXPECT_EQ(caught.status, Status::captured) << gap;
    EXPECT_EQ(caught.state.u, 1.0 / settings.r_min);
    EXPECT_NEAR(caught.swept_azimuth,
                kerr_exact::equatorial_swept_angle(1.0, 0.9, b, 100.0, settings.r_min, false).value,
                1e-13 + 1e-13 / std::sqrt(gap))
        << "the tolerance over the slope of r there";
  }
  // Light that rises from next to the horizon, with more angular momentum than the photon orbit lets out, falls back.
  const SeparatedState rising = equatorial(light, 2.9, 1.0 / 1.45, true);
  FirstIntegralSettings settings{.tol = 1e-12, .r_min = 1.44, .r_max = 50.0};
  const FirstIntegralEnd fallen = trace_one(light, rising, settings);
  EXPECT_EQ(fallen.status, Status::captured);
  EXPECT_EQ(fallen.state.u, 1.0 / 1.44);
  EXPECT_GT(fallen.state.u_rate, 0.0);
  settings.r_max = 1.4505;
  EXPECT_EQ(trace_one(light, rising, settings).status, Status::escaped);
}

TEST(FirstIntegrals, start_beyond_a_stop_by_where_they_go) {
  const SeparatedLight light = KerrParameters{.M = 1.0, .a = 0.0}.separated();
  FirstIntegralSettings settings{.tol = 1e-12, .r_min = 4.0, .r_max = 20.0};
  const auto trace = [&](double b, double r, bool outward) {
    return trace_one(light, equatorial(light, b, 1.0 / r, outward), settings);
  };
  EXPECT_EQ(trace(8.0, 30.0, true).status, Status::escaped);
  EXPECT_EQ(trace(8.0, 30.0, true).steps, 0);
  const FirstIntegralEnd through = trace(8.0, 30.0, false);
  EXPECT_EQ(through.status, Status::escaped);
  EXPECT_EQ(through.state.u, 1.0 / 20.0);
  EXPECT_GT(through.swept_azimuth, std::numbers::pi / 2);
  const FirstIntegralEnd outside = trace(25.0, 30.0, false);
  EXPECT_EQ(outside.status, Status::escaped) << "never inside: escaped where it turns outward";
  EXPECT_NEAR(1.0 / outside.state.u, kerr_exact::equatorial_periapsis(1.0, 0.0, 25.0).value, 1e-10);
  EXPECT_EQ(trace(2.0, 3.0, false).status, Status::captured);
  EXPECT_EQ(trace(2.0, 3.0, true).status, Status::escaped);
  settings.max_steps = 2;
  EXPECT_EQ(trace(8.0, 19.0, false).status, Status::max_steps);
}

TEST(FirstIntegrals, tell_captured_from_escaped_next_to_the_critical_curve) {
  for (const double a : {0.5, 0.9, 0.99}) {
    const SeparatedLight light = kerr(a).separated();
    for (const double r : {kerr_exact::polar_photon_orbit_radius(1.0, a).value, 2.9, 3.1}) {
      const kerr_exact::SphericalOrbit orbit = kerr_exact::spherical_orbit(1.0, a, r);
      for (const double gap : {1e-3, 1e-6, 1e-9, 1e-11}) {
        // More angular momentum of every kind: U falls by kappa's share everywhere.
        for (const double side : {1.0, -1.0}) {
          const double eta = orbit.eta.value * (1.0 + side * gap);
          const FirstIntegralSettings settings = settings_of(kerr(a), 1000.0, 1e-12);
          const FirstIntegralEnd end = trace_one(
              light, separated_start(light, orbit.xi.value, eta, 1.0, 1e-3, 0.5 * std::numbers::pi, false, true),
              settings);
          EXPECT_EQ(end.status, side > 0.0 ? Status::escaped : Status::captured) << a << " " << r << " " << gap;
        }
      }
    }
  }
}

TEST(FirstIntegrals, keep_their_tolerance) {
  Dice dice;
  const SeparatedLight light = kerr(0.9).separated();
  const std::vector<SeparatedState> rays = screen_rays(light, 1000, dice);
  const auto trace = [&](double tol) {
    std::vector<FirstIntegralEnd> ends(rays.size());
    trace_first_integrals(light, rays, ends, settings_of(kerr(0.9), 1000.5, tol));
    return ends;
  };
  const std::vector<FirstIntegralEnd> truth = trace(1e-15);
  for (const double tol : {1e-6, 1e-8, 1e-10, 1e-12}) {
    const std::vector<FirstIntegralEnd> ends = trace(tol);
    std::vector<double> errors;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      EXPECT_EQ(ends[i].status, truth[i].status);
      errors.push_back(angle_between(ends[i].state.n, truth[i].state.n));
    }
    std::sort(errors.begin(), errors.end());
    // Half of all rays within the tolerance, and no coarser than a hundredth of it: the steps are not wasted.
    EXPECT_LT(errors[errors.size() / 2], tol) << tol;
    EXPECT_GT(errors[errors.size() / 2], 0.005 * tol) << tol;
  }
}

TEST(FirstIntegrals, refuse_settings_that_make_no_sense) {
  const SeparatedLight light = kerr(0.9).separated();
  const SeparatedState ray = equatorial(light, 8.0, 0.01, false);
  const FirstIntegralSettings good = settings_of(kerr(0.9), 100.0);
  const auto refused = [&](auto change) {
    FirstIntegralSettings settings = good;
    change(settings);
    EXPECT_THROW(static_cast<void>(trace_one(light, ray, settings)), std::invalid_argument);
  };
  refused([](auto& s) { s.tol = 0.0; });
  refused([](auto& s) { s.tol = std::nan(""); });
  refused([](auto& s) { s.lanes = 3; });
  refused([](auto& s) { s.r_min = 1.0; });
  refused([](auto& s) { s.r_min = 200.0; });
  refused([](auto& s) { s.mino_max = 0.0; });
  EXPECT_THROW(static_cast<void>(trace_one({.mass = 1.0, .spin = 1.1, .charge_squared = 0.0}, ray, good)),
               std::invalid_argument);
  EXPECT_THROW(static_cast<void>(separated_start(light, 8.0, 0.0, 1.0, 0.3, 1.5, false, true)), std::domain_error);
}

static_assert(Separable<KerrParameters> && Separable<SchwarzschildMass> && Separable<KerrBoyerLindquist>);

}  // namespace
}  // namespace xpr
