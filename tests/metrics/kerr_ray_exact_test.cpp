#include "metrics/kerr_ray_exact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "exact_kit.hpp"
#include "kerr_ray_sweep.hpp"
#include "metrics/kerr_exact.hpp"
#include "metrics/schwarzschild_exact.hpp"

namespace {

using namespace xpr;
using kerr_exact::Arrival;
using kerr_exact::Fate;
using kerr_exact::KerrRay;
using kerr_exact::RadialMotion;
using kerr_exact::RayHole;
using kerr_exact::RayMomentum;
using kerr_exact::RayStart;
using std::numbers::pi;

constexpr double degree = pi / 180.0;

// A ray whose end the closed form and the Hamiltonian equations gave alike to 33 digits.
TEST(KerrRay, ends_where_the_checked_ray_ends) {
  const KerrRay ray(RayHole{1.0, 0.6}, RayMomentum{.r = 50, .theta = 1, .lambda = 2, .p_theta = 6, .radial_sign = -1});
  const Arrival end = ray.at_radius(50, 1);
  ASSERT_TRUE(end.reached);
  EXPECT_EQ(ray.fate(), Fate::escaped);
  // Two units in the last place of each, and of the sums behind them.
  EXPECT_NEAR(ray.turning_radius(), 5.12725436642659012, 2e-15);
  EXPECT_NEAR(end.theta.value, 1.2812911704019574, 2e-15);
  EXPECT_NEAR(end.phi.value, 3.58737316228051762, 2e-15);
  EXPECT_NEAR(end.time.value, 118.228672106212655, 5e-14);
  EXPECT_NEAR(end.affine.value, 102.455218678658406, 5e-14);
  EXPECT_NEAR(end.mino.value, 0.627716918138907188, 5e-16);
}

// a = 0.9, i = 60 degrees, screen (5, 4).
TEST(KerrRay, roots_and_periods_are_the_checked_ones) {
  const kerr_exact::UnitConstants constants{0.9, -5.0 * std::sqrt(0.75), (25 - 0.81) / 4 + 16};
  const RadialMotion radial(constants);
  // The reference is printed to 14 digits, its lambda and eta rounded to doubles.
  EXPECT_NEAR(static_cast<double>(radial.r4), 4.147994062372, 2e-12);
  EXPECT_NEAR(static_cast<double>(radial.r3), 2.9899102227491, 2e-12);
  EXPECT_NEAR(static_cast<double>(radial.r2), 0.19633292809827, 2e-13);
  EXPECT_NEAR(static_cast<double>(radial.r1), -7.3342372132194, 2e-13);
  // In from infinity and out again; 1e18 M is as good, where 1e-18 is left.
  EXPECT_NEAR(2.0 * leg_to_turn(radial, 1e18).mino, 0.980571077458834228, 4e-15);
  const kerr_exact::PolarMotion polar(
      constants,
      {.cosine = 0, .sine = 1, .rate_squared = (25 - 0.81) / 4 + 16, .rate_squared_error = 0, .direction = 1});
  EXPECT_NEAR(polar.half_period(), 0.492744242626108, 5e-16);
}

TEST(KerrRay, truth_in_thirty_digits_is_the_truth_in_fifty) {
  for (const double spin : {0.3, 1.0}) {
    for (const double beta : {-3.0, 5.1, 7.0}) {
      const RayStart start = kerr_ray_sweep::Camera{spin, 20.0, 60 * degree}.at(1.0, beta);
      const KerrRay ray(RayHole{1.0, spin}, start);
      const bool escapes = ray.fate() == Fate::escaped;
      const double r_end = escapes ? 20.0 : 2.0;
      using exact_kit::Mp;
      const auto truth =
          kerr_ray_truth::followed<Wide>(kerr_ray_sweep::truth_start(spin, start), r_end, escapes ? 1 : -1);
      const auto fifty = kerr_ray_truth::followed<Mp>(
          {spin, start.lambda, start.eta, start.r, cos(Mp(start.theta)), sin(Mp(start.theta)), -1, start.polar_sign},
          r_end, escapes ? 1 : -1);
      // Steps are cut at 1e-26; beta = 5.1 stands near the edge of the shadow, where an error grows a hundredfold.
      const auto same = [](const Wide& x, const Mp& y) {
        EXPECT_LE(std::abs(static_cast<double>(x - kerr_ray_sweep::wide(y))), 1e-22 * (1.0 + std::abs(x.high)));
      };
      same(truth.mino, fifty.mino), same(truth.phi, fifty.phi), same(truth.time, fifty.time);
      same(truth.affine, fifty.affine), same(truth.cosine, fifty.cosine);
    }
  }
}

// All root cases, all inclinations, both sides of the shadow's edge; thousands more in the program of the full tests.
TEST(KerrRay, keeps_its_own_error_bounds) {
  auto report = kerr_ray_sweep::swept(20260111, 1, 5);
  for (const std::string& fault : report.faults) ADD_FAILURE() << fault;
  EXPECT_GT(report.rays, 120);
  for (auto& [name, finding] : report.findings) {
    std::sort(finding.misses.begin(), finding.misses.end());
    // A few roundings; theta's carries those of two phases and a period.
    EXPECT_LE(finding.misses[finding.misses.size() / 2], 8.0) << name;
    if (name.starts_with("screen")) {
      EXPECT_LE(finding.widest_bound, 1e-11) << name;
    }
  }
}

TEST(KerrRay, class_is_right_next_to_the_edge_of_the_shadow) {
  const double inclination = 60 * degree, far = 1e6;
  for (const double spin : {0.3, 0.9, 0.998}) {
    for (const double angle : {-2.5, -1.0, 0.4, 1.7, 3.0}) {
      const auto edge = kerr_exact::shadow_edge(1.0, spin, inclination, spin, angle);
      const double away = 1e-12;  // the edge's doubles move eta by 1e-15
      for (const double side : {-away, away}) {
        const double alpha = edge.alpha.value + side * std::cos(angle), beta = edge.beta.value + side * std::sin(angle);
        const KerrRay ray(RayHole{1.0, spin}, kerr_ray_sweep::Camera{spin, far, inclination}.at(alpha, beta));
        EXPECT_EQ(ray.fate(), side > 0 ? Fate::escaped : Fate::captured) << spin << ' ' << angle << ' ' << side;
      }
    }
  }
}

// Neighbouring doubles on both sides of the edge: R at its least outside the horizon, to 50 digits, tells whether light
// from afar turns.
TEST(KerrRay, class_is_right_to_the_last_double) {
  using exact_kit::Mp;
  for (const double spin : {0.0, 0.3, 0.9, 0.998, 1.0}) {
    for (const double angle : {-3.0, -1.3, 0.2, 1.1, 2.4}) {
      const auto start = [&](double size) {
        return kerr_ray_sweep::Camera{spin, 1000.0, 60 * degree}.at(size * std::cos(angle), size * std::sin(angle));
      };
      const auto captured = [&](double size) {
        return KerrRay(RayHole{1.0, spin}, start(size)).fate() == Fate::captured;
      };
      double inside = 0.5, outside = 9.0;
      while (std::nextafter(inside, outside) < outside) {
        const double middle = 0.5 * (inside + outside);
        (captured(middle) ? inside : outside) = middle;
      }
      for (const double size : {inside, outside, std::nextafter(inside, 0.0), std::nextafter(outside, 10.0)}) {
        const RayStart ray = start(size);
        const Mp a = spin, xi = ray.lambda, K = ray.eta + (xi - a) * (xi - a);
        // R' = 4 r (r^2 + a^2 - a xi) - 2 (r - 1) K by Newton's rule, from the middle of r3 and r4.
        Mp r = static_cast<double>(RadialMotion({spin, ray.lambda, ray.eta}).s) / 2;
        for (int i = 0; i < 20; ++i) {
          r -= (4 * r * (r * r + a * a - a * xi) - 2 * (r - 1) * K) / (12 * r * r + 4 * (a * a - a * xi) - 2 * K);
        }
        r = std::max(r, Mp(1 + sqrt((1 - a) * (1 + a))));
        const Mp least = kerr_exact::radial_potential(Mp(1), a, {Mp(1), xi, Mp(ray.eta)}, r);
        EXPECT_EQ(captured(size), least > 0) << spin << ' ' << angle << ' ' << size << ": R = " << least;
      }
    }
  }
}

TEST(KerrRay, equatorial_rays_are_the_known_closed_forms) {
  for (const double spin : {-0.9, 0.0, 0.5, 0.998}) {
    for (const double b : {-12.0, -7.5, 7.25, 30.0}) {
      const KerrRay ray(RayHole{1.0, spin},
                        RayStart{.r = 100, .theta = pi / 2, .lambda = b, .eta = 0, .radial_sign = -1, .polar_sign = 1});
      const Arrival end = ray.at_radius(40, 1);
      ASSERT_TRUE(end.reached);
      const ExactValue phi = kerr_exact::equatorial_swept_angle(1.0, spin, b, 100, 40, true);
      const ExactValue time = kerr_exact::equatorial_coordinate_time(1.0, spin, b, 100, 40, true);
      EXPECT_LE(std::abs(end.phi.value - phi.value), end.phi.error + phi.error) << spin << ' ' << b;
      EXPECT_LE(std::abs(end.time.value - time.value), end.time.error + time.error) << spin << ' ' << b;
      EXPECT_EQ(end.cos_theta, 0.0);
      EXPECT_EQ(end.polar_turns, 0);
    }
  }
}

// First meeting of a camera ray with the equatorial plane, x + iy = r exp(i phi), as the tests of a public code print
// them (kgeo, tests/test_geodesics_kerr_ana.py; observer at 1000 M, phi = 0): the sense of frame dragging is in them.
// Traced back in time phi runs backwards.
TEST(KerrRay, meets_the_equator_where_a_public_code_does) {
  const struct {
    double spin, inclination, alpha, beta, x, y;
  } rows[] = {{0.42, 60, -17, 0, -0.0522336, -16.0342},     {0.42, 60, -9, 0, -0.103693, -8.09784},
              {0.42, 60, -4, 0, -0.308159, -3.20445},       {0.42, 60, 8, 0, 0.129720, 6.94829},
              {0.9, 10, -12, 0, -0.164094, -11.0082},       {0.9, 10, -4, 0, -0.655582, -2.99558},
              {0.73, 35, 0.0001, -10, 11.8258, -0.0858775}, {0.73, 35, 0.0001, 4, -2.11221, 1.02322}};
  for (const auto& row : rows) {
    const KerrRay ray(RayHole{1.0, row.spin},
                      kerr_ray_sweep::Camera{row.spin, 1000.0, row.inclination * degree}.at(row.alpha, row.beta));
    const double r = std::hypot(row.x, row.y);
    double best = 1.0;
    for (const int turns : {0, 1}) {
      const Arrival end = ray.at_radius(r, turns);
      if (!end.reached) continue;
      const double x = end.sin_theta * std::cos(end.phi.value), y = -end.sin_theta * std::sin(end.phi.value);
      best = std::min(best, std::hypot(x - row.x / r, y - row.y / r, end.cos_theta));
    }
    // r is printed to 5e-5 M at most, and the direction turns by less than 1/2 a unit of r there.
    EXPECT_LE(best, 3e-5) << row.spin << ' ' << row.alpha << ' ' << row.beta;
  }
}

// Schwarzschild knows no axis: in a tilted plane the angle between two directions is the swept angle of the equator.
TEST(KerrRay, schwarzschild_rays_lie_in_a_plane) {
  const double b = 7.0, p_theta = 5.0, theta = 1.1, lambda = std::sqrt((b - p_theta) * (b + p_theta)) * std::sin(theta);
  const Arrival end =
      KerrRay(RayHole{1.0, 0.0},
              RayMomentum{.r = 50, .theta = theta, .lambda = lambda, .p_theta = p_theta, .radial_sign = -1})
          .at_radius(50, 1);
  const auto [x, y, z] = end.direction();
  const double cosine = x * std::sin(theta) + z * std::cos(theta);
  const double swept = schwarzschild_exact::swept_angle(1.0, b, 50, 50, true).value;
  EXPECT_NEAR(cosine, std::cos(swept), 1e-14);  // a dozen roundings
  EXPECT_NEAR(end.time.value, schwarzschild_exact::coordinate_time(1.0, b, 50, 50, true).value, 2e-13);
}

// lambda = a sin^2 theta and eta = -(lambda - a)^2, exact in doubles; theta itself is rounded.
TEST(KerrRay, principal_rays_keep_theta) {
  const struct {
    double spin, lambda, theta;
  } rows[] = {{0, 0, 0.3}, {0.75, 0.5, std::asin(std::sqrt(2.0 / 3.0))}, {1, 0.75, 2 * pi / 3}, {1, 1, pi / 2}};
  for (const auto& [spin, lambda, theta] : rows) {
    const double away = lambda - spin;
    const KerrRay ray(RayHole{1.0, spin},
                      RayStart{.r = 30, .theta = theta, .lambda = lambda, .eta = -away * away, .radial_sign = -1});
    const Arrival end = ray.at_radius(2.5, 0);
    ASSERT_TRUE(end.reached);
    EXPECT_EQ(ray.fate(), Fate::captured);
    EXPECT_NEAR(end.theta.value, theta, 1e-15) << spin;
    const ExactValue time = kerr_exact::principal_null_time(1.0, spin, 30, 2.5);
    const ExactValue phi = kerr_exact::principal_null_angle(1.0, spin, 30, 2.5);
    EXPECT_LE(std::abs(end.time.value - time.value), end.time.error + time.error) << spin;
    EXPECT_LE(std::abs(end.phi.value - phi.value), end.phi.error + phi.error) << spin;
    EXPECT_LE(std::abs(end.affine.value - 27.5), end.affine.error) << spin;
    EXPECT_LE(end.time.error, 1e-12) << spin;  // some fifty roundings of a time of 35
    EXPECT_LE(end.phi.error, 1e-13) << spin;
  }
}

// a = 0, b^2 = 27: r = 3 is a double root in doubles too.
TEST(KerrRay, winds_for_ever_where_roots_coincide) {
  const RayHole hole{1.0, 0.0};
  const KerrRay inward(hole, RayStart{.r = 10, .theta = 1, .lambda = 0, .eta = 27, .radial_sign = -1});
  EXPECT_EQ(inward.fate(), Fate::asymptotic);
  EXPECT_FALSE(inward.at_end(10, 2.1).reached);
  EXPECT_FALSE(inward.at_radius(2.9, 0).reached);
  const Arrival part = inward.at_radius(3.5, 0);
  ASSERT_TRUE(part.reached);
  // The elementary integral of du/sqrt((1 - 3u)^2 (1 + 6u)): (1/3) [ln((1 + x)/(1 - x))], x = sqrt((1 + 6u)/3).
  const auto primitive = [](double u) {
    const double x = std::sqrt((1 + 6 * u) / 3);
    return std::log((1 + x) / (1 - x)) / std::sqrt(27.0);
  };
  EXPECT_NEAR(part.mino.value, primitive(1 / 3.5) - primitive(0.1), 2e-15);
  const KerrRay outward(hole, RayStart{.r = 2.5, .theta = 1, .lambda = 0, .eta = 27, .radial_sign = 1});
  EXPECT_EQ(outward.fate(), Fate::asymptotic);
  EXPECT_TRUE(outward.at_radius(2.9, 0).reached);
  EXPECT_FALSE(outward.at_radius(3.1, 0).reached);
  const KerrRay falling(hole, RayStart{.r = 2.5, .theta = 1, .lambda = 0, .eta = 27, .radial_sign = -1});
  EXPECT_EQ(falling.fate(), Fate::captured);
}

// L = 0 crosses the axis; next to it phi runs through pi within the passage, on the side of L's sign.
TEST(KerrRay, axis_is_crossed_by_half_a_turn) {
  const RayHole hole{1.0, 0.9};
  const auto end = [&](double lambda) {
    return KerrRay(hole,
                   RayStart{.r = 100, .theta = 1, .lambda = lambda, .eta = 60, .radial_sign = -1, .polar_sign = -1})
        .at_radius(100, 1);
  };
  const Arrival on = end(0.0), beside = end(1e-9), other = end(-1e-9);
  ASSERT_EQ(on.axis_crossings, 1);
  EXPECT_EQ(on.polar_turns, 0);
  EXPECT_EQ(beside.axis_crossings, 0);
  EXPECT_EQ(beside.polar_turns, 1);
  EXPECT_NEAR(beside.phi.value, on.phi.value, 1e-8);
  EXPECT_NEAR(other.phi.value, on.phi.value - 2 * pi, 1e-8);
  EXPECT_NEAR(beside.theta.value, on.theta.value, 1e-8);
  // From the axis itself theta grows at once.
  const Arrival from_axis =
      KerrRay(hole, RayStart{.r = 100, .theta = 0, .lambda = 0, .eta = 40, .radial_sign = -1, .polar_sign = -1})
          .at_radius(20, 0);
  EXPECT_EQ(from_axis.axis_crossings, 0);
  EXPECT_GT(from_axis.theta.value, 0.1);
  EXPECT_EQ(from_axis.polar_sign, 1);
}

// eta = 0 off the equator, |lambda| < a: cos theta falls as 1/cosh and never reaches zero.
TEST(KerrRay, eta_zero_approaches_the_equator) {
  const RayHole hole{1.0, 0.9};
  for (const int sign : {-1, 1}) {
    const auto end = [&](double eta) {
      return KerrRay(hole,
                     RayStart{.r = 1e3, .theta = 0.9, .lambda = 0.3, .eta = eta, .radial_sign = -1, .polar_sign = sign})
          .at_radius(1.6, 0);
    };
    const Arrival at = end(0.0), above = end(1e-13), below = end(-1e-13);
    EXPECT_GT(at.cos_theta, 0.0);
    // Between its neighbours on both sides, which run through the general formulas.
    for (const Arrival& beside : {above, below}) {
      EXPECT_NEAR(at.theta.value, beside.theta.value, 1e-11);
      EXPECT_NEAR(at.phi.value, beside.phi.value, 1e-11);
      EXPECT_NEAR(at.time.value, beside.time.value, 1e-10);
      EXPECT_EQ(at.polar_turns, beside.polar_turns);
    }
  }
}

TEST(KerrRay, mass_is_a_unit_and_spin_has_a_mirror) {
  const RayStart start{.r = 40, .theta = 1.2, .lambda = 3, .eta = 31, .radial_sign = -1, .polar_sign = 1};
  const Arrival unit = KerrRay(RayHole{1.0, 0.7}, start).at_radius(60, 1);
  const Arrival heavy =
      KerrRay(RayHole{4.0, 2.8},
              RayStart{.r = 160, .theta = 1.2, .lambda = 12, .eta = 496, .radial_sign = -1, .polar_sign = 1})
          .at_radius(240, 1);
  EXPECT_EQ(heavy.theta.value, unit.theta.value);
  EXPECT_EQ(heavy.phi.value, unit.phi.value);
  EXPECT_EQ(heavy.time.value, 4.0 * unit.time.value);
  EXPECT_EQ(heavy.affine.value, 4.0 * unit.affine.value);
  EXPECT_EQ(heavy.mino.value, unit.mino.value / 4.0);
  RayStart mirrored = start;
  mirrored.lambda = -3;
  const Arrival mirror = KerrRay(RayHole{1.0, -0.7}, mirrored).at_radius(60, 1);
  EXPECT_EQ(mirror.phi.value, -unit.phi.value);
  EXPECT_EQ(mirror.time.value, unit.time.value);
  EXPECT_EQ(mirror.theta.value, unit.theta.value);
}

// p with p^t < 0: the path of the light that comes the other way, passed through in reverse.
TEST(KerrRay, events_are_followed_forwards_and_back_in_time) {
  const RayHole hole{1.0, -0.8};
  const RayMomentum momentum{.r = 70, .theta = 2.1, .lambda = 3, .p_theta = -5, .radial_sign = -1};
  const Arrival reference = KerrRay(hole, momentum).at_radius(90, 1);
  const Arrival forwards =
      KerrRay(hole,
              kerr_exact::RayEvent{.r = 70, .theta = 2.1, .p_t = -0.5, .p_r = -0.1, .p_theta = -2.5, .p_phi = 1.5})
          .at_radius(90, 1);
  EXPECT_EQ(forwards.phi.value, reference.phi.value);
  EXPECT_EQ(forwards.time.value, reference.time.value);
  const Arrival back =
      KerrRay(hole, kerr_exact::RayEvent{.r = 70, .theta = 2.1, .p_t = 1, .p_r = -0.1, .p_theta = -5, .p_phi = -3})
          .at_radius(90, 1);
  EXPECT_EQ(back.theta.value, reference.theta.value);
  EXPECT_EQ(back.phi.value, -reference.phi.value);
  EXPECT_EQ(back.time.value, -reference.time.value);
  EXPECT_EQ(back.affine.value, -reference.affine.value);
  EXPECT_EQ(back.mino.value, reference.mino.value);
  EXPECT_EQ(back.polar_sign, reference.polar_sign);
}

TEST(KerrRay, goes_back_the_way_it_came) {
  const RayHole hole{1.0, 0.95};
  const Arrival there =
      KerrRay(hole, RayStart{.r = 30, .theta = 0.8, .lambda = -2, .eta = 45, .radial_sign = -1, .polar_sign = 1})
          .at_radius(80, 1);
  const Arrival back = KerrRay(hole, RayStart{.r = 80,
                                              .theta = there.theta.value,
                                              .lambda = -2,
                                              .eta = 45,
                                              .radial_sign = -there.radial_sign,
                                              .polar_sign = -there.polar_sign})
                           .at_radius(30, 1);
  EXPECT_NEAR(back.theta.value, 0.8, back.theta.error + there.theta.error);
  EXPECT_NEAR(back.phi.value, there.phi.value, back.phi.error + there.phi.error);
  EXPECT_NEAR(back.time.value, there.time.value, back.time.error + there.time.error);
  EXPECT_EQ(back.polar_sign, -1);
}

TEST(KerrRay, refuses_what_no_light_does) {
  const RayStart good{.r = 20, .theta = 1, .lambda = 2, .eta = 40, .radial_sign = -1, .polar_sign = 1};
  const auto made = [](const RayHole& hole, const RayStart& start) { return KerrRay(hole, start).fate(); };
  const auto with = [&](auto change) {
    RayStart start = good;
    change(start);
    return start;
  };
  EXPECT_NO_THROW(made({1, 0.5}, good));
  EXPECT_THROW(made({1, 1.2}, good), std::invalid_argument);
  EXPECT_THROW(made({-1, 0}, good), std::invalid_argument);
  EXPECT_THROW(made({1, 0.5}, with([](RayStart& s) { s.radial_sign = 0; })), std::invalid_argument);
  EXPECT_THROW(made({1, 0.5}, with([](RayStart& s) { s.eta = std::nan(""); })), std::invalid_argument);
  EXPECT_THROW(made({1, 0.5}, with([](RayStart& s) { s.r = 1.8; })), std::domain_error);       // below r+
  EXPECT_THROW(made({1, 0.5}, with([](RayStart& s) { s.r = 4; })), std::domain_error);         // R < 0
  EXPECT_THROW(made({1, 0.5}, with([](RayStart& s) { s.theta = 0.05; })), std::domain_error);  // Theta < 0
  EXPECT_THROW(made({1, 0.5}, with([](RayStart& s) { s.theta = 0; })), std::domain_error);     // L on the axis
  EXPECT_THROW(made({1, 0.5}, with([](RayStart& s) { s.theta = 4; })), std::domain_error);
  EXPECT_THROW(KerrRay({1, 0.5}, kerr_exact::RayEvent{.r = 20, .theta = 1, .p_t = 0, .p_phi = 1}), std::domain_error);
  // Deep in the ergosphere of a = 0.99, L = 4: R > 0, but such light has E < 0.
  EXPECT_THROW(KerrRay({1, 0.99}, RayStart{.r = 1.15, .theta = pi / 2, .lambda = 4, .eta = 0, .radial_sign = -1}),
               std::domain_error);
  const KerrRay ray(RayHole{1, 0.5}, good);
  EXPECT_THROW((void)ray.at_radius(1.5, 0), std::domain_error);
  EXPECT_FALSE(ray.at_radius(2.0, 0).reached);   // inside the turning point
  EXPECT_FALSE(ray.at_radius(30.0, 0).reached);  // behind
  EXPECT_FALSE(ray.at_radius(30.0, 2).reached);
  EXPECT_TRUE(ray.at_radius(30.0, 1).reached);
}

}  // namespace
