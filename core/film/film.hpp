// The film: every pixel of a picture, by tiles that threads share. No number depends on tiles, threads or lanes.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/film/film_tracer.hpp"
#include "core/scene/snapshot.hpp"

namespace xpr {

/// A named plane of numbers, one a pixel, row by row from the lower left.
struct FilmPlane {
  std::string name;  ///< as in image files: "R", "depth", "normal.x", ...
  std::string units;
  std::string long_name;
  std::vector<double> values;
};

/// What a frame cost and what became of its pixels.
struct FilmTelemetry {
  std::array<std::int64_t, film_class_names.size()> classes{};
  std::array<std::int64_t, status_names.size()> statuses{};
  std::int64_t rays = 0;
  std::int64_t steps = 0;
  GeometryCounts geometry;

  FilmTelemetry& operator+=(const FilmTelemetry& other);
};

struct FilmFrame {
  int columns = 0;
  int rows = 0;
  std::vector<FilmPlane> planes;  ///< colour first, then the AOVs asked for
  FilmTelemetry telemetry;

  /// A plane by name; null where the frame has none of that name.
  [[nodiscard]] const FilmPlane* plane(std::string_view name) const;
};

/// What makes a record's colour.
using Shader = std::function<Colour(const RayRecord&)>;

struct FilmOptions {
  int threads = 0;  ///< 0: one for each core
  std::uint64_t seed = 1;
  std::function<void(std::int64_t done, std::int64_t tiles)> progress = {};
  std::function<bool()> interrupted = {};
};

/// Where sample s of n of a pixel lies in it, both in (0, 1): the first in the middle, the others spread evenly with a
/// jitter that depends on seed, pixel and s only.
[[nodiscard]] std::array<double, 2> sample_place(std::uint64_t seed, std::uint64_t pixel, std::int64_t s,
                                                 std::int64_t n);

/// Exposes a frame. AOVs are of the middle of each pixel, whatever the number of samples; the colour is the samples'
/// mean. Throws Interrupted where asked to stop.
[[nodiscard]] FilmFrame expose(const FilmTracer& tracer, const SceneFilm& film, const Shader& shader,
                               const FilmOptions& options);

}  // namespace xpr
