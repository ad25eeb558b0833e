// Derivatives carried by duals against central differences at 50 digits, first and second; and duals over packs against
// duals over double, bit for bit.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "metrics/scalar/multiprecision.hpp"

namespace xpr {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Runs `body(name, f, low, high)` over every elementary function of one variable; f is generic over its scalar, and
/// its domain of test lies in [low, high].
template <class Body>
void for_each_function(const Body& body) {
  body(
      "sqrt", [](const auto& x) { return sqrt(x); }, 0.1, 9.0);
  body(
      "sin", [](const auto& x) { return sin(x); }, -7.0, 7.0);
  body(
      "cos", [](const auto& x) { return cos(x); }, -7.0, 7.0);
  body(
      "sincos",
      [](const auto& x) {
        const auto both = sincos(x);
        return both.sin + 0.1 * both.cos;
      },
      0.2, 1.0);
  body(
      "tan", [](const auto& x) { return tan(x); }, -1.4, 1.4);
  body(
      "atan", [](const auto& x) { return atan(x); }, -4.0, 4.0);
  body(
      "atan2(x, 2)", [](const auto& x) { return atan2(x, 2.0 + 0.0 * x); }, -4.0, 4.0);
  body(
      "atan2(2, x)", [](const auto& x) { return atan2(2.0 + 0.0 * x, x); }, -4.0, 4.0);
  body(
      "asin", [](const auto& x) { return asin(x); }, -0.99, 0.99);
  body(
      "acos", [](const auto& x) { return acos(x); }, -0.99, 0.99);
  body(
      "exp", [](const auto& x) { return exp(x); }, -5.0, 5.0);
  body(
      "log", [](const auto& x) { return log(x); }, 0.1, 9.0);
  body(
      "x^2.5", [](const auto& x) { return pow(x, 2.5); }, 0.1, 9.0);
  body(
      "x^-3", [](const auto& x) { return pow(x, -3); }, 0.5, 9.0);
  body(
      "x^x", [](const auto& x) { return pow(x, x); }, 0.5, 3.0);
  body(
      "sinh", [](const auto& x) { return sinh(x); }, -3.0, 3.0);
  body(
      "cosh", [](const auto& x) { return cosh(x); }, -3.0, 3.0);
  body(
      "tanh", [](const auto& x) { return tanh(x); }, -3.0, 3.0);
  body(
      "abs", [](const auto& x) { return abs(x) * x; }, -3.0, -0.1);
  body(
      "copysign", [](const auto& x) { return copysign(x * x, x); }, -3.0, -0.1);
  body(
      "floor", [](const auto& x) { return x * floor(x); }, 2.1, 2.9);
  body(
      "rint", [](const auto& x) { return x * rint(x); }, 2.6, 3.4);
  body(
      "quotient", [](const auto& x) { return (1 + x) / (2.0 - x); }, -3.0, 1.5);
  body(
      "reciprocal", [](const auto& x) { return 3 / x; }, 0.5, 1.5);
  body(
      "constants", [](const auto& x) { return (2 * x - 1) * 0.5 + x / 3.0 - (1 - x) - (-x); }, -3.0, 1.5);
  body(
      "min and max", [](const auto& x) { return min(x, 1.0) * max(x * x, 2.0); }, -3.0, 0.9);
  body(
      "select", [](const auto& x) { return select(x < 0.0, x * x, 3.0 * x); }, -3.0, -0.1);
}

std::vector<double> points(double low, double high) {
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> uniform(low, high);
  std::vector<double> out(40);
  for (double& x : out) x = uniform(generator);
  return out;
}

TEST(DualDerivatives, agree_with_differences_at_50_digits) {
  const Real50 h = pow(Real50(10), -16);  // truncation h^2 and rounding 1e-50/h are both near 1e-33
  for_each_function([&](const char* name, const auto& f, double low, double high) {
    for (const double x : points(low, high)) {
      const Real50 exact = (f(Real50(x) + h) - f(Real50(x) - h)) / (2 * h);
      const double scale = std::fabs(to_double(exact));
      const double slope = f(variable<1>(x, 0)).derivative[0];
      // At most some ten rounded operations lie between x and the slope, each half an epsilon, none cancelling.
      EXPECT_NEAR(slope, to_double(exact), 8 * epsilon * (scale + 1e-3)) << name << " at " << x;
      const Real50 precise = f(variable<1>(Real50(x), 0)).derivative[0];
      EXPECT_LT(to_double(Real50(precise - exact)), 1e-28 * (scale + 1)) << name << " at " << x;
      EXPECT_GT(to_double(Real50(precise - exact)), -1e-28 * (scale + 1)) << name << " at " << x;
    }
  });
}

TEST(DualDerivatives, nest_to_second_derivatives) {
  const Real50 h = pow(Real50(10), -12);  // truncation h^2 and rounding 1e-50/h^2 are below 1e-23
  for_each_function([&](const char* name, const auto& f, double low, double high) {
    for (const double x : points(low, high)) {
      const Real50 exact = (f(Real50(x) + h) - 2 * f(Real50(x)) + f(Real50(x) - h)) / (h * h);
      const auto nested = f(variable<1>(variable<1>(x, 0), 0));
      // Terms of size f' and f'' may cancel; some thirty roundings.
      const double scale = std::fabs(to_double(exact)) + std::fabs(nested.value.derivative[0]);
      EXPECT_NEAR(nested.derivative[0].derivative[0], to_double(exact), 32 * epsilon * (scale + 1e-3))
          << name << " at " << x;
      EXPECT_EQ(nested.value.derivative[0], f(variable<1>(x, 0)).derivative[0]) << name << " at " << x;
    }
  });
}

TEST(DualDerivatives, leave_the_value_as_the_scalar_alone_gives_it) {
  for_each_function([&](const char* name, const auto& f, double low, double high) {
    for (const double x : points(low, high)) {
      EXPECT_EQ(f(variable<3>(x, 1)).value, f(x)) << name << " at " << x;
      EXPECT_EQ(value_of(f(variable<2>(variable<3>(x, 1), 0))), f(x)) << name << " at " << x;
    }
  });
}

/// A function of three variables with everything mixed.
template <class T>
T mixed(const std::array<T, 3>& x) {
  const T r = sqrt(square(x[0]) + square(x[1]) + square(x[2]));
  const T angle = atan2(x[1], x[0]);
  return exp(-r) * sin(2.0 * angle) + pow(r, 1.5) * cos(x[2] / r) + log(1.0 + square(x[2])) / (1.0 + r);
}

TEST(DualDerivatives, gradients_and_hessians_of_three_variables) {
  const Real50 h = pow(Real50(10), -12);
  const std::array<double, 3> at{0.7, -1.2, 0.4};
  const auto shifted = [&](std::size_t i, int si, std::size_t j, int sj) {
    std::array<Real50, 3> x{Real50(at[0]), Real50(at[1]), Real50(at[2])};
    x[i] += si * h;
    x[j] += sj * h;
    return mixed(x);
  };
  const auto value = mixed(variables(variables(at)));
  for (std::size_t i = 0; i < 3; ++i) {
    const Real50 slope = (shifted(i, 1, i, 0) - shifted(i, -1, i, 0)) / (2 * h);
    // All terms are of order one; some fifty roundings.
    EXPECT_NEAR(value.derivative[i].value, to_double(slope), 50 * epsilon);
    for (std::size_t j = 0; j < 3; ++j) {
      const Real50 second =
          (shifted(i, 1, j, 1) - shifted(i, 1, j, -1) - shifted(i, -1, j, 1) + shifted(i, -1, j, -1)) / (4 * h * h);
      EXPECT_NEAR(value.derivative[i].derivative[j], to_double(second), 50 * epsilon) << i << j;
      EXPECT_NEAR(value.derivative[i].derivative[j], value.derivative[j].derivative[i], 50 * epsilon);
    }
  }
}

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

template <int W>
void expect_lanes_as_alone() {
  for_each_function([&](const char* name, const auto& f, double low, double high) {
    const std::vector<double> at = points(low, high);
    for (std::size_t start = 0; start + W <= at.size(); start += W) {
      const auto together = f(variable<1>(Pack<W>::load(at.data() + start), 0));
      for (int i = 0; i < W; ++i) {
        const auto alone = f(variable<1>(at[start + static_cast<std::size_t>(i)], 0));
        const auto mine = lane(together, i);
        EXPECT_TRUE(same_bits(mine.value, alone.value)) << name << ", width " << W;
        EXPECT_TRUE(same_bits(mine.derivative[0], alone.derivative[0])) << name << ", width " << W;
      }
    }
  });
}

template <int W>
void expect_hessian_as_alone() {
  const std::vector<double> at = points(-3.0, 3.0);
  for (std::size_t start = 0; start + 3 * W <= at.size(); start += 3 * W) {
    std::array<Pack<W>, 3> x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = Pack<W>::load(at.data() + start + k * W);
    const auto together = mixed(variables(variables(x)));
    for (int i = 0; i < W; ++i) {
      const auto alone = mixed(variables(variables(std::array{lane(x[0], i), lane(x[1], i), lane(x[2], i)})));
      for (std::size_t j = 0; j < 3; ++j) {
        EXPECT_TRUE(same_bits(lane(together, i).derivative[j].value, alone.derivative[j].value));
        for (std::size_t k = 0; k < 3; ++k) {
          EXPECT_TRUE(same_bits(lane(together, i).derivative[j].derivative[k], alone.derivative[j].derivative[k]));
        }
      }
    }
  }
}

TEST(DualOfPack, has_the_bits_of_dual_of_double_in_every_lane) {
  expect_lanes_as_alone<1>();
  expect_lanes_as_alone<2>();
  expect_lanes_as_alone<4>();
  expect_lanes_as_alone<8>();
  expect_hessian_as_alone<1>();
  expect_hessian_as_alone<4>();
}

TEST(DualOfPack, selects_lane_by_lane) {
  constexpr std::array<double, 4> at{-2.0, -1.0, 1.0, 2.0};
  const auto x = variable<1>(Pack<4>::load(at.data()), 0);
  const auto y = select(x < 0.0, x * x, 3.0 * x);
  const auto against_constant = select(x < 0.0, 1.0, x);
  for (int i = 0; i < 4; ++i) {
    const double v = at[static_cast<std::size_t>(i)];
    EXPECT_EQ(lane(y, i).value, v < 0 ? v * v : 3 * v);
    EXPECT_EQ(lane(y, i).derivative[0], v < 0 ? 2 * v : 3.0);
    EXPECT_EQ(lane(against_constant, i).derivative[0], v < 0 ? 0.0 : 1.0);
  }
}

TEST(DualSquareRoot, is_never_finite_by_accident_at_zero) {
  const auto varying = sqrt(variable<2>(0.0, 0));
  EXPECT_EQ(varying.value, 0.0);
  EXPECT_EQ(varying.derivative[0], std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(varying.derivative[1]));
  EXPECT_FALSE(isfinite(varying));
}

TEST(Dual, mixes_with_plain_numbers_and_inner_duals) {
  using Inner = Dual<double, 2>;
  const Inner inner = variable<2>(3.0, 0);
  const Dual<Inner, 2> outer = variable<2>(inner, 1);
  EXPECT_EQ((2 * outer).derivative[1].value, 2.0);
  EXPECT_EQ((outer * 2.0).value.derivative[0], 2.0);
  EXPECT_EQ((outer * inner).value.value, 9.0);
  EXPECT_EQ((outer * inner).derivative[1].value, 3.0);
  EXPECT_EQ((inner - outer).derivative[1].value, -1.0);
  EXPECT_TRUE(outer > 2);
  EXPECT_TRUE(outer == 3.0);
  EXPECT_EQ(to_double(outer), 3.0);
  EXPECT_EQ(lanes<decltype(outer)>, 1 * lanes<double>);
}

}  // namespace
}  // namespace xpr
