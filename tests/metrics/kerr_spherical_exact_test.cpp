#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "exact_kit.hpp"
#include "metrics/kerr_exact.hpp"

namespace {

using namespace xpr;
using exact_kit::BoundCheck;
using exact_kit::integrate;
using exact_kit::Mp;
using exact_kit::sq;
using kerr_exact::Sense;
namespace exact = kerr_exact;

std::string at(double a, double r) { return "a = " + Mp(a).str(17) + ", r = " + Mp(r).str(17); }

// The radial potential and its slopes in r at 50 digits, M = 1, E = 1.
struct Radial {
  Mp a, xi, eta;
  [[nodiscard]] Mp value(const Mp& r) const {
    return exact::radial_potential(Mp(1), a, exact::RayConstants<Mp>{Mp(1), xi, eta}, r);
  }
  [[nodiscard]] Mp slope(const Mp& r) const {
    return 4 * r * (r * r + a * a - a * xi) - (2 * r - 2) * (eta + sq(xi - a));
  }
  [[nodiscard]] Mp curvature(const Mp& r) const {
    return 4 * (r * r + a * a - a * xi) + 8 * r * r - 2 * (eta + sq(xi - a));
  }
};

// An orbit by quadrature of Theta over the latitude, cos theta = sqrt(u+) sin x.
struct Oscillation {
  Mp period, azimuth, time;
  Oscillation(const Mp& a, const Mp& r, const Mp& xi, const Mp& eta) {
    const Mp middle = xi * xi + eta - a * a, root = sqrt(middle * middle + 4 * a * a * eta);
    const Mp u_plus = (root - middle) / (2 * a * a), u_minus = -(root + middle) / (2 * a * a);
    const Mp delta = r * r - 2 * r + a * a, forward = (r * r + a * a - a * xi) / delta;
    const auto over = [&](auto&& rate) {
      return Mp(4 * integrate(
                        [&](const Mp& x) {
                          const Mp u = u_plus * sq(sin(x));
                          return Mp(rate(u) / (abs(a) * sqrt(u - u_minus)));
                        },
                        Mp(0), exact_kit::pi() / 2));
    };
    period = over([](const Mp&) { return Mp(1); });
    azimuth = over([&](const Mp& u) { return Mp(xi / (1 - u) - a + a * forward); });
    time = over([&](const Mp& u) { return Mp((r * r + a * a) * forward + a * xi - a * a * (1 - u)); });
  }
};

TEST(KerrSphericalOrbit, teos_extremal_examples) {
  const double s2 = std::sqrt(2.0), s3 = std::sqrt(3.0);
  const struct {
    double r, xi, eta;
  } rows[] = {{1 + s2, 0, 11 + 8 * s2},
              {1 + s3, -1, 12 + 8 * s3},
              {3, -2, 27},
              {1 + 2 * s2, -6, -13 + 16 * s2},
              {2, 1, 16},
              {1.0316, 1.99900144, 3.25879036287793}};
  for (const auto& row : rows) {
    const auto orbit = exact::spherical_orbit(1, 1, row.r);
    // r is a rounded surd: xi and eta move by |d eta/dr| < 40 times 4e-16.
    EXPECT_NEAR(orbit.xi.value, row.xi, 4e-15) << row.r;
    EXPECT_NEAR(orbit.eta.value, row.eta, 2e-14) << row.r;
  }
}

TEST(KerrSphericalOrbit, oscillation_is_the_catalogued_digits) {
  const double s2 = std::sqrt(2.0), s3 = std::sqrt(3.0);
  const struct {
    double a, r, azimuth, period, gamma;
  } rows[] = {{1, 1 + s3, -3.713759403902877, 1.20255273675939, 2.615946335697179},
              {1, 3, -4.072767165430038, 1.12290236639429, 2.750537828629762},
              {1, 1 + 2 * s2, -4.744968901749167, 0.937169377743717, 3.08390349040563},
              {1, 2, 10.84278803951935, 1.50577622772191, 2.129489163143327},
              {1, 1.0316, 159.5289420696549, 2.37871900512389, 0.4294794126335896},
              {0.9, 2.5, 9.047483696980271, 1.31398324672716, 2.615160454521323},
              {0.5, 3.2, -5.228305227328578, 1.11812321784575, 3.069419871016817}};
  for (const auto& row : rows) {
    const auto orbit = exact::spherical_orbit(1, row.a, row.r);
    // 15-16 printed digits, and the rounding of r: at 1.0316, 1e-16 times d(azimuth)/dr = 5e3.
    EXPECT_NEAR(orbit.azimuth.value, row.azimuth, row.r == 1.0316 ? 6e-13 : 1e-14) << row.a << " " << row.r;
    EXPECT_NEAR(orbit.mino_period.value, row.period, 1e-14) << row.a << " " << row.r;
    EXPECT_NEAR(orbit.lyapunov_half_orbit.value, row.gamma, 1e-14) << row.a << " " << row.r;
  }
  // Phi = 0 at r = 1 + sqrt2: the catalogued azimuth counts no turn for the axis; on either side it is 2 pi off.
  const auto below = exact::spherical_orbit(1, 1, 1 + s2 - 1e-9), above = exact::spherical_orbit(1, 1, 1 + s2 + 1e-9);
  EXPECT_NEAR(below.azimuth.value - 2 * M_PI, 3.176118755006392, 1e-8);
  EXPECT_NEAR(above.azimuth.value + 2 * M_PI, 3.176118755006392, 1e-8);
  EXPECT_NEAR(below.mino_period.value, 1.3155914640312, 1e-8);
  EXPECT_NEAR(below.lyapunov_half_orbit.value, 2.430896053529963, 1e-8);
}

TEST(KerrSphericalOrbit, matches_the_radial_double_root_and_quadrature_over_latitude) {
  BoundCheck check(1e-14);
  for (const double a : {1e-6, -0.3, 0.7, 0.9, -0.998, 1 - 1e-13, 1.0}) {
    const double low = exact::photon_orbit_radius(1, a, Sense::prograde).value;
    const double high = exact::photon_orbit_radius(1, a, Sense::retrograde).value;
    for (const double part : {1e-9, 0.01, 0.2, 0.41, 0.6, 0.8, 0.99, 1 - 1e-9}) {
      const double r = low + part * (high - low);
      if (r <= 1 + 1e-7) continue;  // at a = M the azimuth itself grows as 1/(r - M)
      const auto orbit = exact::spherical_orbit(1, a, r);
      // xi from R = R' = 0: R' gives eta + (xi - a)^2, then R is linear in (r^2 + a^2 - a xi).
      const Mp spin = a, radius = r, delta = radius * radius - 2 * radius + spin * spin;
      const Mp xi = (radius * radius + spin * spin - 2 * radius * delta / (radius - 1)) / spin;
      const Mp eta = 4 * radius * radius * delta / sq(radius - 1) - sq(xi - spin);
      check(orbit.xi, xi, at(a, r));
      check(orbit.eta, eta, at(a, r));
      const Radial radial{spin, xi, eta};
      EXPECT_LE(abs(radial.value(radius)) + abs(radial.slope(radius)), Mp("1e-40"));
      const Oscillation reference(spin, radius, xi, eta);
      check(orbit.mino_period, reference.period, at(a, r));
      check(orbit.azimuth, reference.azimuth, at(a, r));
      check(orbit.time, reference.time, at(a, r));
      check(orbit.lyapunov_half_orbit, sqrt(radial.curvature(radius) / 2) * reference.period / 2, at(a, r));
    }
  }
  EXPECT_GT(check.points(), 300);
}

TEST(KerrSphericalOrbit, ends_are_the_equatorial_orbits_and_mass_is_a_unit) {
  for (const double a : {0.5, 0.9}) {
    for (const Sense sense : {Sense::prograde, Sense::retrograde}) {
      const auto orbit = exact::spherical_orbit(1, a, exact::photon_orbit_radius(1, a, sense).value);
      EXPECT_NEAR(orbit.xi.value, exact::critical_impact_parameter(1, a, sense).value, 4e-15);
      EXPECT_NEAR(orbit.eta.value, 0, 1e-13);  // d eta/dr times the rounding of r
    }
  }
  const auto one = exact::spherical_orbit(1, 0.9, 2.5), four = exact::spherical_orbit(4, 3.6, 10);
  EXPECT_EQ(four.xi.value, 4 * one.xi.value);
  EXPECT_EQ(four.eta.value, 16 * one.eta.value);
  EXPECT_EQ(four.mino_period.value, one.mino_period.value / 4);
  EXPECT_EQ(four.time.value, 4 * one.time.value);
  EXPECT_EQ(four.azimuth.value, one.azimuth.value);
  const auto mirrored = exact::spherical_orbit(1, -0.9, 2.5);
  EXPECT_EQ(mirrored.xi.value, -one.xi.value);
  EXPECT_EQ(mirrored.azimuth.value, -one.azimuth.value);
  EXPECT_NEAR(exact::spherical_orbit(1, 1e-9, 3.0).lyapunov_half_orbit.value, M_PI, 1e-8);
}

TEST(KerrShadow, extent_is_the_catalogued_digits) {
  const double degree = M_PI / 180;
  const struct {
    double a, i, left, right, highest, alpha_at_highest;
  } rows[] = {{0.5, 90, -4.09626665871387, 6.13815572471545, 5.19615242270663, 1.0},
              {0.9, 90, -2.84442140347617, 6.83231923044667, 5.19615242270663, 1.8},
              {0.9, 60, -3.09590797115244, 6.58940897612201, 5.13546837690077, 1.59713438631948},
              {0.99, 30, -3.55050779561228, 5.95848026495941, 4.94731857951547, 1.10969230894579}};
  for (const auto& row : rows) {
    const auto shadow = exact::shadow_extent(1, row.a, row.i * degree);
    EXPECT_NEAR(shadow.alpha_left.value, row.left, 8e-15) << row.a << " " << row.i;
    EXPECT_NEAR(shadow.alpha_right.value, row.right, 8e-15) << row.a << " " << row.i;
    EXPECT_NEAR(shadow.beta_max.value, row.highest, 8e-15) << row.a << " " << row.i;
    EXPECT_NEAR(shadow.alpha_at_beta_max.value, row.alpha_at_highest, 8e-15) << row.a << " " << row.i;
    const auto mirrored = exact::shadow_extent(1, -row.a, row.i * degree);
    EXPECT_EQ(mirrored.alpha_left.value, -shadow.alpha_right.value);
    EXPECT_EQ(mirrored.alpha_at_beta_max.value, -shadow.alpha_at_beta_max.value);
  }
  EXPECT_NEAR(exact::shadow_extent(1, 0, 1.0).beta_max.value, 3 * std::sqrt(3.0), 1e-15);
  // a = M, edge on: the straight part stands at alpha = -2, from beta = -sqrt3 to sqrt3.
  EXPECT_NEAR(exact::shadow_extent(1, 1, M_PI / 2).alpha_left.value, -2, 1e-15);
  EXPECT_NEAR(exact::shadow_extent(1, 1, M_PI / 2).alpha_right.value, 7, 1e-15);
}

// The integral of rho^2 over half a turn about the middle, by the trapezoidal rule: periodic and smooth, 32 intervals
// leave round-off. The areas are printed to 13 decimals or 15 digits.
TEST(KerrShadow, encloses_the_catalogued_areas) {
  const struct {
    double a, i, area;
  } rows[] = {{0.5, 90, 83.5610541284615},
              {0.9, 90, 79.5871255238728},
              {0.9, 60, 78.5589424588582},
              {0.99, 30, 74.170716437223}};
  for (const auto& row : rows) {
    const double inclination = row.i * M_PI / 180;
    const auto extent = exact::shadow_extent(1, row.a, inclination);
    const double centre = 0.5 * (extent.alpha_left.value + extent.alpha_right.value);
    double area = 0;
    for (int k = 0; k <= 32; ++k) {
      const auto edge = exact::shadow_edge(1, row.a, inclination, centre, M_PI * k / 32);
      area += (k % 32 == 0 ? 0.5 : 1.0) * M_PI / 32 *
              (std::pow(edge.alpha.value - centre, 2) + std::pow(edge.beta.value, 2));
    }
    EXPECT_NEAR(area, row.area, 2e-13) << row.a << " " << row.i;  // half a digit, and round-off of 33 terms of size 2.5
  }
}

// A point of the edge: the ray with these constants has a double root of R at some r, the spherical orbit's.
TEST(KerrShadow, edge_points_are_critical_rays_under_the_asked_angle) {
  int points = 0;
  for (const double a : {-0.9, 1e-5, 0.3, 0.7, 0.998, 1.0}) {
    for (const double i : {0.2, 0.9, M_PI / 2, 2.5}) {
      const auto extent = exact::shadow_extent(1, a, i);
      for (const double centre : {0.0, 0.5 * (extent.alpha_left.value + extent.alpha_right.value)}) {
        for (const double angle : {-M_PI, -2.9, -1.1, 0.0, 1e-9, 0.4, 1.5, 2.0, 3.0, 3.1415, M_PI}) {
          const auto point = exact::shadow_edge(1, a, i, centre, angle);
          const std::string where = at(a, i) + ", angle " + std::to_string(angle);
          const Mp alpha = point.alpha.value, beta = point.beta.value;
          EXPECT_NEAR(std::atan2(point.beta.value, point.alpha.value - centre), angle, 2e-15 * 4) << where;
          EXPECT_LE(point.alpha.error + point.beta.error, 1e-14) << where;
          const Mp xi = -alpha * sin(Mp(i)), eta = (alpha * alpha - sq(Mp(a))) * sq(cos(Mp(i))) + beta * beta;
          const Radial radial{a, xi, eta};
          Mp r = 10;  // Newton from outside to the largest zero of the convex R'
          for (int step = 0; step < 200; ++step) r -= radial.slope(r) / radial.curvature(r);
          // dR = (dR/dxi) dxi + (dR/deta) deta, from the claimed errors and the arguments' own weight.
          const Mp delta = r * r - 2 * r + sq(Mp(a));
          const Mp d_xi = abs(-2 * a * (r * r + a * a - a * xi) - 2 * delta * (xi - a));
          const Mp bound =
              Mp(point.alpha.error) * (d_xi + 2 * delta * abs(alpha)) + Mp(point.beta.error) * 2 * delta * abs(beta);
          // At a = M, R on the straight part has its double root at the horizon, where Newton's r is 1 to 1e-16 only.
          EXPECT_LE(abs(radial.value(r)), bound + Mp("1e-28")) << where;
          EXPECT_GE(r, 1 - Mp("1e-14")) << where;
          ++points;
        }
      }
    }
  }
  EXPECT_EQ(points, 528);
}

TEST(KerrShadow, curve_by_radius_lies_on_the_edge) {
  for (const double a : {0.3, -0.9, 1.0}) {
    for (const double i : {0.4, 1.3}) {
      for (const double r : {2.75, 2.9, 3.05}) {
        if (std::abs(a) == 0.3 && r < 2.8) continue;  // no such orbit seen
        const auto by_radius = exact::shadow_curve(1, a, i, r);
        const double angle = std::atan2(by_radius.beta.value, by_radius.alpha.value);
        const auto by_angle = exact::shadow_edge(1, a, i, 0, angle);
        EXPECT_NEAR(by_radius.alpha.value, by_angle.alpha.value, 8e-15) << at(a, r);
        EXPECT_NEAR(by_radius.beta.value, by_angle.beta.value, 8e-15) << at(a, r);
      }
    }
  }
  const auto circle = exact::shadow_edge(1, 0, 1.0, 0.7, 2.0);
  EXPECT_NEAR(std::hypot(circle.alpha.value, circle.beta.value), 3 * std::sqrt(3.0), 2e-15);
  EXPECT_NEAR(std::atan2(circle.beta.value, circle.alpha.value - 0.7), 2.0, 1e-15);
}

TEST(KerrPotentials, fixture_has_its_constants_and_roots) {
  // a = 0.9, i = 60 deg, screen (5, 4): lambda, eta and the four radial roots as catalogued (14 digits).
  const double i = M_PI / 3, a = 0.9;
  const double lambda = -5 * std::sin(i), eta = (25 - a * a) * std::cos(i) * std::cos(i) + 16;
  EXPECT_NEAR(lambda, -4.33012701892219, 5e-15);
  EXPECT_NEAR(eta, 22.0475, 1e-14);
  const exact::RayConstants<double> ray{1, lambda, eta};
  for (const double root : {-7.3342372132194, 0.19633292809827, 2.9899102227491, 4.147994062372}) {
    // R' is up to 1e3 here, times half a unit of the twelfth to fourteenth decimal.
    EXPECT_NEAR(exact::radial_potential(1.0, a, ray, root), 0, 1e3 * 6e-13) << root;
  }
  EXPECT_NEAR(exact::polar_potential(a, ray, 0.545335748088869), 0, 1e-12);
  // Carter's constant from p_theta: E = 1, L = 2, p_theta = 6, theta = 1, a = 0.6.
  const double q = exact::carter_constant(0.6, 1.0, 2.0, 6.0, std::cos(1.0) * std::cos(1.0));
  EXPECT_NEAR(q, 37.5440381403280533, 2e-14);
  EXPECT_NEAR(exact::polar_potential(0.6, {1.0, 2.0, q}, std::cos(1.0) * std::cos(1.0)), 36, 1e-13);
  EXPECT_NEAR(exact::radial_potential(1.0, 0.6, exact::RayConstants<double>{1.0, 2.0, q}, 5.12725436642659012), 0,
              1e-11);
}

TEST(KerrSphericalOrbit, bad_arguments_throw) {
  EXPECT_THROW((void)exact::spherical_orbit(1, 0, 3), std::domain_error);
  EXPECT_THROW((void)exact::spherical_orbit(1, 0.9, 1.5), std::domain_error);
  EXPECT_THROW((void)exact::spherical_orbit(1, 0.9, 4), std::domain_error);
  EXPECT_THROW((void)exact::spherical_orbit(1, 1, 1), std::domain_error);
  EXPECT_THROW((void)exact::spherical_orbit(1, 1.1, 3), std::invalid_argument);
  EXPECT_THROW((void)exact::shadow_curve(1, 0.9, 0.3, 1.6), std::domain_error);
  EXPECT_THROW((void)exact::shadow_extent(1, 0.9, 0), std::domain_error);
  EXPECT_THROW((void)exact::shadow_extent(1, 0.9, 3.2), std::domain_error);
  EXPECT_THROW((void)exact::shadow_edge(1, 0.9, 1.0, -4, 0.3), std::domain_error);
  EXPECT_THROW((void)exact::shadow_edge(1, 0.9, 1.0, 0, 7), std::domain_error);
}

}  // namespace
