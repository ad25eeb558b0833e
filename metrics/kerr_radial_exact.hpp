// The radial half of a null ray of Kerr, in closed form and in units of the mass. With u = 1/r, E = 1:
//   (du/dtau)^2 = P(u) = 1 + A u^2 + B u^3 + C u^4 = (1 - s u + p u^2)(1 + s u + q u^2),   P = R/r^4
//   A = a^2 - lambda^2 - eta,   B = 2 K,   C = -a^2 eta,   K = eta + (lambda - a)^2,   D = 1 - 2 u + a^2 u^2
// r1 + r2 = -s and r3 + r4 = s are the sums of the roots of R in pairs, r4 and r3 (real or conjugate) those that govern
// light outside the horizon. The two real quadratics serve every case: four real roots, two, none; a = 0, where q = 0.
// s, p and q are held as Wide numbers, so that r4 - r3 keeps its digits next to the critical curve.
// Included by the closed forms of Kerr only. Cites: [GrallaLupsasca2020Geodesics] [Carlson1995]
#pragma once

#include "metrics/wide.hpp"

namespace xpr::kerr_exact {

/// The constants of a ray and of its hole, lengths in units of the mass: spin 0 <= a <= 1, lambda = L/E, eta = Q/E^2.
struct UnitConstants {
  Wide spin;
  Wide lambda;
  Wide eta;
};

/// What the pair r3, r4 is. `straight`: P = 1, the radial ray at a = 0 and the equatorial principal ray.
enum class PairKind { straight, complex_pair, real_pair };

struct RadialMotion {
  UnitConstants constants;
  double a, lambda;
  double A, B, C, K;
  Wide horizon_gap;  ///< w = sqrt(1 - a^2), r+- = 1 +- w
  PairKind kind = PairKind::straight;
  Wide s, p, q;
  Wide quarter_gap;             ///< s^2/4 - p = ((r4 - r3)/2)^2, negative for a conjugate pair
  double gap_error = 0.0;       ///< relative error of quarter_gap
  bool turns_outside = false;   ///< r4 >= r3 > r+: light comes from afar and turns at r4, or from below and turns at r3
  bool spherical = false;       ///< r3 = r4 outside the horizon to all the digits there are: nothing ever passes it
  Wide r4, r3;                  ///< real_pair
  bool far_roots_real = false;  ///< r1 <= r2, the roots of the other quadratic
  Wide r1, r2;

  explicit RadialMotion(const UnitConstants& given);

  [[nodiscard]] double outer_horizon() const { return 1.0 + static_cast<double>(horizon_gap); }
  /// r - r+ and r - r-, to the last digit of r.
  [[nodiscard]] double above_outer_horizon(const Wide& r) const {
    return static_cast<double>(r - Wide(1.0) - horizon_gap);
  }
  [[nodiscard]] double above_inner_horizon(const Wide& r) const {
    return static_cast<double>(r - Wide(1.0) + horizon_gap);
  }
  /// P at 1/r, to its sign near a root.
  [[nodiscard]] double potential(const Wide& r) const;
};

/// What accumulates along a stretch of a ray, all positive with the ray but for the sign of dphi/dt.
struct RadialSums {
  double mino = 0.0;     ///< tau
  double azimuth = 0.0;  ///< the part of phi that depends on r: a (2 r - a lambda)/Delta dtau
  double time = 0.0;     ///< [r^2 + 2 r + 2 r (2 r - a lambda)/Delta] dtau
  double affine = 0.0;   ///< r^2 dtau
  // How far each may be off.
  double mino_error = 0.0;
  double azimuth_error = 0.0;
  double time_error = 0.0;
  double affine_error = 0.0;

  RadialSums& operator+=(const RadialSums& other);
};

/// From the turning point (r4, or r3 where r < r3) to r.
[[nodiscard]] RadialSums leg_to_turn(const RadialMotion& motion, const Wide& r);

/// From r_far to r_near < r_far, straight on; no turning point between.
[[nodiscard]] RadialSums straight_leg(const RadialMotion& motion, const Wide& r_far, const Wide& r_near);

}  // namespace xpr::kerr_exact
