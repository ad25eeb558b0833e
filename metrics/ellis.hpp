// Ellis wormhole: two flat ends joined at a throat of areal radius b0.
//   ds^2 = -dt^2 + dl^2 + (b0^2 + l^2) (dtheta^2 + sin^2 theta dphi^2) = -dt^2 + (1 + b0^2 / 4 rho^2)^2 dx^2
// Charts:
// - `isotropic`, Cartesian, one sheet for each end, sheet = +1 near, -1 far: rho = |x| >= b0/2, with
//   l = sheet (rho - b0^2 / 4 rho) and areal radius r = rho + b0^2 / 4 rho. Inside rho = b0/2 the same formulas
//   describe the other end upside down: the atlas goes on there by the inversion x -> (b0/2)^2 x / rho^2, sheet ->
//   -sheet, which leaves theta and phi as they are;
// - `proper-distance`, (t, l, theta, phi), l over all reals, l < 0 is the far side; breaks on the axis. The hub.
// Ricci is not zero: R_ll = -2 b0^2 / (b0^2 + l^2)^2 alone. Units: lengths as b0. Photon sphere: the throat.
// Cites: [Ellis1973] [MorrisThorne1988]
#pragma once

#include <cmath>
#include <optional>

#include "metrics/atlas.hpp"
#include "metrics/coordinates.hpp"
#include "metrics/killing.hpp"

namespace xpr {

/// What both charts of Ellis share.
struct EllisThroat {
  double b0 = 1.0;

  /// Throws std::invalid_argument: the value and the allowed range.
  void validate() const;
};

struct EllisIsotropic : EllisThroat {
  static constexpr Card card{.metric = "ellis",
                             .chart = "isotropic",
                             .title = "Ellis wormhole, two isotropic Cartesian sheets joined at the throat",
                             .line_element = "ds^2 = -dt^2 + (1 + b0^2 / 4 rho^2)^2 dx^2",
                             .coordinates = cartesian_coordinates,
                             .ignorable = only_time_ignorable,
                             .vacuum = false,
                             .asymptotically_flat = true,
                             .cites = "Ellis1973 MorrisThorne1988"};
  static constexpr std::array<Parameter<EllisIsotropic>, 1> parameters{
      {{"b0", &EllisIsotropic::b0, "areal radius of the throat, b0 > 0"}}};

  template <Scalar T>
  [[nodiscard]] constexpr SymTensor4<T> inverse_metric(const Vec4<T>& x) const {
    const T k = square(0.5 * T(b0)) / (square(x[1]) + square(x[2]) + square(x[3]));
    const T space = 1.0 / square(1.0 + k);  // not (rho^2 / (rho^2 + b0^2/4))^2: its derivative cancels far away
    return diagonal<T>(T(-1.0), space, space, space);
  }

  /// Hamilton's equations of H = 1/2 (p^2 / (1 + k)^2 - p_t^2), k = b0^2 / 4 rho^2, by hand.
  template <Scalar T>
  [[nodiscard]] constexpr PhaseState<T> flow(const PhaseState<T>& y) const {
    const T rho_sq = square(y[1]) + square(y[2]) + square(y[3]);
    const T quarter = square(0.5 * T(b0));
    const T inv = 1.0 / (rho_sq + quarter);
    const T space = square(rho_sq * inv);
    const T p_sq = square(y[5]) + square(y[6]) + square(y[7]);
    const T inward = -2.0 * quarter * p_sq * rho_sq * inv * square(inv);
    return {{-y[4], space * y[5], space * y[6], space * y[7]}, {T(0.0), inward * y[1], inward * y[2], inward * y[3]}};
  }

  template <Scalar T>
  [[nodiscard]] constexpr T radius(const Vec4<T>& x) const {
    const T rho = euclidean_radius(x);
    return rho + square(0.5 * T(b0)) / rho;
  }
  template <Scalar T>
  [[nodiscard]] constexpr T proper_distance(const Vec4<T>& x, int sheet) const {
    const T rho = euclidean_radius(x);
    return static_cast<double>(sheet) * ((rho - 0.5 * b0) * (rho + 0.5 * b0) / rho);
  }
  template <Scalar T>
  [[nodiscard]] constexpr auto killing_vectors(const Vec4<T>& x) const {
    return spherical_symmetry_cartesian(x);
  }
  template <class T>
  [[nodiscard]] constexpr MaskOf<T> inside_domain(const Vec4<T>& x) const {
    return all_finite(x) & (euclidean_radius(x) > 0.0);
  }
  /// R_ll = -2 b0^2 / r^4 alone, with dl = (1 + b0^2 / 4 rho^2) d rho = (r / rho) d rho.
  [[nodiscard]] SymTensor4<double> declared_ricci(const Vec4<double>& x) const {
    const double rho = euclidean_radius(x);
    const double scale = -2.0 * square(b0 / (radius(x) * square(rho)));
    SymTensor4<double> ricci{};
    for (std::size_t i = 1; i < 4; ++i) {
      for (std::size_t j = i; j < 4; ++j) ricci(i, j) = scale * x[i] * x[j];
    }
    return ricci;
  }

  template <class T>
  [[nodiscard]] constexpr PhaseState<T> to_hub(const PhaseState<T>& y, int sheet) const {
    const PhaseState<T> sphere = cartesian_to_spheroidal(y, T(0.0));
    const T rho = sphere[1];
    const T slope = static_cast<double>(sheet) * (1.0 + square(0.5 * b0 / rho));
    return {{y[0], proper_distance(y.x(), sheet), sphere[2], sphere[3]},
            {y[4], sphere[5] / slope, sphere[6], sphere[7]}};
  }
  template <class T>
  [[nodiscard]] constexpr PhaseState<T> from_hub(const PhaseState<T>& hub) const {
    const auto far = hub[1] < 0.0;
    const T distance = abs(hub[1]);
    const T rho = 0.5 * (distance + sqrt(square(distance) + square(T(b0))));
    const T p_out = select(far, -hub[5], hub[5]);
    const T slope = 1.0 + square(0.5 * b0 / rho);
    return spheroidal_to_cartesian<T>({{hub[0], rho, hub[2], hub[3]}, {hub[4], p_out * slope, hub[6], hub[7]}}, T(0.0));
  }
  [[nodiscard]] int hub_sheet(const Vec4<double>& hub) const { return hub[1] < 0.0 ? -1 : 1; }

  /// Through the throat to the other sheet: inversion x -> (b0/2)^2 x / rho^2. It is its own inverse.
  template <class T>
  [[nodiscard]] constexpr PhaseState<T> inverted(const PhaseState<T>& y) const {
    const T rho_sq = square(y[1]) + square(y[2]) + square(y[3]);
    const T shrink = square(0.5 * T(b0)) / rho_sq;
    const T stretch = rho_sq / square(0.5 * T(b0));
    const T radial = 2.0 * (y[1] * y[5] + y[2] * y[6] + y[3] * y[7]) / rho_sq;
    return {
        {y[0], shrink * y[1], shrink * y[2], shrink * y[3]},
        {y[4], stretch * (y[5] - radial * y[1]), stretch * (y[6] - radial * y[2]), stretch * (y[7] - radial * y[3])}};
  }
  [[nodiscard]] std::optional<AtlasMove> atlas_switch(const PhaseState<double>& y, int sheet) const {
    if (!(euclidean_radius(y.x()) < 0.5 * b0)) return std::nullopt;
    return AtlasMove{inverted(y), -sheet};
  }
};

struct EllisProperDistance : EllisThroat {
  static constexpr Card card{
      .metric = "ellis",
      .chart = "proper-distance",
      .title = "Ellis wormhole, proper distance from the throat: the classical chart, singular on the axis",
      .line_element = "ds^2 = -dt^2 + dl^2 + (b0^2 + l^2) (dtheta^2 + sin^2 theta dphi^2)",
      .coordinates = {{{"t", CoordinateKind::time},
                       {"l", CoordinateKind::length},
                       {"theta", CoordinateKind::polar_angle, 0.0, std::numbers::pi},
                       {"phi", CoordinateKind::azimuth, -std::numbers::pi, std::numbers::pi}}},
      .ignorable = time_and_azimuth_ignorable,
      .vacuum = false,
      .asymptotically_flat = true,
      .cites = "Ellis1973 MorrisThorne1988"};
  static constexpr std::array<Parameter<EllisProperDistance>, 1> parameters{
      {{"b0", &EllisProperDistance::b0, "areal radius of the throat, b0 > 0"}}};

  template <Scalar T>
  [[nodiscard]] constexpr SymTensor4<T> inverse_metric(const Vec4<T>& x) const {
    const T areal_sq = square(T(b0)) + square(x[1]);
    return diagonal<T>(T(-1.0), T(1.0), 1.0 / areal_sq, 1.0 / (areal_sq * square(sin(x[2]))));
  }
  template <Scalar T>
  [[nodiscard]] constexpr T radius(const Vec4<T>& x) const {
    return sqrt(square(T(b0)) + square(x[1]));
  }
  template <Scalar T>
  [[nodiscard]] constexpr T proper_distance(const Vec4<T>& x, int /*sheet*/) const {
    return x[1];
  }
  template <Scalar T>
  [[nodiscard]] constexpr auto killing_vectors(const Vec4<T>& x) const {
    return spherical_symmetry(x);
  }
  template <class T>
  [[nodiscard]] constexpr MaskOf<T> inside_domain(const Vec4<T>& x) const {
    return all_finite(x);
  }
  [[nodiscard]] SymTensor4<double> declared_ricci(const Vec4<double>& x) const {
    return diagonal<double>(0.0, -2.0 * square(b0 / (square(b0) + square(x[1]))), 0.0, 0.0);
  }
  [[nodiscard]] int hub_sheet(const Vec4<double>& x) const { return x[1] < 0.0 ? -1 : 1; }
};

}  // namespace xpr
