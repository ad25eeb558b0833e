// Kerr light by Carter's first integrals at 50 digits: what the Hamiltonian flow of the metric module is held against.
//
// Written apart from every metric module, in another time (Mino's, d lambda = Sigma d tau) and other variables, u = 1/r
// and c = cos theta, whose second-order equations pass through every turning point smoothly:
//   u'' = c2 u + (3/2) c3 u^2 + 2 c4 u^3,   c2 = a^2 - L^2 - Q,   c3 = 2 M K,   c4 = -a^2 Q,   K = Q + (L - a)^2
//   c'' = (a^2 - L^2 - Q) c - 2 a^2 c^3
//   phi' = a (r^2 + a^2 - a L)/Delta + L/sin^2 theta - a,   t' = (r^2 + a^2)(r^2 + a^2 - a L)/Delta + a (L - a sin^2
//   theta)
// for E = 1. Cites: [Carter1968] [GrallaLupsasca2020Geodesics]
#pragma once

#include "validation/truth/fifty_digits.hpp"

namespace xpr {

/// A ray that starts at Boyer-Lindquist (t = 0, r, theta, phi = 0) going inward, with E = 1.
struct KerrRay {
  double spin;
  double r, theta;
  double L, p_theta;
  double r_end;
  bool outward;  ///< where it ends: moving outward there, after its turning point
};

/// Where it ends.
struct KerrRayEnd {
  Real50 t, theta, phi, affine;
  Real50 mino;  ///< only the first integrals know it
};

/// Carter's Q and the ingoing p_r.
struct KerrRayStart {
  Real50 Q, p_r;
};
[[nodiscard]] KerrRayStart kerr_ray_start(const KerrRay& ray);

/// By the first integrals.
[[nodiscard]] KerrRayEnd kerr_ray_by_first_integrals(const KerrRay& ray);

/// By Hamilton's equations of the module `kerr` in Boyer-Lindquist coordinates; mino is left at 0.
[[nodiscard]] KerrRayEnd kerr_ray_by_hamiltonian(const KerrRay& ray);

}  // namespace xpr
