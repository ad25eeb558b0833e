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
  T size_squared;    ///< of the ray, a length: what errors of u and t are measured with
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

namespace detail {

/// f(j) for j = Begin ... End - 1, j being a constant.
template <std::size_t Begin, std::size_t End, class F>
[[gnu::always_inline]] inline void unrolled(const F& f) {
  if constexpr (Begin < End) {
    f(std::integral_constant<std::size_t, Begin>{});
    unrolled<Begin + 1, End>(f);
  }
}

/// 1/k for the orders in use; 0 stands for 1/0.
inline constexpr std::array<double, 40> reciprocal = [] {
  std::array<double, 40> table{};
  for (std::size_t k = 1; k < table.size(); ++k) table[k] = 1.0 / static_cast<double>(k);
  return table;
}();

/// Coefficient K of f^2 and of g^2, whose sums overlap in the processor; each product of two different coefficients
/// counts twice.
template <std::size_t K, class A, class T>
[[gnu::always_inline]] inline void square_terms(const A& f, const A& g, T& f_sq, T& g_sq) {
  f_sq = f[0] * f[K];
  g_sq = g[0] * g[K];
  if constexpr (K > 0) {
    unrolled<1, (K + 1) / 2>([&](auto j) {
      f_sq = f_sq + f[j] * f[K - j];
      g_sq = g_sq + g[j] * g[K - j];
    });
    f_sq = f_sq + f_sq;
    g_sq = g_sq + g_sq;
    if constexpr (K % 2 == 0) {
      f_sq = f_sq + f[K / 2] * f[K / 2];
      g_sq = g_sq + g[K / 2] * g[K / 2];
    }
  }
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

/// Order K of every series from the orders below it.
template <std::size_t K, class T, int N, bool Timed>
[[gnu::always_inline]] inline void expand_order(const Constants<T>& c, const T& branch, Series<T, N, Timed>& series) {
  auto& u = series.u;
  auto& x = series.n[0];
  auto& y = series.n[1];
  auto& z = series.n[2];
  auto& u_sq = series.u_sq;
  auto& divisor = series.divisor;
  auto& quotient = series.quotient();
  T z_sq;
  square_terms<K>(u, z, u_sq[K], z_sq);

  const T slope = c.p2 * u_sq[K] + static_cast<double>(K + 1) * branch * u[K + 1];
  divisor[K] = K == 0 ? T(1.0 / (1.0 + slope)) : T(slope * divisor[0]);
  // Timed: Y = kappa / (P + s u'); else F = kappa S / (P + s u') at once.
  T sum = (c.kappa * divisor[0]) * (Timed ? T(K == 0 ? 1.0 : 0.0) : u_sq[K]);
  if constexpr (K + 1 < N) {
    auto& q = series.q;
    auto& w = series.w;
    q[K] = c.three_halves_c3 * u[K] + c.twice_c4 * u_sq[K];
    w[K] = (c.spin_squared + c.spin_squared) * z_sq;
    if constexpr (K == 0) q[0] = q[0] + c.c2, w[0] = w[0] + c.polar_constant;
    T sum_u = q[0] * u[K], sum_x = w[0] * x[K], sum_y = w[0] * y[K], sum_z = w[0] * z[K];
    unrolled<1, K + 1>([&](auto j) {
      sum_u = sum_u + q[j] * u[K - j];
      sum_x = sum_x + w[j] * x[K - j];
      sum_y = sum_y + w[j] * y[K - j];
      sum_z = sum_z + w[j] * z[K - j];
      sum = sum - divisor[j] * quotient[K - j];
    });
    constexpr double scale = 1.0 / static_cast<double>((K + 1) * (K + 2));
    u[K + 2] = scale * sum_u;
    x[K + 2] = -scale * sum_x;
    y[K + 2] = -scale * sum_y;
    z[K + 2] = scale * (c.spin_squared * z[K] - sum_z);
  } else {
    unrolled<1, K + 1>([&](auto j) { sum = sum - divisor[j] * quotient[K - j]; });
  }
  quotient[K] = sum;
  if constexpr (Timed) expand_times<K>(c, z_sq, series);
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
  [&]<std::size_t... K>(std::index_sequence<K...>) { (detail::expand_order<K>(c, branch, series), ...); }
  (std::make_index_sequence<static_cast<std::size_t>(N)>{});
}

/// u and u' at tau = s from the step's beginning.
template <class T, int N, bool Timed>
[[gnu::always_inline]] inline void radius_at(const Series<T, N, Timed>& series, const T& s, T& u, T& u_rate) {
  u = series.u[N];
  u_rate = u;
  u = u * s + series.u[N - 1];
  for (std::size_t k = N - 1; k-- > 0;) {
    u_rate = u_rate * s + u;
    u = u * s + series.u[k];
  }
}

/// u alone.
template <class T, int N, bool Timed>
[[nodiscard, gnu::always_inline]] inline T inverse_radius_at(const Series<T, N, Timed>& series, const T& s) {
  T u = series.u[N];
  for (std::size_t k = N; k-- > 0;) u = u * s + series.u[k];
  return u;
}

/// The integral of a series from 0 to s.
template <class A, class T>
[[nodiscard, gnu::always_inline]] inline T integral(const A& rate, const T& s) {
  std::size_t k = rate.size();
  T sum = detail::reciprocal[k] * rate[k - 1];
  for (--k; k > 0; --k) sum = sum * s + detail::reciprocal[k] * rate[k - 1];
  return sum * s;
}

/// Everything but u and its rate at tau = s; the integrals go on from those of `y`.
template <class T, int N, bool Timed>
[[gnu::always_inline]] inline void rest_at(const Series<T, N, Timed>& series, const T& s, State<T>& y) {
  std::array<T, 3> n, rate;
  for (std::size_t i = 0; i < 3; ++i) {
    rate[i] = series.n[i][N];
    n[i] = rate[i] * s + series.n[i][N - 1];
  }
  for (std::size_t k = N - 1; k-- > 0;) {
    for (std::size_t i = 0; i < 3; ++i) {
      rate[i] = rate[i] * s + n[i];
      n[i] = n[i] * s + series.n[i][k];
    }
  }
  y.n = n;
  y.n_rate = rate;
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
    const double scale = detail::reciprocal[k] * detail::reciprocal[k];
    T sum = c.size_squared * square(series.u[k]) + square(series.n[0][k]) + square(series.n[1][k]) +
            square(series.n[2][k]) + scale * (c.spin_squared * square(series.azimuth[k - 1]));
    if constexpr (Timed) sum = sum + scale * (square(series.time[k - 1]) / c.size_squared);
    return sum + 1e-250;  // where nothing changes the step is long, not infinite
  };
  const T last = rough_root(T(tol * tol) / term_squared(N), 2.0 * N);
  const T before = rough_root(T(tol * tol) / term_squared(N - 1), 2.0 * (N - 1));
  return min(last, before);
}

}  // namespace xpr::first_integrals
