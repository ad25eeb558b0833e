// exp, log, pow and the hyperbolic functions for double and every pack width, from + - * / and bit operations alone.
//
// exp and log reduce by powers of two and use fdlibm's printed coefficients [Fdlibm1993]; pow carries the logarithm in
// double-double [Dekker1971]. The evaluation is branch-free. Accuracy: see elementary.hpp.
#pragma once

#include "metrics/scalar/double_double.hpp"

namespace xpr {

namespace exponentials {

// ln 2 = high + low; the high part has 32 significant bits, so that its product with an exponent is exact.
inline constexpr double ln2_high = 6.93147180369123816490e-01;
inline constexpr double ln2_low = 1.90821492927058770002e-10;
inline constexpr double inverse_ln2 = 1.44269504088896338700e+00;

/// exp(x + x_low) 2^power with x in about [-746, 711]: results below the normal range are rounded once.
template <MachineScalar T>
[[nodiscard]] constexpr T scaled_exp(const T& x, const T& x_low, double power) {
  const T k = rint(x * inverse_ln2);
  const T high = x - k * ln2_high;
  const T low = k * ln2_low - x_low;
  const T r = high - low;
  const T z = r * r;
  const T c =
      r -
      z * (1.66666666666666019037e-01 +
           z * (-2.77777777770155933842e-03 +
                z * (6.61375632143793436117e-05 + z * (-1.65339022054652515390e-06 + z * 4.13813679705723846039e-08))));
  const T y = 1.0 - ((low - (r * c) / (2.0 - c)) - high);
  const T exponent = k + power;
  const T half = rint(0.5 * exponent);
  return (y * bits::power_of_two(half)) * bits::power_of_two(exponent - half);
}

/// x = 2^k (1 + f) with 1 + f in [sqrt(1/2), sqrt 2), for positive finite x, below the normal range too.
template <class T>
struct BinaryParts {
  T k;
  T f;
};

template <MachineScalar T>
[[nodiscard]] constexpr BinaryParts<T> binary_parts(const T& x) {
  const auto tiny = x < T(0x1p-1022);
  const T scaled = select(tiny, x * 0x1p54, x);
  const T m = bits::significand(scaled);
  const T k = bits::exponent(scaled) - select(tiny, T(54.0), T(0.0));
  const auto upper = m > T(1.41421356237309504880);
  return {select(upper, k + 1.0, k), select(upper, 0.5 * m, m) - 1.0};
}

/// log x as high + low with a relative error near 2^-66, for positive finite x: twice the series of atanh(f / (2 + f)).
template <MachineScalar T>
[[nodiscard]] constexpr double_double::Pair<T> log_pair(const T& x) {
  using double_double::ordered_sum;
  using double_double::product;
  const BinaryParts<T> parts = binary_parts(x);
  const T& f = parts.f;

  const T divisor = 2.0 + f;
  const T divisor_low = f - (divisor - 2.0);
  const T s = f / divisor;
  const auto back = product(s, divisor);
  const T s_low = (((f - back.high) - back.low) - s * divisor_low) / divisor;

  const auto square_pair = product(s, s);
  const T z = square_pair.high;
  const T z_low = square_pair.low + 2.0 * s * s_low;
  T series = T(1.0 / 25.0);  // z <= 0.0295, so that z^12/25 is the last term above 2^-66
  for (int odd = 23; odd >= 5; odd -= 2) series = series * z + 1.0 / odd;

  // q = z/3 + z^2 series, the leading term to double-double.
  constexpr double third = 1.0 / 3.0;
  constexpr double third_low = 1.85037170770859413132e-17;
  const auto lead = product(z, T(third));
  const auto q = ordered_sum(lead.high, z * z * series);
  const T q_low = q.low + (lead.low + (z * third_low + z_low * third));

  // log(1 + f) = 2 s (1 + q)
  const auto cubic = product(s, q.high);
  const auto half_log = ordered_sum(s, cubic.high);
  const T half_log_low = half_log.low + (s_low + (cubic.low + (s * q_low + s_low * q.high)));
  const auto total = double_double::sum(parts.k * ln2_high, 2.0 * half_log.high);
  return ordered_sum(total.high, total.low + (2.0 * half_log_low + parts.k * ln2_low));
}

// Beyond these the result is infinite or zero.
inline constexpr double overflow_at = 7.09782712893383973096e+02;
inline constexpr double underflow_at = -7.45133219101941108420e+02;

/// exp(x + x_low), infinite and zero beyond the range of doubles; NaN stays to the caller.
template <MachineScalar T>
[[nodiscard]] constexpr T exp_in_range(const T& x, const T& x_low) {
  const auto over = x > T(overflow_at);
  const auto under = x < T(underflow_at);
  const auto outside = over | under;
  const T y = scaled_exp(select(outside, T(0.0), x), select(outside, T(0.0), x_low), 0.0);
  return select(over, T(bits::infinity), select(under, T(0.0), y));
}

}  // namespace exponentials

/// e^x. Infinite above 709.78, zero below -745.13.
template <MachineScalar T>
[[nodiscard]] constexpr T exp(const T& x) {
  return select(x == x, exponentials::exp_in_range(x, T(0.0)), T(bits::nan));
}

/// The natural logarithm. -infinity at 0, NaN below.
template <MachineScalar T>
[[nodiscard]] constexpr T log(const T& x) {
  const auto [k, f] = exponentials::binary_parts(x);
  const T s = f / (2.0 + f);
  const T z = s * s;
  const T series = z * (6.666666666666735130e-01 +
                        z * (3.999999999940941908e-01 +
                             z * (2.857142874366239149e-01 +
                                  z * (2.222219843214978396e-01 +
                                       z * (1.818357216161805012e-01 +
                                            z * (1.531383769920937332e-01 + z * 1.479819860511658591e-01))))));
  const T half_square = 0.5 * f * f;
  const T y =
      k * exponentials::ln2_high - ((half_square - (s * (half_square + series) + k * exponentials::ln2_low)) - f);
  const T finite = select(x > T(0.0), y, select(x == T(0.0), T(-bits::infinity), T(bits::nan)));
  return select(x == T(bits::infinity), x, finite);
}

/// x^y for x >= 0; NaN for x < 0 (for whole powers of any x there is pow(x, int)). pow(x, 0) = pow(1, y) = 1.
template <MachineScalar T>
[[nodiscard]] constexpr T pow(const T& x, const std::type_identity_t<T>& y) {
  const auto inside = (x > T(0.0)) & (x < T(bits::infinity));
  const auto log_x = exponentials::log_pair(select(inside, x, T(1.0)));
  const T rough = y * log_x.high;
  // Far outside the range of exp the exact product would overflow; its sign is all that matters there.
  const auto product_is_safe = abs(rough) < T(1000.0);
  const auto exact = double_double::product(select(product_is_safe, y, T(0.0)), log_x.high);
  const T exponent = select(product_is_safe, exact.high, rough);
  const T exponent_low = select(product_is_safe, exact.low + y * log_x.low, T(0.0));
  const T power = exponentials::exp_in_range(exponent, exponent_low);

  // At x = 0 and x = infinity: 0 or infinity by the sign of y.
  const auto grows = (x > T(1.0)) ^ (y < T(0.0));
  const T at_ends = select(grows, T(bits::infinity), T(0.0));
  const T defined = select(inside, power, at_ends);
  const auto is_one = (y == T(0.0)) | (x == T(1.0));
  const auto is_nan = (x != x) | (y != y) | (x < T(0.0));
  return select(is_one, T(1.0), select(is_nan, T(bits::nan), defined));
}

/// x^n for a whole number n by repeated multiplication; any x.
template <MachineScalar T, std::same_as<int> I>
[[nodiscard]] constexpr T pow(const T& x, I n) {
  return whole_power(x, n);
}

/// (e^x + e^-x) / 2.
template <MachineScalar T>
[[nodiscard]] constexpr T cosh(const T& x) {
  const T magnitude = min(abs(x), T(720.0));
  const T half_exp = exponentials::scaled_exp(magnitude, T(0.0), -1.0);
  return select(x == x, half_exp + 0.25 / half_exp, T(bits::nan));
}

/// (e^x - e^-x) / 2.
template <MachineScalar T>
[[nodiscard]] constexpr T sinh(const T& x) {
  const T magnitude = min(abs(x), T(720.0));
  const T half_exp = exponentials::scaled_exp(magnitude, T(0.0), -1.0);
  // Below 1 the difference would cancel; the Taylor series to x^19 leaves 1/21! there.
  const T z = x * x;
  T series = T(1.0);
  for (int n = 18; n >= 4; n -= 2) series = 1.0 + series * z / static_cast<double>(n * (n + 1));
  const T small = magnitude + magnitude * (z * series / 6.0);
  const T result = select(magnitude < T(1.0), small, half_exp - 0.25 / half_exp);
  return select(x == x, copysign(result, x), T(bits::nan));
}

/// sinh x / cosh x.
template <MachineScalar T>
[[nodiscard]] constexpr T tanh(const T& x) {
  const T magnitude = min(abs(x), T(20.0));  // 1 - tanh 20 < 2^-54
  return select(x == x, copysign(sinh(magnitude) / cosh(magnitude), x), T(bits::nan));
}

}  // namespace xpr
