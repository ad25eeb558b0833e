// The elementary functions against MPFR at 50 digits, in units in the last place of the exact result, and their values
// at zeros, infinities, NaN and the edges of their domains.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

/// The largest error of f over the arguments; f is generic, so that MPFR's own function answers for 50 digits.
template <class F>
double worst(const std::vector<double>& arguments, const F& f) {
  double largest = 0.0;
  for (const double x : arguments) {
    const double error = ulps(f(x), Real50(f(Real50(x))));
    if (!(error <= largest)) largest = error;  // NaN stays
  }
  return largest;
}

/// The same over pairs (x, y).
template <class F>
double worst(const std::vector<double>& xs, const std::vector<double>& ys, const F& f) {
  double largest = 0.0;
  for (std::size_t i = 0; i < xs.size(); ++i) {
    const double error = ulps(f(xs[i], ys[i]), Real50(f(Real50(xs[i]), Real50(ys[i]))));
    if (!(error <= largest)) largest = error;
  }
  return largest;
}

constexpr int many = 20'000;

// Every bound below is the largest error found over a million arguments of the same distribution (the table in
// elementary.hpp), rounded up to the next 0.05: half a unit is the final rounding, the rest the operations before it.
constexpr double sine_bound = 0.80;
constexpr double tangent_bound = 2.15;
constexpr double arctangent_bound = 0.80;
constexpr double arctangent_2_bound = 0.95;
constexpr double arcsine_bound = 0.90;
constexpr double exponential_bound = 0.90;
constexpr double logarithm_bound = 0.85;
constexpr double power_bound = 0.95;
constexpr double sinh_bound = 1.65;
constexpr double cosh_bound = 1.45;
constexpr double tanh_bound = 2.70;

constexpr auto sine = [](const auto& x) { return sin(x); };
constexpr auto cosine = [](const auto& x) { return cos(x); };

TEST(Elementary, sine_and_cosine_are_within_one_ulp) {
  for (const auto& arguments : {uniform(-4.0, 4.0, many), logarithmic(1e-300, largest_angle, many, true),
                                uniform(-largest_angle, largest_angle, many)}) {
    EXPECT_LT(worst(arguments, sine), sine_bound);
    EXPECT_LT(worst(arguments, cosine), sine_bound);
  }
}

TEST(Elementary, sine_and_cosine_hold_next_to_multiples_of_half_pi) {
  std::vector<double> arguments;
  for (int n = 1; n < 1'335'000; n += 97) {
    const double x = to_double(Real50(n * pi<Real50>() / 2));
    for (const double y : {x, std::nextafter(x, 0.0), std::nextafter(x, inf)}) arguments.push_back(y);
  }
  EXPECT_LT(worst(arguments, sine), sine_bound);
  EXPECT_LT(worst(arguments, cosine), sine_bound);
}

TEST(Elementary, tangent) {
  for (const auto& arguments : {uniform(-4.0, 4.0, many), uniform(-1e6, 1e6, many)}) {
    EXPECT_LT(worst(arguments, [](const auto& x) { return tan(x); }), tangent_bound);
  }
}

TEST(Elementary, arctangent_is_within_one_ulp) {
  for (const auto& arguments : {uniform(-4.0, 4.0, many), logarithmic(1e-300, 1e300, many, true)}) {
    EXPECT_LT(worst(arguments, [](const auto& x) { return atan(x); }), arctangent_bound);
  }
}

TEST(Elementary, arctangent_of_two_arguments_is_within_one_ulp_near_the_limits_of_double_too) {
  for (const double scale : {1.0, 1e-307, 1e307}) {
    std::vector<double> xs = uniform(-4.0, 4.0, many);
    std::vector<double> ys = logarithmic(0.05, 10.0, many, true);
    for (double& x : xs) x *= scale;
    for (double& y : ys) y *= scale;
    EXPECT_LT(worst(xs, ys, [](const auto& x, const auto& y) { return atan2(y, x); }), arctangent_2_bound) << scale;
    EXPECT_LT(worst(xs, ys, [](const auto& x, const auto& y) { return atan2(x, y); }), arctangent_2_bound) << scale;
  }
}

TEST(Elementary, arcsine_and_arccosine_are_within_one_ulp) {
  for (const auto& arguments :
       {uniform(-1.0, 1.0, many), logarithmic(1e-300, 1.0, many, true), uniform(0.97, 1.0, many)}) {
    EXPECT_LT(worst(arguments, [](const auto& x) { return asin(x); }), arcsine_bound);
    EXPECT_LT(worst(arguments, [](const auto& x) { return acos(x); }), arcsine_bound);
  }
}

TEST(Elementary, exponential_is_within_one_ulp) {
  for (const auto& arguments :
       {uniform(-745.0, 709.78, many), uniform(-1.0, 1.0, many), logarithmic(1e-300, 700.0, many, true)}) {
    EXPECT_LT(worst(arguments, [](const auto& x) { return exp(x); }), exponential_bound);
  }
}

TEST(Elementary, logarithm_is_within_one_ulp) {
  for (const auto& arguments : {uniform(0.5, 2.0, many), logarithmic(1e-320, 1e308, many, false)}) {
    EXPECT_LT(worst(arguments, [](const auto& x) { return log(x); }), logarithm_bound);
  }
}

constexpr auto power = [](const auto& x, const auto& y) { return pow(x, y); };

TEST(Elementary, power_is_within_one_ulp_up_to_the_limits_of_double) {
  for (const double reach : {5.0, 700.0}) {  // of y log x
    const auto bases = logarithmic(1e-30, 1e30, many, false);
    const auto logarithms = uniform(-reach, reach, many);
    std::vector<double> exponents(bases.size());
    for (std::size_t i = 0; i < bases.size(); ++i) {
      exponents[i] = logarithms[(i * 7919) % logarithms.size()] / std::log(bases[i]);
    }
    EXPECT_LT(worst(bases, exponents, power), power_bound) << reach;
  }
}

TEST(Elementary, power_is_within_one_ulp_for_bases_near_one) {
  std::vector<double> bases;
  std::vector<double> exponents;
  for (const double offset : logarithmic(1e-14, 0.4, many, true)) {
    bases.push_back(1.0 + offset);
    exponents.push_back(600.0 * std::cos(static_cast<double>(bases.size())) / std::log(bases.back()));
  }
  EXPECT_LT(worst(bases, exponents, power), power_bound);
}

TEST(Elementary, hyperbolic_functions) {
  for (const auto& arguments :
       {uniform(-3.0, 3.0, many), uniform(-710.0, 710.0, many), logarithmic(1e-300, 700.0, many, true)}) {
    EXPECT_LT(worst(arguments, [](const auto& x) { return sinh(x); }), sinh_bound);
    EXPECT_LT(worst(arguments, [](const auto& x) { return cosh(x); }), cosh_bound);
    EXPECT_LT(worst(arguments, [](const auto& x) { return tanh(x); }), tanh_bound);
  }
}

}  // namespace
}  // namespace xpr
