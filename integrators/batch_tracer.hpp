// Many rays through one spacetime, one in each SIMD lane: every lane has its own step size, and takes the next ray as
// soon as its own has ended. The result is that of trace_ray for each ray, bit for bit, whatever the width.
//
// Steps are made W at a time. A step that nothing happens on (no stop, no chart's end, no rejection) is taken in lanes;
// any other is looked at alone, by the code that traces single rays.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "integrators/path_watch.hpp"
#include "integrators/tracer.hpp"

namespace xpr {

struct BatchRay {
  PhaseState<double> start;
  int sheet = 1;
  std::optional<double> r_max = {};  ///< its own, in place of the settings', which must have one then
};

/// The widths of this build.
inline constexpr std::array<int, 4> lane_widths = {1, 2, 4, 8};

/// The width that traces fastest on the machine that this build is for.
[[nodiscard]] int best_lanes();

/// Whether rays of this chart and method are traced in lanes: explicit methods do, with charts made for it. Others are
/// traced one at a time.
[[nodiscard]] bool runs_in_lanes(const Spacetime& spacetime, const TraceSettings& settings);

/// Traces ray k into ends[k], up to the first of the `things` that it meets, if any are given. `lanes` is one of
/// lane_widths. Throws std::invalid_argument as trace_ray does, for
/// other widths, spans of different lengths, and an r_max where the settings have none. One thread; from several at
/// once on different rays.
void trace_rays(const Spacetime& spacetime, std::span<const BatchRay> rays, const TraceSettings& settings, int lanes,
                std::span<RayEnd> ends, PathWatch* things = nullptr);

}  // namespace xpr
