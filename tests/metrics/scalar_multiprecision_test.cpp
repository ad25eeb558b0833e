// Templates written for double run at 50 digits without a change.
#include <gtest/gtest.h>

#include "metrics/scalar/multiprecision.hpp"

namespace xpr {
namespace {

/// Uses every function that physics may call, unqualified.
template <class T>
T everything(const T& x, const T& y) {
  const auto both = sincos(x);
  const T angles = tan(x) + atan(x) + atan2(y, x) + asin(0.3 * x) + acos(0.3 * x);
  const T growth = exp(x) + log(x) + pow(x, y) + pow(x, 2.5) + pow(x, 3) + sinh(x) + cosh(x) + tanh(x);
  const T pieces = abs(-x) + floor(3 * x) + rint(3 * x) + copysign(x, -y) + min(x, y) + max(x, 1) +
                   select((x < y) & (x > 0), x, 0.0) + select(x < y, 1, y);
  return both.sin * both.cos + square(x) / sqrt(y) + angles + growth + pieces + pi<T>() + select(signbit(x), 1.0, 0.0);
}

TEST(Real50, runs_the_same_source_as_double_and_agrees_to_round_off) {
  const double x = 0.7;
  const double y = 0.9;
  const double exact = to_double(everything(Real50(x), Real50(y)));
  // Some thirty terms, the largest below 10, each within two units of rounding.
  const double rounding = 60 * 10 * 1.1e-16;
  EXPECT_NEAR(everything(x, y), exact, rounding);
  EXPECT_NEAR(lane(everything(Pack<4>(x), Pack<4>(y)), 3), exact, rounding);
  EXPECT_NEAR(everything(variable<2>(x, 0), variable<2>(y, 1)).value, exact, rounding);
  const auto at_50_digits = everything(variable<2>(Real50(x), 0), variable<2>(Real50(y), 1));
  EXPECT_NEAR(to_double(at_50_digits), exact, rounding);
  const auto slopes = everything(variable<2>(x, 0), variable<2>(y, 1)).derivative;
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(slopes[i], to_double(at_50_digits.derivative[i]), 2 * rounding);
}

TEST(Real50, pi_has_fifty_digits) {
  // The digits are those printed in any table.
  const Real50 printed("3.14159265358979323846264338327950288419716939937510");
  EXPECT_LT(to_double(Real50(abs(pi<Real50>() - printed))), 1e-49);
  EXPECT_EQ(pi<double>(), to_double(pi<Real50>()));
  EXPECT_EQ(to_double(pi<Dual<Real50, 2>>()), pi<double>());
}

TEST(Real50, takes_doubles_exactly) {
  EXPECT_EQ(to_double(Real50(0.1)), 0.1);
  EXPECT_NE(Real50(0.1), Real50("0.1"));
}

}  // namespace
}  // namespace xpr
