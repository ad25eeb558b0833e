#include "validation/papers/schwarzschild_light.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "metrics/scalar/elementary.hpp"
#include "metrics/schwarzschild_exact.hpp"
#include "validation/papers/quadrature.hpp"

namespace xpr::papers {

namespace exact = schwarzschild_exact;

namespace {
constexpr double mass = 1.0;
constexpr double far = std::numeric_limits<double>::infinity();
}  // namespace

const std::vector<Route>& schwarzschild_routes() {
  static const std::vector<Route> routes{{"kerr-schild", {"dop853", 1e-14}}, {"areal", {"dopri54", 1e-12}}};
  return routes;
}

Charts schwarzschild(const Lab& lab, std::string_view transport) {
  const std::array<NamedValue, 1> values{{{"M", mass}}};
  return charts(lab, "schwarzschild", "areal", transport, values);
}

SweptRay there_and_back(const Lab& lab, const Charts& at, double b, double r0, const MethodAt& method,
                        bool grade_time) {
  TraceSettings settings = trace_settings(method, mass);
  settings.r_max = r0;
  settings.r_min = 2.01 * mass;
  settings.grade_time = grade_time;
  return trace_swept(lab, *at.classical, *at.transport, equatorial_light(*at.classical, *at.transport, r0, b),
                     settings);
}

double traced_deflection(const SweptRay& ray, double b) {
  return std::abs(ray.azimuth()) + exact::swept_angle(mass, b, ray.start_classical[1], far, false).value +
         exact::swept_angle(mass, b, ray.end_classical[1], far, false).value - pi<double>();
}

double deflection_condition(double b) {
  const double h = 1e-3 * (b - exact::critical_impact_parameter(mass).value);
  const double slope = (exact::deflection(mass, b + h).value - exact::deflection(mass, b - h).value) / (2.0 * h);
  return 1.0 + b * std::abs(slope);
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
    const Charts at = schwarzschild(lab, route.chart);
    const SweptRay ray = there_and_back(lab, at, b, std::max(50.0, 2.0 * b), route.method);
    Tolerance tolerance = accumulated(ray.end, route.method.setting, condition);
    tolerance.value *= scale;
    claim.traced({*at.transport, route.method, ray.end}, scale * traced_deflection(ray, b), tolerance);
  }
}

}  // namespace xpr::papers
