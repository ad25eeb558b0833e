// Wide: a number kept as high + low, about 106 bits, for the few places in a closed form where doubles cancel. Four
// operations and the square root, each within some 4 units of 2^-104. Finite numbers only. [Dekker1971]
#pragma once

#include <cmath>

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
  const double high = x * y;
  return {high, __builtin_fma(x, y, -high)};
#else
  const auto p = double_double::product(x, y);
  return {p.high, p.low};
#endif
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

}  // namespace xpr
