// What the papers on the Ellis wormhole share. b0 = 1.
#pragma once

#include "validation/paper.hpp"

namespace xpr::papers {

/// The deflection for b > b0 by quadrature: 2 int dt/sqrt(1 - k^2 sin^2 t) over a quarter turn, less pi, k = b0/b.
[[nodiscard]] double ellis_deflection_by_quadrature(long double b);

/// Adds both traced routes to a claim: the deflection for b > b0, the angle swept on the way through for b < b0.
void add_ellis_routes(ClaimSheet& claim, const Lab& lab, double b);

}  // namespace xpr::papers
