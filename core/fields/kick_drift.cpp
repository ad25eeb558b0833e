#include "core/fields/kick_drift.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace xpr {

namespace {

FieldVector<double> place_of(const Vec3& x) { return {x.x, x.y, x.z}; }

void check(const KickDriftSettings& settings) {
  if (!(settings.min_step > 0.0 && settings.min_step <= settings.max_step)) {
    throw std::invalid_argument(fmt::format("min_step = {}, max_step = {}, needs 0 < min_step <= max_step",
                                            settings.min_step, settings.max_step));
  }
  if (!(settings.step_length > 0.0) || !(settings.gain >= 0.0) || !(settings.low_curvature_boost > 0.0)) {
    throw std::invalid_argument(
        fmt::format("step_length = {}, gain = {}, low_curvature_boost = {}, needs a positive "
                    "step and boost and no negative gain",
                    settings.step_length, settings.gain, settings.low_curvature_boost));
  }
}

}  // namespace

KickDriftState kick_drift_step(const FieldModel& fields, const KickDriftSettings& settings,
                               const KickDriftState& from) {
  const FieldVector<double> gradient = fields.evaluate(place_of(from.position)).gradient;
  Vec3 a{gradient[0], gradient[1], gradient[2]};
  double size = length(a);
  if (settings.acceleration_cap && size > *settings.acceleration_cap) {
    a = (*settings.acceleration_cap / size) * a;
    size = *settings.acceleration_cap;
  }
  double h = std::clamp(settings.step_length / (1.0 + size * settings.gain), settings.min_step, settings.max_step);
  const Vec3 across = a - dot(a, from.direction) * from.direction;
  if (length(across) < settings.low_curvature) h = std::min(h * settings.low_curvature_boost, settings.max_step);
  h = std::min(h, settings.max_distance - from.travelled);
  const Vec3 direction = normalized(from.direction + h * a);
  return {from.position + h * direction, direction, from.travelled + h, from.steps + 1};
}

KickDriftEnd trace_kick_drift(
    const FieldModel& fields, const Vec3& from, const Vec3& direction, const KickDriftSettings& settings,
    const std::function<bool(const KickDriftState& begin, const KickDriftState& end)>& visit) {
  check(settings);
  const bool absorbs = fields.absorbs();
  KickDriftState now{from, normalized(direction)};
  while (true) {
    if (!is_finite(now.position) || !is_finite(now.direction)) return {Status::not_finite, now};
    if (absorbs && fields.absorber_distance(place_of(now.position)) < 0.0) return {Status::captured, now};
    if (now.travelled >= settings.max_distance) return {Status::max_affine, now};
    if (now.steps >= settings.max_steps) return {Status::max_steps, now};
    const KickDriftState next = kick_drift_step(fields, settings, now);
    if (visit && !visit(now, next)) return {Status::hit, next};
    now = next;
  }
}

}  // namespace xpr
