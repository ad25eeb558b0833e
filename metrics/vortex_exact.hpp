// Light past the vortex of Gordon's metric (gordon.hpp) by first integrals, no stepping. With E = 1, w = 1/r^2, r the
// distance from the axis, k = n^2 - 1, q = 1 - p_z^2:
//   p_r^2 = P(w) / (1 - W^2 w),   P(w) = (q - J^2 w)(1 - W^2 w) + k (1 - W J w)^2, a quadratic
//   dphi/dlambda = J w + k W w (1 - W J w) / (1 - W^2 w)
// The turning point is the smaller root of P, and p_r^2 is taken by its factors, so that nothing cancels there.
// Cites: [LeonhardtPiwnicki1999]
#pragma once

#include "metrics/exact_value.hpp"

namespace xpr::vortex_exact {

/// Light: index n > 0, W, J = p_phi != 0 and p_z, in units of E.
struct Light {
  double n = 1.5;
  double W = 0.25;
  double J = 1.0;
  double p_z = 0.0;
};

/// p_r^2 at r.
[[nodiscard]] double radial_momentum_squared(const Light& light, double r);
/// How near to the axis it comes. Throws std::domain_error where it falls into the core.
[[nodiscard]] double periapsis(const Light& light);
/// The azimuth swept from the distance r1 in to the periapsis and out to r2, signed. Throws std::domain_error where r1
/// or r2 lie within the periapsis.
[[nodiscard]] ExactValue swept(const Light& light, double r1, double r2);

}  // namespace xpr::vortex_exact
