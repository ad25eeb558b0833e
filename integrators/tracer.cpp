#include "integrators/tracer.hpp"

#include "integrators/ray_trace.hpp"
#include "metrics/scalar/elementary.hpp"

namespace xpr {
namespace {

[[nodiscard]] bool is_angle(CoordinateKind kind) {
  return kind == CoordinateKind::polar_angle || kind == CoordinateKind::azimuth || kind == CoordinateKind::latitude;
}

}  // namespace

std::array<double, 8> component_units(const Spacetime& spacetime, const PhaseState<double>& y, double length_unit) {
  double momentum = abs(y[4]);
  if (momentum == 0.0) {
    for (std::size_t i = 5; i < 8; ++i) momentum = abs(y[i]) > momentum ? abs(y[i]) : momentum;
  }
  std::array<double, 8> unit{};
  for (std::size_t mu = 0; mu < 4; ++mu) {
    const bool angle = is_angle(spacetime.card().coordinates[mu].kind);
    unit[mu] = angle ? 1.0 : length_unit;
    unit[4 + mu] = angle ? momentum * length_unit : momentum;
  }
  return unit;
}

ErrorScale error_scale(const Spacetime& spacetime, const PhaseState<double>& start, const TraceSettings& settings) {
  const std::array<double, 8> unit = component_units(spacetime, start, settings.length_unit);
  ErrorScale scale;
  for (std::size_t i = 0; i < 8; ++i) {
    scale.absolute[i] = settings.tol * unit[i];
    const bool relative = i < 4 && !is_angle(spacetime.card().coordinates[i].kind);
    scale.relative[i] = relative ? settings.tol : 0.0;
  }
  if (!settings.grade_time) scale.absolute[0] = unbounded;
  return scale;
}

RayEnd trace_ray(const Spacetime& spacetime, const PhaseState<double>& start, int sheet, const TraceSettings& settings,
                 std::span<const Event> events, const std::function<void(const StepView&)>& observer) {
  RayTrace ray(spacetime, settings, events, observer);
  const std::optional<Status> status = ray.begin(start, sheet);
  return ray.end(status ? *status : ray.go_on());
}

}  // namespace xpr
