// What the papers on Schwarzschild share: the deflection by quadrature, and by two traced routes that have neither
// chart nor method in common. M = 1.
#pragma once

#include <string_view>

#include "validation/paper.hpp"
#include "validation/schwarzschild_rays.hpp"

namespace xpr::papers {

/// A way to trace: transport chart and method.
struct Route {
  std::string_view chart;
  MethodAt method;
};

/// Kerr-Schild with dop853, the areal chart with dopri54: nothing in common but the tracer's frame.
[[nodiscard]] const std::vector<Route>& schwarzschild_routes();

/// 2 int_0^{u2} du / sqrt(1/b^2 - u^2 + 2 u^3) - pi with the turning point's root taken out: the polynomial's own
/// quadrature, without elliptic integrals.
[[nodiscard]] ExactValue deflection_by_quadrature(long double periapsis);

/// The periapsis of an impact parameter as a root of r^3 - b^2 (r - 2) in long double.
[[nodiscard]] long double periapsis_of(long double b);

/// Adds the quadrature and both traced routes of the deflection at b to a claim; `scale` turns radians into its unit.
void add_deflection_routes(ClaimSheet& claim, const Lab& lab, double b, double scale = 1.0);

}  // namespace xpr::papers
