// Everything physical that follows from g^{mu nu}(x) alone: the covariant metric, the Hamiltonian and its flow, the
// connection and the curvature. Derivatives are those of dual numbers: exact to round-off, no step size.
//
//   H = 1/2 g^{mu nu} p_mu p_nu,   dx^mu/dlambda = g^{mu nu} p_nu,   dp_mu/dlambda = -1/2 (d_mu g^{ab}) p_a p_b
//
// Conventions: signature (-+++); Gamma^l_{mn} = 1/2 g^{ls} (d_m g_{sn} + d_n g_{sm} - d_s g_{mn});
// R^r_{smn} = d_m Gamma^r_{ns} - d_n Gamma^r_{ms} + Gamma^r_{ml} Gamma^l_{ns} - Gamma^r_{nl} Gamma^l_{ms};
// R_{sn} = R^r_{srn}.  [MisnerThorneWheeler1973]
#pragma once

#include <concepts>
#include <cstddef>

#include "metrics/card.hpp"
#include "metrics/scalar/dual.hpp"
#include "metrics/tensor.hpp"

namespace xpr {

/// A spacetime chart: a plain struct of parameters, a Card, the contravariant metric, and the radius that stops refer
/// to (Boyer-Lindquist r, areal r where spherical, |x| in flat space and media). All else may be derived.
template <class M>
concept MetricModule = requires(const M& metric, const Vec4<double>& x) {
  { M::card.metric } -> std::convertible_to<std::string_view>;
  { metric.inverse_metric(x) } -> std::same_as<SymTensor4<double>>;
  { metric.radius(x) } -> std::convertible_to<double>;
};

/// A module that brings its own flow, for speed; conformance compares it with the derived one.
template <class M>
concept HandWrittenFlow = requires(const M& metric, const PhaseState<double>& y) {
  { metric.flow(y) } -> std::same_as<PhaseState<double>>;
};

/// H = 1/2 g^{mu nu} p_mu p_nu: zero for light.
template <MetricModule M, class T>
[[nodiscard]] constexpr T hamiltonian(const M& metric, const PhaseState<T>& y) {
  const Vec4<T> p = y.p();
  return 0.5 * contract(p, raise_index(metric.inverse_metric(y.x()), p));
}

/// How many coordinates the metric of M depends on.
template <MetricModule M>
inline constexpr int dependent_coordinates = [] {
  int n = 0;
  for (const bool ignorable : M::card.ignorable) n += ignorable ? 0 : 1;
  return n;
}();

/// The dual direction of each coordinate, -1 for ignorable ones.
template <MetricModule M>
inline constexpr std::array<int, 4> direction_of = [] {
  std::array<int, 4> direction{};
  int next = 0;
  for (std::size_t mu = 0; mu < 4; ++mu) direction[mu] = M::card.ignorable[mu] ? -1 : next++;
  return direction;
}();

/// Hamilton's equations with derivatives by duals, one dual direction for each coordinate that is not ignorable.
template <MetricModule M, class T>
[[nodiscard]] constexpr PhaseState<T> derived_flow(const M& metric, const PhaseState<T>& y) {
  constexpr int n = dependent_coordinates<M>;
  const Vec4<T> p = y.p();
  if constexpr (n == 0) {
    return {raise_index(metric.inverse_metric(y.x()), p), Vec4<T>{}};
  } else {
    using D = Dual<T, n>;
    const auto seeded = [&](std::size_t mu) __attribute__((always_inline)) {
      return D(y[mu], dual::generate<T, n>([&](std::size_t k) __attribute__((always_inline)) {
                 return T(direction_of<M>[mu] == static_cast<int>(k) ? 1.0 : 0.0);
               }));
    };
    const SymTensor4<D> g = metric.inverse_metric(Vec4<D>{seeded(0), seeded(1), seeded(2), seeded(3)});
    return PhaseState<T>::of([&](auto i) __attribute__((always_inline)) {
      if constexpr (i < 4) {
        return g(i, 0).value * p[0] + g(i, 1).value * p[1] + g(i, 2).value * p[2] + g(i, 3).value * p[3];
      } else if constexpr (direction_of<M>[i - 4] < 0) {
        return T(0.0);
      } else {
        constexpr auto k = static_cast<std::size_t>(direction_of<M>[i - 4]);
        const auto term = [&](std::size_t a, std::size_t b) __attribute__((always_inline)) {
          return g(a, b).derivative[k] * (p[a] * p[b]);
        };
        const T diagonal_sum = term(0, 0) + term(1, 1) + term(2, 2) + term(3, 3);
        const T mixed_sum = term(0, 1) + term(0, 2) + term(0, 3) + term(1, 2) + term(1, 3) + term(2, 3);
        return T(-(0.5 * diagonal_sum + mixed_sum));
      }
    });
  }
}

/// The flow that transport uses: the hand-written one where the module has it, the derived one otherwise.
template <MetricModule M, class T>
[[nodiscard]] constexpr PhaseState<T> flow(const M& metric, const PhaseState<T>& y) {
  if constexpr (HandWrittenFlow<M>) {
    return metric.flow(y);
  } else {
    return derived_flow(metric, y);
  }
}

/// The covariant metric g_{mu nu}, by inversion of the contravariant one.
template <MetricModule M, class T>
[[nodiscard]] constexpr SymTensor4<T> covariant_metric(const M& metric, const Vec4<T>& x) {
  return inverse(metric.inverse_metric(x));
}

/// Gamma^l_{mn} as an array over the upper index l.
template <class T>
using Connection = std::array<SymTensor4<T>, 4>;

/// The Christoffel symbols of the Levi-Civita connection at x.
template <MetricModule M, class T>
[[nodiscard]] constexpr Connection<T> christoffel(const M& metric, const Vec4<T>& x) {
  using D = Dual<T, 4>;
  Vec4<D> seeded;
  for (std::size_t mu = 0; mu < 4; ++mu) {
    seeded[mu] = D(x[mu]);
    seeded[mu].derivative[mu] = T(1.0);
  }
  const SymTensor4<D> upper = metric.inverse_metric(seeded);
  const SymTensor4<D> lower = inverse(upper);
  Connection<T> gamma;
  for (std::size_t m = 0; m < 4; ++m) {
    for (std::size_t n = m; n < 4; ++n) {
      Vec4<T> first_kind;
      for (std::size_t s = 0; s < 4; ++s) {
        first_kind[s] = 0.5 * (lower(s, n).derivative[m] + lower(s, m).derivative[n] - lower(m, n).derivative[s]);
      }
      for (std::size_t l = 0; l < 4; ++l) {
        gamma[l](m, n) = upper(l, 0).value * first_kind[0] + upper(l, 1).value * first_kind[1] +
                         upper(l, 2).value * first_kind[2] + upper(l, 3).value * first_kind[3];
      }
    }
  }
  return gamma;
}

/// The curvature at a point: R^r_{smn} (index order r, s, m, n), the Ricci tensor and what they are measured against.
struct Curvature {
  std::array<double, 256> riemann{};  ///< R^r_{smn} at 64 r + 16 s + 4 m + n
  SymTensor4<double> ricci{};
  double connection_scale = 0.0;  ///< |d Gamma| + |Gamma|^2 (largest components): the round-off of curvature

  [[nodiscard]] double operator()(std::size_t r, std::size_t s, std::size_t m, std::size_t n) const {
    return riemann[64 * r + 16 * s + 4 * m + n];
  }
};

/// The Riemann and Ricci tensors at x, by duals of duals.
template <MetricModule M>
[[nodiscard]] Curvature curvature(const M& metric, const Vec4<double>& x) {
  using D = Dual<double, 4>;
  Vec4<D> seeded;
  for (std::size_t mu = 0; mu < 4; ++mu) {
    seeded[mu] = D(x[mu]);
    seeded[mu].derivative[mu] = 1.0;
  }
  const Connection<D> gamma = christoffel(metric, seeded);
  Curvature out;
  double largest_gamma = 0.0;
  double largest_slope = 0.0;
  const auto magnitude = [](double v) { return v < 0.0 ? -v : v; };
  for (const SymTensor4<D>& plane : gamma) {
    for (const D& component : plane.c) {
      if (magnitude(component.value) > largest_gamma) largest_gamma = magnitude(component.value);
      for (const double slope : component.derivative) {
        if (magnitude(slope) > largest_slope) largest_slope = magnitude(slope);
      }
    }
  }
  out.connection_scale = largest_slope + largest_gamma * largest_gamma;
  for (std::size_t r = 0; r < 4; ++r) {
    for (std::size_t s = 0; s < 4; ++s) {
      for (std::size_t m = 0; m < 4; ++m) {
        for (std::size_t n = 0; n < 4; ++n) {
          double sum = gamma[r](n, s).derivative[m] - gamma[r](m, s).derivative[n];
          for (std::size_t l = 0; l < 4; ++l) {
            sum += gamma[r](m, l).value * gamma[l](n, s).value - gamma[r](n, l).value * gamma[l](m, s).value;
          }
          out.riemann[64 * r + 16 * s + 4 * m + n] = sum;
        }
      }
    }
  }
  for (std::size_t s = 0; s < 4; ++s) {
    for (std::size_t n = s; n < 4; ++n) {
      out.ricci(s, n) = out(0, s, 0, n) + out(1, s, 1, n) + out(2, s, 2, n) + out(3, s, 3, n);
    }
  }
  return out;
}

/// Whether physics and chart admit the event: what the module itself says, and lengths within their card's ranges. An
/// angle beyond its range is a point too: the one that is reached over the axis, or once more around.
template <MetricModule M, class T>
[[nodiscard]] constexpr MaskOf<T> inside_domain(const M& metric, const Vec4<T>& x) {
  MaskOf<T> inside(true);
  if constexpr (requires { metric.inside_domain(x); }) inside = metric.inside_domain(x);
  for (std::size_t mu = 0; mu < 4; ++mu) {
    const Coordinate& coordinate = M::card.coordinates[mu];
    if (coordinate.kind != CoordinateKind::time && coordinate.kind != CoordinateKind::length) continue;
    inside = inside & (x[mu] >= coordinate.lower) & (x[mu] <= coordinate.upper);
  }
  return inside;
}

/// How far off the light cone y is: |g^{mu nu} p_mu p_nu| / (n.p)^2 = |2H| (-g^{tt}) / (p^t)^2, n being the unit normal
/// to x^0 = const. Independent of the scale of p; defined where g^{tt} < 0.
template <class T>
[[nodiscard, gnu::always_inline]] constexpr T null_residual(const SymTensor4<T>& inverse_metric, const Vec4<T>& p) {
  const Vec4<T> v = raise_index(inverse_metric, p);
  return abs(contract(p, v) * -inverse_metric(0, 0) / (v[0] * v[0]));
}
template <MetricModule M, class T>
[[nodiscard]] constexpr T null_residual(const M& metric, const PhaseState<T>& y) {
  return null_residual(metric.inverse_metric(y.x()), y.p());
}

/// The Jacobian J^a_b = d map^a / d x^b of a point map between charts.
template <class Map, class T>
[[nodiscard]] constexpr Matrix4<T> jacobian(const Map& map, const Vec4<T>& x) {
  using D = Dual<T, 4>;
  Vec4<D> seeded;
  for (std::size_t mu = 0; mu < 4; ++mu) {
    seeded[mu] = D(x[mu]);
    seeded[mu].derivative[mu] = T(1.0);
  }
  const Vec4<D> image = map(seeded);
  Matrix4<T> j{};
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = 0; b < 4; ++b) j[a][b] = image[a].derivative[b];
  }
  return j;
}

/// Carries (x, p) through a change of chart. p is a covector, so p'_a = p_m d x^m / d x'^a: the Jacobian of `back` (the
/// map that undoes `there`) at the image.
template <class There, class Back, class T>
[[nodiscard]] constexpr PhaseState<T> map_state(const There& there, const Back& back, const PhaseState<T>& y) {
  const Vec4<T> image = there(y.x());
  const Matrix4<T> j = jacobian(back, image);
  const Vec4<T> p = y.p();
  Vec4<T> q{};
  for (std::size_t a = 0; a < 4; ++a) q[a] = p[0] * j[0][a] + p[1] * j[1][a] + p[2] * j[2][a] + p[3] * j[3][a];
  return {image, q};
}

}  // namespace xpr
