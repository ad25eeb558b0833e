// What the elementary functions need of the layout of a double (IEEE 754 binary64), for double and every pack width:
// sign, exponent and rounding to an integer, without branches.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>

#include "metrics/scalar/pack.hpp"

namespace xpr {

/// The correctly rounded square root; NaN below zero.
template <class T>
requires std::is_arithmetic_v<T>
[[nodiscard]] constexpr double sqrt(T x) { return __builtin_sqrt(static_cast<double>(x)); }

namespace bits {

/// Every NaN that our functions return is this one, so that a result's bits do not depend on which operand was NaN.
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr std::uint64_t sign_bit = std::uint64_t{1} << 63;
inline constexpr std::uint64_t fraction = (std::uint64_t{1} << 52) - 1;

/// Adding it to |n| < 2^51 leaves the nearest integer in the low bits of the sum, in two's complement.
inline constexpr double rounding_shift = 0x1.8p52;

/// f, a function of 64-bit patterns, applied to the patterns of x and the rest; the result is read as doubles.
template <MachineScalar T, class F, class... Ts>
[[gnu::always_inline]] constexpr T transform(const F& f, const T& x, const Ts&... rest) {
  const auto on_register = [&f]<class R>(const R& r, const auto&... s) {
    return std::bit_cast<R>(f(std::bit_cast<registers::Bits<R>>(r), std::bit_cast<registers::Bits<R>>(s)...));
  };
  if constexpr (is_pack<T>) {
    return T::wrap(registers::map(on_register, x.reg, rest.reg...));
  } else {
    return on_register(x, rest...);
  }
}

/// The mask of a predicate of 64-bit patterns.
template <MachineScalar T, class F>
[[gnu::always_inline]] constexpr MaskOf<T> test(const F& f, const T& x) {
  const auto on_register = [&f]<class R>(const R& r) {
    return static_cast<typename registers::ComparisonOf<R>::type>(f(std::bit_cast<registers::Bits<R>>(r)));
  };
  if constexpr (is_pack<T>) {
    return MaskOf<T>::wrap(registers::map(on_register, x.reg));
  } else {
    return on_register(x);
  }
}

/// Whether bit `which` of the integer n is set, given n + rounding_shift.
template <MachineScalar T>
[[nodiscard]] constexpr MaskOf<T> shifted_integer_bit(const T& shifted, unsigned which) {
  return test([which](const auto& b) { return ((b >> which) & std::uint64_t{1}) != 0; }, shifted);
}

/// 2^n for an integer-valued n in [-1022, 1023].
template <MachineScalar T>
[[nodiscard]] constexpr T power_of_two(const T& n) {
  // The low 12 bits of the shifted sum hold the biased exponent; the shift drops all others.
  return transform([](const auto& b) { return b << 52U; }, n + (rounding_shift + 1023.0));
}

/// floor(log2 x) for positive normal x.
template <MachineScalar T>
[[nodiscard]] constexpr T exponent(const T& x) {
  return transform([](const auto& b) { return (b >> 52U) | std::bit_cast<std::uint64_t>(0x1p52); }, x) -
         (0x1p52 + 1023.0);
}

/// x scaled by a power of two into [1, 2), for positive normal x.
template <MachineScalar T>
[[nodiscard]] constexpr T significand(const T& x) {
  return transform([](const auto& b) { return (b & fraction) | std::bit_cast<std::uint64_t>(1.0); }, x);
}

/// x with the low 32 bits of its fraction cleared, so that its square is exact.
template <MachineScalar T>
[[nodiscard]] constexpr T upper_half(const T& x) {
  return transform([](const auto& b) { return b & ~std::uint64_t{0xFFFFFFFF}; }, x);
}

}  // namespace bits

/// |x|, which clears the sign of zero and NaN too.
template <MachineScalar T>
[[nodiscard]] constexpr T abs(const T& x) {
  return bits::transform([](const auto& b) { return b & ~bits::sign_bit; }, x);
}

/// The magnitude of x with the sign of s, of zeros too.
template <MachineScalar T>
[[nodiscard]] constexpr T copysign(const T& x, const T& s) {
  return bits::transform([](const auto& b, const auto& c) { return (b & ~bits::sign_bit) | (c & bits::sign_bit); }, x,
                         s);
}

/// Whether the sign bit is set: true for -0.
template <MachineScalar T>
[[nodiscard]] constexpr MaskOf<T> signbit(const T& x) {
  return bits::test([](const auto& b) { return (b & bits::sign_bit) != 0; }, x);
}

/// Whether x is neither infinite nor NaN.
template <MachineScalar T>
[[nodiscard]] constexpr MaskOf<T> isfinite(const T& x) {
  return abs(x) < T(bits::infinity);
}

/// The nearest integer, ties to even; keeps the sign of zero.
template <MachineScalar T>
[[nodiscard]] constexpr T rint(const T& x) {
  constexpr double two_52 = 0x1p52;  // doubles from here on are integers
  const T magnitude = abs(x);
  const T rounded = (magnitude + two_52) - two_52;
  return copysign(select(magnitude < T(two_52), rounded, x), x);
}

/// The largest integer not above x; keeps the sign of zero.
template <MachineScalar T>
[[nodiscard]] constexpr T floor(const T& x) {
  const T nearest = rint(x);
  return copysign(select(x < nearest, nearest - 1.0, nearest), x);
}

}  // namespace xpr
