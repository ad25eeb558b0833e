// The scalar types that physics is written over: double, Pack (SIMD lanes), Dual (derivatives) and 50-digit numbers.
//
// A physical function is a template over its scalar T and uses only arithmetic and the functions named here, found by
// unqualified look-up. Comparison of two scalars gives a mask; `select(mask, a, b)` takes the place of `if` where the
// choice differs from lane to lane.
#pragma once

#include <array>
#include <concepts>
#include <type_traits>

namespace xpr {

/// What a physical function may assume of its scalar: field arithmetic with itself and with plain numbers, and sqrt.
template <class T>
concept Scalar = requires(T a, T b) {
  { a + b } -> std::convertible_to<T>;
  { a - b } -> std::convertible_to<T>;
  { a* b } -> std::convertible_to<T>;
  { a / b } -> std::convertible_to<T>;
  { -a } -> std::convertible_to<T>;
  { 2.0 * a } -> std::convertible_to<T>;
  { a + 1.0 } -> std::convertible_to<T>;
};

/// x², spelled out so that formulas read as on paper and no pow is called.
template <class T>
[[nodiscard]] constexpr T square(const T& x) {
  return x * x;
}

}  // namespace xpr
