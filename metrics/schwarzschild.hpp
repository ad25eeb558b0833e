// Schwarzschild: a black hole of mass M without rotation.
//   ds^2 = -(1 - 2M/r) dt^2 + dr^2 / (1 - 2M/r) + r^2 (dtheta^2 + sin^2 theta dphi^2)
// Charts:
// - `kerr-schild` (s = +1, ingoing: regular on the future horizon), `kerr-schild-outgoing` (s = -1: on the past one),
// all
//   r > 0: g = eta + (2M/r) l l, l_mu = (s, x/r, y/r, z/r), t_s = t + 2 s M ln|r/2M - 1|;
// - `isotropic`, Cartesian, one exterior, rho > M/2: r = rho (1 + m)^2 with m = M/2rho,
//   ds^2 = -((1 - m) / (1 + m))^2 dt^2 + (1 + m)^4 dx^2;
// - `areal`, the form above; breaks on r = 2M and the axis.
// The hub is `kerr-schild`. Units: lengths in any one unit, M too. Cites: [Schwarzschild1916] [MisnerThorneWheeler1973]
#pragma once

#include <cmath>

#include "metrics/coordinates.hpp"
#include "metrics/killing.hpp"
#include "metrics/separable.hpp"

namespace xpr {

/// What all charts of Schwarzschild share.
struct SchwarzschildMass {
  double M = 1.0;

  /// Throws std::invalid_argument: the value and the allowed range.
  void validate() const;
  [[nodiscard]] double horizon_radius() const { return 2.0 * M; }
  /// 0.5% outside the horizon: nearer to it than the photon orbit r = 3M.
  [[nodiscard]] double default_r_min() const { return 2.01 * M; }
  /// For first integrals: metrics/separable.hpp.
  [[nodiscard]] constexpr SeparatedLight separated() const { return {.mass = M, .spin = 0.0, .charge_squared = 0.0}; }

  /// 2 M ln|r/2M - 1|: what the Kerr-Schild charts add to Schwarzschild's t, given r - 2M.
  template <class T>
  [[nodiscard]] constexpr T time_shift(const T& r_minus_horizon) const {
    return 2.0 * M * log(abs(r_minus_horizon) / (2.0 * M));
  }
};

template <int Direction>
struct SchwarzschildKerrSchild : SchwarzschildMass {
  static_assert(Direction == 1 || Direction == -1);
  static constexpr Card card{
      .metric = "schwarzschild",
      .chart = Direction > 0 ? "kerr-schild" : "kerr-schild-outgoing",
      .title = Direction > 0
                   ? "Schwarzschild black hole, ingoing Kerr-Schild: regular for rays that fall in"
                   : "Schwarzschild black hole, outgoing Kerr-Schild: regular for camera rays traced back in time",
      .line_element = "g = eta + (2M/r) l l, l null in eta and g",
      .coordinates = cartesian_coordinates,
      .ignorable = only_time_ignorable,
      .vacuum = true,
      .asymptotically_flat = true,
      .cites = "Schwarzschild1916 MisnerThorneWheeler1973"};
  static constexpr std::array<Parameter<SchwarzschildKerrSchild>, 1> parameters{
      {{"M", &SchwarzschildKerrSchild::M, "mass, a length, M > 0"}}};

  template <Scalar T>
  [[nodiscard]] constexpr SymTensor4<T> inverse_metric(const Vec4<T>& x) const {
    const T inv_r = 1.0 / euclidean_radius(x);
    const T f = 2.0 * M * inv_r;
    const Vec4<T> l_up{T(-Direction), x[1] * inv_r, x[2] * inv_r, x[3] * inv_r};
    return kerr_schild_inverse<T>(f, l_up);
  }

  /// Hamilton's equations of H = 1/2 (eta^{mu nu} p_mu p_nu - f (l.p)^2) by hand: one square root, one division.
  template <Scalar T>
  [[nodiscard]] constexpr PhaseState<T> flow(const PhaseState<T>& y) const {
    const T inv_r = 1.0 / euclidean_radius(y.x());
    const T n_x = y[1] * inv_r, n_y = y[2] * inv_r, n_z = y[3] * inv_r;
    const T p_radial = n_x * y[5] + n_y * y[6] + n_z * y[7];
    const T l_p = p_radial - static_cast<double>(Direction) * y[4];
    const T k = 2.0 * M * inv_r * l_p;
    const T k_over_r = k * inv_r;
    const T inward = k_over_r * (p_radial + 0.5 * l_p);
    return {{static_cast<double>(Direction) * k - y[4], y[5] - k * n_x, y[6] - k * n_y, y[7] - k * n_z},
            {T(0.0), k_over_r * y[5] - inward * n_x, k_over_r * y[6] - inward * n_y, k_over_r * y[7] - inward * n_z}};
  }

  template <Scalar T>
  [[nodiscard]] constexpr T radius(const Vec4<T>& x) const {
    return euclidean_radius(x);
  }
  template <Scalar T>
  [[nodiscard]] constexpr auto killing_vectors(const Vec4<T>& x) const {
    return spherical_symmetry_cartesian(x);
  }
  template <class T>
  [[nodiscard]] constexpr MaskOf<T> inside_domain(const Vec4<T>& x) const {
    return all_finite(x) & (radius(x) > 0.0);
  }

  template <class T>
  requires(Direction < 0) [[nodiscard]] constexpr Vec4<T> to_hub(const Vec4<T>& x, int /*sheet*/) const {
    return later(x, 1.0);
  }
  template <class T>
  requires(Direction < 0) [[nodiscard]] constexpr Vec4<T> from_hub(const Vec4<T>& x) const { return later(x, -1.0); }

 private:
  template <class T>
  [[nodiscard]] constexpr Vec4<T> later(const Vec4<T>& x, double sense) const {
    return {x[0] + 2.0 * sense * time_shift(radius(x) - 2.0 * M), x[1], x[2], x[3]};
  }
};

using SchwarzschildIngoing = SchwarzschildKerrSchild<1>;
using SchwarzschildOutgoing = SchwarzschildKerrSchild<-1>;

struct SchwarzschildIsotropic : SchwarzschildMass {
  static constexpr Card card{.metric = "schwarzschild",
                             .chart = "isotropic",
                             .title = "Schwarzschild black hole outside the horizon, isotropic Cartesian coordinates",
                             .line_element = "ds^2 = -((1 - m)/(1 + m))^2 dt^2 + (1 + m)^4 dx^2, m = M / 2 rho",
                             .coordinates = cartesian_coordinates,
                             .ignorable = only_time_ignorable,
                             .vacuum = true,
                             .asymptotically_flat = true,
                             .cites = "MisnerThorneWheeler1973"};
  static constexpr std::array<Parameter<SchwarzschildIsotropic>, 1> parameters{
      {{"M", &SchwarzschildIsotropic::M, "mass, a length, M > 0"}}};

  template <Scalar T>
  [[nodiscard]] constexpr SymTensor4<T> inverse_metric(const Vec4<T>& x) const {
    const T m = 0.5 * M / euclidean_radius(x);
    const T space = 1.0 / square(square(1.0 + m));
    return diagonal<T>(-square((1.0 + m) / (1.0 - m)), space, space, space);
  }
  template <Scalar T>
  [[nodiscard]] constexpr T radius(const Vec4<T>& x) const {
    const T rho = euclidean_radius(x);
    return square(rho + 0.5 * M) / rho;
  }
  template <Scalar T>
  [[nodiscard]] constexpr auto killing_vectors(const Vec4<T>& x) const {
    return spherical_symmetry_cartesian(x);
  }
  template <class T>
  [[nodiscard]] constexpr MaskOf<T> inside_domain(const Vec4<T>& x) const {
    return all_finite(x) & (euclidean_radius(x) > 0.5 * M);
  }

  template <class T>
  [[nodiscard]] constexpr Vec4<T> to_hub(const Vec4<T>& x, int /*sheet*/) const {
    const T rho = euclidean_radius(x);
    const T scale = square((rho + 0.5 * M) / rho);
    return {x[0] + time_shift(square(rho - 0.5 * M) / rho), x[1] * scale, x[2] * scale, x[3] * scale};
  }
  template <class T>
  [[nodiscard]] constexpr Vec4<T> from_hub(const Vec4<T>& x) const {
    const T r = euclidean_radius(x);
    const T scale = 0.5 * (r - M + sqrt(r * (r - 2.0 * M))) / r;
    return {x[0] - time_shift(r - 2.0 * M), x[1] * scale, x[2] * scale, x[3] * scale};
  }
};

struct SchwarzschildAreal : SchwarzschildMass {
  static constexpr Card card{
      .metric = "schwarzschild",
      .chart = "areal",
      .title = "Schwarzschild black hole, areal radius: the classical chart, singular on horizon and axis",
      .line_element = "ds^2 = -(1 - 2M/r) dt^2 + dr^2 / (1 - 2M/r) + r^2 (dtheta^2 + sin^2 theta dphi^2)",
      .coordinates = spherical_coordinates,
      .ignorable = time_and_azimuth_ignorable,
      .vacuum = true,
      .asymptotically_flat = true,
      .cites = "Schwarzschild1916"};
  static constexpr std::array<Parameter<SchwarzschildAreal>, 1> parameters{
      {{"M", &SchwarzschildAreal::M, "mass, a length, M > 0"}}};

  template <Scalar T>
  [[nodiscard]] constexpr SymTensor4<T> inverse_metric(const Vec4<T>& x) const {
    const T r = x[1];
    const T above_horizon = r - 2.0 * M;
    const T r_sq = square(r);
    return diagonal<T>(-r / above_horizon, above_horizon / r, 1.0 / r_sq, 1.0 / (r_sq * square(sin(x[2]))));
  }
  template <Scalar T>
  [[nodiscard]] constexpr T radius(const Vec4<T>& x) const {
    return x[1];
  }
  template <Scalar T>
  [[nodiscard]] constexpr auto killing_vectors(const Vec4<T>& x) const {
    return spherical_symmetry(x);
  }
  /// r > 0 off the horizon, where t diverges; inside it too, where r is the time.
  template <class T>
  [[nodiscard]] constexpr MaskOf<T> inside_domain(const Vec4<T>& x) const {
    return all_finite(x) & (x[1] > 0.0) & (x[1] != 2.0 * M);
  }

  template <class T>
  [[nodiscard]] constexpr PhaseState<T> to_hub(const PhaseState<T>& y, int /*sheet*/) const {
    const T above_horizon = y[1] - 2.0 * M;
    return spheroidal_to_cartesian<T>({{y[0] + time_shift(above_horizon), y[1], y[2], y[3]},
                                       {y[4], y[5] - 2.0 * M * y[4] / above_horizon, y[6], y[7]}},
                                      T(0.0));
  }
  template <class T>
  [[nodiscard]] constexpr PhaseState<T> from_hub(const PhaseState<T>& hub) const {
    const PhaseState<T> y = cartesian_to_spheroidal(hub, T(0.0));
    const T above_horizon = y[1] - 2.0 * M;
    return {{y[0] - time_shift(above_horizon), y[1], y[2], y[3]},
            {y[4], y[5] + 2.0 * M * y[4] / above_horizon, y[6], y[7]}};
  }
};

}  // namespace xpr
