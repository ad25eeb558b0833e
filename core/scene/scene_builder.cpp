// The parts of a scene that stand alone: header, camera, observer, sky, film.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/io/errors.hpp"
#include "core/scene/colour_check.hpp"
#include "core/scene/scene_host.hpp"
#include "metrics/catalogue.hpp"

namespace xpr {
namespace {

/// Memory of a pixel of the film with everything that is kept of it while a frame is made.
constexpr double pixel_bytes = 240.0;
constexpr double most_film_bytes = 16.0 * 1024.0 * 1024.0 * 1024.0;

/// Below this sine of the angle between two directions none is perpendicular to both with any accuracy.
constexpr double least_sine = 1e-9;

std::string size_text(double bytes) {
  constexpr std::array<std::string_view, 5> units{"kB", "MB", "GB", "TB", "PB"};
  std::size_t k = 0;
  for (bytes /= 1e3; bytes >= 1e3 && k + 1 < units.size(); ++k) bytes /= 1e3;
  return fmt::format("{:.3g} {}", bytes, units[k]);
}

void need(bool good, const SourcePlace& place, std::string_view key, const std::string& what) {
  if (!good) place.fail(key, what);
}

bool is_cartesian(const Card& card) {
  return std::all_of(card.coordinates.begin() + 1, card.coordinates.end(),
                     [](const Coordinate& c) { return c.kind == CoordinateKind::length; });
}

}  // namespace

SceneHeader SceneBuilder::finished_header() const {
  SceneHeader header = header_.what;
  std::vector<std::string_view> cartesian;
  for (const CatalogueEntry& entry : catalogue()) {
    if (entry.card->metric == spacetime_.what.metric && is_cartesian(*entry.card)) {
      cartesian.push_back(entry.card->chart);
    }
  }
  if (cartesian.empty()) {
    spacetime_.place.fail("metric",
                          fmt::format("{} has no Cartesian chart to build a scene in", spacetime_.what.metric));
  }
  if (header.chart.empty()) header.chart = cartesian.front();
  if (std::find(cartesian.begin(), cartesian.end(), header.chart) == cartesian.end()) {
    header_.place.fail("chart", fmt::format("'{}' is no Cartesian chart of {}; there are {}", header.chart,
                                            spacetime_.what.metric, fmt::join(cartesian, ", ")));
  }
  return header;
}

SceneCamera SceneBuilder::finished_camera() const {
  SceneCamera camera = camera_.what;
  const SourcePlace& place = camera_.place;
  const bool looks = is_finite(camera.forward) && length(camera.forward) > 0.0;
  need(is_finite(camera.position) && std::isfinite(camera.time), place, "position", "is not finite");
  need(looks, place, place.key_line.contains("look_at") ? "look_at" : "forward",
       "gives no direction to look in: it needs to differ from the camera's position");
  camera.forward = normalized(camera.forward);
  const Vec3 right = cross(camera.forward, camera.up);
  need(is_finite(right) && length(right) > least_sine * length(camera.up), place, "up",
       "is parallel to the direction in which the camera looks");
  camera.right = normalized(right);
  camera.up = cross(camera.right, camera.forward);
  const double most_fov = camera.model == CameraModel::fisheye ? 2.0 * std::numbers::pi : std::numbers::pi;
  const bool open = camera.model == CameraModel::pinhole;
  need(camera.fov > 0.0 && (open ? camera.fov < most_fov : camera.fov <= most_fov), place, "fov",
       fmt::format("is {:.6g} degrees, needs more than 0 and {} {:.0f}", camera.fov * 180.0 / std::numbers::pi,
                   open ? "less than" : "at most", most_fov * 180.0 / std::numbers::pi));
  need(camera.half_width > 0.0 && std::isfinite(camera.half_width), place, "half_width",
       fmt::format("is {}, needs > 0", camera.half_width));
  return camera;
}

void SceneBuilder::check_observer() const {
  const SceneObserver& observer = observer_.what;
  const SourcePlace& place = observer_.place;
  const double speed = length(observer.velocity);
  if (observer.kind == ObserverKind::boosted) {
    need(speed < 1.0, place, "velocity", fmt::format("has the size {}, needs less than 1, the speed of light", speed));
  } else {
    need(speed == 0.0, place, "velocity", "is for kind = \"boosted\" alone");
  }
  const bool needs_mass = observer.kind == ObserverKind::circular_orbit || observer.kind == ObserverKind::falling;
  need(!needs_mass || spacetime_.what.metric != SceneSpacetime{}.metric, place, "kind",
       fmt::format("is {}, which needs gravity: a [spacetime] with a mass",
                   observer_kind_names[static_cast<std::size_t>(observer.kind)]));
}

void SceneBuilder::check_sky() const {
  const SceneSky& sky = sky_.what;
  const SourcePlace& place = sky_.place;
  check_colour(sky.colour_a, place, "colour_a");
  check_colour(sky.colour_b, place, "colour_b");
  need(sky.squares >= 2 && sky.squares <= 3600 && sky.squares % 2 == 0, place, "squares",
       fmt::format("is {}, needs an even number from 2 to 3600", sky.squares));
  need(sky.line_width > 0.0 && sky.line_width < std::numbers::pi / 2.0, place, "line_width",
       "needs more than 0 and less than 90 degrees");
  need(sky.kind == SkyKind::image || sky.file.empty(), place, "file", "is for kind = \"image\" alone");
  need(sky.kind != SkyKind::image || sky.image != nullptr, place, "file", "is missing: kind = \"image\" needs one");
}

SceneFilm SceneBuilder::finished_film() const {
  SceneFilm film = film_.what;
  const SourcePlace& place = film_.place;
  constexpr double most_edge = 1e6;
  if (flags_.scale) film.scale = *flags_.scale;
  if (flags_.samples) film.samples = *flags_.samples;
  for (const auto& [key, size] : {std::pair{"width", film.width}, {"height", film.height}}) {
    need(size >= 1, place, key, fmt::format("is {}: the film has no area; needs 1 or more", size));
  }
  need(film.scale > 0.0 && std::isfinite(film.scale), place, "scale", fmt::format("is {}, needs > 0", film.scale));
  const double columns = static_cast<double>(film.width) * film.scale;
  const double rows = static_cast<double>(film.height) * film.scale;
  const double bytes = columns * rows * pixel_bytes;
  need(bytes <= most_film_bytes && columns <= most_edge && rows <= most_edge, place, "width",
       fmt::format(
           "and height make {:.0f} x {:.0f} pixels, which need {} of memory; at most {} and {:.0f} pixels an edge",
           columns, rows, size_text(bytes), size_text(most_film_bytes), most_edge));
  need(film.samples >= 1 && film.samples <= 65536, place, "samples",
       fmt::format("is {}, needs 1 to 65536 rays a pixel", film.samples));
  need(film.tile >= 1 && film.tile <= 4096, place, "tile", fmt::format("is {}, needs 1 to 4096 pixels", film.tile));
  need(film.seed >= 0, place, "seed", fmt::format("is {}, needs 0 or more", film.seed));
  if (film.aovs.empty()) {
    for (std::size_t k = 0; k < aov_names.size(); ++k) film.aovs.push_back(static_cast<Aov>(k));
  }
  std::sort(film.aovs.begin(), film.aovs.end());
  film.aovs.erase(std::unique(film.aovs.begin(), film.aovs.end()), film.aovs.end());
  return film;
}

std::shared_ptr<const SceneSnapshot> SceneBuilder::finish() const {
  auto scene = std::make_shared<SceneSnapshot>();
  check_spacetime();
  scene->header = finished_header();
  scene->camera = finished_camera();
  check_observer();
  scene->observer = observer_.what;
  scene->spacetime = spacetime_.what;
  std::sort(scene->spacetime.parameters.begin(), scene->spacetime.parameters.end());
  scene->fields = finished_fields();
  scene->transport = finished_transport();
  scene->materials = finished_materials();
  finish_instances(*scene);
  check_sky();
  scene->sky = sky_.what;
  scene->film = finished_film();
  finish_research(*scene);
  scene->warnings = warnings_;
  return scene;
}

std::shared_ptr<const SceneSnapshot> make_snapshot(const SceneHost& host, SceneFlags flags) {
  SceneBuilder builder;
  builder.set_flags(std::move(flags));
  host.describe(builder);
  return builder.finish();
}

}  // namespace xpr
