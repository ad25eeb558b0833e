// Light in closed form as balls: the truth of what can be written as elliptic integrals, with its error proven.
//
// Written separately from metrics/*_exact, by other formulas: Legendre's K, E, F and Pi from the roots of the cubic or
// quartic, where those use Carlson's forms and one angle; polynomials whose roots are certified, where those bisect.
// Arguments are taken as the stored doubles that they are. Lengths in the unit of M (of b0), angles in radians. Every
// function throws std::domain_error for a ray or an orbit that is not there, saying what it needs.
#pragma once

#include <string>
#include <vector>

#include "validation/truth/ball.hpp"

namespace xpr::enclosure {

// Schwarzschild, b > 3 sqrt3 M. [Darwin1959]

/// alpha = (4/sqrt(2 (u3 - u1))) [K(m) - F(psi0|m)] - pi, m = (u2 - u1)/(u3 - u1), sin^2 psi0 = -u1/(u2 - u1), with the
/// roots u1 < 0 < u2 < u3 of 2 u^3 - u^2 + (M/b)^2.
[[nodiscard]] Ball schwarzschild_deflection(double mass, double impact_parameter);
/// 1/u2.
[[nodiscard]] Ball schwarzschild_periapsis(double mass, double impact_parameter);

// Kerr in the equatorial plane, b = L/E signed as L, |a| <= M. [Chandrasekhar1983]

/// |Delta phi| - pi. (du/dphi)^2 is the square of N/(D sqrt P), N = b - 2 (b - a) u, D = 1 - 2 u + a^2 u^2, P = 1 -
/// (b^2
/// - a^2) u^2 + 2 (b - a)^2 u^3 in units of M; N/D in partial fractions over the horizons gives one Pi each.
/// Schwarzschild's where a = 0; at |a| = M the horizons meet and the integral is taken by proven quadrature.
[[nodiscard]] Ball kerr_deflection(double mass, double spin, double impact_parameter);
/// The same for any |a| <= M by proven quadrature in theta, u = u1 + (u2 - u1) sin^2 theta: a second route.
[[nodiscard]] Ball kerr_deflection_by_quadrature(double mass, double spin, double impact_parameter);
[[nodiscard]] Ball kerr_periapsis(double mass, double spin, double impact_parameter);

/// What bounds the light that falls in: the photon orbits in the equator and over the poles, and the two critical b.
struct CriticalParameters {
  Ball prograde_radius, retrograde_radius, polar_radius;
  Ball prograde_b, retrograde_b;  ///< signed as L: the first has the sign of a
};
/// b = -a +- 6 M cos[arccos(-+a/M)/3]. [BardeenPressTeukolsky1972]
[[nodiscard]] CriticalParameters kerr_critical_parameters(double mass, double spin);

/// Constants and one full latitudinal oscillation of the spherical photon orbit at r, between the equatorial orbits, 0
/// < |a| <= M. [Teo2003] [Johnson2020]
struct SphericalOrbit {
  Ball xi, eta;                     ///< L/E and Q/E^2
  Ball cos_squared_least;           ///< u+
  Ball minus_u_minus;               ///< -u-
  Ball mino_period, azimuth, time;  ///< for one oscillation
  Ball lyapunov_half_orbit;         ///< a deviation grows by its exponential every half oscillation
};
[[nodiscard]] SphericalOrbit kerr_spherical_orbit(double mass, double spin, double r);

// The shadow's edge on the screen at inclination 0 < i < pi, 0 < |a| < M: beta^2 = 0, its maximum and a direction are
// polynomials of degree 6 in r. [Bardeen1973] [GrallaLupsascaMarrone2020]

struct ScreenPoint {
  Ball alpha, beta;
};
/// By the radius of its spherical orbit; upper half.
[[nodiscard]] ScreenPoint kerr_shadow_curve(double mass, double spin, double inclination, double r);
/// Seen from (alpha_centre, 0), inside the shadow, under `screen_angle` in [-pi, pi] from the alpha axis.
[[nodiscard]] ScreenPoint kerr_shadow_edge(double mass, double spin, double inclination, double alpha_centre,
                                           double screen_angle);
struct ShadowExtent {
  Ball alpha_left, alpha_right, beta_max, alpha_at_beta_max;
};
[[nodiscard]] ShadowExtent kerr_shadow_extent(double mass, double spin, double inclination);

// Ellis. [ChetouaniClement1984]

/// 2 K(m = (b0/b)^2) - pi, b > b0.
[[nodiscard]] Ball ellis_deflection(double throat_radius, double impact_parameter);
/// Delta phi from one infinity to the other, 2 (b/b0) K(m = (b/b0)^2), 0 < b < b0.
[[nodiscard]] Ball ellis_transit_angle(double throat_radius, double impact_parameter);

}  // namespace xpr::enclosure
