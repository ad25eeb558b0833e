// Flat spacetime: light goes straight.
//   ds^2 = -dt^2 + dx^2 + dy^2 + dz^2 = -dt^2 + dr^2 + r^2 (dtheta^2 + sin^2 theta dphi^2)
// Charts: `cartesian`, all of spacetime; `spherical`, r > 0, which breaks on the axis theta = 0, pi. The hub is
// `cartesian`. Lengths in any one unit. Cites: [MisnerThorneWheeler1973]
#pragma once

#include "metrics/coordinates.hpp"
#include "metrics/killing.hpp"

namespace xpr {

struct MinkowskiCartesian {
  static constexpr Card card{.metric = "minkowski",
                             .chart = "cartesian",
                             .title = "Flat spacetime",
                             .line_element = "ds^2 = -dt^2 + dx^2 + dy^2 + dz^2",
                             .coordinates = cartesian_coordinates,
                             .ignorable = {true, true, true, true},
                             .vacuum = true,
                             .asymptotically_flat = true,
                             .cites = "MisnerThorneWheeler1973"};
  static constexpr bool separable = true;
  static constexpr bool flat = true;

  template <Scalar T>
  [[nodiscard]] constexpr SymTensor4<T> inverse_metric(const Vec4<T>& /*x*/) const {
    return diagonal<T>(T(-1.0), T(1.0), T(1.0), T(1.0));
  }
  template <Scalar T>
  [[nodiscard]] constexpr PhaseState<T> flow(const PhaseState<T>& y) const {
    return {{-y[4], y[5], y[6], y[7]}, {T(0.0), T(0.0), T(0.0), T(0.0)}};
  }
  template <Scalar T>
  [[nodiscard]] constexpr T radius(const Vec4<T>& x) const {
    return euclidean_radius(x);
  }
  template <Scalar T>
  [[nodiscard]] constexpr auto killing_vectors(const Vec4<T>& x) const {
    return euclidean_symmetry_cartesian(x);
  }
  template <class T>
  [[nodiscard]] constexpr MaskOf<T> inside_domain(const Vec4<T>& x) const {
    return all_finite(x);
  }
};

struct MinkowskiSpherical {
  static constexpr Card card{.metric = "minkowski",
                             .chart = "spherical",
                             .title = "Flat spacetime in spherical coordinates",
                             .line_element = "ds^2 = -dt^2 + dr^2 + r^2 (dtheta^2 + sin^2 theta dphi^2)",
                             .coordinates = spherical_coordinates,
                             .ignorable = time_and_azimuth_ignorable,
                             .vacuum = true,
                             .asymptotically_flat = true,
                             .cites = "MisnerThorneWheeler1973"};
  static constexpr bool flat = true;

  template <Scalar T>
  [[nodiscard]] constexpr SymTensor4<T> inverse_metric(const Vec4<T>& x) const {
    const T r_sq = square(x[1]);
    return diagonal<T>(T(-1.0), T(1.0), 1.0 / r_sq, 1.0 / (r_sq * square(sin(x[2]))));
  }
  template <Scalar T>
  [[nodiscard]] constexpr T radius(const Vec4<T>& x) const {
    return x[1];
  }
  template <Scalar T>
  [[nodiscard]] constexpr auto killing_vectors(const Vec4<T>& x) const {
    return spherical_symmetry(x);
  }
  template <class T>
  [[nodiscard]] constexpr MaskOf<T> inside_domain(const Vec4<T>& x) const {
    return all_finite(x) & (x[1] > 0.0);
  }

  template <class T>
  [[nodiscard]] constexpr PhaseState<T> to_hub(const PhaseState<T>& y, int /*sheet*/) const {
    return spheroidal_to_cartesian(y, T(0.0));
  }
  template <class T>
  [[nodiscard]] constexpr PhaseState<T> from_hub(const PhaseState<T>& y) const {
    return cartesian_to_spheroidal(y, T(0.0));
  }
};

}  // namespace xpr
