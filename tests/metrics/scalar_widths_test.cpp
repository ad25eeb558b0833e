// Every elementary function gives the same bits in every lane at every width as for a plain double.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "metrics/scalar/elementary.hpp"

namespace xpr {
namespace {

struct Pair {
  double x;
  double y;
};

/// Pairs of ordinary size, of every bit pattern (infinities and NaN among them), and all pairs of special values. The
/// same in every build: the standard fixes the engine's bits, though not those of its distributions.
std::vector<Pair> arguments() {
  std::mt19937_64 generator(7);
  const auto within = [&](double reach) { return reach * (static_cast<double>(generator() >> 11U) * 0x1p-52 - 1.0); };
  std::vector<Pair> out;
  for (int i = 0; i < 60'000; ++i) {
    const double x = within(8.0);
    out.push_back({x, within(8.0)});
  }
  for (int i = 0; i < 20'000; ++i) {
    const double x = within(3e6);
    out.push_back({x, within(8.0)});
  }
  for (int i = 0; i < 40'000; ++i) {
    const double x = std::bit_cast<double>(generator());
    out.push_back({x, std::bit_cast<double>(generator())});
  }
  constexpr double inf = std::numeric_limits<double>::infinity();
  constexpr std::array<double, 16> special{
      0.0,  -0.0,   1.0,     -1.0,  0.5,    -0.5,   2.0,    inf,
      -inf, 5e-324, -5e-324, 1e308, -1e308, 1e-308, 0x1p52, std::numeric_limits<double>::quiet_NaN()};
  for (const double x : special) {
    for (const double y : special) out.push_back({x, y});
  }
  return out;
}

// The functions under test, by name: each takes a pair of the scalar.
struct Named {
  template <class T>
  static T call(int which, const T& x, const T& y) {
    switch (which) {
      case 0:
        return sin(x);
      case 1:
        return cos(x);
      case 2:
        return tan(x);
      case 3:
        return atan(x);
      case 4:
        return atan2(y, x);
      case 5:
        return asin(0.1 * x);
      case 6:
        return acos(0.1 * x);
      case 7:
        return exp(x);
      case 8:
        return log(x);
      case 9:
        return pow(x, y);
      case 10:
        return sinh(x);
      case 11:
        return cosh(x);
      case 12:
        return tanh(x);
      case 13:
        return floor(x);
      case 14:
        return rint(x);
      case 15:
        return abs(x);
      case 16:
        return copysign(x, y);
      case 17:
        return min(x, y);
      case 18:
        return max(x, y);
      case 19:
        return pow(x, 5);
      default:
        return sqrt(abs(x));
    }
  }
};
constexpr std::array<const char*, 21> names{"sin",  "cos", "tan",      "atan", "atan2", "asin",  "acos",
                                            "exp",  "log", "pow",      "sinh", "cosh",  "tanh",  "floor",
                                            "rint", "abs", "copysign", "min",  "max",   "pow 5", "sqrt"};

/// Equal bits; one NaN is as good as another, since the machine does not say whose payload survives x * y.
bool same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (a != a && b != b);
}

template <int W>
std::string first_difference(int which, const std::vector<Pair>& pairs) {
  for (std::size_t start = 0; start + W <= pairs.size(); start += W) {
    Pack<W> x;
    Pack<W> y;
    for (int i = 0; i < W; ++i) {
      set_lane(x, i, pairs[start + static_cast<std::size_t>(i)].x);
      set_lane(y, i, pairs[start + static_cast<std::size_t>(i)].y);
    }
    const Pack<W> together = Named::call(which, x, y);
    for (int i = 0; i < W; ++i) {
      const Pair& p = pairs[start + static_cast<std::size_t>(i)];
      const double alone = Named::call(which, p.x, p.y);
      if (!same(alone, lane(together, i))) {
        std::array<char, 160> text{};
        std::snprintf(text.data(), text.size(), "x = %a, y = %a: %a alone, %a in lane %d", p.x, p.y, alone,
                      lane(together, i), i);
        return text.data();
      }
    }
  }
  return {};
}

TEST(ElementaryFunctions, have_the_same_bits_at_every_width) {
  const std::vector<Pair> pairs = arguments();
  ASSERT_GE(pairs.size(), 100'000U);
  for (std::size_t which = 0; which < names.size(); ++which) {
    const int w = static_cast<int>(which);
    EXPECT_EQ(first_difference<1>(w, pairs), "") << names[which] << ", width 1";
    EXPECT_EQ(first_difference<2>(w, pairs), "") << names[which] << ", width 2";
    EXPECT_EQ(first_difference<4>(w, pairs), "") << names[which] << ", width 4";
    EXPECT_EQ(first_difference<8>(w, pairs), "") << names[which] << ", width 8";
  }
}

// Not a check of values (scalar_elementary_test.cpp does that): it is what every compiler, optimisation level and
// instruction set must agree on, first recorded from g++ 12 -O2 -march=x86-64-v3. It changes only where a function is
// changed on purpose.
TEST(ElementaryFunctions, have_the_same_bits_in_every_build) {
  const std::vector<Pair> pairs = arguments();
  std::uint64_t fingerprint = 0xcbf29ce484222325;  // FNV-1a over the results
  for (std::size_t which = 0; which < names.size(); ++which) {
    for (const Pair& p : pairs) {
      const double value = Named::call(static_cast<int>(which), p.x, p.y);
      // Whose NaN survives x * y is the compiler's choice.
      fingerprint = (fingerprint ^ (value != value ? 0 : std::bit_cast<std::uint64_t>(value))) * 0x100000001b3;
    }
  }
  EXPECT_EQ(fingerprint, 16466474428323969237U);
}

}  // namespace
}  // namespace xpr
