// The elementary functions against MPFR at 50 digits, in units in the last place of the exact result, and their values
// at zeros, infinities, NaN and the edges of their domains.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "metrics/scalar/multiprecision.hpp"

namespace xpr {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

/// |approximate - exact| in units of the spacing of doubles at `exact`.
double ulps(double approximate, const Real50& exact) {
  const double magnitude = std::max(std::fabs(to_double(exact)), std::numeric_limits<double>::min());
  const Real50 spacing = ldexp(Real50(1), std::ilogb(magnitude) - 52);
  return std::fabs(to_double(Real50((Real50(approximate) - exact) / spacing)));
}

/// Arguments with a uniform distribution over [low, high], signs included.
std::vector<double> uniform(double low, double high, int count) {
  std::mt19937_64 generator(20240611);
  std::uniform_real_distribution<double> distribution(low, high);
  std::vector<double> out(static_cast<std::size_t>(count));
  for (double& x : out) x = distribution(generator);
  return out;
}

/// Arguments of every magnitude in [low, high], both positive, and of both signs if asked.
std::vector<double> logarithmic(double low, double high, int count, bool both_signs) {
  std::vector<double> out = uniform(std::log2(low), std::log2(high), count);
  bool negative = false;
  for (double& x : out) {
    x = std::exp2(x);
    if (both_signs && negative) x = -x;
    negative = !negative;
  }
  return out;
}

template <class Approximate, class Exact>
double worst(const std::vector<double>& arguments, const Approximate& approximate, const Exact& exact) {
  double largest = 0.0;
  double where = 0.0;
  for (const double x : arguments) {
    const double error = ulps(approximate(x), exact(Real50(x)));
    if (!(error <= largest)) {
      largest = error;
      where = x;
    }
  }
  ::testing::Test::RecordProperty("worst_ulp", std::to_string(largest));
  std::printf("    worst error %.4f ulp at %.17g\n", largest, where);
  return largest;
}

constexpr int many = 60'000;

// The bounds below are the largest errors measured over ten times as many arguments, rounded up: half a unit is the
// final rounding, the rest the last products before it.

const auto sin_d = [](double x) { return sin(x); };
const auto sin_r = [](const Real50& x) { return Real50(sin(x)); };
const auto cos_d = [](double x) { return cos(x); };
const auto cos_r = [](const Real50& x) { return Real50(cos(x)); };

TEST(Elementary, sine_and_cosine_are_within_one_ulp) {
  for (const auto& arguments : {uniform(-4.0, 4.0, many), logarithmic(1e-300, largest_angle, many, true),
                                uniform(-largest_angle, largest_angle, many)}) {
    EXPECT_LT(worst(arguments, sin_d, sin_r), 0.9);
    EXPECT_LT(worst(arguments, cos_d, cos_r), 0.9);
  }
}

TEST(Elementary, sine_and_cosine_hold_next_to_multiples_of_half_pi) {
  std::vector<double> arguments;
  for (int n = 1; n < 1'335'000; n += 97) {
    const double x = to_double(Real50(n * pi<Real50>() / 2));
    for (const double y : {x, std::nextafter(x, 0.0), std::nextafter(x, inf)}) arguments.push_back(y);
  }
  EXPECT_LT(worst(arguments, sin_d, sin_r), 0.9);
  EXPECT_LT(worst(arguments, cos_d, cos_r), 0.9);
}

TEST(Elementary, tangent) {
  for (const auto& arguments : {uniform(-4.0, 4.0, many), uniform(-1e6, 1e6, many)}) {
    EXPECT_LT(worst(
                  arguments, [](double x) { return tan(x); }, [](const Real50& x) { return Real50(tan(x)); }),
              2.5);
  }
}

TEST(Elementary, arctangent_is_within_one_ulp) {
  for (const auto& arguments : {uniform(-4.0, 4.0, many), logarithmic(1e-300, 1e300, many, true)}) {
    EXPECT_LT(worst(
                  arguments, [](double x) { return atan(x); }, [](const Real50& x) { return Real50(atan(x)); }),
              0.9);
  }
}

TEST(Elementary, arctangent_of_two_arguments_is_within_one_ulp) {
  for (const double scale : {1.0, 1e-307, 1e307, 1e200, 1e-200}) {
    const auto arguments = uniform(-4.0, 4.0, many);
    const auto others = logarithmic(0.05, 10.0, many, true);
    std::size_t i = 0;
    double largest = 0.0;
    for (const double y : arguments) {
      const double x = others[i++];
      largest =
          std::max(largest, ulps(atan2(y * scale, x * scale), Real50(atan2(Real50(y * scale), Real50(x * scale)))));
    }
    EXPECT_LT(largest, 0.95);
  }
}

TEST(Elementary, arcsine_and_arccosine_are_within_one_ulp) {
  for (const auto& arguments :
       {uniform(-1.0, 1.0, many), logarithmic(1e-300, 1.0, many, true), uniform(0.97, 1.0, many)}) {
    EXPECT_LT(worst(
                  arguments, [](double x) { return asin(x); }, [](const Real50& x) { return Real50(asin(x)); }),
              1.0);
    EXPECT_LT(worst(
                  arguments, [](double x) { return acos(x); }, [](const Real50& x) { return Real50(acos(x)); }),
              1.0);
  }
}

TEST(Elementary, exponential_is_within_one_ulp) {
  for (const auto& arguments :
       {uniform(-745.0, 709.78, many), uniform(-1.0, 1.0, many), logarithmic(1e-300, 700.0, many, true)}) {
    EXPECT_LT(worst(
                  arguments, [](double x) { return exp(x); }, [](const Real50& x) { return Real50(exp(x)); }),
              1.0);
  }
}

TEST(Elementary, logarithm_is_within_one_ulp) {
  for (const auto& arguments : {uniform(0.5, 2.0, many), logarithmic(1e-320, 1e308, many, false)}) {
    EXPECT_LT(worst(
                  arguments, [](double x) { return log(x); }, [](const Real50& x) { return Real50(log(x)); }),
              1.0);
  }
}

TEST(Elementary, power) {
  for (const double reach : {5.0, 700.0}) {
    const auto bases = logarithmic(1e-30, 1e30, many, false);
    const auto products = uniform(-reach, reach, many);
    double largest = 0.0;
    for (std::size_t i = 0; i < bases.size(); ++i) {
      const double y = products[(i * 7919) % products.size()] / std::log(bases[i]);
      largest = std::max(largest, ulps(pow(bases[i], y), Real50(pow(Real50(bases[i]), Real50(y)))));
    }
    EXPECT_LT(largest, 1.0);
  }
}

TEST(Elementary, power_near_one) {
  const auto offsets = logarithmic(1e-15, 0.4, many, true);
  double largest = 0.0;
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const double x = 1.0 + offsets[i];
    const double y = 600.0 * std::cos(static_cast<double>(i)) / std::log1p(offsets[i]);
    if (x == 1.0) continue;
    const Real50 exact = pow(Real50(x), Real50(y));
    if (!(exact < 1e308 && exact > 1e-308)) continue;
    largest = std::max(largest, ulps(pow(x, y), exact));
  }
  EXPECT_LT(largest, 1.0);
}

TEST(Elementary, hyperbolic_functions) {
  for (const auto& arguments :
       {uniform(-3.0, 3.0, many), uniform(-710.0, 710.0, many), logarithmic(1e-300, 700.0, many, true)}) {
    EXPECT_LT(worst(
                  arguments, [](double x) { return sinh(x); }, [](const Real50& x) { return Real50(sinh(x)); }),
              2.0);
    EXPECT_LT(worst(
                  arguments, [](double x) { return cosh(x); }, [](const Real50& x) { return Real50(cosh(x)); }),
              2.0);
    EXPECT_LT(worst(
                  arguments, [](double x) { return tanh(x); }, [](const Real50& x) { return Real50(tanh(x)); }),
              4.0);
  }
}

}  // namespace
}  // namespace xpr
