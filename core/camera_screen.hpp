// The common screen: camera rays of a distant or near observer of Kerr, by the screen's coordinates alpha and beta.
//
//   pixel centres alpha, beta = +-A (2 (i + 1/2) / N - 1);   lambda = -alpha sin i,   eta = (alpha^2 - a^2) cos^2 i +
//   beta^2
//
// alpha grows to the right and beta upwards for a camera that looks at the hole with the spin up; prograde light
// (lambda > 0 for a > 0) comes from alpha < 0. Rays are past-directed: the tangent is minus the light's own, so p_t =
// +1 and p_phi = -lambda, and the ray moves away from the camera towards what it sees. Lengths in the unit of M. Cites:
// [Bardeen1973]
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "metrics/kerr_potentials.hpp"
#include "metrics/tensor.hpp"

namespace xpr {

struct CameraScreen {
  double mass = 1.0;
  double spin = 0.0;
  double radius = 1000.0;               ///< Boyer-Lindquist r of the observer
  double inclination = 1.0;             ///< its theta, in (0, pi): on the axis there is no horizontal
  double half_width = 12.0;             ///< A, the same in both directions
  std::array<int, 2> pixels{512, 512};  ///< along alpha, along beta

  /// Throws std::invalid_argument: an observer on the axis, inside the ergosphere (where nothing stands still) or the
  /// horizon, a screen without pixels or width.
  void validate() const;
  /// Screen coordinates of a pixel, (0, 0) at the lower left.
  [[nodiscard]] std::array<double, 2> point(int column, int row) const;
  /// Constants of the light (future-directed, E = 1) that reaches the screen there.
  [[nodiscard]] kerr_exact::RayConstants<double> constants(double alpha, double beta) const;
  /// Where the past-directed ray starts in Boyer-Lindquist phase space, going inward. Nothing where R < 0 at the
  /// observer: no light reaches that point of the screen.
  [[nodiscard]] std::optional<PhaseState<double>> ray(double alpha, double beta) const;
};

}  // namespace xpr
