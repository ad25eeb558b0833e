// Judging closed forms: 50-digit numbers, quadrature and one way to say "the value is right and its error bound holds".
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/mpfr.hpp>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "metrics/exact_value.hpp"

namespace xpr::exact_kit {

using Mp =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<50, boost::multiprecision::allocate_stack>,
                                  boost::multiprecision::et_off>;

inline Mp pi() { return boost::math::constants::pi<Mp>(); }
inline Mp sq(const Mp& x) { return x * x; }

/// Nodes of the double-exponential rule x = 1/(1 + exp(pi sinh t)) on (0, 1/2] and their weights, by halvings of the
/// step.
class DoubleExponentialNodes {
 public:
  struct Node {
    Mp x;       ///< distance from the nearer end, in units of the interval
    Mp weight;  ///< without the step
  };

  /// The nodes that halving number `level` adds: t = k h with k odd, or all t > 0 at level 0, h = 2^-level.
  static const std::vector<Node>& of_level(std::size_t level) {
    static std::vector<std::vector<Node>> levels;
    while (levels.size() <= level) {
      const Mp h = pow(Mp(2), -static_cast<int>(levels.size()));
      std::vector<Node> nodes;
      for (int k = 1;; k += levels.empty() ? 1 : 2) {
        const Mp grown = exp(pi() * sinh(k * h));
        const Mp x = 1 / (1 + grown);
        const Mp weight = pi() * cosh(k * h) * x * (1 - x);
        if (weight < Mp("1e-55")) break;
        nodes.push_back({x, weight});
      }
      levels.push_back(std::move(nodes));
    }
    return levels[level];
  }
};

/// Double-exponential quadrature at 50 digits, halved until two halvings move it by less than 1e-24 of the integral of
/// |f|: the last one then holds to the square of that. No convergence in 14 halvings is a test failure.
template <class F>
Mp integrate(const F& f, const Mp& from, const Mp& to) {
  if (from == to) return 0;
  const Mp width = to - from;
  Mp sum = f(Mp((from + to) / 2)) * pi() / 4, size = abs(sum), last = 0;
  for (std::size_t level = 0; level <= 14; ++level) {
    for (const auto& node : DoubleExponentialNodes::of_level(level)) {
      const Mp pair = node.weight * (f(Mp(from + node.x * width)) + f(Mp(to - node.x * width)));
      sum += pair;
      size += abs(pair);
    }
    const Mp h = pow(Mp(2), -static_cast<int>(level));
    const Mp value = sum * h * width;
    if (level > 2 && abs(value - last) <= Mp("1e-24") * size * h * abs(width)) return value;
    last = value;
  }
  ADD_FAILURE() << "quadrature from " << from << " to " << to << " does not converge";
  return last;
}

/// Collects |value - reference| against the claimed bound over many points; the largest ratio must stay below one.
class BoundCheck {
 public:
  /// `smallness`: what the bound itself may be, in units of max(1, |reference|).
  explicit BoundCheck(double smallness) : smallness_(smallness) {}

  void operator()(const ExactValue& got, const Mp& reference, const std::string& where) {
    const Mp miss = abs(Mp(got.value) - reference);
    EXPECT_LE(miss, Mp(got.error)) << where << ": value " << got.value << ", reference " << reference.str(20);
    EXPECT_LE(got.error, smallness_ * std::max(1.0, std::abs(got.value))) << where;
    ++points_;
  }
  [[nodiscard]] int points() const { return points_; }

 private:
  double smallness_;
  int points_ = 0;
};

/// Log-uniform in [from, to], from a seed written down by the caller.
class LogUniform {
 public:
  LogUniform(unsigned seed, double from, double to) : engine_(seed), exponent_(std::log(from), std::log(to)) {}
  double operator()() { return std::exp(exponent_(engine_)); }

 private:
  std::mt19937_64 engine_;
  std::uniform_real_distribution<double> exponent_;
};

}  // namespace xpr::exact_kit
