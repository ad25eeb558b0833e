#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "exact_kit.hpp"
#include "metrics/kerr_exact.hpp"
#include "metrics/schwarzschild_exact.hpp"

namespace {

using namespace xpr;
using exact_kit::BoundCheck;
using exact_kit::integrate;
using exact_kit::LogUniform;
using exact_kit::Mp;
using exact_kit::sq;
using kerr_exact::Sense;
namespace exact = kerr_exact;

const double infinity = std::numeric_limits<double>::infinity();
constexpr Sense both[] = {Sense::prograde, Sense::retrograde};

std::string at(double a, double b, double r1 = 0, double r2 = 0) {
  return "a = " + Mp(a).str(17) + ", b = " + Mp(b).str(17) + ", r1 = " + Mp(r1).str(17) + ", r2 = " + Mp(r2).str(17);
}

// The ray by its radial potential R = (r^2 + a^2 - a b)^2 - Delta (b - a)^2 = r (r^3 + (a^2 - b^2) r + 2 (b - a)^2), M
// = 1.
struct Equatorial {
  Mp a, b;
  [[nodiscard]] Mp delta(const Mp& r) const { return r * r - 2 * r + a * a; }
  [[nodiscard]] Mp phi_rate(const Mp& r) const { return a * (r * r + a * a - a * b) / delta(r) + b - a; }
  [[nodiscard]] Mp t_rate(const Mp& r) const {
    return (r * r + a * a) * (r * r + a * a - a * b) / delta(r) + a * (b - a);
  }
  [[nodiscard]] Mp turning_point() const {
    Mp r = sqrt(b * b - a * a);  // beyond the largest root of the convex cubic: Newton comes down to it
    for (int i = 0; i < 400; ++i) {
      const Mp step = (r * r * r + (a * a - b * b) * r + 2 * sq(b - a)) / (3 * r * r + a * a - b * b);
      r -= step;
      if (abs(step) < Mp("1e-45")) break;
    }
    return r;
  }
  // From the turning point r0 out to u = 1/r, u = (1 - x^2)/r0; R r^-4 without its factor x^2 under the root.
  [[nodiscard]] Mp from_turn(const Mp& to_u, bool time) const {
    const Mp r0 = turning_point();
    const auto f = [&](const Mp& x) {
      const Mp u = (1 - x * x) / r0;
      const Mp rest = 1 + r0 * u + (r0 * r0 + a * a - b * b) * u * u;
      const Mp rate = time ? t_rate(1 / u) : Mp(a * (1 + a * (a - b) * u * u) / (1 - 2 * u + a * a * u * u) + b - a);
      return Mp(2 * rate / (r0 * sqrt(rest)));
    };
    return integrate(f, Mp(0), sqrt(1 - r0 * to_u));
  }
  [[nodiscard]] Mp straight(const Mp& low, const Mp& high, bool time) const {
    const auto f = [&](const Mp& z) {
      const Mp r = exp(z);
      const Mp R = r * (r * r * r + (a * a - b * b) * r + 2 * sq(b - a));
      return Mp(r * (time ? t_rate(r) : phi_rate(r)) / sqrt(R));
    };
    // Split at the least of R/r^4, where a ray that nearly turns spends its time: u = s/(3 d).
    const Mp least = b == a ? Mp(0) : Mp(3 * (b - a) / (b + a));
    if (low < least && least < high) return integrate(f, log(low), log(least)) + integrate(f, log(least), log(high));
    return integrate(f, log(low), log(high));
  }
};

TEST(KerrExact, characteristic_radii_are_those_of_bardeen_press_and_teukolsky) {
  const struct {
    double a, prograde, retrograde, b_prograde, b_retrograde, isco_prograde, isco_retrograde, polar;
  } rows[] = {{0.5, 2.34729635533386, 3.53208888623796, 4.09626665871387, -6.13815572471545, 4.23300252953083,
               7.55458471451236, 2.88321774192635},
              {0.9, 1.55785462742338, 3.91026793910304, 2.84442140347617, -6.83231923044667, 2.32088304176189,
               8.71735227960649, 2.55999686936568},
              {0.99, 1.16764185185753, 3.99110286108940, 2.25172433539895, -6.98332343110269, 1.45449793805967,
               8.97186134254697, 2.43098324380603}};
  // 15 printed digits; the table stands at the decimal a, the double lies 1e-17 to 5e-17 off.
  for (const auto& row : rows) {
    EXPECT_NEAR(exact::photon_orbit_radius(1, row.a, Sense::prograde).value, row.prograde, 6e-15);
    EXPECT_NEAR(exact::photon_orbit_radius(1, row.a, Sense::retrograde).value, row.retrograde, 6e-15);
    EXPECT_NEAR(exact::critical_impact_parameter(1, row.a, Sense::prograde).value, row.b_prograde, 6e-15);
    EXPECT_NEAR(exact::critical_impact_parameter(1, row.a, Sense::retrograde).value, row.b_retrograde, 6e-15);
    EXPECT_NEAR(exact::isco_radius(1, row.a, Sense::prograde).value, row.isco_prograde, 6e-15);
    EXPECT_NEAR(exact::isco_radius(1, row.a, Sense::retrograde).value, row.isco_retrograde, 6e-15);
    EXPECT_NEAR(exact::polar_photon_orbit_radius(1, row.a).value, row.polar, 6e-15);
  }
  EXPECT_NEAR(exact::marginally_bound_radius(1, 0.9, Sense::prograde).value, 1.73245553203368, 6e-15);
  EXPECT_NEAR(exact::marginally_bound_radius(1, 0.9, Sense::retrograde).value, 5.65680975041804, 6e-15);
  // James et al. 2015 at a = 0.999.
  EXPECT_NEAR(exact::photon_orbit_radius(1, 0.999, Sense::prograde).value, 1.05208091592876, 6e-15);
  EXPECT_NEAR(exact::critical_impact_parameter(1, 0.999, Sense::retrograde).value, -6.99833323454229, 6e-15);
  EXPECT_NEAR(exact::isco_radius(1, 0.999, Sense::prograde).value, 1.18176461303357, 6e-15);
}

TEST(KerrExact, radii_solve_their_equations_at_any_spin) {
  BoundCheck check(2e-15);
  for (const double a : {0.0, 1e-9, 0.3, 0.7, 0.9, 0.998, 1 - 1e-12, 1.0}) {
    // Mp reference by Newton's rule on the orbit's own equation, from a point on the convex side.
    for (const Sense sense : both) {
      const Mp spin = sense == Sense::prograde ? Mp(a) : Mp(-a);
      // sqrt(r) = x: x^3 - 3x + 2a = 0 is the photon orbit, largest root, at or above 1.
      Mp x = 2;
      for (int i = 0; i < 400; ++i) {
        const Mp slope = 3 * x * x - 3;
        const Mp step = slope == 0 ? Mp(0) : Mp((x * x * x - 3 * x + 2 * spin) / slope);
        x -= step;
        if (abs(step) < Mp("1e-40")) break;
      }
      check(exact::photon_orbit_radius(1, a, sense), x * x, at(a, 0));
      const Mp b = sense == Sense::prograde ? Mp(3 * x - a) : Mp(-3 * x - a);
      check(exact::critical_impact_parameter(1, a, sense), b, at(a, 0));
      EXPECT_EQ(exact::critical_impact_parameter(1, -a, sense).value,
                a == 0 ? exact::critical_impact_parameter(1, a, sense).value
                       : -exact::critical_impact_parameter(1, a, sense).value);
      const Mp r = exact::isco_radius(1, a, sense).value;  // r^2 - 6 r + 8 a sqrt(r) - 3 a^2 = 0
      const Mp residual = r * r - 6 * r + 8 * spin * sqrt(r) - 3 * sq(spin);
      EXPECT_LE(abs(residual), 40 * Mp(exact::isco_radius(1, a, sense).error)) << at(a, 0);
    }
    check(exact::outer_horizon(1, a), 1 + sqrt(1 - sq(Mp(a))), at(a, 0));
    check(exact::inner_horizon(1, a), 1 - sqrt(1 - sq(Mp(a))), at(a, 0));
    const Mp r = exact::polar_photon_orbit_radius(1, a).value;  // r^3 - 3 r^2 + a^2 r + a^2 = 0
    EXPECT_LE(abs(r * r * r - 3 * r * r + sq(Mp(a)) * (r + 1)), 20 * Mp(exact::polar_photon_orbit_radius(1, a).error));
  }
  EXPECT_EQ(exact::photon_orbit_radius(2, 2, Sense::prograde).value, 2.0);
  EXPECT_EQ(exact::critical_impact_parameter(1, 1, Sense::prograde).value, 2.0);
  EXPECT_EQ(exact::critical_impact_parameter(1, 1, Sense::retrograde).value, -7.0);
}

TEST(KerrExact, equatorial_deflection_is_the_catalogued_digits) {
  const struct {
    double a, b;
    const char *alpha, *r0;
  } rows[] = {{0.5, 6, "1.2263997980084294142", "4.815124439894567"},
              {0.9, 4, "2.1782904489070825181", "2.942454458726617"},
              {0.9, -8, "1.2532938661300810946", "6.101196816389851"},
              {0.9, 10, "0.50463298400067238183", "8.986685319386695"},
              {0.9, -10, "0.72050361395396128304", "8.425386636234732"}};
  for (const auto& row : rows) {
    // The table stands at a = 9/10; the double is 2e-17 off, and |d alpha/da| < 2.
    EXPECT_NEAR(exact::equatorial_deflection(1, row.a, row.b).value, std::stod(row.alpha), 1e-15) << row.a << row.b;
    EXPECT_NEAR(exact::equatorial_periapsis(1, row.a, row.b).value, std::stod(row.r0), 2e-15 + 5e-16 * 10)
        << row.a << row.b;
    EXPECT_EQ(exact::equatorial_deflection(1, -row.a, -row.b).value,
              exact::equatorial_deflection(1, row.a, row.b).value);
  }
}

TEST(KerrExact, equatorial_deflection_matches_quadrature_within_its_error) {
  BoundCheck check(1e-13);
  for (const double a : {0.0, 1e-12, 1e-5, 0.3, 0.7, 0.9, 0.998, 1 - 1e-9, 1 - 1.2e-16, 1.0}) {
    for (const Sense sense : both) {
      const double critical = exact::critical_impact_parameter(1, a, sense).value;
      for (double f = 1e-9; f < 1e5; f *= 7) {
        const double b = critical * (1 + f);
        const Equatorial ray{a, b};
        check(exact::equatorial_deflection(1, a, b), 2 * abs(ray.from_turn(0, false)) - exact_kit::pi(), at(a, b));
        check(exact::equatorial_periapsis(1, a, b), ray.turning_point(), at(a, b));
      }
    }
  }
  EXPECT_GT(check.points(), 500);
}

TEST(KerrExact, equatorial_deflection_scales_with_the_mass) {
  // Powers of two scale exactly.
  EXPECT_EQ(exact::equatorial_deflection(4, 3.6, 20).value, exact::equatorial_deflection(1, 0.9, 5).value);
  EXPECT_EQ(exact::equatorial_periapsis(4, 3.6, 20).value, 4 * exact::equatorial_periapsis(1, 0.9, 5).value);
  EXPECT_EQ(exact::equatorial_coordinate_time(4, 3.6, 20, 400, 80, true).value,
            4 * exact::equatorial_coordinate_time(1, 0.9, 5, 100, 20, true).value);
}

TEST(KerrExact, without_spin_it_is_schwarzschild) {
  for (const double b : {5.2, 5.5, 8.0, 100.0}) {
    const ExactValue here = exact::equatorial_deflection(1, 0, b), there = schwarzschild_exact::deflection(1, b);
    EXPECT_NEAR(here.value, there.value, here.error + there.error) << b;
    EXPECT_EQ(exact::equatorial_deflection(1, 0, -b).value, here.value);
    // A spin of 1e-30 takes the elliptic integrals of the third kind, and moves alpha by 4e-30/b^2.
    EXPECT_NEAR(exact::equatorial_deflection(1, 1e-30, b).value, here.value, 1e-15 * (1 + here.value)) << b;
  }
}

TEST(KerrExact, swept_angle_and_time_of_turning_rays_match_quadrature) {
  BoundCheck check(1e-13);
  LogUniform excess(3, 1e-8, 1e3), stretch(4, 1e-3, 1e5), stretch2(5, 1e-3, 1e3);
  for (const double a : {-0.9, -0.3, 1e-7, 0.7, 0.998, 1.0}) {
    for (int i = 0; i < 12; ++i) {
      const double b = exact::critical_impact_parameter(1, a, both[i % 2]).value * (1 + excess());
      const double r0 = exact::equatorial_periapsis(1, a, b).value;
      const double r1 = r0 * (1 + stretch()), r2 = r1 * (1 + stretch2());
      const Equatorial ray{a, b};
      for (const bool time : {false, true}) {
        const Mp to1 = ray.from_turn(1 / Mp(r1), time), to2 = ray.from_turn(1 / Mp(r2), time);
        const auto& f = time ? exact::equatorial_coordinate_time : exact::equatorial_swept_angle;
        check(f(1, a, b, r1, r2, true), to1 + to2, at(a, b, r1, r2));
        check(f(1, a, b, r2, r1, false), to2 - to1, at(a, b, r1, r2));
      }
    }
  }
  EXPECT_EQ(check.points(), 288);
}

TEST(KerrExact, swept_angle_and_time_of_captured_rays_match_quadrature) {
  BoundCheck check(1e-13);
  LogUniform from(14, 1e-4, 1e4), width(15, 1e-3, 1e4);
  std::mt19937_64 engine(16);
  for (const double a : {-0.9, 0.3, 0.998, 1.0}) {
    const double low = exact::critical_impact_parameter(1, a, a > 0 ? Sense::retrograde : Sense::prograde).value;
    const double high = exact::critical_impact_parameter(1, a, a > 0 ? Sense::prograde : Sense::retrograde).value;
    for (int i = 0; i < 12; ++i) {
      double b = std::uniform_real_distribution<double>(low, high)(engine);
      if (i == 0) b = low * (1 - 1e-8);
      if (i == 1) b = high * (1 - 1e-8);
      if (i == 2) b = -a;  // s = 0
      if (i == 3) b = a;   // the principal null ray
      if (i == 4) b = 0.5 * a;
      if (i == 5) b = a * (1 + 1e-9);
      if (i == 6) b = a * 1.05;  // turns inside the horizon
      const double r1 = exact::outer_horizon(1, a).value * (1 + from()), r2 = r1 * (1 + width());
      const Equatorial ray{a, b};
      check(exact::equatorial_swept_angle(1, a, b, r2, r1, false), ray.straight(r1, r2, false), at(a, b, r1, r2));
      check(exact::equatorial_coordinate_time(1, a, b, r1, r2, false), ray.straight(r1, r2, true), at(a, b, r1, r2));
    }
  }
}

TEST(KerrExact, principal_null_rays_are_the_catalogued_ones) {
  EXPECT_NEAR(exact::principal_null_time(1, 0.9, 100, 3).value, 105.8486894565526, 6e-14);
  EXPECT_NEAR(exact::principal_null_angle(1, 0.9, 100, 3).value, 0.4482442491241231, 1e-15);
  EXPECT_NEAR(exact::principal_null_angle(1, -0.9, 100, 3).value, 0.4482442491241231, 1e-15);
  EXPECT_NEAR(exact::principal_null_time(1, 0, 100, 3).value, 97 + 2 * std::log(98.0), 3e-14);
  for (const double theta : {0.3, 1.2, 2.7}) {
    const auto ray = exact::principal_null_constants(0.9, theta);
    EXPECT_NEAR(ray.carter + (ray.angular_momentum - 0.9) * (ray.angular_momentum - 0.9), 0, 1e-15);
    for (const double r : {1.5, 3.0, 50.0}) {  // R = Sigma^2, Theta = 0
      const double sigma = r * r + 0.81 * std::cos(theta) * std::cos(theta);
      EXPECT_NEAR(exact::radial_potential(1.0, 0.9, ray, r), sigma * sigma, 4e-15 * sigma * sigma);
      EXPECT_NEAR(exact::polar_potential(0.9, ray, std::cos(theta) * std::cos(theta)), 0, 2e-15);
    }
  }
}

TEST(KerrExact, weak_series_stays_within_its_stated_remainder) {
  for (const double a : {0.0, 0.4, 0.9, 1.0}) {
    for (const int side : {1, -1}) {
      for (double b = 14.5; b < 1e5; b *= 3) {
        const Mp alpha = 2 * abs(Equatorial{a, side * b}.from_turn(0, false)) - exact_kit::pi();
        for (int order = 1; order <= 5; ++order) {
          const ExactValue series = exact::equatorial_weak_field_series(1, a, side * b, order);
          EXPECT_LE(abs(Mp(series.value) - alpha), Mp(series.error)) << at(a, side * b) << " to order " << order;
        }
      }
      // Each term by itself: at b = 1e4 the miss of order n is the next coefficient to 1e-2.
      const double b = 1e4;
      const Mp alpha = 2 * abs(Equatorial{a, side * b}.from_turn(0, false)) - exact_kit::pi();
      const double c = side * a;
      const double next[] = {15 * M_PI / 4 - 4 * c, 128.0 / 3 - 10 * M_PI * c + 4 * c * c};
      for (int order = 1; order <= 2; ++order) {
        const Mp miss =
            (alpha - exact::equatorial_weak_field_series(1, a, side * b, order).value) * pow(Mp(b), order + 1);
        EXPECT_NEAR(static_cast<double>(miss), next[order - 1], 0.05) << at(a, b) << " to order " << order;
      }
    }
  }
}

TEST(KerrExact, bad_equatorial_arguments_throw) {
  EXPECT_THROW((void)exact::outer_horizon(1, 1.2), std::invalid_argument);
  EXPECT_THROW((void)exact::outer_horizon(-1, 0), std::invalid_argument);
  EXPECT_THROW((void)exact::outer_horizon(1, std::nan("")), std::invalid_argument);
  EXPECT_THROW((void)exact::equatorial_deflection(1, 0.9, 2), std::domain_error);
  EXPECT_THROW((void)exact::equatorial_deflection(1, 0.9, -6), std::domain_error);
  // The cubic has a root here, inside the horizon.
  EXPECT_THROW((void)exact::equatorial_deflection(1, 0.9, 0.95), std::domain_error);
  EXPECT_THROW((void)exact::equatorial_swept_angle(1, 0.9, 0.95, 5, 5, true), std::domain_error);
  EXPECT_THROW((void)exact::equatorial_swept_angle(1, 0.9, 5, 3, 10, true), std::domain_error);
  EXPECT_THROW((void)exact::equatorial_swept_angle(1, 0.9, 0, 1.4, 10, false), std::domain_error);
  EXPECT_THROW((void)exact::equatorial_coordinate_time(1, 0.9, 5, 5, infinity, true), std::domain_error);
  EXPECT_THROW((void)exact::equatorial_weak_field_series(1, 0.9, 10, 2), std::domain_error);
  try {
    (void)exact::equatorial_deflection(1, 0.9, 2);
  } catch (const std::domain_error& error) {
    EXPECT_NE(std::string(error.what()).find("b = 2, needs b < -6.83"), std::string::npos) << error.what();
  }
}

}  // namespace
