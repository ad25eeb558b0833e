// sin, cos, tan and their inverses for double and every pack width, from + - * / sqrt and bit operations alone.
//
// Reduction by multiples of pi/2 in three parts [CodyWaite1980]; the polynomial and rational approximations on the
// reduced ranges are those of fdlibm [Fdlibm1993], whose printed coefficients are used; the evaluation here is
// branch-free. Accuracy: see elementary.hpp.
#pragma once

#include "metrics/scalar/double_double.hpp"

namespace xpr {

/// Beyond this |x| sin, cos and tan return NaN: the three-part reduction holds for fewer than 2^21 quarter turns.
inline constexpr double largest_angle = 0x1p21;

namespace trigonometry {

// pi/2 = half_pi_1 + half_pi_2 + half_pi_3 + half_pi_rest, the first three with at most 32 significant bits each, so
// that their products with a count of quarter turns below 2^21 are exact.
inline constexpr double half_pi_1 = 1.57079632673412561417e+00;
inline constexpr double half_pi_2 = 6.07710050630396597660e-11;
inline constexpr double half_pi_3 = 2.02226624871116645580e-21;
inline constexpr double half_pi_rest = 8.47842766036889956997e-32;
inline constexpr double two_over_pi = 6.36619772367581382433e-01;

// pi and pi/2 as double plus remainder.
inline constexpr double pi_high = 3.14159265358979311600e+00;
inline constexpr double pi_low = 1.22464679914735317636e-16;
inline constexpr double half_pi_high = 1.57079632679489655800e+00;
inline constexpr double half_pi_low = 6.12323399573676603587e-17;

/// x = quarter_turns pi/2 + (r + r_low), |r| <= pi/4; the count is kept shifted, for its bits.
template <class T>
struct ReducedAngle {
  T r;
  T r_low;
  T shifted_quarter_turns;
};

template <MachineScalar T>
[[nodiscard]] constexpr ReducedAngle<T> reduce(const T& x) {
  const T shifted = x * two_over_pi + bits::rounding_shift;
  const T n = shifted - bits::rounding_shift;
  const T first = x - n * half_pi_1;  // exact: the two nearly cancel
  const auto second = double_double::sum(first, -(n * half_pi_2));
  const auto third = double_double::sum(second.high, -(n * half_pi_3));
  const T rest = (second.low + third.low) - n * half_pi_rest;
  const T r = third.high + rest;
  return {r, (third.high - r) + rest, shifted};
}

/// sin(r + r_low) for |r| <= pi/4.
template <MachineScalar T>
[[nodiscard]] constexpr T sin_kernel(const T& r, const T& r_low) {
  const T z = r * r;
  const T r_cubed = z * r;
  const T tail =
      8.33333333332248946124e-03 +
      z * (-1.98412698298579493134e-04 +
           z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)));
  return r - ((z * (0.5 * r_low - r_cubed * tail) - r_low) - r_cubed * -1.66666666666666324348e-01);
}

/// cos(r + r_low) for |r| <= pi/4.
template <MachineScalar T>
[[nodiscard]] constexpr T cos_kernel(const T& r, const T& r_low) {
  const T z = r * r;
  const T tail = z * (4.16666666666666019037e-02 +
                      z * (-1.38888888888741095749e-03 +
                           z * (2.48015872894767294178e-05 +
                                z * (-2.75573143513906633035e-07 +
                                     z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));
  const T half_z = 0.5 * z;
  const T head = 1.0 - half_z;
  return head + (((1.0 - head) - half_z) + (z * tail - r * r_low));
}

/// atan(numerator / denominator), both >= 0, not both zero, the denominator finite, without the quotient's rounding
/// error; pi minus it where `supplement` holds.
template <MachineScalar T>
[[nodiscard]] constexpr T atan_of_ratio(const T& numerator, const T& denominator, const MaskOf<T>& supplement) {
  // A common scale keeps sums and error terms below clear of overflow and underflow.
  const T larger = max(numerator, denominator);
  const T scale = select(larger > T(0x1p900), T(0x1p-200), select(larger < T(0x1p-700), T(0x1p300), T(1.0)));
  const T a = numerator * scale, b = denominator * scale;

  // tan(u - v) = (tan u - tan v) / (1 + tan u tan v) with tan v = 1/2, 1, 3/2, infinity, chosen nearest to a/b.
  const auto above_1 = a >= (7.0 / 16.0) * b, above_2 = a >= (11.0 / 16.0) * b;
  const auto above_3 = a >= (19.0 / 16.0) * b, above_4 = a >= (39.0 / 16.0) * b;
  const auto pick = [&](const T& v0, const T& v1, const T& v2, const T& v3, const T& v4) {
    return select(above_4, v4, select(above_3, v3, select(above_2, v2, select(above_1, v1, v0))));
  };
  const T over = pick(a, 2.0 * a - b, a - b, (a - b) - 0.5 * b, -b);
  const T under = pick(b, 2.0 * b + a, a + b, b + 1.5 * a, a);
  const T slope = over / under;
  const T base = pick(T(0.0), T(4.63647609000806093515e-01), T(7.85398163397448278999e-01),
                      T(9.82793723247329054082e-01), T(half_pi_high));
  // For a small ratio nothing large is added to the slope, so its own rounding error would show: restore it from the
  // residual.
  const auto back = double_double::product(slope, b);
  const T residual = ((a - back.high) - back.low) / b;
  const T base_low = pick(residual, T(2.26987774529616870924e-17), T(3.06161699786838301793e-17),
                          T(1.39033110312309984516e-17), T(half_pi_low));

  // pi - (base + atan slope) = (pi - base) + atan(-slope): one rounding, like the other case.
  const auto rest = double_double::ordered_sum(T(pi_high), -base);
  const T origin = select(supplement, rest.high, base);
  const T origin_low = select(supplement, rest.low + (pi_low - base_low), base_low);
  const T t = select(supplement, -slope, slope);

  const T z = t * t;
  const T w = z * z;
  const T even = z * (3.33333333333329318027e-01 +
                      w * (1.42857142725034663711e-01 +
                           w * (9.09088713343650656196e-02 +
                                w * (6.66107313738753120669e-02 +
                                     w * (4.97687799461593236017e-02 + w * 1.62858201153657823623e-02)))));
  const T odd =
      w *
      (-1.99999999998764832476e-01 +
       w * (-1.11111104054623557880e-01 +
            w * (-7.69187620504482999495e-02 + w * (-5.83357013379057348645e-02 + w * -3.65315727442169155270e-02))));
  return origin - ((t * (even + odd) - origin_low) - t);
}

/// (asin(x) - x) / x as a function of x^2, for |x| <= 1/2.
template <MachineScalar T>
[[nodiscard]] constexpr T asin_tail(const T& z) {
  const T p = z * (1.66666666666666657415e-01 +
                   z * (-3.25565818622400915405e-01 +
                        z * (2.01212532134862925881e-01 +
                             z * (-4.00555345006794114027e-02 +
                                  z * (7.91534994289814532176e-04 + z * 3.47933107596021167570e-05)))));
  const T q =
      1.0 + z * (-2.40339491173441421878e+00 +
                 z * (2.02094576023350569471e+00 + z * (-6.88283971605453293030e-01 + z * 7.70381505559019352791e-02)));
  return p / q;
}

/// sqrt(z) as s + s_low, s holding its upper half only.
template <MachineScalar T>
[[nodiscard]] constexpr double_double::Pair<T> split_sqrt(const T& z) {
  const T s = sqrt(z);
  const T s_high = bits::upper_half(s);
  return {s_high, select(s > T(0.0), (z - s_high * s_high) / (s + s_high), T(0.0))};
}

}  // namespace trigonometry

/// sin x and cos x. NaN for |x| > largest_angle, infinities and NaN.
template <MachineScalar T>
[[nodiscard]] constexpr SinCos<T> sincos(const T& x) {
  const auto angle = trigonometry::reduce(x);
  const T s = trigonometry::sin_kernel(angle.r, angle.r_low);
  const T c = trigonometry::cos_kernel(angle.r, angle.r_low);
  const auto odd = bits::shifted_integer_bit(angle.shifted_quarter_turns, 0);
  const auto sin_negative = bits::shifted_integer_bit(angle.shifted_quarter_turns, 1);
  const auto cos_negative = bits::shifted_integer_bit(angle.shifted_quarter_turns + 1.0, 1);
  const T sin_magnitude = select(odd, c, s);
  const T cos_magnitude = select(odd, s, c);
  const T sine = select(sin_negative, -sin_magnitude, sin_magnitude);
  const T cosine = select(cos_negative, -cos_magnitude, cos_magnitude);
  const auto in_domain = abs(x) <= T(largest_angle);
  // The reduction loses the sign of zero.
  return {select(in_domain, select(x == T(0.0), x, sine), T(bits::nan)), select(in_domain, cosine, T(bits::nan))};
}

/// sin x; see sincos.
template <MachineScalar T>
[[nodiscard]] constexpr T sin(const T& x) {
  return sincos(x).sin;
}

/// cos x; see sincos.
template <MachineScalar T>
[[nodiscard]] constexpr T cos(const T& x) {
  return sincos(x).cos;
}

/// tan x as sin x / cos x; see sincos.
template <MachineScalar T>
[[nodiscard]] constexpr T tan(const T& x) {
  const SinCos<T> both = sincos(x);
  return both.sin / both.cos;
}

/// The angle in [-pi/2, pi/2] whose tangent is x.
template <MachineScalar T>
[[nodiscard]] constexpr T atan(const T& x) {
  const T magnitude = trigonometry::atan_of_ratio(abs(x), T(1.0), MaskOf<T>(false));
  return select(x == x, copysign(magnitude, x), T(bits::nan));
}

/// The angle in [-pi, pi] of the point (x, y), with IEEE 754's values on the axes and for signed zeros and infinities.
template <MachineScalar T>
[[nodiscard]] constexpr T atan2(const T& y, const T& x) {
  const T a = abs(y);
  const T b = abs(x);
  // On the axes and at infinity the ratio is taken from IEEE 754's table: 0/0 is 0, y/inf is 0, inf/inf is 1.
  const T one = T(1.0);
  const auto far = b == T(bits::infinity);
  const T numerator = select(far, select(a == T(bits::infinity), one, T(0.0)), a);
  const T denominator = select((a == T(0.0)) | far, one, b);
  const T angle = trigonometry::atan_of_ratio(numerator, denominator, signbit(x));
  return select((x == x) & (y == y), copysign(angle, y), T(bits::nan));
}

/// The angle in [-pi/2, pi/2] whose sine is x. NaN for |x| > 1.
template <MachineScalar T>
[[nodiscard]] constexpr T asin(const T& x) {
  using namespace trigonometry;
  const T magnitude = abs(x);
  const auto small = magnitude < T(0.5);
  const T z = select(small, x * x, 0.5 * (1.0 - magnitude));
  const T tail = asin_tail(z);
  // asin x = pi/2 - 2 asin sqrt((1 - x)/2), about pi/4 so that the large parts subtract exactly.
  const auto root = split_sqrt(z);
  constexpr double quarter_pi = 0.5 * half_pi_high;
  const T correction = 2.0 * (root.high + root.low) * tail - (half_pi_low - 2.0 * root.low);
  const T large = quarter_pi - (correction - (quarter_pi - 2.0 * root.high));
  const T result = select(small, magnitude + magnitude * tail, large);
  return select(magnitude <= T(1.0), copysign(result, x), T(bits::nan));
}

/// The angle in [0, pi] whose cosine is x. NaN for |x| > 1.
template <MachineScalar T>
[[nodiscard]] constexpr T acos(const T& x) {
  using namespace trigonometry;
  const T magnitude = abs(x);
  const auto small = magnitude < T(0.5);
  const T z = select(small, x * x, 0.5 * (1.0 - magnitude));
  const T tail = asin_tail(z);
  const auto root = split_sqrt(z);
  const T s = root.high + root.low;
  const T middle = half_pi_high - (x - (half_pi_low - x * tail));
  const T near_one = 2.0 * (root.high + (tail * s + root.low));
  const T near_minus_one = pi_high - 2.0 * (s + (tail * s - half_pi_low));
  const T result = select(small, middle, select(signbit(x), near_minus_one, near_one));
  return select(magnitude <= T(1.0), result, T(bits::nan));
}

}  // namespace xpr
