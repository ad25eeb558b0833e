#include "core/film/film.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "core/io/errors.hpp"
#include "core/workers.hpp"

namespace xpr {
namespace {

struct PlaneOf {
  Aov aov;
  const char* name;
  const char* units;
  const char* long_name;
  double (*value)(const RayRecord&);
};

double when_hit(const RayRecord& ray, double value) {
  return ray.film_class == FilmClass::geom_hit ? value : not_measured;
}
/// Cosine between the shading normal and the way back to the camera.
double n_dot_v(const RayRecord& ray) { return when_hit(ray, -dot(ray.hit.shading_normal, ray.direction)); }

constexpr std::array<PlaneOf, 13> planes{{
    {Aov::depth, "depth", "1", "straight-line distance from the camera to the hit, in the scene's unit",
     [](const RayRecord& ray) { return ray.depth; }},
    {Aov::normal, "normal.x", "1", "shading normal, x",
     [](const RayRecord& ray) { return when_hit(ray, ray.hit.shading_normal.x); }},
    {Aov::normal, "normal.y", "1", "shading normal, y",
     [](const RayRecord& ray) { return when_hit(ray, ray.hit.shading_normal.y); }},
    {Aov::normal, "normal.z", "1", "shading normal, z",
     [](const RayRecord& ray) { return when_hit(ray, ray.hit.shading_normal.z); }},
    {Aov::n_dot_v, "n_dot_v", "1", "cosine between shading normal and the way back", n_dot_v},
    {Aov::two_sided_n_dot_v, "two_sided_n_dot_v", "1", "its size",
     [](const RayRecord& ray) { return std::abs(n_dot_v(ray)); }},
    {Aov::pixel_class, "class", "1", "what became of the pixel, an index into the class names",
     [](const RayRecord& ray) { return static_cast<double>(ray.film_class); }},
    {Aov::frequency_shift, "frequency_shift", "1", "frequency at the camera over that of an emitter at rest at the end",
     [](const RayRecord& ray) { return ray.frequency_shift; }},
    {Aov::deflection, "deflection", "radian", "angle between the ray's first and last direction",
     [](const RayRecord& ray) { return ray.deflection; }},
    {Aov::swept_angle, "swept_angle", "radian", "azimuth about the z axis swept on the way, turns counted",
     [](const RayRecord& ray) { return ray.swept_angle; }},
    {Aov::null_drift, "null_drift", "1", "largest null residual on the way",
     [](const RayRecord& ray) { return ray.null_drift; }},
    {Aov::steps, "steps", "1", "accepted steps", [](const RayRecord& ray) { return static_cast<double>(ray.steps); }},
    {Aov::owner, "owner", "1", "owner of the surface hit, by its place in the scene",
     [](const RayRecord& ray) { return when_hit(ray, static_cast<double>(ray.hit.owner)); }},
}};

/// The bits of a counter scattered over all 64: one round of splitmix64. Cites: [SteeleLeaFlood2014]
std::uint64_t scattered(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}
/// In (0, 1).
double uniform(std::uint64_t bits) { return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52; }

/// 0, 1/2, 1/4, 3/4, 1/8, ...
double reversed_bits(std::uint64_t n) {
  double value = 0.0;
  for (double unit = 0.5; n != 0; n >>= 1, unit *= 0.5) value += (n & 1U) != 0 ? unit : 0.0;
  return value;
}

struct Tile {
  std::int64_t column, row, columns, rows;
};

std::vector<Tile> tiles_of(const SceneFilm& film) {
  std::vector<Tile> tiles;
  for (std::int64_t row = 0; row < film.rows(); row += film.tile) {
    for (std::int64_t column = 0; column < film.columns(); column += film.tile) {
      tiles.push_back(
          {column, row, std::min(film.tile, film.columns() - column), std::min(film.tile, film.rows() - row)});
    }
  }
  return tiles;
}

/// Exposes tiles into a frame; several at once, each into its own pixels.
class Exposure {
 public:
  Exposure(const FilmTracer& tracer, const SceneFilm& film, const Shader& shader, std::uint64_t seed)
      : tracer_(tracer), film_(film), shader_(shader), seed_(seed) {
    frame_.columns = static_cast<int>(film.columns());
    frame_.rows = static_cast<int>(film.rows());
    const auto pixels = static_cast<std::size_t>(film.columns() * film.rows());
    const auto add = [&](const char* name, const char* units, const char* long_name) {
      frame_.planes.push_back({name, units, long_name, std::vector<double>(pixels, not_measured)});
    };
    add("R", "1", "red, linear");
    add("G", "1", "green, linear");
    add("B", "1", "blue, linear");
    for (const PlaneOf& plane : planes) {
      if (std::find(film.aovs.begin(), film.aovs.end(), plane.aov) == film.aovs.end()) continue;
      add(plane.name, plane.units, plane.long_name);
      values_.push_back(plane.value);
    }
  }

  void expose(const Tile& tile);
  [[nodiscard]] FilmFrame finish() { return std::move(frame_); }

 private:
  const FilmTracer& tracer_;
  const SceneFilm& film_;
  const Shader& shader_;
  std::uint64_t seed_;
  std::vector<double (*)(const RayRecord&)> values_;
  FilmFrame frame_;
  std::mutex telemetry_;
};

void Exposure::expose(const Tile& tile) {
  const std::array<int, 2> size{frame_.columns, frame_.rows};
  const auto pixels = static_cast<std::size_t>(tile.columns * tile.rows);
  std::vector<ScreenPoint> points(pixels);
  std::vector<RayRecord> records(pixels);
  std::vector<Colour> colours(pixels, Colour{});
  FilmTelemetry telemetry;
  for (std::int64_t s = 0; s < film_.samples; ++s) {
    for (std::size_t k = 0; k < pixels; ++k) {
      const std::int64_t column = tile.column + static_cast<std::int64_t>(k) % tile.columns;
      const std::int64_t row = tile.row + static_cast<std::int64_t>(k) / tile.columns;
      const auto [dx, dy] =
          sample_place(seed_, static_cast<std::uint64_t>(row * film_.columns() + column), s, film_.samples);
      points[k] = screen_point(size, static_cast<double>(column) + dx, static_cast<double>(row) + dy);
    }
    tracer_.trace(points, records, &telemetry.geometry);
    for (std::size_t k = 0; k < pixels; ++k) {
      const RayRecord& ray = records[k];
      const Colour colour = shader_(ray);
      for (std::size_t c = 0; c < 3; ++c) colours[k][c] += colour[c];
      telemetry.steps += ray.steps;
      if (s > 0) continue;
      ++telemetry.classes[static_cast<std::size_t>(ray.film_class)];
      ++telemetry.statuses[static_cast<std::size_t>(ray.status)];
      const std::int64_t column = tile.column + static_cast<std::int64_t>(k) % tile.columns;
      const std::int64_t row = tile.row + static_cast<std::int64_t>(k) / tile.columns;
      const auto place = static_cast<std::size_t>((film_.rows() - 1 - row) * film_.columns() + column);
      for (std::size_t a = 0; a < values_.size(); ++a) frame_.planes[3 + a].values[place] = values_[a](ray);
    }
    telemetry.rays += static_cast<std::int64_t>(pixels);
  }
  for (std::size_t k = 0; k < pixels; ++k) {
    const std::int64_t column = tile.column + static_cast<std::int64_t>(k) % tile.columns;
    const std::int64_t row = tile.row + static_cast<std::int64_t>(k) / tile.columns;
    const auto place = static_cast<std::size_t>((film_.rows() - 1 - row) * film_.columns() + column);
    for (std::size_t c = 0; c < 3; ++c) {
      frame_.planes[c].values[place] = colours[k][c] / static_cast<double>(film_.samples);
    }
  }
  // Sums of integers: no order matters.
  const std::scoped_lock lock(telemetry_);
  frame_.telemetry += telemetry;
}

}  // namespace

FilmTelemetry& FilmTelemetry::operator+=(const FilmTelemetry& other) {
  for (std::size_t k = 0; k < classes.size(); ++k) classes[k] += other.classes[k];
  for (std::size_t k = 0; k < statuses.size(); ++k) statuses[k] += other.statuses[k];
  rays += other.rays;
  steps += other.steps;
  geometry.paths += other.geometry.paths;
  geometry.far += other.geometry.far;
  geometry.pieces += other.geometry.pieces;
  geometry.nodes += other.geometry.nodes;
  geometry.triangles += other.geometry.triangles;
  geometry.hits += other.geometry.hits;
  return *this;
}

const FilmPlane* FilmFrame::plane(std::string_view name) const {
  const auto found = std::find_if(planes.begin(), planes.end(), [&](const FilmPlane& p) { return p.name == name; });
  return found == planes.end() ? nullptr : &*found;
}

std::array<double, 2> sample_place(std::uint64_t seed, std::uint64_t pixel, std::int64_t s, std::int64_t n) {
  if (s == 0) return {0.5, 0.5};
  const std::uint64_t of_pixel = scattered(seed ^ scattered(pixel));
  const double strata = static_cast<double>(n - 1);
  const double x =
      (static_cast<double>(s - 1) + uniform(scattered(of_pixel + 2 * static_cast<std::uint64_t>(s)))) / strata;
  // The same shift for all samples of a pixel keeps them even in y.
  const double y = reversed_bits(static_cast<std::uint64_t>(s)) + uniform(scattered(of_pixel + 1));
  return {x, y < 1.0 ? y : y - 1.0};
}

FilmFrame expose(const FilmTracer& tracer, const SceneFilm& film, const Shader& shader, const FilmOptions& options) {
  const std::vector<Tile> tiles = tiles_of(film);
  Exposure exposure(tracer, film, shader, options.seed);
  std::mutex progress;
  std::int64_t done = 0;
  Workers(options.threads).for_blocks(0, tiles.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      if (options.interrupted && options.interrupted())
        throw Interrupted("the frame was interrupted; nothing was written");
      exposure.expose(tiles[k]);
      const std::scoped_lock lock(progress);
      ++done;
      if (options.progress) options.progress(done, static_cast<std::int64_t>(tiles.size()));
    }
  });
  return exposure.finish();
}

}  // namespace xpr
