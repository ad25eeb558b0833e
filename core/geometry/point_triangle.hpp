// The point of a triangle that is nearest to another point: [Ericson2005], by the regions of corners, edges and face.
#pragma once

#include <array>

#include "core/geometry/scene_geometry.hpp"

namespace xpr {

[[nodiscard]] Vec3 nearest_on_triangle(const Vec3& p, const std::array<Vec3, 3>& corners);

/// `best`, or the triangle where it is nearer to p.
[[nodiscard]] inline NearestSurface nearer(const NearestSurface& best, const Vec3& p,
                                           const std::array<Vec3, 3>& corners, std::uint32_t instance,
                                           std::uint32_t triangle) {
  const Vec3 there = nearest_on_triangle(p, corners);
  const double distance = length(p - there);
  const bool first = distance < best.distance ||
                     (distance == best.distance &&
                      (instance < best.instance || (instance == best.instance && triangle < best.triangle)));
  return first ? NearestSurface{distance, there, instance, triangle} : best;
}

}  // namespace xpr
