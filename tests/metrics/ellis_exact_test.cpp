#include "metrics/ellis_exact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "exact_kit.hpp"

namespace {

using namespace xpr;
using exact_kit::BoundCheck;
using exact_kit::integrate;
using exact_kit::LogUniform;
using exact_kit::Mp;
using exact_kit::sq;
namespace exact = ellis_exact;

const double infinity = std::numeric_limits<double>::infinity();

std::string at(double x) { return "at " + Mp(x).str(17) + " "; }

// The first integrals by quadrature, b0 = 1: l = sinh z on the way through, l = l_turn cosh z on the way round.
Mp transit(const Mp& b, const Mp& from, const Mp& to, bool time) {
  const auto f = [&](const Mp& z) {
    const Mp r_squared = 1 + sq(sinh(z));
    return Mp((time ? r_squared : b) / sqrt(r_squared - b * b));
  };
  const Mp z1 = asinh(from), z2 = asinh(to);
  if (z1 < 0 && z2 > 0) return integrate(f, z1, Mp(0)) + integrate(f, Mp(0), z2);
  return integrate(f, z1, z2);
}
Mp round_from_turn(const Mp& b, const Mp& l, bool time) {
  const Mp turn = sqrt(b * b - 1);
  return integrate(
      [&](const Mp& z) {
        const Mp r_squared = 1 + sq(turn * cosh(z));
        return Mp((time ? r_squared : b) / sqrt(r_squared));
      },
      Mp(0), acosh(l / turn));
}
// dphi = k dx/(sqrt(1 - x^2) sqrt(1 - k^2 x^2)) in x = sin, k = b0/b or b/b0.
Mp complete(const Mp& k) {
  return integrate([&](const Mp& angle) { return Mp(1 / sqrt(1 - sq(k * sin(angle)))); }, Mp(0), exact_kit::pi() / 2);
}

TEST(EllisExact, deflection_is_the_catalogued_digits) {
  const struct {
    double b;
    const char* alpha;
  } rows[] = {{1.001, "5.85059614364190603"}, {1.05, "2.08328556871952521"}, {1.25, "0.849012901739665537"},
              {3, "0.0931808176596716147"},   {5, "0.0321430413185392362"},  {20, "0.00196626137679581861"},
              {100, "7.85442345112335902e-5"}};
  for (const auto& row : rows) {
    // The tabulated b is the decimal; the double is off by up to 1.2e-16, and d alpha/db is about 1/(b - 1).
    const double tolerance = exact::deflection(1.0, row.b).error + 1.2e-16 / (row.b - 1);
    EXPECT_NEAR(exact::deflection(1.0, row.b).value, std::stod(row.alpha), tolerance) << row.b;
  }
  EXPECT_NEAR(exact::transit_angle(1.0, 0.5).value, 1.68575035481259604, 1e-15);
  EXPECT_NEAR(exact::transit_angle(1.0, 0.95).value, 4.92102133866155232, 1e-14);
}

TEST(EllisExact, deflection_and_transit_match_quadrature_within_their_error) {
  BoundCheck check(2e-14);
  for (double f = 1e-15; f < 1e6; f *= 1.4) {
    const double b = 1 + f;
    check(exact::deflection(1.0, b), 2 * complete(1 / Mp(b)) - exact_kit::pi(), at(b));
    if (f >= 1) continue;
    const double inside = 1 - f;
    check(exact::transit_angle(1.0, inside), 2 * inside * complete(inside), at(inside));
  }
  check(exact::transit_angle(1.0, 0.0), 0, "radial");
  EXPECT_GT(check.points(), 200);
}

TEST(EllisExact, deflection_depends_on_the_ratio_alone) {
  for (const double b0 : {1e-6, 0.37, 5e8}) {
    EXPECT_NEAR(exact::deflection(b0, 3 * b0).value, 0.0931808176596716147, 1e-14) << b0;
    EXPECT_NEAR(exact::transit_angle(b0, 0.5 * b0).value, 1.68575035481259604, 2e-15) << b0;
  }
}

TEST(EllisExact, turning_rays_match_quadrature) {
  BoundCheck check(1e-13);
  LogUniform excess(3, 1e-9, 1e3), stretch(4, 1e-4, 1e5), stretch2(5, 1e-4, 1e3);
  for (int i = 0; i < 80; ++i) {
    const double b = 1 + excess();
    const double turn = exact::turning_point(1.0, b).value;
    const double l1 = turn * (1 + stretch()), l2 = l1 * (1 + stretch2());
    for (const int side : {1, -1}) {
      const Mp to1 = round_from_turn(b, l1, false), to2 = round_from_turn(b, l2, false);
      check(exact::swept_angle(1.0, b, side * l1, side * l2, true), to1 + to2, at(b) + at(l1) + at(l2));
      check(exact::swept_angle(1.0, b, side * l2, side * l1, false), to2 - to1, at(b) + at(l1) + at(l2));
    }
    const Mp t1 = round_from_turn(b, l1, true), t2 = round_from_turn(b, l2, true);
    check(exact::coordinate_time(1.0, b, l1, l2, true), t1 + t2, at(b) + at(l1) + at(l2));
    check(exact::coordinate_time(1.0, b, l1, l2, false), t2 - t1, at(b) + at(l1) + at(l2));
  }
  EXPECT_EQ(check.points(), 480);
}

TEST(EllisExact, rays_through_the_throat_match_quadrature) {
  BoundCheck check(1e-13);
  LogUniform deficit(13, 1e-9, 0.999), far(14, 1e-6, 1e5), far2(15, 1e-6, 1e5);
  for (int i = 0; i < 80; ++i) {
    const double b = 1 - deficit();
    const double l1 = far(), l2 = far2();
    check(exact::swept_angle(1.0, b, -l1, l2, false), transit(b, -l1, l2, false), at(b) + at(l1) + at(l2));
    check(exact::swept_angle(1.0, b, l1, l2, false), abs(transit(b, l1, l2, false)), at(b) + at(l1) + at(l2));
    check(exact::coordinate_time(1.0, b, l2, -l1, false), transit(b, -l1, l2, true), at(b) + at(l1) + at(l2));
    check(exact::coordinate_time(1.0, b, -l1, -l2, false), abs(transit(b, l1, l2, true)), at(b) + at(l1) + at(l2));
  }
  check(exact::swept_angle(1.0, 1.0, 0.25, 7, false), transit(1, 0.25, 7, false), "critical");
  check(exact::coordinate_time(1.0, 1.0, -0.25, -7, false), transit(1, 0.25, 7, true), "critical");
  check(exact::coordinate_time(1.0, 0.0, -3, 5, false), 8, "radial");
}

TEST(EllisExact, swept_angles_to_infinity_are_the_whole_ones) {
  for (const double b : {1.0001, 1.5, 30.0}) {
    EXPECT_NEAR(exact::swept_angle(1.0, b, infinity, infinity, true).value, exact::deflection(1.0, b).value + M_PI,
                1e-13);
    EXPECT_NEAR(exact::swept_angle(1.0, b, -infinity, -infinity, true).value, exact::deflection(1.0, b).value + M_PI,
                1e-13);
  }
  for (const double b : {0.0, 0.5, 0.9999}) {
    EXPECT_NEAR(exact::swept_angle(1.0, b, -infinity, infinity, false).value, exact::transit_angle(1.0, b).value,
                1e-13);
  }
}

TEST(EllisExact, series_stay_within_their_stated_remainders) {
  for (double b = 1.01; b < 1e5; b *= 2.5) {
    const Mp alpha = 2 * complete(1 / Mp(b)) - exact_kit::pi();
    for (int order = 1; order < 40; order += order < 4 ? 1 : 9) {
      const ExactValue series = exact::weak_field_series(1.0, b, order);
      EXPECT_LE(abs(Mp(series.value) - alpha), Mp(series.error)) << b << " to order " << order;
    }
  }
  for (double f = 1e-12; f <= 0.5; f *= 2) {
    const double b = 1 + f;
    const ExactValue logarithm = exact::strong_field_logarithm(1.0, b);
    EXPECT_LE(abs(Mp(logarithm.value) - (2 * complete(1 / Mp(b)) - exact_kit::pi())), Mp(logarithm.error)) << f;
  }
  // Nakajima and Asada's three terms and Tsukamoto's limit, as catalogued (14 digits).
  EXPECT_NEAR(exact::weak_field_series(1.0, 1.25, 3).value, 0.76403533335304, 1e-14);
  EXPECT_NEAR(exact::weak_field_series(1.0, 5, 3).value, 0.032142419837041, 1e-15);
  EXPECT_NEAR(exact::weak_field_series(1.0, 20, 3).value, 0.0019662613676018, 1e-16);
  EXPECT_NEAR(exact::strong_field_logarithm(1.0, 1.25).value, 0.32414324920993, 1e-14);
  EXPECT_NEAR(exact::strong_field_logarithm(1.0, 1.05).value, 1.9335811616440, 6e-14);  // 13 decimals
}

TEST(EllisExact, throat_is_the_photon_sphere) {
  EXPECT_EQ(exact::critical_impact_parameter(0.7).value, 0.7);
  EXPECT_NEAR(exact::lyapunov_exponent_per_time(0.7).value, 1 / 0.7, 1e-15);
  // Next to b0 the time spent within |l| < l1 grows by 1/(2 Lyapunov exponent) per e-fold of b - b0.
  const double near = exact::coordinate_time(2.0, 2.0 * (1 - 1e-9), -1, 1, false).value;
  const double nearer = exact::coordinate_time(2.0, 2.0 * (1 - 1e-11), -1, 1, false).value;
  EXPECT_NEAR((nearer - near) / std::log(100.0), 1 / exact::lyapunov_exponent_per_time(2.0).value, 1e-6);
}

TEST(EllisExact, charts_agree) {
  BoundCheck check(2e-15);
  LogUniform distance(23, 1e-9, 1e6);
  for (int i = 0; i < 500; ++i) {
    const double rho = 0.5 + distance();
    const Mp l = Mp(rho) - 1 / (4 * Mp(rho));
    for (const int sheet : {1, -1}) check(exact::proper_distance_from_isotropic(1.0, rho, sheet), sheet * l, at(rho));
    const double d = distance();
    check(exact::isotropic_from_proper_distance(1.0, -d), (Mp(d) + sqrt(sq(Mp(d)) + 1)) / 2, at(d));
    check(exact::areal_radius(1.0, d), sqrt(sq(Mp(d)) + 1), at(d));
  }
}

TEST(EllisExact, bad_arguments_throw) {
  EXPECT_THROW((void)exact::deflection(0.0, 2), std::invalid_argument);
  EXPECT_THROW((void)exact::deflection(1.0, 1.0), std::domain_error);
  EXPECT_THROW((void)exact::deflection(1.0, infinity), std::domain_error);
  EXPECT_THROW((void)exact::transit_angle(1.0, 1.0), std::domain_error);
  EXPECT_THROW((void)exact::swept_angle(1.0, 2.0, -5, 5, false), std::domain_error);
  EXPECT_THROW((void)exact::swept_angle(1.0, 2.0, 1, 5, true), std::domain_error);
  EXPECT_THROW((void)exact::swept_angle(1.0, 0.5, -5, 5, true), std::domain_error);
  EXPECT_THROW((void)exact::swept_angle(1.0, 1.0, -5, 5, false), std::domain_error);
  EXPECT_THROW((void)exact::swept_angle(1.0, 0.5, std::nan(""), 5, false), std::domain_error);
  EXPECT_THROW((void)exact::coordinate_time(1.0, 0.5, 0, infinity, false), std::domain_error);
  EXPECT_THROW((void)exact::proper_distance_from_isotropic(1.0, 0.4, 1), std::domain_error);
  EXPECT_THROW((void)exact::proper_distance_from_isotropic(1.0, 4, 0), std::domain_error);
}

}  // namespace
