// Exact light in Schwarzschild: closed forms, no stepping.
//   ds^2 = -(1 - 2M/r) dt^2 + dr^2/(1 - 2M/r) + r^2 dOmega^2,      b = L/E >= 0
// Lengths in the unit of M > 0. Angles in radians, swept angles unwrapped. b_c = 3 sqrt3 M; the ray b = b_c itself
// never arrives, and no double is exactly b_c. Every function throws std::invalid_argument for M <= 0 and
// std::domain_error for an argument outside its range, with the value and the range. Near b_c the results stay accurate
// for the stored doubles; what the rounding of b itself does, about 1e-16 b/(b - b_c), is the caller's. Cites:
// [Darwin1959] [Synge1966] [Shapiro1964] [IyerPetters2007] [Bozza2002]
#pragma once

#include "metrics/exact_value.hpp"

namespace xpr::schwarzschild_exact {

/// 3M.
[[nodiscard]] ExactValue photon_sphere_radius(double mass);

/// b_c = 3 sqrt3 M.
[[nodiscard]] ExactValue critical_impact_parameter(double mass);

/// Growth rate of a deviation from the photon orbit in coordinate time, 1/(3 sqrt3 M).
[[nodiscard]] ExactValue lyapunov_exponent_per_time(double mass);

/// The same over half an orbit: pi.
[[nodiscard]] ExactValue lyapunov_exponent_per_half_orbit();

/// Radius of closest approach, b > b_c.
[[nodiscard]] ExactValue periapsis(double mass, double impact_parameter);

/// Deflection |Delta phi| - pi from infinity to infinity, b > b_c; positive towards the hole. Darwin's complete minus
/// incomplete elliptic integral as one Carlson R_F.
[[nodiscard]] ExactValue deflection(double mass, double impact_parameter);

/// The same against the periapsis P > 3M.
[[nodiscard]] ExactValue deflection_from_periapsis(double mass, double periapsis);

/// |Delta phi| between two radii (infinity allowed): by way of the periapsis, or straight on (then also for b < b_c, on
/// either side of the photon sphere). Radii lie outside the horizon and, for b > b_c, not below the periapsis: a radius
/// within 4 units in the last place of it counts as the periapsis.
[[nodiscard]] ExactValue swept_angle(double mass, double impact_parameter, double r1, double r2, bool via_periapsis);

/// Elapsed Schwarzschild time between two finite radii, radii as above. Gauss-Legendre quadrature of the first
/// integral with the turning point and the far end transformed away, in long double, halved until it stands still; b =
/// 0 in closed form. The error is the last change of the quadrature plus rounding.
[[nodiscard]] ExactValue coordinate_time(double mass, double impact_parameter, double r1, double r2,
                                         bool via_periapsis);

/// The series of the deflection in M/b to `order` terms, 1 <= order <= 10. `error` bounds |series - deflection|: what
/// the series leaves out, with rounding. b > 2 b_c.
[[nodiscard]] ExactValue weak_field_series(double mass, double impact_parameter, int order);

/// Bozza's strong deflection limit -ln(b/b_c - 1) + ln[216 (7 - 4 sqrt3)] - pi. `error` bounds what it leaves out of
/// the deflection, b_c < b < 1.1 b_c.
[[nodiscard]] ExactValue strong_field_logarithm(double mass, double impact_parameter);

/// Iyer and Petters's series in 1 - b_c/b with its logarithms, to `order` = 0...3. `error` bounds what it leaves out of
/// the deflection, b_c < b < 2 b_c.
[[nodiscard]] ExactValue strong_field_series(double mass, double impact_parameter, int order);

/// Synge: the angle from the direction of the hole within which a static observer at r > 2M sees it black; more than
/// pi/2 inside the photon sphere.
[[nodiscard]] ExactValue escape_cone_angle(double mass, double r);

/// r = rho (1 + M/(2 rho))^2 for the isotropic radius rho >= M/2 outside the horizon.
[[nodiscard]] ExactValue areal_from_isotropic(double mass, double rho);

/// The inverse, r >= 2M.
[[nodiscard]] ExactValue isotropic_from_areal(double mass, double r);

/// n(rho) = (1 + M/(2 rho))^3/(1 - M/(2 rho)): the medium with the same light, rho > M/2.
[[nodiscard]] ExactValue refractive_index(double mass, double rho);

}  // namespace xpr::schwarzschild_exact
