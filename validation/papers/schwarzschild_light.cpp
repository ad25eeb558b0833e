#include "validation/papers/schwarzschild_light.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "validation/papers/quadrature.hpp"

namespace xpr::papers {

const std::vector<Route>& schwarzschild_routes() {
  static const std::vector<Route> routes{{"kerr-schild", {"dop853", 1e-14}}, {"areal", {"dopri54", 1e-12}}};
  return routes;
}

ExactValue deflection_by_quadrature(long double periapsis) {
  const long double u2 = 1.0L / periapsis;
  // u = u2 - w and w = s^2: the polynomial is w (2 u2 - 6 u2^2 + (6 u2 - 1) w - 2 w^2), its root taken out.
  const auto integrand = [u2](long double s) {
    const long double w = s * s;
    return 4.0L / std::sqrt(2.0L * u2 - 6.0L * u2 * u2 + (6.0L * u2 - 1.0L) * w - 2.0L * w * w);
  };
  const Integral swept = integral(integrand, 0.0L, std::sqrt(u2));
  const auto deflection = static_cast<double>(swept.value - std::numbers::pi_v<long double>);
  return {deflection, swept.error + 2e-16 * std::abs(deflection)};
}

long double periapsis_of(long double b) {
  return zero_of([b](long double r) { return r * r * r - b * b * (r - 2.0L); }, 3.0L, b);
}

void add_deflection_routes(ClaimSheet& claim, const Lab& lab, double b, double scale) {
  const double condition = deflection_condition(b);
  const ExactValue quadrature = deflection_by_quadrature(periapsis_of(b));
  claim.ours("quadrature of the orbit equation", scale * quadrature.value,
             {scale * (5e-14 * condition + 2.0 * quadrature.error),
              "round-off of b and of an angle of 3 rad and more, amplified by the ray's condition; the quadrature's "
              "own error"});
  for (const Route& route : schwarzschild_routes()) {
    const Charts at = schwarzschild_charts(lab, route.chart);
    const SweptRay ray = there_and_back(lab, at, b, std::max(50.0, 2.0 * b), route.method);
    Tolerance tolerance = accumulated(ray.end, route.method.setting, condition);
    tolerance.value *= scale;
    claim.traced({*at.transport, route.method, ray.end}, scale * traced_deflection(ray, b), tolerance);
  }
}

}  // namespace xpr::papers
