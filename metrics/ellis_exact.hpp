// Exact light through and around the Ellis wormhole: closed forms, no stepping.
//   ds^2 = -dt^2 + dl^2 + (l^2 + b0^2) dOmega^2,      b = L/E >= 0
// Throat radius b0 > 0, proper radius l over all reals. b > b0 turns at |l| = sqrt(b^2 - b0^2) on its own side, towards
// the throat (the deflection is positive); b < b0 goes through. The throat is an unstable photon sphere. Every function
// throws std::invalid_argument for b0 <= 0 and std::domain_error for an argument outside its range. Cites: [Ellis1973]
// [ChetouaniClement1984] [NakajimaAsada2012] [Tsukamoto2016]
#pragma once

#include "metrics/exact_value.hpp"

namespace xpr::ellis_exact {

/// Deflection |Delta phi| - pi = 2 K(m = (b0/b)^2) - pi, b > b0.
[[nodiscard]] ExactValue deflection(double throat_radius, double impact_parameter);

/// Delta phi from l = -infinity to +infinity, 2 (b/b0) K(m = (b/b0)^2), 0 <= b < b0.
[[nodiscard]] ExactValue transit_angle(double throat_radius, double impact_parameter);

/// b0: rays above it turn, rays below it go through.
[[nodiscard]] ExactValue critical_impact_parameter(double throat_radius);

/// Growth rate of a deviation from the photon orbit at the throat, in t: 1/b0.
[[nodiscard]] ExactValue lyapunov_exponent_per_time(double throat_radius);

/// pi sum_n [(2n-1)!!/(2n)!!]^2 (b0/b)^(2n) up to n = `order` >= 1, b > b0. `error` bounds |series - deflection|.
[[nodiscard]] ExactValue weak_field_series(double throat_radius, double impact_parameter, int order);

/// Tsukamoto's strong deflection limit -ln(b/b0 - 1) + 3 ln 2 - pi; `error` bounds what it leaves out, b0 < b <= 1.5
/// b0.
[[nodiscard]] ExactValue strong_field_logarithm(double throat_radius, double impact_parameter);

/// |Delta phi| from l1 to l2 (infinities allowed), straight on or, for b > b0, by way of the turning point. For b > b0
/// both ends lie on one side, not below the turning point (4 units in the last place below count as it); b = b0 may not
/// touch or cross the throat.
[[nodiscard]] ExactValue swept_angle(double throat_radius, double impact_parameter, double l1, double l2,
                                     bool via_periapsis);

/// Elapsed t between finite l1 and l2, as for swept_angle.
[[nodiscard]] ExactValue coordinate_time(double throat_radius, double impact_parameter, double l1, double l2,
                                         bool via_periapsis);

/// |l| of the turning point, b >= b0.
[[nodiscard]] ExactValue turning_point(double throat_radius, double impact_parameter);

/// l = rho - b0^2/(4 rho) on the near sheet, minus that on the far one; rho >= b0/2, sheet = +1 or -1.
[[nodiscard]] ExactValue proper_distance_from_isotropic(double throat_radius, double rho, int sheet);

/// rho = (|l| + sqrt(l^2 + b0^2))/2; the sheet is the sign of l.
[[nodiscard]] ExactValue isotropic_from_proper_distance(double throat_radius, double l);

/// r = sqrt(l^2 + b0^2).
[[nodiscard]] ExactValue areal_radius(double throat_radius, double l);

}  // namespace xpr::ellis_exact
