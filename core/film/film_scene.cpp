#include "core/film/film_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "core/film/kick_drift_tracer.hpp"
#include "core/film/shading.hpp"
#include "core/transport.hpp"
#include "integrators/batch_tracer.hpp"
#include "metrics/catalogue.hpp"
#include "metrics/fields/field_medium.hpp"

namespace xpr {
namespace {

/// Metrics of the catalogue that are a medium's in flat space: clocks and emitters do not feel them.
constexpr std::array<std::string_view, 3> media{"medium-uniform", "luneburg", "maxwell-fisheye"};

std::shared_ptr<const Spacetime> chart_of(const SceneSpacetime& spacetime, std::string_view chart) {
  std::vector<NamedValue> values;
  for (const auto& [name, value] : spacetime.parameters) values.push_back({name, value});
  return make_spacetime(spacetime.metric, chart, values);
}

FilmSpace space_of(const SceneSnapshot& scene, const std::shared_ptr<const FieldModel>& fields) {
  if (!scene.fields.sources.empty()) {
    const std::shared_ptr<const Spacetime> medium = make_field_spacetime(fields);
    return {medium, medium, true};
  }
  const std::string& metric = scene.spacetime.metric;
  FilmSpace space;
  space.scene = chart_of(scene.spacetime, scene.header.chart);
  const std::string_view carried =
      scene.transport.chart.empty() ? transport_chart(metric, false) : std::string_view(scene.transport.chart);
  // The two Kerr-Schild charts of a hole that does not turn differ in t alone.
  if (metric == "schwarzschild" && carried == "kerr-schild-outgoing" && space.scene->card().chart == "kerr-schild") {
    space.scene = chart_of(scene.spacetime, carried);
  }
  space.transport = carried == space.scene->card().chart ? space.scene : chart_of(scene.spacetime, carried);
  space.medium = std::find(media.begin(), media.end(), metric) != media.end();
  return space;
}

double distance_of(const SceneCamera& camera) { return length(camera.position); }

FilmTracerSettings tracer_settings(const SceneSnapshot& scene, const FilmSpace& space, int lanes) {
  const SceneTransport& from = scene.transport;
  FilmTracerSettings out;
  out.lanes = lanes;
  out.has_sky = scene.sky.kind != SkyKind::none;
  out.trace.method = from.method;
  out.trace.tol = from.tol;
  out.trace.step = from.step;
  out.trace.max_steps = from.max_steps;
  out.trace.projection = from.project.value_or(Projection::none);
  out.trace.length_unit = length_unit_of(*space.scene);
  out.trace.r_min = from.r_min ? from.r_min : space.transport->default_r_min();
  out.trace.r_max = from.r_max.value_or(std::max(1000.0 * out.trace.length_unit, 2.0 * distance_of(scene.camera)));
  return out;
}

KickDriftSettings preview_settings(const SceneSnapshot& scene) {
  KickDriftSettings out = scene.transport.preview;
  if (scene.research.config.research_enabled) out.acceleration_cap = std::nullopt;
  if (scene.transport.r_max) out.max_distance = *scene.transport.r_max;
  return out;
}

}  // namespace

FilmScene::FilmScene(std::shared_ptr<const SceneSnapshot> scene, const SceneGeometry& geometry, int lanes)
    : scene_(std::move(scene)), lanes_(lanes == 0 ? best_lanes() : lanes) {
  const double aspect = static_cast<double>(scene_->film.columns()) / static_cast<double>(scene_->film.rows());
  const auto fields = std::make_shared<const FieldModel>(scene_->fields);
  const FilmSpace space = space_of(*scene_, fields);
  if (scene_->transport.tier > 0) {
    tracer_ = std::make_unique<GeodesicTracer>(space, geometry, scene_->camera, scene_->observer, aspect,
                                               tracer_settings(*scene_, space, lanes_));
    return;
  }
  if (scene_->fields.sources.empty() && scene_->spacetime.metric != "minkowski") {
    throw std::invalid_argument("tier 0 steps through fields and flat space only; tiers 1 and 2 know " +
                                scene_->spacetime.metric);
  }
  if (scene_->observer.kind != ObserverKind::at_rest) {
    throw std::invalid_argument("tier 0 knows the static observer only");
  }
  tracer_ = std::make_unique<KickDriftTracer>(fields, space, geometry, scene_->camera, aspect,
                                              preview_settings(*scene_), scene_->sky.kind != SkyKind::none);
}

Shader FilmScene::shader() const {
  return [scene = scene_](const RayRecord& ray) { return colour_of(*scene, ray); };
}

}  // namespace xpr
