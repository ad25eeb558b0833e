// The scalar types that physics is written over: double, Pack (SIMD lanes), Dual (derivatives) and 50-digit numbers.
//
// A physical function is a template over its scalar T in namespace xpr. It uses arithmetic and the functions of
// elementary.hpp (sin, sqrt, select, ...) by unqualified calls. Comparison of two scalars gives a mask (bool for
// double); `select(mask, a, b)` takes the place of `if` where the choice differs from lane to lane.
#pragma once

#include <concepts>
#include <cstddef>
#include <type_traits>

namespace xpr {

/// What a physical function may assume of its scalar: field arithmetic with itself and with plain numbers, and order.
template <class T>
concept Scalar = !std::integral<T> && requires(T a, T b) {
  { a + b } -> std::convertible_to<T>;
  { a - b } -> std::convertible_to<T>;
  { a* b } -> std::convertible_to<T>;
  { a / b } -> std::convertible_to<T>;
  { -a } -> std::convertible_to<T>;
  { 2.0 * a } -> std::convertible_to<T>;
  { a + 1.0 } -> std::convertible_to<T>;
  a < b;
};

/// How many independent numbers a T holds side by side: W for Pack<W>, and for duals of it; else 1.
template <class T>
inline constexpr int lanes = 1;

/// What comparing two T gives: bool, or Mask<W> for packs and duals of packs.
template <class T>
using MaskOf = std::remove_cvref_t<decltype(std::declval<const T&>() < std::declval<const T&>())>;

/// The scalar that can hold an A or a B: the class type where one is a plain number, else the one that the other
/// converts to.
template <class A, class B>
using Promoted =
    std::conditional_t<std::is_same_v<A, B>, A,
                       std::conditional_t<std::is_arithmetic_v<A> && std::is_arithmetic_v<B>, double,
                                          std::conditional_t<std::is_arithmetic_v<A> || (!std::is_arithmetic_v<B> &&
                                                                                         std::is_convertible_v<A, B>),
                                                             B, A>>>;

/// mask ? a : b. For packs it chooses lane by lane; both sides are always evaluated.
template <class A, class B>
[[nodiscard]] constexpr Promoted<A, B> select(bool mask, const A& a, const B& b) {
  using R = Promoted<A, B>;
  return mask ? R(a) : R(b);
}

/// Whether the mask holds in at least one lane.
[[nodiscard]] constexpr bool any(bool mask) { return mask; }
/// Whether the mask holds in every lane.
[[nodiscard]] constexpr bool all(bool mask) { return mask; }

/// Lane i of a scalar or of a mask: what a function of one ray sees of a pack of rays.
template <class T>
requires std::is_arithmetic_v<T>
[[nodiscard]] constexpr T lane(const T& x, int /*i*/) { return x; }

/// Puts `value` into lane i.
constexpr void set_lane(double& x, int /*i*/, double value) { x = value; }

/// x without its derivatives: strips every layer of Dual.
template <class T>
[[nodiscard]] constexpr T value_of(const T& x) {
  return x;
}

/// x², spelled out so that formulas read as on paper and no pow is called.
template <class T>
[[nodiscard]] constexpr T square(const T& x) {
  return x * x;
}

/// x^n for a whole number n, by repeated squaring; 1/x^|n| for negative n.
template <class T>
[[nodiscard]] constexpr T whole_power(T x, int n) {
  T power = T(1.0);
  for (unsigned left = n < 0 ? 0U - static_cast<unsigned>(n) : static_cast<unsigned>(n); left != 0; left >>= 1U) {
    if ((left & 1U) != 0) power = power * x;
    if (left > 1U) x = x * x;
  }
  return n < 0 ? T(1.0 / power) : power;
}

/// The smaller of the two; `a` where they are equal or where one is NaN.
template <class A, class B>
[[nodiscard]] constexpr auto min(const A& a, const B& b) {
  return select(b < a, b, a);
}

/// The larger of the two; `a` where they are equal or where one is NaN.
template <class A, class B>
[[nodiscard]] constexpr auto max(const A& a, const B& b) {
  return select(a < b, b, a);
}

/// sin x and cos x, which share their argument reduction.
template <class T>
struct SinCos {
  T sin;
  T cos;
};

/// Both at once, for scalars that bring their own sin and cos.
template <class T>
[[nodiscard]] constexpr SinCos<T> sincos(const T& x) {
  return {sin(x), cos(x)};
}

/// Mathematical constants to the precision of T. Specialised where T holds more digits than a double.
template <class T>
struct Constants {
  [[nodiscard]] static constexpr T pi() { return T(3.14159265358979323846); }
};

/// The ratio of a circle's circumference to its diameter, rounded to the precision of T.
template <class T = double>
[[nodiscard]] constexpr T pi() {
  return Constants<T>::pi();
}

}  // namespace xpr
