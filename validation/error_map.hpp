// A camera's rays traced and solved: for every pixel of a screen before a Kerr or Schwarzschild hole, the ray as a
// method traces it and the same ray in closed form (metrics/kerr_ray_exact.hpp), and how far they are apart.
//
// Angles are compared as directions on the sphere: no wrap of phi, no pole. The condition of a ray is how much its end
// turns, in radians, for a step of M on the screen: every error of a tracer is amplified by it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/camera_screen.hpp"
#include "core/transport.hpp"

namespace xpr {

struct ErrorMapSettings {
  CameraScreen screen;
  TransportSettings transport;  ///< metric, method, tolerance; the chart and r_max are set from the screen
  int threads = 0;              ///< 0: one for each core
  int lanes = 0;                ///< 0: what this machine does best
  std::function<void(std::int64_t done, std::int64_t pixels)> progress = {};
  std::function<bool()> interrupted = {};
};

/// What became of a pixel's ray, by the closed form. Near-critical rays, escaped or captured, are a class of their own.
enum class PixelClass { escaped, captured, near_critical, no_light };
inline constexpr std::array<std::string_view, 4> pixel_class_names = {"escaped", "captured", "near_critical",
                                                                      "no_light"};

/// Rays whose end turns by more than this for a step of M on the screen are near-critical.
inline constexpr double critical_condition = 30.0;

/// One entry a pixel, row by row from the lower left. NaN where there is nothing to compare.
struct ErrorMap {
  int columns = 0;
  int rows = 0;
  std::vector<double> alpha, beta;          ///< in the unit in which M is given
  std::vector<std::int64_t> pixel_class;    ///< PixelClass, by the closed form
  std::vector<std::int64_t> status;         ///< Status of the traced ray
  std::vector<std::int64_t> status_agrees;  ///< 1: traced and exact rays escape, or are captured, alike
  std::vector<double> direction_error;      ///< angle between the ends' directions, radian
  std::vector<double> swept_error;          ///< of the azimuth swept, radian; modulo 2 pi where lambda = 0
  std::vector<double> time_error;           ///< of the elapsed t, in the unit of alpha
  std::vector<double> truth_error;          ///< what the closed form says of its own direction, radian
  std::vector<double> condition;            ///< rad per M; NaN where a neighbour's fate is another
  std::vector<std::int64_t> steps, rejected, evaluations;
  std::string rays_hash;  ///< over what transport put out
};

/// Throws std::invalid_argument for settings that make no sense, Interrupted.
[[nodiscard]] ErrorMap error_map(const ErrorMapSettings& settings);

/// Errors of one class of pixels.
struct ErrorSummary {
  std::string name;
  std::int64_t pixels = 0;
  std::int64_t wrong_status = 0;
  double median = 0.0, p99 = 0.0, most = 0.0;  ///< direction; NaN without pixels
  double swept_median = 0.0, swept_p99 = 0.0, swept_most = 0.0;
  double scaled_median = 0.0, scaled_p99 = 0.0, scaled_most = 0.0;  ///< direction over max(1, condition)
  double steps = 0.0, evaluations = 0.0;                            ///< means
};

/// All pixels with light first, then the classes.
[[nodiscard]] std::vector<ErrorSummary> summary_of(const ErrorMap& map);

}  // namespace xpr
