// The elementary functions at zeros, infinities, NaN, on axes and at the edges of their domains: IEEE 754's values,
// with the sign of zero, and NaN rather than a wrong number outside.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "metrics/scalar/elementary.hpp"

namespace xpr {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double smallest = std::numeric_limits<double>::denorm_min();
constexpr double largest = std::numeric_limits<double>::max();

/// Equal to the bit, so that -0 differs from +0 and every NaN that we return is the same one.
void expect_same(double actual, double expected) {
  EXPECT_EQ(std::bit_cast<std::uint64_t>(actual), std::bit_cast<std::uint64_t>(expected))
      << actual << ", not " << expected;
}

TEST(SpecialValues, sine_and_cosine) {
  expect_same(sin(0.0), 0.0);
  expect_same(sin(-0.0), -0.0);
  expect_same(cos(0.0), 1.0);
  expect_same(cos(-0.0), 1.0);
  expect_same(sin(smallest), smallest);
  for (const double x : {inf, -inf, not_a_number, -not_a_number, 1e300}) {
    expect_same(sin(x), not_a_number);
    expect_same(cos(x), not_a_number);
  }
}

TEST(SpecialValues, angles_are_refused_beyond_the_documented_bound) {
  EXPECT_TRUE(isfinite(sin(largest_angle)));
  EXPECT_TRUE(isfinite(cos(-largest_angle)));
  expect_same(sin(std::nextafter(largest_angle, inf)), not_a_number);
  expect_same(cos(std::nextafter(-largest_angle, -inf)), not_a_number);
}

TEST(SpecialValues, arctangent) {
  expect_same(atan(0.0), 0.0);
  expect_same(atan(-0.0), -0.0);
  expect_same(atan(inf), pi() / 2);
  expect_same(atan(-inf), -pi() / 2);
  expect_same(atan(smallest), smallest);
  expect_same(atan(1.0), pi() / 4);
  expect_same(atan(not_a_number), not_a_number);
}

// y, x, atan2(y, x) as IEEE 754-2008 (9.2.1) lists them, and the points between the axes.
TEST(SpecialValues, arctangent_of_two_arguments_in_every_quadrant_and_on_every_axis) {
  struct Row {
    double y, x, angle;
  };
  const double p = pi();
  const std::array<Row, 29> rows{{{0.0, 1.0, 0.0},
                                  {-0.0, 1.0, -0.0},
                                  {0.0, -1.0, p},
                                  {-0.0, -1.0, -p},
                                  {0.0, 0.0, 0.0},
                                  {-0.0, 0.0, -0.0},
                                  {0.0, -0.0, p},
                                  {-0.0, -0.0, -p},
                                  {1.0, 0.0, p / 2},
                                  {1.0, -0.0, p / 2},
                                  {-1.0, 0.0, -p / 2},
                                  {-1.0, -0.0, -p / 2},
                                  {1.0, 1.0, p / 4},
                                  {1.0, -1.0, 3 * p / 4},
                                  {-1.0, 1.0, -p / 4},
                                  {-1.0, -1.0, -3 * p / 4},
                                  {1.0, inf, 0.0},
                                  {-1.0, inf, -0.0},
                                  {1.0, -inf, p},
                                  {-1.0, -inf, -p},
                                  {inf, 1.0, p / 2},
                                  {-inf, 1.0, -p / 2},
                                  {inf, inf, p / 4},
                                  {inf, -inf, 3 * p / 4},
                                  {-inf, inf, -p / 4},
                                  {-inf, -inf, -3 * p / 4},
                                  {largest, largest, p / 4},
                                  {smallest, smallest, p / 4},
                                  {largest, -smallest, p / 2}}};
  for (const Row& row : rows) {
    SCOPED_TRACE(::testing::Message() << "atan2(" << row.y << ", " << row.x << ")");
    expect_same(atan2(row.y, row.x), row.angle);
  }
  for (const double other : {0.0, 1.0, inf, not_a_number}) {
    expect_same(atan2(not_a_number, other), not_a_number);
    expect_same(atan2(other, not_a_number), not_a_number);
  }
}

TEST(SpecialValues, arcsine_and_arccosine) {
  expect_same(asin(0.0), 0.0);
  expect_same(asin(-0.0), -0.0);
  expect_same(asin(1.0), pi() / 2);
  expect_same(asin(-1.0), -pi() / 2);
  expect_same(acos(1.0), 0.0);
  expect_same(acos(-1.0), pi());
  expect_same(acos(0.0), pi() / 2);
  for (const double x : {std::nextafter(1.0, 2.0), -2.0, inf, not_a_number}) {
    expect_same(asin(x), not_a_number);
    expect_same(acos(x), not_a_number);
  }
}

TEST(SpecialValues, exponential) {
  expect_same(exp(0.0), 1.0);
  expect_same(exp(-0.0), 1.0);
  expect_same(exp(inf), inf);
  expect_same(exp(-inf), 0.0);
  expect_same(exp(709.79), inf);
  EXPECT_TRUE(isfinite(exp(709.782)));
  expect_same(exp(-745.0), smallest);
  expect_same(exp(-746.0), 0.0);
  expect_same(exp(not_a_number), not_a_number);
}

TEST(SpecialValues, logarithm) {
  expect_same(log(1.0), 0.0);
  expect_same(log(0.0), -inf);
  expect_same(log(-0.0), -inf);
  expect_same(log(inf), inf);
  for (const double x : {-smallest, -1.0, -inf, not_a_number}) expect_same(log(x), not_a_number);
}

TEST(SpecialValues, power) {
  for (const double y : {0.0, -0.0}) {
    for (const double x : {0.0, 2.0, inf, not_a_number, -3.0}) expect_same(pow(x, y), 1.0);
  }
  for (const double y : {3.0, -inf, inf, not_a_number, largest}) expect_same(pow(1.0, y), 1.0);
  expect_same(pow(0.0, 2.5), 0.0);
  expect_same(pow(0.0, -2.5), inf);
  expect_same(pow(inf, 0.5), inf);
  expect_same(pow(inf, -0.5), 0.0);
  expect_same(pow(2.0, inf), inf);
  expect_same(pow(2.0, -inf), 0.0);
  expect_same(pow(0.5, inf), 0.0);
  expect_same(pow(0.5, -inf), inf);
  expect_same(pow(2.0, largest), inf);
  expect_same(pow(0.5, largest), 0.0);
  expect_same(pow(-2.0, 2.5), not_a_number);
  expect_same(pow(not_a_number, 2.0), not_a_number);
  expect_same(pow(2.0, not_a_number), not_a_number);
}

TEST(SpecialValues, powers_of_two_are_exact) {
  for (int n = -1074; n < 1024; ++n) expect_same(pow(2.0, static_cast<double>(n)), std::ldexp(1.0, n));
}

TEST(SpecialValues, whole_powers_take_any_base) {
  expect_same(pow(-2.0, 3), -8.0);
  expect_same(pow(-2.0, -2), 0.25);
  expect_same(pow(-0.0, 3), -0.0);
  expect_same(pow(not_a_number, 0), 1.0);
  expect_same(pow(1.5, 10), 57.6650390625);
}

TEST(SpecialValues, hyperbolic_functions) {
  expect_same(sinh(0.0), 0.0);
  expect_same(sinh(-0.0), -0.0);
  expect_same(cosh(0.0), 1.0);
  expect_same(tanh(-0.0), -0.0);
  expect_same(sinh(-inf), -inf);
  expect_same(cosh(-inf), inf);
  expect_same(tanh(inf), 1.0);
  expect_same(tanh(-1e300), -1.0);
  EXPECT_TRUE(isfinite(cosh(710.4)));
  expect_same(cosh(710.5), inf);
  for (const auto f : {sinh<double>, cosh<double>, tanh<double>}) expect_same(f(not_a_number), not_a_number);
}

TEST(SpecialValues, rounding_to_integers) {
  for (const double x : {0.0, -0.0, 0.3, -0.3, 0.5, -0.5, 1.5, 2.5, -2.5, 0x1p51 + 0.5, 0x1p52 + 1.0, -0x1p53, 1e300,
                         inf, -inf, smallest, -smallest, 0.49999999999999994}) {
    SCOPED_TRACE(x);
    expect_same(floor(x), std::floor(x));
    expect_same(rint(x), std::nearbyint(x));
  }
}

TEST(SpecialValues, signs) {
  expect_same(abs(-0.0), 0.0);
  expect_same(abs(-inf), inf);
  expect_same(copysign(3.0, -0.0), -3.0);
  expect_same(copysign(-3.0, 0.0), 3.0);
  EXPECT_TRUE(signbit(-0.0));
  EXPECT_FALSE(isfinite(inf));
  EXPECT_FALSE(isfinite(not_a_number));
  EXPECT_TRUE(isfinite(largest));
  expect_same(min(1.0, 2), 1.0);
  expect_same(max(1.0, 2), 2.0);
}

}  // namespace
}  // namespace xpr
