#include "validation/schwarzschild_rays.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "metrics/scalar/elementary.hpp"
#include "metrics/schwarzschild_exact.hpp"

namespace xpr {

namespace exact = schwarzschild_exact;

namespace {
constexpr double mass = 1.0;
constexpr double far = std::numeric_limits<double>::infinity();
}  // namespace

Charts schwarzschild_charts(const Lab& lab, std::string_view transport) {
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

}  // namespace xpr
