// What the papers on Kerr's equatorial light share. M = 1.
#pragma once

#include <vector>

#include "validation/paper.hpp"
#include "validation/papers/schwarzschild_light.hpp"

namespace xpr::papers {

/// Kerr-Schild with dop853, Boyer-Lindquist with dopri54.
[[nodiscard]] const std::vector<Route>& kerr_routes();

/// |Delta phi| - pi of an equatorial ray by quadrature of dphi/du, the turning point's root taken out; b signed as L.
[[nodiscard]] double kerr_deflection_by_quadrature(long double a, long double b);

/// Closest approach of an equatorial ray as a root of the radial polynomial.
[[nodiscard]] long double kerr_periapsis(long double a, long double b);

/// Adds the quadrature and both traced routes of the equatorial deflection to a claim.
void add_kerr_deflection_routes(ClaimSheet& claim, const Lab& lab, double a, double b);

}  // namespace xpr::papers
