// Dual<T, N>: a value with its derivatives in N directions, carried by the chain rule: exact to round-off, no step
// size.
//
// T is double, a Pack, a 50-digit number or another Dual (second derivatives). The value is bit for bit what T gives
// alone; derivatives of Dual<Pack<W>, N> are bit for bit those of Dual<double, N> in every lane. Comparisons go by
// value.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "metrics/scalar/elementary.hpp"

namespace xpr {

template <class T, int N>
struct Dual;

/// A number without derivatives in the directions of Dual<T, N>: a T, or what converts to one (int, double, ...).
template <class S, class T, int N>
concept ConstantOf = !std::same_as<S, Dual<T, N>> && std::convertible_to<S, T>;

namespace dual {

/// The array {f(0), ..., f(N-1)}, unrolled so that it stays in registers.
template <class T, int N, class F>
[[gnu::always_inline]] constexpr std::array<T, static_cast<std::size_t>(N)> generate(const F& f) {
  return [&f]<std::size_t... I>(std::index_sequence<I...>) {
    return std::array<T, static_cast<std::size_t>(N)>{f(I)...};
  }
  (std::make_index_sequence<static_cast<std::size_t>(N)>{});
}

}  // namespace dual

template <class T, int N>
struct Dual {
  static_assert(N > 0);
  using Derivative = std::array<T, static_cast<std::size_t>(N)>;

  T value{};
  Derivative derivative{};

  constexpr Dual() = default;
  /// A constant: all derivatives zero. Implicit, so that formulas may write plain numbers.
  template <ConstantOf<T, N> S>
  [[gnu::always_inline]] constexpr Dual(const S& constant) : value(constant) {}
  [[gnu::always_inline]] constexpr Dual(const T& v, const Derivative& d) : value(v), derivative(d) {}

  [[nodiscard, gnu::always_inline]] friend constexpr Dual operator+(const Dual& a) { return a; }
  [[nodiscard, gnu::always_inline]] friend constexpr Dual operator-(const Dual& a) {
    return {-a.value, dual::generate<T, N>([&](std::size_t i) { return T(-a.derivative[i]); })};
  }

  [[nodiscard, gnu::always_inline]] friend constexpr Dual operator+(const Dual& a, const Dual& b) {
    return {a.value + b.value, dual::generate<T, N>([&](std::size_t i) { return a.derivative[i] + b.derivative[i]; })};
  }
  [[nodiscard, gnu::always_inline]] friend constexpr Dual operator-(const Dual& a, const Dual& b) {
    return {a.value - b.value, dual::generate<T, N>([&](std::size_t i) { return a.derivative[i] - b.derivative[i]; })};
  }
  [[nodiscard, gnu::always_inline]] friend constexpr Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value,
            dual::generate<T, N>([&](std::size_t i) { return a.derivative[i] * b.value + a.value * b.derivative[i]; })};
  }
  [[nodiscard, gnu::always_inline]] friend constexpr Dual operator/(const Dual& a, const Dual& b) {
    const T quotient = a.value / b.value;
    const T inverse = 1.0 / b.value;
    return {quotient, dual::generate<T, N>(
                          [&](std::size_t i) { return (a.derivative[i] - quotient * b.derivative[i]) * inverse; })};
  }

  // With a constant on one side: no products with derivatives that are zero.
  template <ConstantOf<T, N> S>
  [[nodiscard, gnu::always_inline]] friend constexpr Dual operator+(const Dual& a, const S& b) {
    return {a.value + b, a.derivative};
  }
  template <ConstantOf<T, N> S>
  [[nodiscard, gnu::always_inline]] friend constexpr Dual operator+(const S& a, const Dual& b) {
    return {a + b.value, b.derivative};
  }
  template <ConstantOf<T, N> S>
  [[nodiscard, gnu::always_inline]] friend constexpr Dual operator-(const Dual& a, const S& b) {
    return {a.value - b, a.derivative};
  }
  template <ConstantOf<T, N> S>
  [[nodiscard, gnu::always_inline]] friend constexpr Dual operator-(const S& a, const Dual& b) {
    return {a - b.value, dual::generate<T, N>([&](std::size_t i) { return T(-b.derivative[i]); })};
  }
  template <ConstantOf<T, N> S>
  [[nodiscard, gnu::always_inline]] friend constexpr Dual operator*(const Dual& a, const S& b) {
    return {a.value * b, dual::generate<T, N>([&](std::size_t i) { return a.derivative[i] * b; })};
  }
  template <ConstantOf<T, N> S>
  [[nodiscard, gnu::always_inline]] friend constexpr Dual operator*(const S& a, const Dual& b) {
    return {a * b.value, dual::generate<T, N>([&](std::size_t i) { return a * b.derivative[i]; })};
  }
  template <ConstantOf<T, N> S>
  [[nodiscard, gnu::always_inline]] friend constexpr Dual operator/(const Dual& a, const S& b) {
    return {a.value / b, dual::generate<T, N>([&](std::size_t i) { return a.derivative[i] / b; })};
  }
  template <ConstantOf<T, N> S>
  [[nodiscard, gnu::always_inline]] friend constexpr Dual operator/(const S& a, const Dual& b) {
    const T quotient = a / b.value;
    const T slope = -quotient / b.value;
    return {quotient, dual::generate<T, N>([&](std::size_t i) { return slope * b.derivative[i]; })};
  }

  template <class S>
  [[gnu::always_inline]] friend constexpr Dual& operator+=(Dual& a, const S& b) {
    return a = a + b;
  }
  template <class S>
  [[gnu::always_inline]] friend constexpr Dual& operator-=(Dual& a, const S& b) {
    return a = a - b;
  }
  template <class S>
  [[gnu::always_inline]] friend constexpr Dual& operator*=(Dual& a, const S& b) {
    return a = a * b;
  }
  template <class S>
  [[gnu::always_inline]] friend constexpr Dual& operator/=(Dual& a, const S& b) {
    return a = a / b;
  }

  [[nodiscard]] friend constexpr auto operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  [[nodiscard]] friend constexpr auto operator>(const Dual& a, const Dual& b) { return b.value < a.value; }
  [[nodiscard]] friend constexpr auto operator<=(const Dual& a, const Dual& b) { return a.value <= b.value; }
  [[nodiscard]] friend constexpr auto operator>=(const Dual& a, const Dual& b) { return b.value <= a.value; }
  [[nodiscard]] friend constexpr auto operator==(const Dual& a, const Dual& b) { return a.value == b.value; }
  [[nodiscard]] friend constexpr auto operator!=(const Dual& a, const Dual& b) { return a.value != b.value; }
};

template <class T, int N>
inline constexpr int lanes<Dual<T, N>> = lanes<T>;

template <class T, int N>
struct Constants<Dual<T, N>> {
  [[nodiscard]] static constexpr Dual<T, N> pi() { return Constants<T>::pi(); }
};

/// The independent variable number `index`: derivative 1 in its own direction, 0 in the others.
template <int N, class T>
[[nodiscard]] constexpr Dual<T, N> variable(const T& value, int index) {
  Dual<T, N> x(value);
  x.derivative[static_cast<std::size_t>(index)] = T(1.0);
  return x;
}

/// N independent variables at once: the point at which a function of N coordinates is to be differentiated.
template <class T, std::size_t N>
[[nodiscard]] constexpr std::array<Dual<T, static_cast<int>(N)>, N> variables(const std::array<T, N>& point) {
  return dual::generate<Dual<T, static_cast<int>(N)>, static_cast<int>(N)>(
      [&](std::size_t i) { return variable<static_cast<int>(N)>(point[i], static_cast<int>(i)); });
}

/// x without its derivatives: strips every layer of Dual.
template <class T, int N>
[[nodiscard]] constexpr auto value_of(const Dual<T, N>& x) {
  return value_of(x.value);
}

/// Lane i of the value and of every derivative.
template <class T, int N>
[[nodiscard]] constexpr auto lane(const Dual<T, N>& x, int i) {
  using L = decltype(lane(x.value, i));
  return Dual<L, N>(lane(x.value, i), dual::generate<L, N>([&](std::size_t k) { return lane(x.derivative[k], i); }));
}

/// a where the mask holds, else b, in value and derivatives; one of the two may be a constant.
template <class M, class T, int N>
requires std::is_class_v<M>
[[nodiscard]] constexpr Dual<T, N> select(const M& mask, const Dual<T, N>& a, const Dual<T, N>& b) {
  return {select(mask, a.value, b.value),
          dual::generate<T, N>([&](std::size_t i) { return select(mask, a.derivative[i], b.derivative[i]); })};
}
template <class M, class T, int N, ConstantOf<T, N> S>
requires std::is_class_v<M>
[[nodiscard]] constexpr Dual<T, N> select(const M& mask, const Dual<T, N>& a, const S& b) {
  return select(mask, a, Dual<T, N>(b));
}
template <class M, class T, int N, ConstantOf<T, N> S>
requires std::is_class_v<M>
[[nodiscard]] constexpr Dual<T, N> select(const M& mask, const S& a, const Dual<T, N>& b) {
  return select(mask, Dual<T, N>(a), b);
}

namespace dual {

/// f(x) given f and df/dx at the value of x.
template <class T, int N>
[[nodiscard, gnu::always_inline]] constexpr Dual<T, N> chain(const Dual<T, N>& x, const T& f, const T& slope) {
  return {f, generate<T, N>([&](std::size_t i) { return slope * x.derivative[i]; })};
}

/// f(x, y) given f and its partial derivatives.
template <class T, int N>
[[nodiscard, gnu::always_inline]] constexpr Dual<T, N> chain(const Dual<T, N>& x, const Dual<T, N>& y, const T& f,
                                                             const T& slope_x, const T& slope_y) {
  return {f, generate<T, N>([&](std::size_t i) { return slope_x * x.derivative[i] + slope_y * y.derivative[i]; })};
}

}  // namespace dual

/// At 0 the value is 0 and every derivative is not finite (infinite, or NaN where x itself does not vary): the slope
/// there is infinite, and no finite number is made up for it.
template <class T, int N>
[[nodiscard, gnu::always_inline]] constexpr Dual<T, N> sqrt(const Dual<T, N>& x) {
  const T root = sqrt(x.value);
  return dual::chain(x, root, T(0.5 / root));
}

template <class T, int N>
[[nodiscard]] constexpr SinCos<Dual<T, N>> sincos(const Dual<T, N>& x) {
  const SinCos<T> v = sincos(x.value);
  return {dual::chain(x, v.sin, v.cos), dual::chain(x, v.cos, T(-v.sin))};
}

template <class T, int N>
[[nodiscard]] constexpr Dual<T, N> sin(const Dual<T, N>& x) {
  const SinCos<T> v = sincos(x.value);
  return dual::chain(x, v.sin, v.cos);
}

template <class T, int N>
[[nodiscard]] constexpr Dual<T, N> cos(const Dual<T, N>& x) {
  const SinCos<T> v = sincos(x.value);
  return dual::chain(x, v.cos, T(-v.sin));
}

template <class T, int N>
[[nodiscard]] constexpr Dual<T, N> tan(const Dual<T, N>& x) {
  const T t = tan(x.value);
  return dual::chain(x, t, T(1.0 + t * t));
}

template <class T, int N>
[[nodiscard]] constexpr Dual<T, N> atan(const Dual<T, N>& x) {
  return dual::chain(x, atan(x.value), T(1.0 / (1.0 + x.value * x.value)));
}

/// Not differentiable at the origin: NaN derivatives there. Across the cut (y = 0, x < 0) derivatives are continuous.
template <class T, int N>
[[nodiscard]] constexpr Dual<T, N> atan2(const Dual<T, N>& y, const Dual<T, N>& x) {
  const T inverse = 1.0 / (x.value * x.value + y.value * y.value);
  return dual::chain(y, x, atan2(y.value, x.value), T(x.value * inverse), T(-(y.value * inverse)));
}
template <class T, int N, ConstantOf<T, N> S>
[[nodiscard]] constexpr Dual<T, N> atan2(const Dual<T, N>& y, const S& x) {
  return atan2(y, Dual<T, N>(x));
}
template <class T, int N, ConstantOf<T, N> S>
[[nodiscard]] constexpr Dual<T, N> atan2(const S& y, const Dual<T, N>& x) {
  return atan2(Dual<T, N>(y), x);
}

/// Infinite derivatives at |x| = 1.
template <class T, int N>
[[nodiscard]] constexpr Dual<T, N> asin(const Dual<T, N>& x) {
  return dual::chain(x, asin(x.value), T(1.0 / sqrt((1.0 - x.value) * (1.0 + x.value))));
}

/// Infinite derivatives at |x| = 1.
template <class T, int N>
[[nodiscard]] constexpr Dual<T, N> acos(const Dual<T, N>& x) {
  return dual::chain(x, acos(x.value), T(-1.0 / sqrt((1.0 - x.value) * (1.0 + x.value))));
}

template <class T, int N>
[[nodiscard]] constexpr Dual<T, N> exp(const Dual<T, N>& x) {
  const T e = exp(x.value);
  return dual::chain(x, e, e);
}

template <class T, int N>
[[nodiscard]] constexpr Dual<T, N> log(const Dual<T, N>& x) {
  return dual::chain(x, log(x.value), T(1.0 / x.value));
}

/// A constant power of a variable.
template <class T, int N, ConstantOf<T, N> S>
requires(!std::same_as<S, int>) [[nodiscard]] constexpr Dual<T, N> pow(const Dual<T, N>& x, const S& y) {
  const T exponent = T(y);
  return dual::chain(x, pow(x.value, exponent), T(exponent * pow(x.value, T(exponent - 1.0))));
}

/// A whole power: any x, negative ones too.
template <class T, int N, std::same_as<int> I>
[[nodiscard]] constexpr Dual<T, N> pow(const Dual<T, N>& x, I n) {
  return whole_power(x, n);
}

/// Needs x > 0: the derivative with respect to the exponent holds log x.
template <class T, int N>
[[nodiscard]] constexpr Dual<T, N> pow(const Dual<T, N>& x, const Dual<T, N>& y) {
  const T power = pow(x.value, y.value);
  return dual::chain(x, y, power, T(y.value * pow(x.value, T(y.value - 1.0))), T(power * log(x.value)));
}

template <class T, int N>
[[nodiscard]] constexpr Dual<T, N> sinh(const Dual<T, N>& x) {
  return dual::chain(x, sinh(x.value), cosh(x.value));
}

template <class T, int N>
[[nodiscard]] constexpr Dual<T, N> cosh(const Dual<T, N>& x) {
  return dual::chain(x, cosh(x.value), sinh(x.value));
}

template <class T, int N>
[[nodiscard]] constexpr Dual<T, N> tanh(const Dual<T, N>& x) {
  const T t = tanh(x.value);
  const T c = cosh(x.value);
  return dual::chain(x, t, T(1.0 / (c * c)));
}

/// At 0 the slope is taken as +1.
template <class T, int N>
[[nodiscard]] constexpr Dual<T, N> abs(const Dual<T, N>& x) {
  return dual::chain(x, abs(x.value), select(x.value < T(0.0), T(-1.0), T(1.0)));
}

/// The magnitude of x with the sign of s: |x| times a constant sign.
template <class T, int N, class S>
[[nodiscard]] constexpr Dual<T, N> copysign(const Dual<T, N>& x, const S& s) {
  const T sign = copysign(T(1.0), T(value_of(s)));
  const Dual<T, N> magnitude = abs(x);
  return dual::chain(magnitude, copysign(x.value, sign), sign);
}

/// A constant between integers: derivatives are zero.
template <class T, int N>
[[nodiscard]] constexpr Dual<T, N> floor(const Dual<T, N>& x) {
  return floor(x.value);
}

/// A constant between half-integers: derivatives are zero.
template <class T, int N>
[[nodiscard]] constexpr Dual<T, N> rint(const Dual<T, N>& x) {
  return rint(x.value);
}

template <class T, int N>
[[nodiscard]] constexpr auto signbit(const Dual<T, N>& x) {
  return signbit(x.value);
}

/// Whether the value and every derivative are finite.
template <class T, int N>
[[nodiscard]] constexpr auto isfinite(const Dual<T, N>& x) {
  auto finite = isfinite(x.value);
  for (const T& d : x.derivative) finite = finite & isfinite(d);
  return finite;
}

}  // namespace xpr
