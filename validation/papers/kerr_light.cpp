#include "validation/papers/kerr_light.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "metrics/kerr_exact.hpp"
#include "validation/families/kerr.hpp"
#include "validation/papers/quadrature.hpp"

namespace xpr::papers {

namespace exact = kerr_exact;

const std::vector<Route>& kerr_routes() {
  static const std::vector<Route> routes{{"kerr-schild", {"dop853", 1e-14}}, {"boyer-lindquist", {"dopri54", 1e-12}}};
  return routes;
}

long double kerr_periapsis(long double a, long double b) {
  // R/r = r^3 + (a^2 - b^2) r + 2 (b - a)^2, positive outside the turning point.
  const auto outside = [a, b](long double r) { return r * r * r + (a * a - b * b) * r + 2.0L * (b - a) * (b - a); };
  // Between its least value and infinity the cubic has one root.
  return zero_of(outside, std::sqrt((b * b - a * a) / 3.0L), std::abs(b) + 1.0L);
}

double kerr_deflection_by_quadrature(long double a, long double b) {
  const long double u2 = 1.0L / kerr_periapsis(a, b);
  const long double c2 = a * a - b * b, c3 = 2.0L * (b - a) * (b - a);
  const Integral swept = integral(
      [=](long double s) {
        const long double w = s * s, u = u2 - w;
        // 1 + c2 u^2 + c3 u^3 with its root at u2 taken out.
        const long double rest = -(2.0L * c2 * u2 + 3.0L * c3 * u2 * u2) + (c2 + 3.0L * c3 * u2) * w - c3 * w * w;
        return 4.0L * (b - 2.0L * (b - a) * u) / ((1.0L - 2.0L * u + a * a * u * u) * std::sqrt(rest));
      },
      0.0L, std::sqrt(u2));
  return static_cast<double>(std::abs(swept.value) - std::numbers::pi_v<long double>);
}

void add_kerr_deflection_routes(ClaimSheet& claim, const Lab& lab, double a, double b) {
  const double condition = kerr_family::deflection_condition(a, b);
  claim.ours("quadrature of dphi/du", kerr_deflection_by_quadrature(a, b),
             {2e-15 * condition, "round-off of b amplified by the ray's condition"});
  constexpr double far = std::numeric_limits<double>::infinity();
  for (const Route& route : kerr_routes()) {
    const Charts at = kerr_family::charts(lab, a, route.chart);
    TraceSettings settings = trace_settings(route.method);
    const double r0 = std::max(50.0, 2.0 * std::abs(b));
    settings.r_max = r0;
    settings.r_min = *at.transport->default_r_min();
    const SweptRay ray = trace_swept(lab, *at.classical, *at.transport,
                                     kerr_family::inward_light(at, r0, 0.5 * std::numbers::pi, b, 0.0), settings);
    const double tails = exact::equatorial_swept_angle(1.0, a, b, ray.start_classical[1], far, false).value +
                         exact::equatorial_swept_angle(1.0, a, b, ray.end_classical[1], far, false).value;
    claim.traced({*at.transport, route.method, ray.end}, std::abs(ray.azimuth() + tails) - std::numbers::pi,
                 accumulated(ray.end, route.method.setting, condition));
  }
}

}  // namespace xpr::papers
