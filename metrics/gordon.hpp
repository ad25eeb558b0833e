// Gordon's metric of a transparent medium that moves: what light sees where the index is n and the velocity v.
//   g_{mn} = eta_{mn} + (1 - 1/n^2) u_m u_n,   g^{mn} = eta^{mn} + (1 - n^2) u^m u^n,   u = gamma (1, v)
// At rest it is the medium of medium.hpp. The vortex (`medium-vortex`: n, W) turns about the z axis with v = W / rho,
// rho^2 = x^2 + y^2: light is dragged along, and J = n b - (n^2 - 1) W is the momentum of light that comes in at b.
// Chart `cartesian`, rho > |W|: further in the medium would outrun light in vacuum. Within rho = n |W| it outruns light
// in itself, d/dt is spacelike there, and nothing breaks.
// Units: lengths in any one unit, W too. Cites: [Gordon1923] [LeonhardtPiwnicki1999]
#pragma once

#include "metrics/coordinates.hpp"
#include "metrics/killing.hpp"

namespace xpr {

/// The four-velocity, index up, of a velocity below one.
template <class T>
[[nodiscard]] constexpr Vec4<T> four_velocity(const std::array<T, 3>& v) {
  const T gamma = 1.0 / sqrt(1.0 - (square(v[0]) + square(v[1]) + square(v[2])));
  return {gamma, gamma * v[0], gamma * v[1], gamma * v[2]};
}

/// g^{mn} over flat space in Cartesian coordinates.
template <class T>
[[nodiscard]] constexpr SymTensor4<T> gordon_inverse(const T& n, const Vec4<T>& u) {
  const T drag = 1.0 - square(n);
  SymTensor4<T> g = diagonal<T>(T(-1.0), T(1.0), T(1.0), T(1.0));
  for (std::size_t m = 0; m < 4; ++m) {
    for (std::size_t k = m; k < 4; ++k) g(m, k) = g(m, k) + drag * (u[m] * u[k]);
  }
  return g;
}

/// g_{mn} likewise; u with its index up.
template <class T>
[[nodiscard]] constexpr SymTensor4<T> gordon_covariant(const T& n, const Vec4<T>& u) {
  const T drag = 1.0 - 1.0 / square(n);
  SymTensor4<T> g = diagonal<T>(T(-1.0), T(1.0), T(1.0), T(1.0));
  for (std::size_t m = 0; m < 4; ++m) {
    for (std::size_t k = m; k < 4; ++k) {
      const T sign = (m == 0) != (k == 0) ? T(-1.0) : T(1.0);  // u_0 = -u^0
      g(m, k) = g(m, k) + drag * sign * (u[m] * u[k]);
    }
  }
  return g;
}

struct GordonVortex {
  double n = 1.5;
  double W = 0.25;

  static constexpr Card card{.metric = "medium-vortex",
                             .chart = "cartesian",
                             .title = "Vortex of circulation 2 pi W in a medium of index n (Gordon's metric)",
                             .line_element = "eta + (1 - 1/n^2) u u, u = gamma (1, v), v = W / rho about the z axis",
                             .coordinates = cartesian_coordinates,
                             .ignorable = {true, false, false, true},
                             .vacuum = false,
                             .asymptotically_flat = false,
                             .cites = "Gordon1923 LeonhardtPiwnicki1999"};
  static constexpr std::array<Parameter<GordonVortex>, 2> parameters{
      {{"n", &GordonVortex::n, "refractive index, n > 0"},
       {"W", &GordonVortex::W, "velocity times distance from the axis, any sign, in units of length"}}};

  /// Throws std::invalid_argument: the value and the allowed range.
  void validate() const;
  template <Scalar T>
  [[nodiscard]] constexpr SymTensor4<T> inverse_metric(const Vec4<T>& x) const {
    const T turning = W / (square(x[1]) + square(x[2]));
    return gordon_inverse(T(n), four_velocity(std::array<T, 3>{-turning * x[2], turning * x[1], T(0.0)}));
  }
  template <Scalar T>
  [[nodiscard]] constexpr T radius(const Vec4<T>& x) const {
    return euclidean_radius(x);
  }
  template <Scalar T>
  [[nodiscard]] constexpr std::array<KillingVectorOf<T>, 3> killing_vectors(const Vec4<T>& x) const {
    return {time_translation<T>(), cartesian_rotation_z(x),
            KillingVectorOf<T>{"p_z", 1.0, {T(0.0), T(0.0), T(0.0), T(1.0)}}};
  }
  /// Where the medium is slower than light in vacuum.
  template <class T>
  [[nodiscard]] constexpr MaskOf<T> inside_domain(const Vec4<T>& x) const {
    return all_finite(x) & (square(x[1]) + square(x[2]) > T(square(W)));
  }
};

}  // namespace xpr
