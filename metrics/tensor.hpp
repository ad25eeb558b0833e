// Four-vectors, symmetric second-rank tensors and points of phase space, over any scalar.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "metrics/scalar/scalar.hpp"

namespace xpr {

/// Components of an event x^mu, a vector or a covector, index 0 being time.
template <class T>
using Vec4 = std::array<T, 4>;

/// Row-major 4 x 4 components without symmetry (Jacobians).
template <class T>
using Matrix4 = std::array<std::array<T, 4>, 4>;

/// A symmetric tensor with two indices; stores its ten independent components, (mu, nu) in any order.
template <class T>
struct SymTensor4 {
  std::array<T, 10> c{};

  [[nodiscard]] static constexpr std::size_t slot(std::size_t mu, std::size_t nu) {
    const std::size_t lo = mu < nu ? mu : nu;
    const std::size_t hi = mu < nu ? nu : mu;
    return lo * 4 + hi - lo * (lo + 1) / 2;
  }
  [[nodiscard]] constexpr T& operator()(std::size_t mu, std::size_t nu) { return c[slot(mu, nu)]; }
  [[nodiscard]] constexpr const T& operator()(std::size_t mu, std::size_t nu) const { return c[slot(mu, nu)]; }
};

/// The diagonal tensor diag(d0, d1, d2, d3).
template <class T>
[[nodiscard]] constexpr SymTensor4<T> diagonal(const T& d0, const T& d1, const T& d2, const T& d3) {
  SymTensor4<T> g{};
  g(0, 0) = d0;
  g(1, 1) = d1;
  g(2, 2) = d2;
  g(3, 3) = d3;
  return g;
}

/// g^{mu nu} v_nu: raises (or lowers) an index. Not `apply`, which std:: has for arrays.
template <class T>
[[nodiscard]] constexpr Vec4<T> raise_index(const SymTensor4<T>& g, const Vec4<T>& v) {
  const auto component = [&](std::size_t mu) {
    return g(mu, 0) * v[0] + g(mu, 1) * v[1] + g(mu, 2) * v[2] + g(mu, 3) * v[3];
  };
  return {component(0), component(1), component(2), component(3)};
}

/// The plain contraction a_mu b^mu.
template <class T>
[[nodiscard]] constexpr T contract(const Vec4<T>& a, const Vec4<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

/// The inverse of a symmetric tensor, by 2 x 2 minors: no pivoting, so that it runs unchanged in lanes and on duals.
/// A singular tensor gives non-finite components.
template <class T>
[[nodiscard]] constexpr SymTensor4<T> inverse(const SymTensor4<T>& g) {
  const T s0 = g(0, 0) * g(1, 1) - g(0, 1) * g(0, 1), s1 = g(0, 0) * g(1, 2) - g(0, 1) * g(0, 2);
  const T s2 = g(0, 0) * g(1, 3) - g(0, 1) * g(0, 3), s3 = g(0, 1) * g(1, 2) - g(1, 1) * g(0, 2);
  const T s4 = g(0, 1) * g(1, 3) - g(1, 1) * g(0, 3), s5 = g(0, 2) * g(1, 3) - g(1, 2) * g(0, 3);
  const T c5 = g(2, 2) * g(3, 3) - g(2, 3) * g(2, 3), c4 = g(0, 2) * g(3, 3) - g(0, 3) * g(2, 3);
  const T c3 = g(0, 2) * g(2, 3) - g(0, 3) * g(2, 2), c2 = g(1, 2) * g(3, 3) - g(1, 3) * g(2, 3);
  const T c1 = g(1, 2) * g(2, 3) - g(1, 3) * g(2, 2);
  const T c0 = g(0, 2) * g(1, 3) - g(0, 3) * g(1, 2);
  // Rows (0,1) against rows (2,3): s over columns of the upper rows, c over columns of the lower ones.
  const T determinant = s0 * c5 - s1 * c2 + s2 * c1 + s3 * c4 - s4 * c3 + s5 * c0;
  const T scale = 1.0 / determinant;
  SymTensor4<T> out;
  out(0, 0) = (g(1, 1) * c5 - g(1, 2) * c2 + g(1, 3) * c1) * scale;
  out(0, 1) = (-g(0, 1) * c5 + g(0, 2) * c2 - g(0, 3) * c1) * scale;
  out(0, 2) = (g(1, 3) * s5 - g(2, 3) * s4 + g(3, 3) * s3) * scale;
  out(0, 3) = (-g(1, 2) * s5 + g(2, 2) * s4 - g(2, 3) * s3) * scale;
  out(1, 1) = (g(0, 0) * c5 - g(0, 2) * c4 + g(0, 3) * c3) * scale;
  out(1, 2) = (-g(0, 3) * s5 + g(2, 3) * s2 - g(3, 3) * s1) * scale;
  out(1, 3) = (g(0, 2) * s5 - g(2, 2) * s2 + g(2, 3) * s1) * scale;
  out(2, 2) = (g(0, 3) * s4 - g(1, 3) * s2 + g(3, 3) * s0) * scale;
  out(2, 3) = (-g(0, 2) * s4 + g(1, 2) * s2 - g(2, 3) * s0) * scale;
  out(3, 3) = (g(0, 2) * s3 - g(1, 2) * s1 + g(2, 2) * s0) * scale;
  return out;
}

/// A point of phase space: the event x^mu and the covariant momentum p_mu, stored as eight components x0..x3, p0..p3.
template <class T>
struct PhaseState {
  static constexpr std::size_t size = 8;
  std::array<T, 8> c{};

  constexpr PhaseState() = default;
  constexpr PhaseState(const Vec4<T>& x, const Vec4<T>& p) : c{x[0], x[1], x[2], x[3], p[0], p[1], p[2], p[3]} {}
  /// Component i is f(i), i a constant, laid out flat: a loop over components keeps packs in memory, and components
  /// zeroed before they are set cost as much as the rest of a stage.
  template <class F>
  [[nodiscard, gnu::always_inline]] static constexpr PhaseState of(const F& f) {
    return PhaseState(f, std::make_index_sequence<size>{});
  }

  [[nodiscard]] constexpr Vec4<T> x() const { return {c[0], c[1], c[2], c[3]}; }
  [[nodiscard]] constexpr Vec4<T> p() const { return {c[4], c[5], c[6], c[7]}; }
  [[nodiscard]] constexpr T& operator[](std::size_t i) { return c[i]; }
  [[nodiscard]] constexpr const T& operator[](std::size_t i) const { return c[i]; }

 private:
  template <class F, std::size_t... I>
  [[gnu::always_inline]] constexpr PhaseState(const F& f, std::index_sequence<I...>)
      : c{f(std::integral_constant<std::size_t, I>{})...} {}
};

}  // namespace xpr
