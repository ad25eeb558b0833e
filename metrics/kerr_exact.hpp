// Exact light in Kerr: closed forms, no stepping.
//   Boyer-Lindquist (t, r, theta, phi), mass M > 0, spin a with |a| <= M about theta = 0 (the extremal hole included).
//   b = L/E, signed as L: b > 0 is prograde where a > 0. xi = L/E, eta = Q/E^2 (Carter's Q).
// Lengths in the unit of M, angles in radians, swept angles unwrapped. Every function throws std::invalid_argument for
// M <= 0 or |a| > M and std::domain_error for an argument outside its range, with the value and the range.
// Numbers are 113 bits wide inside and rounded once. Cites: [BardeenPressTeukolsky1972] [Bardeen1973] [IyerHansen2009]
// [SerenoDeLuca2006] [EderyGodin2006] [Teo2003] [Johnson2020] [GrallaLupsasca2020Lensing] [Carter1968]
#pragma once

#include "metrics/exact_value.hpp"
#include "metrics/kerr_potentials.hpp"

namespace xpr::kerr_exact {

/// With or against the hole's rotation; at a = 0 prograde means L > 0.
enum class Sense { prograde, retrograde };

// Characteristic radii.

[[nodiscard]] ExactValue outer_horizon(double mass, double spin);
[[nodiscard]] ExactValue inner_horizon(double mass, double spin);
/// Equatorial photon orbit.
[[nodiscard]] ExactValue photon_orbit_radius(double mass, double spin, Sense sense);
/// Its b, signed as L: negative for retrograde orbits where a > 0.
[[nodiscard]] ExactValue critical_impact_parameter(double mass, double spin, Sense sense);
/// Innermost stable circular orbit of massive particles.
[[nodiscard]] ExactValue isco_radius(double mass, double spin, Sense sense);
/// Marginally bound circular orbit of massive particles.
[[nodiscard]] ExactValue marginally_bound_radius(double mass, double spin, Sense sense);
/// The spherical photon orbit with L = 0, over the poles.
[[nodiscard]] ExactValue polar_photon_orbit_radius(double mass, double spin);

// Equatorial rays.

/// Radius of closest approach of a ray from afar, b outside the two critical values.
[[nodiscard]] ExactValue equatorial_periapsis(double mass, double spin, double impact_parameter);

/// |Delta phi| - pi from infinity to infinity. Complete and incomplete elliptic integrals of the third kind (Iyer and
/// Hansen's, in partial fractions that stay finite as a -> 0); a = 0 as Schwarzschild, a = M by Gauss-Legendre
/// quadrature with its error. A public transcription has + (a/b)^2/2 for - (a/b)^2/2 in their Omega_-, off by 10 rad.
[[nodiscard]] ExactValue equatorial_deflection(double mass, double spin, double impact_parameter);

/// Sereno and De Luca's series to `order` = 1...5 terms in 1/|b|; `error` bounds |series - deflection|. |b| > 14 M.
[[nodiscard]] ExactValue equatorial_weak_field_series(double mass, double spin, double impact_parameter, int order);

/// Delta phi between two radii outside the horizon (infinity allowed), signed as dphi/dt, straight on or by way of the
/// periapsis. Straight on also for rays that fall in, by quadrature. A radius within 4 units in the last place below
/// the periapsis counts as it. phi diverges at the horizon.
[[nodiscard]] ExactValue equatorial_swept_angle(double mass, double spin, double impact_parameter, double r1, double r2,
                                                bool via_periapsis);

/// Elapsed t between two finite radii, as above; by quadrature (Schwarzschild's, see there).
[[nodiscard]] ExactValue equatorial_coordinate_time(double mass, double spin, double impact_parameter, double r1,
                                                    double r2, bool via_periapsis);

// Principal null rays: theta = theta0, L = a sin^2 theta0, Q = -a^2 cos^4 theta0 (E = 1); r is affine.

[[nodiscard]] RayConstants<double> principal_null_constants(double spin, double theta);
/// |Delta t| between r1 and r2 outside the horizon: the integral of (r^2 + a^2)/Delta.
[[nodiscard]] ExactValue principal_null_time(double mass, double spin, double r1, double r2);
/// |Delta phi|: the integral of |a|/Delta.
[[nodiscard]] ExactValue principal_null_angle(double mass, double spin, double r1, double r2);

// Spherical photon orbits, a != 0 (where a = 0 there is the photon sphere alone).

/// The orbit at constant r, prograde photon orbit <= r <= retrograde one, r > M. All for one full latitudinal
/// oscillation where nothing else is said. The azimuth jumps by 2 pi where xi changes sign (the axis is passed on the
/// other side).
struct SphericalOrbit {
  ExactValue xi;                   ///< L/E
  ExactValue eta;                  ///< Q/E^2
  ExactValue cos_squared_least;    ///< u+ = cos^2 of the least theta: squared sine of the greatest latitude
  ExactValue minus_u_minus;        ///< -u- > 0, the other root of a^2 u^2 + (xi^2 + eta - a^2) u - eta
  ExactValue mino_period;          ///< in 1/(length unit), E = 1
  ExactValue azimuth;              ///< Delta phi, signed
  ExactValue time;                 ///< Delta t
  ExactValue lyapunov_half_orbit;  ///< gamma: a deviation in r grows by exp(gamma) every half oscillation
};
[[nodiscard]] SphericalOrbit spherical_orbit(double mass, double spin, double r);

// The shadow's edge on the screen of a distant observer at inclination 0 < i < pi to the spin: alpha = -xi/sin i,
// beta^2 = eta + a^2 cos^2 i - xi^2 cot^2 i. Prograde light makes the edge at alpha < 0 where a > 0.

struct ScreenPoint {
  ExactValue alpha;
  ExactValue beta;
};

/// The edge's upper half by the radius of its spherical orbit, a != 0.
[[nodiscard]] ScreenPoint shadow_curve(double mass, double spin, double inclination, double r);

/// The point of the edge seen from (alpha_centre, 0), inside it, under the polar angle `screen_angle` in [-pi, pi] from
/// the alpha axis. Root by bisection at 113 bits. At a = M the straight part of the edge belongs to r = M.
[[nodiscard]] ScreenPoint shadow_edge(double mass, double spin, double inclination, double alpha_centre,
                                      double screen_angle);

/// Where the edge meets the alpha axis and where it stands highest.
struct ShadowExtent {
  ExactValue alpha_left;
  ExactValue alpha_right;
  ExactValue beta_max;
  ExactValue alpha_at_beta_max;
};
[[nodiscard]] ShadowExtent shadow_extent(double mass, double spin, double inclination);

}  // namespace xpr::kerr_exact
