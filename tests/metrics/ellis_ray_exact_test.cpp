#include "metrics/ellis_ray_exact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "metrics/ellis_exact.hpp"
#include "metrics/kerr_ray_exact.hpp"
#include "metrics/schwarzschild_exact.hpp"

namespace {

using namespace xpr;
using ellis_exact::EllisRay;
using ellis_exact::WormholeArrival;
using ellis_exact::WormholeEnd;
using ellis_exact::WormholeStart;
using std::numbers::pi;

// In the equatorial plane, b from 0.2 to 30 throat radii and next to b0: the closed forms at 113 bits, whose own tests
// integrate at 50 digits.
TEST(EllisRay, sweeps_and_lasts_as_the_wide_closed_forms) {
  for (const double b : {0.2, 0.9, 0.999999, 1.000001, 1.1, 3.0, 30.0}) {
    const double far = 40.0, far_end = b < 1 ? -25.0 : 60.0;
    const EllisRay ray(1.0, WormholeStart{.l = far, .theta = pi / 2, .lambda = b, .p_theta = 0, .radial_sign = -1});
    const WormholeArrival end = ray.at_end(std::abs(far_end));
    ASSERT_TRUE(end.reached) << b;
    EXPECT_EQ(end.l, far_end);
    EXPECT_EQ(end.end, b < 1 ? WormholeEnd::negative : WormholeEnd::positive);
    EXPECT_EQ(end.radial_sign, b < 1 ? -1 : 1);
    const ExactValue swept = ellis_exact::swept_angle(1.0, b, far, far_end, b > 1);
    const ExactValue time = ellis_exact::coordinate_time(1.0, b, far, far_end, b > 1);
    EXPECT_LE(std::abs(end.swept.value - swept.value), end.swept.error + swept.error) << b;
    EXPECT_LE(std::abs(end.time.value - time.value), end.time.error + time.error) << b;
    EXPECT_LE(end.swept.error, 1e-13) << b;
    EXPECT_NEAR(end.direction.phi.value, swept.value, end.direction.phi.error) << b;
    // Part of the way in, and out again.
    const double part = b > 1 ? 35.0 : -0.5;
    const WormholeArrival inward = ray.at(part, 0);
    const ExactValue part_swept = ellis_exact::swept_angle(1.0, b, far, part, false);
    EXPECT_LE(std::abs(inward.swept.value - part_swept.value), inward.swept.error + part_swept.error) << b;
  }
}

// The rotation into the sky is the same in every spherical spacetime: Kerr's own formulas at a = 0 give its theta and
// phi.
TEST(OrbitalPlane, points_where_the_separated_equations_do) {
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 60; ++i) {
    const double theta = std::acos(unit(engine)), p_theta = 8.0 * unit(engine), across = 8.0 * unit(engine);
    const double lambda = across * std::sin(theta), b = std::hypot(p_theta, across);
    if (b < 5.3) continue;
    const kerr_exact::Arrival kerr =
        kerr_exact::KerrRay({1.0, 0.0}, kerr_exact::RayMomentum{60.0, theta, lambda, p_theta, -1}).at_radius(60.0, 1);
    const ExactValue swept = schwarzschild_exact::swept_angle(1.0, b, 60.0, 60.0, true);
    const OrbitalPlane plane(std::cos(theta), std::sin(theta), lambda, p_theta);
    // Rounding b moves what is swept by |d chi/db| < 30 of it.
    const PlaneEnd end = plane.after(swept.value, swept.error + 30.0 * 4e-16 * b);
    EXPECT_NEAR(end.theta.value, kerr.theta.value, end.theta.error + kerr.theta.error);
    EXPECT_NEAR(end.phi.value, kerr.phi.value, end.phi.error + kerr.phi.error);
    EXPECT_EQ(end.polar_turns, kerr.polar_turns);
    EXPECT_EQ(end.polar_sign, kerr.polar_sign);
  }
}

TEST(OrbitalPlane, counts_windings_and_crossings) {
  const OrbitalPlane tilted(0.6, 0.8, 0.4, 0.3);
  for (int turns = 0; turns < 4; ++turns) {
    const PlaneEnd end = tilted.after(2 * pi * turns + 1.0, 0.0);
    EXPECT_NEAR(end.phi.value, tilted.after(1.0, 0.0).phi.value + 2 * pi * turns, 1e-14);
    EXPECT_EQ(end.polar_turns, tilted.after(1.0, 0.0).polar_turns + 2 * turns);
  }
  // South over the pole from theta = 2: there after pi - 2.
  const OrbitalPlane meridian(std::cos(2.0), std::sin(2.0), 0.0, 1.5);
  EXPECT_EQ(meridian.after(1.0, 0.0).axis_crossings, 0);
  EXPECT_EQ(meridian.after(1.2, 0.0).axis_crossings, 1);
  EXPECT_EQ(meridian.after(1.2, 0.0).phi.value, pi);
  EXPECT_NEAR(meridian.after(1.2, 0.0).theta.value, 2 * pi - 3.2, 1e-15);
}

TEST(EllisRay, winds_towards_the_throat_at_the_critical_impact_parameter) {
  const EllisRay ray(2.0, WormholeStart{.l = 6, .theta = pi / 2, .lambda = 2, .p_theta = 0, .radial_sign = -1});
  EXPECT_EQ(ray.end(), WormholeEnd::throat);
  EXPECT_FALSE(ray.at_end(6).reached);
  EXPECT_FALSE(ray.at(-1, 0).reached);
  const WormholeArrival near = ray.at(1e-3, 0);
  ASSERT_TRUE(near.reached);
  EXPECT_NEAR(near.swept.value, std::asinh(2e3) - std::asinh(1.0 / 3.0), near.swept.error + 1e-15);
  const ExactValue time = ellis_exact::coordinate_time(2.0, 2.0, 6, 1e-3, false);
  EXPECT_NEAR(near.time.value, time.value, near.time.error);
  EXPECT_EQ(EllisRay(2.0, WormholeStart{.l = 6, .theta = pi / 2, .lambda = 2, .radial_sign = 1}).end(),
            WormholeEnd::positive);
}

TEST(EllisRay, refuses_what_no_light_does) {
  const auto made = [](double throat, const WormholeStart& start) { return EllisRay(throat, start).end(); };
  EXPECT_THROW(made(0.0, {.l = 1, .theta = 1}), std::invalid_argument);
  EXPECT_THROW(made(1.0, {.l = std::nan(""), .theta = 1}), std::invalid_argument);
  EXPECT_THROW(made(1.0, {.l = 1, .theta = 1, .radial_sign = 2}), std::invalid_argument);
  EXPECT_THROW(made(1.0, {.l = 1, .theta = 4}), std::domain_error);
  EXPECT_THROW(made(1.0, {.l = 1, .theta = 0, .lambda = 0.1}), std::domain_error);
  EXPECT_THROW(made(1.0, {.l = 1, .theta = pi / 2, .lambda = 5}), std::domain_error);  // turns at 4.9
  EXPECT_THROW(made(1.0, {.l = 0, .theta = pi / 2, .lambda = 1}), std::domain_error);
  const EllisRay ray(1.0, {.l = 10, .theta = pi / 2, .lambda = 5});
  EXPECT_FALSE(ray.at(4.0, 0).reached);
  EXPECT_FALSE(ray.at(11.0, 0).reached);
  EXPECT_FALSE(ray.at(-11.0, 1).reached);
  EXPECT_TRUE(ray.at(11.0, 1).reached);
}

}  // namespace
