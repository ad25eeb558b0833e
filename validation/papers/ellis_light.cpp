#include "validation/papers/ellis_light.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "metrics/ellis_exact.hpp"
#include "validation/papers/quadrature.hpp"
#include "validation/papers/schwarzschild_light.hpp"

namespace xpr::papers {

namespace exact = ellis_exact;

double ellis_deflection_by_quadrature(long double b) {
  // dphi = b dl/[r sqrt(r^2 - b^2)] with r^2 = l^2 + 1; r = b/sin t makes it dt/sqrt(1 - sin^2 t/b^2).
  const Integral quarter = integral(
      [b](long double t) {
        const long double s = std::sin(t) / b;
        return 1.0L / std::sqrt((1.0L - s) * (1.0L + s));
      },
      0.0L, std::numbers::pi_v<long double> / 2.0L);
  return static_cast<double>(2.0L * quarter.value - std::numbers::pi_v<long double>);
}

void add_ellis_routes(ClaimSheet& claim, const Lab& lab, double b) {
  constexpr double far = std::numeric_limits<double>::infinity();
  const bool through = b < 1.0;
  for (const Route& route : {Route{"isotropic", {"dop853", 1e-14}}, Route{"proper-distance", {"dopri54", 1e-12}}}) {
    const std::array<NamedValue, 1> values{{{"b0", 1.0}}};
    const Charts at = charts(lab, "ellis", "proper-distance", route.chart, values);
    const double l0 = std::max(50.0, 2.0 * b);
    TraceSettings settings = trace_settings(route.method);
    settings.l_max = l0;
    settings.l_min = -l0;
    const SweptRay ray =
        trace_swept(lab, *at.classical, *at.transport, equatorial_light(*at.classical, *at.transport, l0, b), settings);
    const double tails = exact::swept_angle(1.0, b, ray.start_classical[1], far, false).value +
                         exact::swept_angle(1.0, b, std::abs(ray.end_classical[1]), far, false).value;
    const double swept = std::abs(ray.azimuth()) + tails;
    claim.traced({*at.transport, route.method, ray.end, Status::crossed}, through ? swept : swept - std::numbers::pi,
                 accumulated(ray.end, route.method.setting, 1.0 + b / std::abs(b - 1.0)));
  }
}

}  // namespace xpr::papers
