#include "core/film/sky.hpp"

#include <cmath>

#include "core/scene/sky_image.hpp"
#include "metrics/scalar/elementary.hpp"

namespace xpr {
namespace {

/// How far an angle is from the nearest line of a grid of that spacing.
double off_line(double angle, double spacing) {
  const double part = angle / spacing;
  return std::abs(part - std::round(part)) * spacing;
}

}  // namespace

SkyDirection sky_direction(const Vec3& d) { return {atan2(d.x, -d.z), atan2(d.y, std::sqrt(d.x * d.x + d.z * d.z))}; }

Colour sky_colour(const SceneSky& sky, const Vec3& direction) {
  const SkyDirection at = sky_direction(direction);
  const double spacing = 2.0 * pi<double>() / static_cast<double>(sky.squares);
  switch (sky.kind) {
    case SkyKind::checker: {
      const auto column = static_cast<long>(std::floor(at.longitude / spacing));
      const auto row = static_cast<long>(std::floor(at.latitude / spacing));
      return ((column + row) & 1L) != 0 ? sky.colour_b : sky.colour_a;
    }
    case SkyKind::graticule: {
      // Meridians keep their width towards the poles.
      const double across = off_line(at.longitude, spacing) * cos(at.latitude);
      const double off = std::min(across, off_line(at.latitude, spacing));
      return off < 0.5 * sky.line_width ? sky.colour_b : sky.colour_a;
    }
    case SkyKind::image:
      return sky.image->at(at.longitude, at.latitude);
    case SkyKind::none:
      break;
  }
  return {0.0, 0.0, 0.0};
}

}  // namespace xpr
