// `tier0_kick_drift`: the stepper of older renderers as it was, for previews and as a measured control. It is Euler's
// rule with the direction renormalised: first order in end position at fixed arc length.
//   h = clamp(step_length / (1 + gain |a|), min_step, max_step), doubled (low_curvature_boost) but at most max_step
//       where |a_perp| < low_curvature,   v <- normalise(v + h a),   x <- x + h v,   a = grad ln n
// As h -> 0 its rays become those of FieldMedium.
#pragma once

#include <functional>
#include <optional>

#include "core/geometry/vec3.hpp"
#include "integrators/status.hpp"
#include "metrics/fields/field_model.hpp"

namespace xpr {

struct KickDriftSettings {
  int max_steps = 64;
  double step_length = 0.25;
  double min_step = 0.05;
  double max_step = 0.5;
  double gain = 0.05;
  double low_curvature = 0.05;
  double low_curvature_boost = 2.0;
  std::optional<double> acceleration_cap = 50.0;  ///< none in Research Mode
  double max_distance = 1e30;                     ///< of arc length
};

/// Where such a ray is.
struct KickDriftState {
  Vec3 position;
  Vec3 direction;  ///< unit
  double travelled = 0.0;
  int steps = 0;
};

/// One step; it is cut where max_distance is reached.
[[nodiscard]] KickDriftState kick_drift_step(const FieldModel& fields, const KickDriftSettings& settings,
                                             const KickDriftState& from);

struct KickDriftEnd {
  Status status =
      Status::max_steps;  ///< max_affine at max_distance, captured in an absorbing core, hit if `visit` says
  KickDriftState state;
};

/// Steps until the ray ends. `visit` sees both ends of every step and answers whether to go on; the ray ends as `hit`
/// where it does not. Throws std::invalid_argument for settings that make no sense.
[[nodiscard]] KickDriftEnd trace_kick_drift(
    const FieldModel& fields, const Vec3& from, const Vec3& direction, const KickDriftSettings& settings,
    const std::function<bool(const KickDriftState& begin, const KickDriftState& end)>& visit = {});

}  // namespace xpr
