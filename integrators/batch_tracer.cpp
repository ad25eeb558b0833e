#include "integrators/batch_tracer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "integrators/lane_batch.hpp"

namespace xpr {
namespace {

/// The scalar stepper of the method, to see whether there is a kernel for it.
std::unique_ptr<Stepper> stepper_of(const Spacetime& spacetime, const TraceSettings& settings) {
  const Flow flow = [&spacetime](const PhaseState<double>& y) { return spacetime.flow(y); };
  return make_stepper(settings.method, flow, {});
}

/// Traces in lanes; false where this chart or method has none.
template <int W>
bool traced_in_lanes(const Spacetime& spacetime, std::span<const BatchRay> rays, const TraceSettings& settings,
                     std::span<RayEnd> ends, PathWatch* things) {
  if (spacetime.lane_charts().of_width<W>() == nullptr || settings.stepper_factory) return false;
  std::unique_ptr<LaneKernel<W>> kernel = make_lane_kernel<W>(*stepper_of(spacetime, settings));
  if (!kernel) return false;
  LaneBatch<W>(spacetime, settings, std::move(kernel), things).trace(rays, ends);
  return true;
}

void trace_one_by_one(const Spacetime& spacetime, std::span<const BatchRay> rays, const TraceSettings& settings,
                      std::span<RayEnd> ends, PathWatch* things) {
  RayTrace ray(spacetime, settings);
  ray.look_for(things);
  for (std::size_t k = 0; k < rays.size(); ++k) {
    const std::optional<Status> status = ray.begin(rays[k].start, rays[k].sheet, rays[k].r_max, k);
    ends[k] = ray.end(status ? *status : ray.go_on());
  }
}

}  // namespace

int best_lanes() { return registers::native_lanes; }

bool runs_in_lanes(const Spacetime& spacetime, const TraceSettings& settings) {
  return spacetime.lane_charts().one != nullptr && !settings.stepper_factory &&
         make_lane_kernel<1>(*stepper_of(spacetime, settings)) != nullptr;
}

void trace_rays(const Spacetime& spacetime, std::span<const BatchRay> rays, const TraceSettings& settings, int lanes,
                std::span<RayEnd> ends, PathWatch* things) {
  if (rays.size() != ends.size()) {
    throw std::invalid_argument(fmt::format("{} rays but room for {} ends", rays.size(), ends.size()));
  }
  const auto has_r_max = [](const BatchRay& ray) { return ray.r_max.has_value(); };
  if (!settings.r_max && std::any_of(rays.begin(), rays.end(), has_r_max)) {
    throw std::invalid_argument("a ray has an r_max of its own, needs one in the settings too");
  }
  const auto traced = [&] {
    switch (lanes) {
      case 1:
        return traced_in_lanes<1>(spacetime, rays, settings, ends, things);
      case 2:
        return traced_in_lanes<2>(spacetime, rays, settings, ends, things);
      case 4:
        return traced_in_lanes<4>(spacetime, rays, settings, ends, things);
      case 8:
        return traced_in_lanes<8>(spacetime, rays, settings, ends, things);
      default:
        throw std::invalid_argument(fmt::format("{} lanes, needs 1, 2, 4 or 8", lanes));
    }
  }();
  if (!traced) trace_one_by_one(spacetime, rays, settings, ends, things);
}

}  // namespace xpr
