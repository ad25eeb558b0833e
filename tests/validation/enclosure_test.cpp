// Proven enclosures: right where papers print digits, the same by two routes, and the judge of the closed forms that
// work in doubles.
#include "validation/truth/enclosure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "metrics/ellis_exact.hpp"
#include "metrics/kerr_exact.hpp"
#include "metrics/schwarzschild_exact.hpp"

namespace xpr {
namespace {

using kerr_exact::Sense;

/// The double closed form keeps its word: the true number lies within its stated error.
void expect_within(const ExactValue& claimed, const Ball& truth, const std::string& where) {
  const Ball miss = abs(Ball(claimed.value) - truth);
  EXPECT_FALSE(miss > Ball(claimed.error))
      << where << ": " << claimed.value << " +- " << claimed.error << ", truth " << decimal_text(truth, 20);
}

/// Digits as a paper has them, of an argument that a double holds exactly.
void expect_printed(const Ball& truth, const std::string& printed, int digits) {
  EXPECT_EQ(decimal_text(truth, digits), printed);
}

TEST(Ball, keeps_what_is_true_inside) {
  const Ball third = Ball(1) / Ball(3);
  EXPECT_TRUE((third * Ball(3)).contains(Ball(1)));
  EXPECT_GT(third.radius(), 0.0);
  EXPECT_FALSE(third < third);  // a comparison that is not certain is false
  EXPECT_EQ(decimal_text(sqrt(Ball(2)), 30), "1.41421356237309504880168872421e+00");
  const ExactValue pi = proven(ball_pi());
  EXPECT_EQ(pi.value, 3.141592653589793);
  // pi less its double is 1.2246467991473532e-16.
  EXPECT_NEAR(pi.error, 1.2246467991473532e-16, 1e-24);
  EXPECT_GE(pi.error, 1.2246467991473531e-16);
}

TEST(Ball, refuses_digits_and_proofs_that_it_does_not_have) {
  const Ball nothing = sqrt(Ball(-1));
  EXPECT_FALSE(nothing.finite());
  EXPECT_THROW((void)proven(nothing), std::domain_error);
  EXPECT_THROW((void)decimal_text(nothing, 5), std::domain_error);
  EXPECT_THROW((void)decimal_text(ball_pi(), 130), std::domain_error);
  // (x - 1)^2 (x - 2)
  EXPECT_THROW((void)real_roots({-2, 5, -4, 1}), std::domain_error);
  const std::vector<Ball> roots = real_roots({-6, 11, -6, 1});
  ASSERT_EQ(roots.size(), 3U);
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(roots[static_cast<std::size_t>(k)].contains(Ball(k + 1)));
  EXPECT_EQ(real_roots({1, 0, 1, 1}).size(), 1U);
}

TEST(Enclosure, has_the_digits_of_the_literature) {
  expect_printed(enclosure::schwarzschild_deflection(1.0, 5.5), "2.5530201823453383129e+00", 20);
  expect_printed(enclosure::schwarzschild_deflection(1.0, 8.0), "8.5873001807909526024e-01", 20);
  expect_printed(enclosure::schwarzschild_deflection(1.0, 10.0), "5.9039578760582732122e-01", 20);
  expect_printed(enclosure::schwarzschild_deflection(1.0, 1000.0), "4.0118238099253647101e-03", 20);
  expect_printed(enclosure::schwarzschild_periapsis(1.0, 10.0), "8.788850662499728e+00", 16);
  expect_printed(enclosure::kerr_deflection(1.0, 0.5, 6.0), "1.2263997980084294142e+00", 20);
  expect_printed(enclosure::kerr_periapsis(1.0, 0.5, 6.0), "4.815124439894567e+00", 16);
  expect_printed(enclosure::ellis_deflection(1.0, 1.25), "8.49012901739665537e-01", 18);
  expect_printed(enclosure::ellis_deflection(1.0, 3.0), "9.31808176596716147e-02", 18);
  expect_printed(enclosure::ellis_transit_angle(1.0, 0.5), "1.68575035481259604e+00", 18);
  const enclosure::SphericalOrbit orbit = enclosure::kerr_spherical_orbit(1.0, 1.0, 3.0);  // Teo's third: Q = 27
  EXPECT_TRUE(orbit.eta.contains(Ball(27)) && orbit.xi.contains(Ball(-2)));
  expect_printed(orbit.azimuth, "-4.072767165430038e+00", 16);
  expect_printed(orbit.mino_period, "1.12290236639429e+00", 15);
  expect_printed(orbit.lyapunov_half_orbit, "2.750537828629762e+00", 16);
  const enclosure::CriticalParameters critical = enclosure::kerr_critical_parameters(1.0, 0.5);
  expect_printed(critical.prograde_radius, "2.34729635533386e+00", 15);
  expect_printed(critical.retrograde_radius, "3.53208888623796e+00", 15);
  expect_printed(critical.polar_radius, "2.88321774192635e+00", 15);
  expect_printed(critical.prograde_b, "4.09626665871387e+00", 15);
  expect_printed(critical.retrograde_b, "-6.13815572471545e+00", 15);
}

TEST(Enclosure, of_kerr_deflection_is_the_same_by_legendre_and_by_proven_quadrature) {
  for (const double a : {1e-9, 0.3, 0.9, 0.998, -0.7}) {
    for (const double b : {7.3, -7.3, 12.0, -40.0}) {
      const Ball first = enclosure::kerr_deflection(1.0, a, b);
      const Ball second = enclosure::kerr_deflection_by_quadrature(1.0, a, b);
      EXPECT_TRUE(first.overlaps(second)) << a << " " << b;
      EXPECT_LT(second.radius(), 1e-50) << a << " " << b;  // asked for 200 bits
    }
  }
  EXPECT_TRUE(
      enclosure::kerr_deflection(1.0, 0.0, 7.3).overlaps(enclosure::kerr_deflection_by_quadrature(1.0, 0.0, 7.3)));
  // Without spin both are Darwin's; a spin of 1e-30 moves them by some 1e-31.
  const Ball spun = enclosure::kerr_deflection(1.0, 1e-30, 7.3);
  EXPECT_LT(std::abs(proven(spun - enclosure::schwarzschild_deflection(1.0, 7.3)).value), 1e-30);
  EXPECT_FALSE(spun.overlaps(enclosure::schwarzschild_deflection(1.0, 7.3)));
}

TEST(Enclosure, of_schwarzschild_is_darwin_s_formula_against_the_periapsis) {
  for (const double b : {5.2, 5.5, 8.0, 100.0}) {
    const Ball P = enclosure::schwarzschild_periapsis(1.0, b), two = 2, six = 6;
    const Ball Q = sqrt((P - two) * (P + six)), m = (Q - P + six) / (two * Q);
    const Ball zeta = asin(sqrt((Q - P + two) / (Q - P + six)));
    const Ball alpha = Ball(4) * sqrt(P / Q) * (legendre_k(m) - legendre_f(zeta, m)) - ball_pi();
    EXPECT_TRUE(alpha.overlaps(enclosure::schwarzschild_deflection(1.0, b))) << b;
  }
}

TEST(Enclosure, of_the_shadow_is_tangent_where_it_is_highest_and_closes_at_its_ends) {
  for (const double i : {0.2, 1.0, 1.5707963267948966, 2.3}) {
    const enclosure::ShadowExtent e = enclosure::kerr_shadow_extent(1.0, 0.9, i);
    const double centre = 0.5 * (proven(e.alpha_left).value + proven(e.alpha_right).value);
    const double across = proven(e.alpha_at_beta_max).value - centre, up = proven(e.beta_max).value;
    const enclosure::ScreenPoint top = enclosure::kerr_shadow_edge(1.0, 0.9, i, centre, std::atan2(up, across));
    // The angle is rounded to 1e-16, along a tangent: beta to the square of that.
    EXPECT_NEAR(proven(top.beta - e.beta_max).value, 0.0, 1e-30);
    EXPECT_NEAR(proven(top.alpha - e.alpha_at_beta_max).value, 0.0, 1e-14);
    const enclosure::ScreenPoint right = enclosure::kerr_shadow_edge(1.0, 0.9, i, centre, 1e-9);
    EXPECT_NEAR(proven(right.alpha - e.alpha_right).value, 0.0, 1e-16);
  }
  // In the equator the ends are the two critical rays. The stored right angle is off by 6e-17.
  const enclosure::ShadowExtent e = enclosure::kerr_shadow_extent(1.0, 0.9, 1.5707963267948966);
  const enclosure::CriticalParameters c = enclosure::kerr_critical_parameters(1.0, 0.9);
  EXPECT_NEAR(proven(e.alpha_left + c.prograde_b).value, 0.0, 1e-30);
  EXPECT_NEAR(proven(e.alpha_right + c.retrograde_b).value, 0.0, 1e-30);
  EXPECT_NEAR(proven(e.beta_max - sqrt(Ball(27))).value, 0.0, 1e-30);
}

TEST(Enclosure, scales_with_the_mass_and_mirrors_with_the_spin) {
  EXPECT_TRUE(enclosure::kerr_deflection(2.0, 1.0, 20.0).overlaps(enclosure::kerr_deflection(1.0, 0.5, 10.0)));
  EXPECT_TRUE(enclosure::kerr_deflection(1.0, -0.5, 10.0).overlaps(enclosure::kerr_deflection(1.0, 0.5, -10.0)));
  EXPECT_TRUE((-enclosure::kerr_shadow_extent(1.0, -0.5, 1.0).alpha_left)
                  .overlaps(enclosure::kerr_shadow_extent(1.0, 0.5, 1.0).alpha_right));
  const enclosure::ScreenPoint up = enclosure::kerr_shadow_edge(1.0, 0.5, 1.0, 0.5, 2.0);
  const enclosure::ScreenPoint down = enclosure::kerr_shadow_edge(1.0, 0.5, 1.0, 0.5, -2.0);
  EXPECT_TRUE(up.alpha.overlaps(down.alpha) && up.beta.overlaps(-down.beta) && up.beta > Ball(0));
}

TEST(Enclosure, judges_the_closed_forms_in_doubles) {
  std::mt19937_64 random(19590101);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  for (int n = 0; n < 60; ++n) {
    const double excess = std::pow(10.0, uniform(-12.0, 2.0));
    const double b = 5.196152422706632 * (1.0 + excess);
    const std::string where = "b/b_c - 1 = " + std::to_string(excess);
    expect_within(schwarzschild_exact::deflection(1.0, b), enclosure::schwarzschild_deflection(1.0, b), where);
    expect_within(schwarzschild_exact::periapsis(1.0, b), enclosure::schwarzschild_periapsis(1.0, b), where);
    expect_within(ellis_exact::deflection(1.0, 1.0 + excess), enclosure::ellis_deflection(1.0, 1.0 + excess), where);
    const double a = uniform(-0.999, 0.999);
    for (const Sense sense : {Sense::prograde, Sense::retrograde}) {
      const enclosure::CriticalParameters c = enclosure::kerr_critical_parameters(1.0, a);
      const bool prograde = sense == Sense::prograde;
      const Ball& critical = prograde ? c.prograde_b : c.retrograde_b;
      expect_within(kerr_exact::critical_impact_parameter(1.0, a, sense), critical, where);
      expect_within(kerr_exact::photon_orbit_radius(1.0, a, sense), prograde ? c.prograde_radius : c.retrograde_radius,
                    where);
      const double signed_b = proven(critical).value * (1.0 + excess);
      expect_within(kerr_exact::equatorial_deflection(1.0, a, signed_b), enclosure::kerr_deflection(1.0, a, signed_b),
                    where + ", a = " + std::to_string(a));
    }
    expect_within(kerr_exact::polar_photon_orbit_radius(1.0, a),
                  enclosure::kerr_critical_parameters(1.0, a).polar_radius, where);
  }
}

TEST(Enclosure, judges_the_spherical_orbits_and_the_shadow_in_doubles) {
  std::mt19937_64 random(20030101);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  for (int n = 0; n < 25; ++n) {
    const double a = uniform(0.01, 0.999) * (n % 2 == 0 ? 1.0 : -1.0);
    const enclosure::CriticalParameters c = enclosure::kerr_critical_parameters(1.0, a);
    const double low = proven(c.prograde_radius).value, high = proven(c.retrograde_radius).value;
    const double r = low + uniform(0.001, 0.999) * (high - low);
    const kerr_exact::SphericalOrbit got = kerr_exact::spherical_orbit(1.0, a, r);
    const enclosure::SphericalOrbit truth = enclosure::kerr_spherical_orbit(1.0, a, r);
    const std::string where = "a = " + std::to_string(a) + ", r = " + std::to_string(r);
    expect_within(got.xi, truth.xi, where + " xi");
    expect_within(got.eta, truth.eta, where + " eta");
    expect_within(got.cos_squared_least, truth.cos_squared_least, where + " u+");
    expect_within(got.minus_u_minus, truth.minus_u_minus, where + " -u-");
    expect_within(got.mino_period, truth.mino_period, where + " period");
    expect_within(got.azimuth, truth.azimuth, where + " azimuth");
    expect_within(got.time, truth.time, where + " time");
    expect_within(got.lyapunov_half_orbit, truth.lyapunov_half_orbit, where + " gamma");
    const double i = uniform(0.05, 3.09), angle = uniform(-3.1, 3.1);
    const kerr_exact::ShadowExtent extent = kerr_exact::shadow_extent(1.0, a, i);
    const enclosure::ShadowExtent edge = enclosure::kerr_shadow_extent(1.0, a, i);
    expect_within(extent.alpha_left, edge.alpha_left, where + " left");
    expect_within(extent.alpha_right, edge.alpha_right, where + " right");
    expect_within(extent.beta_max, edge.beta_max, where + " top");
    const double centre = 0.5 * (extent.alpha_left.value + extent.alpha_right.value);
    const kerr_exact::ScreenPoint point = kerr_exact::shadow_edge(1.0, a, i, centre, angle);
    const enclosure::ScreenPoint proof = enclosure::kerr_shadow_edge(1.0, a, i, centre, angle);
    expect_within(point.alpha, proof.alpha, where + " alpha");
    expect_within(point.beta, proof.beta, where + " beta");
  }
}

TEST(Enclosure, says_what_it_needs) {
  EXPECT_THROW((void)enclosure::schwarzschild_deflection(1.0, 5.0), std::domain_error);
  EXPECT_THROW((void)enclosure::schwarzschild_deflection(-1.0, 8.0), std::domain_error);
  EXPECT_THROW((void)enclosure::kerr_deflection(1.0, 1.5, 8.0), std::domain_error);
  EXPECT_THROW((void)enclosure::kerr_deflection(1.0, 0.9, 0.5), std::domain_error);
  EXPECT_THROW((void)enclosure::kerr_deflection(1.0, 0.9, -6.0), std::domain_error);
  EXPECT_THROW((void)enclosure::kerr_spherical_orbit(1.0, 0.9, 1.5), std::domain_error);
  EXPECT_THROW((void)enclosure::kerr_spherical_orbit(1.0, 0.0, 3.0), std::domain_error);
  EXPECT_THROW((void)enclosure::kerr_shadow_extent(1.0, 1.0, 1.0), std::domain_error);
  EXPECT_THROW((void)enclosure::kerr_shadow_edge(1.0, 0.9, 1.0, 20.0, 1.0), std::domain_error);
  EXPECT_THROW((void)enclosure::ellis_deflection(1.0, 1.0), std::domain_error);
  EXPECT_THROW((void)enclosure::ellis_transit_angle(1.0, 1.0), std::domain_error);
}

}  // namespace
}  // namespace xpr
