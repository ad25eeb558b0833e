// Two frames of one size: which planes and pixels moved, by how much, and what classes turned into what.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/film/film.hpp"

namespace xpr {

/// How a plane moved.
struct PlaneDifference {
  std::string name;
  std::int64_t pixels = 0;  ///< with other bits; two NaN are the same
  double most = 0.0;        ///< largest |difference|; NaN where a pixel is a number in one frame only
  std::uint64_t ulps = 0;   ///< largest distance in doubles between, of pixels that are numbers in both
  std::size_t first = 0;    ///< the first such pixel, row by row from the lower left
};

/// Pixels of one class that are of another now.
struct ClassChange {
  std::size_t before = 0, after = 0;  ///< indices into film_class_names
  std::int64_t pixels = 0;
};

struct FrameDifference {
  std::int64_t pixels = 0;
  std::vector<PlaneDifference> planes;  ///< those that moved
  std::vector<std::string> gone, added;
  std::vector<ClassChange> classes;
  double mean_colour = 0.0;         ///< mean |difference| of R, G, B on the scale of 0 to 255, of what a screen shows
  std::vector<std::uint8_t> moved;  ///< 1 for every pixel of which anything moved

  [[nodiscard]] bool unchanged() const { return planes.empty() && gone.empty() && added.empty(); }
};

/// Throws std::invalid_argument for frames of different sizes.
[[nodiscard]] FrameDifference compare_frames(const FilmFrame& before, const FilmFrame& after);

/// How many doubles lie between two numbers.
[[nodiscard]] std::uint64_t ulps_between(double a, double b);

}  // namespace xpr
