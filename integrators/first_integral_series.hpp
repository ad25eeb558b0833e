// The Taylor series of one step of separated light: recurrences that follow from the equations of
// metrics/separable.hpp, all of them products of series, and the evaluation of the polynomials that come out.
//
// Coefficients are k-th derivatives in Mino time over k!. With S = u^2, Q = c2 + 3/2 c3 u + 2 c4 S and
// W = eta + lambda^2 + 2 a^2 n_z^2 the equations are u'' = Q u and n'' = a^2 n_z e_z - W n; the azimuth's rate F solves
// (P + s u') F = kappa S, where s is the branch. Templates over the scalar: one ray a lane. The newest coefficient
// comes last in every sum, so that sums of neighbouring orders overlap in the processor. Cites: [JorbaZou2005]
#pragma once

#include <array>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

#include "metrics/scalar/elementary.hpp"

namespace xpr::first_integrals {

/// A ray's constants as the recurrences want them.
template <class T>
struct Constants {
  T c2, three_halves_c3, twice_c4, p2, kappa;
  T polar_constant;  ///< eta + lambda^2
  T spin_squared;    ///< a^2
  T time_constant;   ///< a (lambda - a)
  T size_squared;    ///< of the ray, a length squared: what errors of u and t are measured with
  T inverse_size_squared;
};

/// What is integrated: u and n with their rates, the integrals of F (azimuth), dt/dtau and Sigma without what is known
/// in closed form.
template <class T>
struct State {
  T u, u_rate;
  std::array<T, 3> n, n_rate;
  T azimuth, time, affine;
};

template <class T, int N, bool Timed>
struct Series {
  static constexpr std::size_t order = N;
  template <int K>
  using Coefficients = std::array<T, static_cast<std::size_t>(K)>;

  Coefficients<N + 1> u;
  std::array<Coefficients<N + 1>, 3> n;
  Coefficients<N> azimuth;
  Coefficients<Timed ? N : 0> time, affine;
  Coefficients<N> u_sq, q, w;           ///< S, Q, W
  Coefficients<N> divisor;              ///< P + s u' over its first coefficient; [0] is the inverse of that
  Coefficients<Timed ? N : 0> regular;  ///< Y = kappa / (P + s u')

  /// What the division by P + s u' gives.
  [[nodiscard]] Coefficients<N>& quotient() {
    if constexpr (Timed) {
      return regular;
    } else {
      return azimuth;
    }
  }
};

/// f(j) for j = Begin ... End - 1, j being a constant.
template <std::size_t Begin, std::size_t End, class F>
[[gnu::always_inline]] inline void unrolled(const F& f) {
  if constexpr (Begin < End) {
    f(std::integral_constant<std::size_t, Begin>{});
    unrolled<Begin + 1, End>(f);
  }
}

[[nodiscard]] constexpr double reciprocal(std::size_t k) { return 1.0 / static_cast<double>(k); }

namespace detail {

/// Coefficients K and K + 1 of f^2 for even K; each product of two different coefficients counts twice.
template <std::size_t K, class A, class T>
[[gnu::always_inline]] inline void square_terms(const A& f, T& even, T& odd) {
  odd = f[0] * f[K + 1];
  if constexpr (K == 0) {
    even = f[0] * f[0];
  } else {
    even = f[0] * f[K];
    unrolled<1, K / 2>([&](auto j) {
      even = even + f[j] * f[K - j];
      odd = odd + f[j] * f[K + 1 - j];
    });
    odd = odd + f[K / 2] * f[K / 2 + 1];
    even = (even + even) + f[K / 2] * f[K / 2];
  }
  odd = odd + odd;
}

/// Order K of the azimuth, F = S Y, of dt/dtau = Y + a^2 F + a^2 n_z^2 + a (lambda - a), and of Sigma with
/// 1/u^2 = (-u'/u)' + c3 u / 2 + c4 u^2.
template <std::size_t K, class T, int N>
[[gnu::always_inline]] inline void expand_times(const Constants<T>& c, const T& z_sq, Series<T, N, true>& series) {
  const auto& u_sq = series.u_sq;
  const auto& regular = series.regular;
  T sum = u_sq[0] * regular[K];
  unrolled<1, K + 1>([&](auto j) { sum = sum + u_sq[j] * regular[K - j]; });
  series.azimuth[K] = sum;
  series.time[K] = regular[K] + c.spin_squared * (sum + z_sq);
  if constexpr (K == 0) series.time[0] = series.time[0] + c.time_constant;
  series.affine[K] = (1.0 / 3.0) * c.three_halves_c3 * series.u[K] + 0.5 * c.twice_c4 * u_sq[K] + c.spin_squared * z_sq;
}

/// Order K of the division by P + s u'; `z_sq` is that of n_z^2.
template <std::size_t K, class T, int N, bool Timed>
[[gnu::always_inline]] inline void expand_quotient(const Constants<T>& c, const T& branch, const T& z_sq,
                                                   Series<T, N, Timed>& series) {
  auto& divisor = series.divisor;
  auto& quotient = series.quotient();
  const T slope = c.p2 * series.u_sq[K] + static_cast<double>(K + 1) * branch * series.u[K + 1];
  divisor[K] = K == 0 ? T(1.0 / (1.0 + slope)) : T(slope * divisor[0]);
  // Timed: Y = kappa / (P + s u'); else F = kappa S / (P + s u') at once.
  T sum = (c.kappa * divisor[0]) * (Timed ? T(K == 0 ? 1.0 : 0.0) : series.u_sq[K]);
  unrolled<0, K>([&](auto j) { sum = sum - divisor[K - j] * quotient[j]; });
  quotient[K] = sum;
  if constexpr (Timed) expand_times<K>(c, z_sq, series);
}

/// Orders K and K + 1 of every series, K even, from the orders below: both equations are of second order, so u and n
/// are known one order ahead and two orders can share what they read.
template <std::size_t K, class T, int N, bool Timed>
[[gnu::always_inline]] inline void expand_pair(const Constants<T>& c, const T& branch, Series<T, N, Timed>& series) {
  constexpr bool two = K + 2 < N;  // the highest order of u and n is N
  auto& q = series.q;
  auto& w = series.w;
  auto& u_sq = series.u_sq;
  std::array<T, 2> z_sq;
  square_terms<K>(series.u, u_sq[K], u_sq[K + 1]);
  square_terms<K>(series.n[2], z_sq[0], z_sq[1]);
  for (std::size_t i = 0; i < 2; ++i) {
    q[K + i] = c.three_halves_c3 * series.u[K + i] + c.twice_c4 * u_sq[K + i];
    w[K + i] = (c.spin_squared + c.spin_squared) * z_sq[i];
  }
  if constexpr (K == 0) q[0] = q[0] + c.c2, w[0] = w[0] + c.polar_constant;

  const auto multiply = [&](const auto& f, auto& g, double sign) {
    T even = f[0] * g[K], odd = f[0] * g[K + 1];
    unrolled<1, K + 1>([&](auto j) {
      even = even + f[j] * g[K - j];
      if constexpr (two) odd = odd + f[j] * g[K + 1 - j];
    });
    g[K + 2] = (sign / static_cast<double>((K + 1) * (K + 2))) * even;
    if constexpr (two) g[K + 3] = (sign / static_cast<double>((K + 2) * (K + 3))) * (odd + f[K + 1] * g[0]);
  };
  multiply(q, series.u, 1.0);
  for (auto& n : series.n) multiply(w, n, -1.0);
  auto& z = series.n[2];
  z[K + 2] = z[K + 2] + (1.0 / static_cast<double>((K + 1) * (K + 2))) * (c.spin_squared * z[K]);
  if constexpr (two) z[K + 3] = z[K + 3] + (1.0 / static_cast<double>((K + 2) * (K + 3))) * (c.spin_squared * z[K + 1]);

  expand_quotient<K>(c, branch, z_sq[0], series);
  expand_quotient<K + 1>(c, branch, z_sq[1], series);
}

}  // namespace detail

/// Fills `series` from the state at the step's beginning.
template <class T, int N, bool Timed>
void expand(const Constants<T>& c, const State<T>& y, const T& branch, Series<T, N, Timed>& series) {
  series.u[0] = y.u;
  series.u[1] = y.u_rate;
  for (std::size_t i = 0; i < 3; ++i) {
    series.n[i][0] = y.n[i];
    series.n[i][1] = y.n_rate[i];
  }
  static_assert(N % 2 == 0);
  [&]<std::size_t... K>(std::index_sequence<K...>) { (detail::expand_pair<2 * K>(c, branch, series), ...); }
  (std::make_index_sequence<static_cast<std::size_t>(N / 2)>{});
}

/// A polynomial and its derivative at s.
template <class A, class T>
[[gnu::always_inline]] inline void evaluate(const A& coefficients, const T& s, T& value, T& rate) {
  constexpr std::size_t top = std::tuple_size_v<A> - 1;
  T f = coefficients[top];
  T slope = f;
  f = f * s + coefficients[top - 1];
  unrolled<2, top + 1>([&](auto k) {
    slope = slope * s + f;
    f = f * s + coefficients[top - k];
  });
  value = f;
  rate = slope;
}

/// A polynomial of even order alone: even and odd powers apart, so that one waits half as long.
template <class A, class T>
[[nodiscard, gnu::always_inline]] inline T value_at(const A& coefficients, const T& s) {
  constexpr std::size_t top = std::tuple_size_v<A> - 1;
  const T s_sq = s * s;
  T even = coefficients[top], odd = coefficients[top - 1];
  unrolled<1, top / 2>([&](auto k) {
    even = even * s_sq + coefficients[top - 2 * k];
    odd = odd * s_sq + coefficients[top - 2 * k - 1];
  });
  return (even * s_sq + coefficients[0]) + odd * s;
}

/// The integral of a series from 0 to s.
template <class A, class T>
[[nodiscard, gnu::always_inline]] inline T integral(const A& rate, const T& s) {
  constexpr std::size_t count = std::tuple_size_v<A>;
  T sum = reciprocal(count) * rate[count - 1];
  unrolled<1, count>([&](auto k) { sum = sum * s + reciprocal(count - k) * rate[count - k - 1]; });
  return sum * s;
}

/// Direction and integrals at tau = s from the step's beginning; the integrals go on from those of `y`.
template <class T, int N, bool Timed>
[[gnu::always_inline]] inline void advance_rest(const Series<T, N, Timed>& series, const T& s, State<T>& y) {
  unrolled<0, 3>([&](auto i) { evaluate(series.n[i], s, y.n[i], y.n_rate[i]); });
  y.azimuth = y.azimuth + integral(series.azimuth, s);
  if constexpr (Timed) {
    y.time = y.time + integral(series.time, s);
    y.affine = y.affine + integral(series.affine, s);
  }
}

/// x^(1/p) to a fraction of a per cent, for positive normal x: 2^(log2(x)/p) with both functions linear between powers
/// of two. Good for step sizes, and the same bits everywhere.
template <class T>
[[nodiscard, gnu::always_inline]] inline T rough_root(const T& x, double p) {
  const T log2 = bits::exponent(x) + (bits::significand(x) - 1.0);
  const T scaled = log2 * (1.0 / p);
  const T whole = floor(scaled);
  return bits::power_of_two(whole) * (1.0 + (scaled - whole));
}

/// The step for which the last two terms of every series fall to the tolerance: of n and of the azimuth
/// absolutely, of u and t in units of the ray's size.
template <class T, int N, bool Timed>
[[nodiscard]] T step_size(const Constants<T>& c, const Series<T, N, Timed>& series, double tol) {
  const auto term_squared = [&](std::size_t k) {
    const double scale = square(reciprocal(k));
    T sum = c.size_squared * square(series.u[k]) + square(series.n[0][k]) + square(series.n[1][k]) +
            square(series.n[2][k]) + scale * (c.spin_squared * square(series.azimuth[k - 1]));
    if constexpr (Timed) sum = sum + scale * (square(series.time[k - 1]) * c.inverse_size_squared);
    return sum + 1e-250;  // where nothing changes the step is long, not infinite
  };
  const T last = rough_root(T(tol * tol) / term_squared(N), 2.0 * N);
  const T before = rough_root(T(tol * tol) / term_squared(N - 1), 2.0 * (N - 1));
  return min(last, before);
}

}  // namespace xpr::first_integrals
