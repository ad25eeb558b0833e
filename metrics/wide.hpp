// Wide: a number kept as high + low, about 106 bits, for the few places in a closed form where doubles cancel. Four
// operations and the square root, each within some 4 units of 2^-104. Finite numbers only. [Dekker1971]
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "metrics/scalar/double_double.hpp"

namespace xpr {

struct Wide {
  double high = 0.0;
  double low = 0.0;

  constexpr Wide() = default;
  constexpr Wide(double x) : high(x) {}  // implicit: a double is exact here
  constexpr Wide(double h, double l) : high(h), low(l) {}
  explicit constexpr operator double() const { return high + low; }
};

namespace wide_detail {
/// x y as high + low, exactly: the same bits with and without the machine's fused multiply-add.
[[nodiscard]] constexpr Wide product(double x, double y) {
#ifdef __FMA__
  if (!std::is_constant_evaluated()) {
    const double high = x * y;
    return {high, __builtin_fma(x, y, -high)};
  }
#endif
  const auto p = double_double::product(x, y);
  return {p.high, p.low};
}
[[nodiscard]] constexpr Wide tidy(double high, double low) {
  const auto s = double_double::ordered_sum(high, low);
  return {s.high, s.low};
}
}  // namespace wide_detail

[[nodiscard]] constexpr Wide operator-(const Wide& x) { return {-x.high, -x.low}; }
[[nodiscard]] constexpr Wide operator+(const Wide& x, const Wide& y) {
  const auto s = double_double::sum(x.high, y.high);
  const auto t = double_double::sum(x.low, y.low);
  const Wide u = wide_detail::tidy(s.high, s.low + t.high);
  return wide_detail::tidy(u.high, u.low + t.low);
}
[[nodiscard]] constexpr Wide operator-(const Wide& x, const Wide& y) { return x + (-y); }
[[nodiscard]] constexpr Wide operator*(const Wide& x, const Wide& y) {
  const Wide p = wide_detail::product(x.high, y.high);
  return wide_detail::tidy(p.high, p.low + (x.high * y.low + x.low * y.high));
}
[[nodiscard]] constexpr Wide operator/(const Wide& x, const Wide& y) {
  const double q1 = x.high / y.high;
  const Wide rest = x - y * Wide(q1);
  const double q2 = rest.high / y.high;
  const Wide rest2 = rest - y * Wide(q2);
  return wide_detail::tidy(q1, q2) + Wide(rest2.high / y.high);
}

/// x >= 0.
[[nodiscard]] inline Wide sqrt(const Wide& x) {
  if (!(x.high > 0.0)) return 0.0;
  const double root = std::sqrt(x.high);
  const Wide rest = x - wide_detail::product(root, root);
  return wide_detail::tidy(root, static_cast<double>(rest) / (2.0 * root));
}

/// 2^n x for a power of two.
[[nodiscard]] constexpr Wide scaled(const Wide& x, double power_of_two) {
  return {x.high * power_of_two, x.low * power_of_two};
}

struct WideSincos {
  Wide sine;
  Wide cosine;
};

/// Sine and cosine of |theta| <= pi to some 30 digits: Taylor's series of theta/16, doubled four times.
[[nodiscard]] inline WideSincos wide_sincos(double theta) {
  constexpr std::size_t terms = 10;  // (pi/16)^22/22! is 1e-37
  // Of x = theta^2: sin theta = theta (1 - x/6 (1 - x/20 (...))), 1 - cos theta = x/2 (1 - x/12 (1 - x/30 (...))).
  static constexpr auto factors = [] {
    std::array<std::array<Wide, terms>, 2> f{};
    for (std::size_t k = 0; k < terms; ++k) {
      const auto n = static_cast<double>(2 * k);
      f[0][k] = Wide(1.0) / Wide((n + 2.0) * (n + 3.0));
      f[1][k] = Wide(1.0) / Wide((n + 1.0) * (n + 2.0));
    }
    return f;
  }();
  const double part = theta / 16.0;
  const Wide x = wide_detail::product(part, part);
  Wide sine = 1.0, versed = 1.0;
  for (std::size_t k = terms; k-- > 0;) sine = Wide(1.0) - x * factors[0][k] * sine;
  for (std::size_t k = terms; k-- > 1;) versed = Wide(1.0) - x * factors[1][k] * versed;
  sine = sine * Wide(part), versed = x * factors[1][0] * versed;
  for (int i = 0; i < 4; ++i) {
    const Wide twice = scaled(sine * (Wide(1.0) - versed), 2.0);
    versed = scaled(sine * sine, 2.0);
    sine = twice;
  }
  return {sine, Wide(1.0) - versed};
}

}  // namespace xpr
