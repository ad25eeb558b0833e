// Light in the equatorial plane of Kerr (Schwarzschild where a = 0), by its first integrals: no stepping.
//   With u = M/r, s = (b + a)/M, d = (b - a)/M, E = 1:   (du/dphi)^2 is proportional to
//   P(u) = 1 - s d u^2 + 2 d^2 u^3 = 2 d^2 (u - u1)(u2 - u)(u3 - u),     D(u) = 1 - 2 u + (a/M)^2 u^2
//   dphi = [d + a/M - 2 d u] / (D sqrt P) du,      dt = M [1 + (a/M)^2 u^2 - 2 (a/M) d u^3] / (u^2 D sqrt P) du
// Scaled by U = u d/s this is Schwarzschild's cubic with b_eff^2 = s^3/d, so that the roots and their differences come
// from one angle each, without cancellation: near the critical ray u3 - u2 keeps all its digits.
// Included by the closed forms of Schwarzschild and Kerr only; numbers are 113 bits wide, because doubles lose digits
// near the photon orbit, and each result is rounded once. Cites: [Chandrasekhar1983] [IyerHansen2009]
#pragma once

#include "metrics/bounded.hpp"

namespace xpr::equatorial_light {

/// P(u) of one ray. With three real roots u1 < 0 < u2 < u3 and `gap` = u3 - u2, and the ray `turns` at u2 if that lies
/// outside the horizon (for b just above a it does not). Else u1 is the one real root and rho +- i sigma the pair. d =
/// 0 (b = a, the principal null ray) has P = 1 and no roots: `straight`.
struct Ray {
  Quad mass, spin, s, d;  ///< spin, s and d in units of the mass; mass as given
  bool three_real_roots = false;
  bool turns = false;
  bool straight = false;
  Quad u1, u2, gap;
  Quad rho, sigma;

  /// b = L/E > 0 along the sense of positive `spin`. Throws std::domain_error for the critical b itself, whose ray
  /// never arrives, and for numbers that are not finite.
  Ray(double mass, double spin, double impact_parameter);

  [[nodiscard]] Quad horizon() const;        ///< r+/M
  [[nodiscard]] Quad inner_horizon() const;  ///< r-/M
  [[nodiscard]] Quad periapsis() const;      ///< 1/u2, in units of the mass; only where it turns
};

/// Part of a ray: from radius `r1` to `r2` (lengths as the mass; infinity allowed), straight on or by way of the
/// periapsis. Throws std::domain_error for a radius that is not outside the horizon or that this ray does not reach.
struct Path {
  double r1;
  double r2;
  bool via_periapsis;
};

/// Swept phi, with the sign of dphi/dt.
[[nodiscard]] Bounded swept_angle(const Ray& ray, const Path& path);

/// Elapsed coordinate time, in the unit of the mass; both radii finite.
[[nodiscard]] Bounded coordinate_time(const Ray& ray, const Path& path);

/// The two legs between u = 0 and u2: the whole swept phi of a scattered ray.
[[nodiscard]] Bounded whole_swept_angle(const Ray& ray);

}  // namespace xpr::equatorial_light
