// Polynomials on [0, 1] in Bernstein form: values, derivatives, halves, and bounds by their coefficients.
//
//   p(t) = sum_k c_k B_k(t),   B_k(t) = binomial(n, k) t^k (1 - t)^(n-k) >= 0,   sum_k B_k = 1
//
// A value is an average of the coefficients: p lies between the least and the largest, and has no more roots in (0, 1)
// than the coefficients have changes of sign. Evaluation adds terms of weights that are positive and sum to one, so its
// error is a few n units of rounding of the largest coefficient. Cites: [Farouki2012] [LaneRiesenfeld1981]
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "core/geometry/ray_path.hpp"

namespace xpr::bernstein {

inline constexpr std::size_t most_coefficients = RayPath::max_degree + 1;

/// binomial(n, k) for n up to the largest degree.
inline constexpr auto binomials = [] {
  std::array<std::array<double, most_coefficients>, most_coefficients> row{};
  for (std::size_t n = 0; n < most_coefficients; ++n) {
    row[n][0] = 1.0;
    for (std::size_t k = 1; k <= n; ++k) row[n][k] = row[n - 1][k - 1] + (k < n ? row[n - 1][k] : 0.0);
  }
  return row;
}();

/// The sum over k of c[k] B_k(t), by Horner's rule in t beside the powers of 1 - t. Exact at t = 0 and t = 1. C needs
/// a sum and a product with a number.
template <class C>
[[nodiscard]] constexpr C value(const std::array<C, most_coefficients>& c, int degree, double t) {
  const auto n = static_cast<std::size_t>(degree);
  const double rest = 1.0 - t;
  double power = 1.0;
  C sum = rest * c[0];
  for (std::size_t k = 1; k < n; ++k) {
    power *= t;
    sum = rest * (sum + (power * binomials[n][k]) * c[k]);
  }
  return sum + (power * t) * c[n];
}

/// The derivative's coefficients, of one degree less.
template <class C>
[[nodiscard]] constexpr std::array<C, most_coefficients> derivative(const std::array<C, most_coefficients>& c,
                                                                    int degree) {
  std::array<C, most_coefficients> d{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(degree); ++k) {
    d[k] = static_cast<double>(degree) * (c[k + 1] - c[k]);
  }
  return d;
}

/// The same polynomial over [0, t] and over [t, 1], by de Casteljau's scheme.
template <class C>
constexpr void split(const std::array<C, most_coefficients>& c, int degree, double t,
                     std::array<C, most_coefficients>& first, std::array<C, most_coefficients>& second) {
  const auto n = static_cast<std::size_t>(degree);
  second = c;
  first[0] = c[0];
  for (std::size_t level = 1; level <= n; ++level) {
    for (std::size_t k = 0; k <= n - level; ++k) second[k] = (1.0 - t) * second[k] + t * second[k + 1];
    first[level] = second[0];
  }
}

/// The same polynomial over [a, b].
template <class C>
[[nodiscard]] constexpr std::array<C, most_coefficients> restricted(const std::array<C, most_coefficients>& c,
                                                                    int degree, double a, double b) {
  std::array<C, most_coefficients> left{}, right{}, ignored{};
  split(c, degree, a, ignored, right);
  split(right, degree, a < 1.0 ? (b - a) / (1.0 - a) : 1.0, left, ignored);
  return left;
}

}  // namespace xpr::bernstein
