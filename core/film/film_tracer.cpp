#include "core/film/film_tracer.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/film/geometry_watch.hpp"
#include "integrators/batch_tracer.hpp"
#include "metrics/chart_map.hpp"
#include "metrics/scalar/elementary.hpp"

namespace xpr {
namespace {

/// The unit direction in which a point of phase space moves.
Vec3 heading(const Spacetime& chart, const PhaseState<double>& y) {
  const Vec4<double> tangent = raise_index(chart.inverse_metric(y.x()), y.p());
  return normalized({tangent[1], tangent[2], tangent[3]});
}

double angle_between(const Vec3& a, const Vec3& b) { return atan2(length(cross(a, b)), dot(a, b)); }

}  // namespace

GeodesicTracer::GeodesicTracer(FilmSpace space, const SceneGeometry& geometry, const SceneCamera& camera,
                               const SceneObserver& observer, double aspect, FilmTracerSettings settings)
    : space_(std::move(space)),
      geometry_(geometry),
      view_(*space_.scene, camera, observer, aspect),
      settings_(std::move(settings)) {
  if (space_.medium && observer.kind != ObserverKind::at_rest) {
    throw std::invalid_argument(
        "observer: within a medium only a static one; its metric is that of light, not of clocks");
  }
  if (space_.scene->card().chart == space_.transport->card().chart) return;
  map_ = [from = space_.transport, to = space_.scene](const Vec4<double>& x, int sheet) {
    const Vec4<double> there = change_chart(*from, *to, PhaseState<double>(x, {}), sheet).state.x();
    return Vec3{there[1], there[2], there[3]};
  };
  accuracy_ = 1e-12 * settings_.trace.r_max.value_or(1.0);
}

void GeodesicTracer::trace(std::span<const ScreenPoint> points, std::span<RayRecord> records,
                           GeometryCounts* counts) const {
  std::vector<PhaseState<double>> starts;
  std::vector<BatchRay> rays;
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < points.size(); ++k) {
    records[k] = {};
    const std::optional<PhaseState<double>> start = view_.ray(points[k]);
    if (!start) continue;
    ChartState departure{*start, 1};
    if (map_) departure = change_chart(*space_.scene, *space_.transport, *start);
    starts.push_back(*start);
    rays.push_back({.start = departure.state, .sheet = departure.sheet});
    places.push_back(k);
  }
  std::vector<RayEnd> ends(rays.size());
  GeometryWatch watch(geometry_, rays.size(), map_, accuracy_, counts);
  trace_rays(*space_.transport, rays, settings_.trace, settings_.lanes, ends, &watch);
  for (std::size_t k = 0; k < rays.size(); ++k) records[places[k]] = record(starts[k], ends[k], watch.hit(k));
}

/// The frequency of light at an emitter at rest where the ray ends, in that at the camera.
double GeodesicTracer::emitted(const PhaseState<double>& end, Status status) const {
  if (space_.medium) return 1.0;
  const double at_infinity = std::abs(end[4]);
  if (status == Status::escaped) return space_.scene->card().asymptotically_flat ? at_infinity : not_measured;
  const double g_tt = space_.scene->metric(end.x())(0, 0);
  return g_tt < 0.0 ? at_infinity / std::sqrt(-g_tt) : not_measured;
}

RayRecord GeodesicTracer::record(const PhaseState<double>& start, const RayEnd& end,
                                 const std::optional<SurfaceHit>& hit) const {
  RayRecord out;
  out.status = end.status;
  out.film_class = film_class_of(end.status, settings_.has_sky);
  out.steps = end.steps;
  out.null_drift = end.null_residual_max;
  const bool moved = end.status == Status::hit || end.status == Status::escaped || end.status == Status::captured ||
                     end.status == Status::max_steps || end.status == Status::max_affine;
  if (!moved) return out;
  const PhaseState<double> there =
      end.chart == space_.scene.get() ? end.y : change_chart(*end.chart, *space_.scene, end.y, end.sheet).state;
  out.position = {there[1], there[2], there[3]};
  out.direction = heading(*space_.scene, there);
  out.deflection = angle_between(heading(*space_.scene, start), out.direction);
  out.optical_path = std::abs(there[0] - start[0]);
  out.swept_angle = atan2(there[2], there[1]) - atan2(start[2], start[1]) + 2.0 * pi<double>() * end.windings;
  if (end.status == Status::hit || end.status == Status::escaped)
    out.frequency_shift = 1.0 / emitted(there, end.status);
  if (end.status == Status::hit && hit) {
    out.hit = *hit;
    out.depth = length(hit->position - Vec3{start[1], start[2], start[3]});
  }
  return out;
}

}  // namespace xpr
