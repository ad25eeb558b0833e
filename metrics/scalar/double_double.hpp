// Sums and products with their rounding errors: the few operations on unevaluated pairs high + low that the elementary
// functions need to stay below one unit in the last place. Round to nearest is assumed; no fused multiply-add is used,
// so the bits are the same on every machine. [Dekker1971]
#pragma once

#include "metrics/scalar/bits.hpp"

namespace xpr::double_double {

/// high + low, with |low| at most half a unit in the last place of high.
template <class T>
struct Pair {
  T high;
  T low;
};

/// a + b exactly.
template <MachineScalar T>
[[nodiscard]] constexpr Pair<T> sum(const T& a, const T& b) {
  const T s = a + b;
  const T b_part = s - a;
  const T a_part = s - b_part;
  return {s, (a - a_part) + (b - b_part)};
}

/// a + b exactly, where |a| >= |b| or a = 0.
template <MachineScalar T>
[[nodiscard]] constexpr Pair<T> ordered_sum(const T& a, const T& b) {
  const T s = a + b;
  return {s, b - (s - a)};
}

/// a b exactly, while |a|, |b| < 2^995 and the product's tail does not underflow.
template <MachineScalar T>
[[nodiscard]] constexpr Pair<T> product(const T& a, const T& b) {
  constexpr double splitter = 0x1p27 + 1.0;
  const T a_scaled = splitter * a, b_scaled = splitter * b;
  const T a_high = a_scaled - (a_scaled - a), b_high = b_scaled - (b_scaled - b);
  const T a_low = a - a_high, b_low = b - b_high;
  const T p = a * b;
  return {p, ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low};
}

}  // namespace xpr::double_double
