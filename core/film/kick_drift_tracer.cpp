#include "core/film/kick_drift_tracer.hpp"

#include <utility>

#include "metrics/scalar/elementary.hpp"

namespace xpr {

KickDriftTracer::KickDriftTracer(std::shared_ptr<const FieldModel> fields, FilmSpace space,
                                 const SceneGeometry& geometry, const SceneCamera& camera, double aspect,
                                 KickDriftSettings settings, bool has_sky)
    : fields_(std::move(fields)),
      space_(std::move(space)),
      geometry_(geometry),
      view_(*space_.scene, camera, {}, aspect),
      settings_(settings),
      has_sky_(has_sky) {}

void KickDriftTracer::trace(std::span<const ScreenPoint> points, std::span<RayRecord> records,
                            GeometryCounts* counts) const {
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::optional<PhaseState<double>> start = view_.ray(points[k]);
    records[k] = start ? trace_one(*start, counts) : RayRecord{};
  }
}

RayRecord KickDriftTracer::trace_one(const PhaseState<double>& start, GeometryCounts* counts) const {
  const Vec3 from{start[1], start[2], start[3]};
  const Vec3 first = normalized({start[5], start[6], start[7]});
  RayRecord out;
  const auto look = [&](const KickDriftState& begin, const KickDriftState& end) {
    RayPath chord{.degree = 1, .control = {}};
    chord.control[0] = begin.position;
    chord.control[1] = end.position;
    const std::optional<SurfaceHit> hit = geometry_.first_hit(chord, counts);
    if (hit) out.hit = *hit;
    return !hit;
  };
  const KickDriftEnd end = trace_kick_drift(*fields_, from, first, settings_, look);
  out.status = end.status;
  // Running out of distance is what older renderers call a miss.
  if (end.status == Status::max_affine) out.status = Status::escaped;
  out.film_class = film_class_of(out.status, has_sky_);
  out.steps = end.state.steps;
  out.position = out.status == Status::hit ? out.hit.position : end.state.position;
  out.direction = end.state.direction;
  out.deflection = atan2(length(cross(first, out.direction)), dot(first, out.direction));
  if (out.status == Status::hit) out.depth = length(out.hit.position - from);
  if (out.status == Status::hit || out.status == Status::escaped) out.frequency_shift = 1.0;
  return out;
}

}  // namespace xpr
