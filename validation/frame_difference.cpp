#include "validation/frame_difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "core/film/tone.hpp"

namespace xpr {
namespace {

/// The number's place among all doubles in their order.
std::int64_t place_of(double x) {
  const auto bits = std::bit_cast<std::int64_t>(x);
  return bits >= 0 ? bits : std::numeric_limits<std::int64_t>::min() - bits;
}

bool same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (std::isnan(a) && std::isnan(b));
}

PlaneDifference difference_of(const FilmPlane& before, const FilmPlane& after, std::vector<std::uint8_t>& moved) {
  PlaneDifference out{.name = before.name};
  for (std::size_t k = 0; k < before.values.size(); ++k) {
    const double a = before.values[k], b = after.values[k];
    if (same(a, b)) continue;
    if (out.pixels++ == 0) out.first = k;
    moved[k] = 1;
    if (std::isnan(a) || std::isnan(b)) {
      out.most = not_measured;
      continue;
    }
    if (!std::isnan(out.most)) out.most = std::max(std::abs(a - b), out.most);
    out.ulps = std::max(ulps_between(a, b), out.ulps);
  }
  return out;
}

std::vector<ClassChange> class_changes(const FilmPlane& before, const FilmPlane& after) {
  std::map<std::pair<std::size_t, std::size_t>, std::int64_t> counts;
  for (std::size_t k = 0; k < before.values.size(); ++k) {
    if (before.values[k] == after.values[k]) continue;
    ++counts[{static_cast<std::size_t>(before.values[k]), static_cast<std::size_t>(after.values[k])}];
  }
  std::vector<ClassChange> out;
  for (const auto& [classes, pixels] : counts) out.push_back({classes.first, classes.second, pixels});
  return out;
}

double mean_colour_difference(const FilmFrame& before, const FilmFrame& after) {
  for (const char* name : {"R", "G", "B"}) {
    if (before.plane(name) == nullptr || after.plane(name) == nullptr) return not_measured;
  }
  const std::vector<std::uint8_t> a = displayed(before), b = displayed(after);
  std::int64_t sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += std::abs(static_cast<int>(a[k]) - static_cast<int>(b[k]));
  return static_cast<double>(sum) / static_cast<double>(a.size());
}

}  // namespace

std::uint64_t ulps_between(double a, double b) {
  const std::int64_t x = place_of(a), y = place_of(b);
  return x > y ? static_cast<std::uint64_t>(x) - static_cast<std::uint64_t>(y)
               : static_cast<std::uint64_t>(y) - static_cast<std::uint64_t>(x);
}

FrameDifference compare_frames(const FilmFrame& before, const FilmFrame& after) {
  if (before.columns != after.columns || before.rows != after.rows) {
    throw std::invalid_argument(
        fmt::format("frames of {} x {} and {} x {} pixels cannot be compared; render both at "
                    "one size",
                    before.columns, before.rows, after.columns, after.rows));
  }
  FrameDifference out;
  out.pixels = std::int64_t{before.columns} * before.rows;
  out.moved.assign(static_cast<std::size_t>(out.pixels), 0);
  for (const FilmPlane& plane : before.planes) {
    const FilmPlane* other = after.plane(plane.name);
    if (other == nullptr) {
      out.gone.push_back(plane.name);
      continue;
    }
    PlaneDifference difference = difference_of(plane, *other, out.moved);
    if (difference.pixels == 0) continue;
    if (plane.name == "class") out.classes = class_changes(plane, *other);
    out.planes.push_back(std::move(difference));
  }
  for (const FilmPlane& plane : after.planes) {
    if (before.plane(plane.name) == nullptr) out.added.push_back(plane.name);
  }
  out.mean_colour = mean_colour_difference(before, after);
  return out;
}

}  // namespace xpr
