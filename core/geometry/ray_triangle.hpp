// A straight ray and a triangle, so that edges and corners have no gap: [WoopBenthinWald2013], in double precision.
//
// The triangle is moved and sheared so that the ray becomes the third axis; the edges' functions are then 2 x 2
// determinants of the corners' coordinates. Two triangles see a common edge in opposite directions and find the same
// number with opposite sign, to the bit. Rounding is monotone: fl(a) - fl(b) has the sign of a - b or is zero, and zero
// belongs to the triangle, so that one of two neighbours at least is hit, and one of all around a corner.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/geometry/scene_geometry.hpp"
#include "metrics/scalar/elementary.hpp"

namespace xpr {

/// A ray, its axes in the order in which it is looked along.
struct ShearedRay {
  explicit ShearedRay(const StraightRay& ray) : origin(ray.origin) {
    const Vec3& d = ray.direction;
    const double x = std::fabs(d.x), y = std::fabs(d.y), z = std::fabs(d.z);
    along = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    right = (along + 1) % 3;
    up = (along + 2) % 3;
    shear_right = d[right] / d[along];
    shear_up = d[up] / d[along];
    scale = 1.0 / d[along];
  }

  Vec3 origin;
  std::size_t right, up, along;
  double shear_right, shear_up, scale;
};

/// Corners as [corner][axis]; a scalar or a pack, one triangle a lane.
template <class T>
using Corners = std::array<std::array<T, 3>, 3>;

/// The ray's parameter on the triangle, infinite where it misses, and where the triangle's plane holds the ray. The
/// axes of the corners are in the ray's order: right, up, along. The same bits for every T.
template <class T>
[[nodiscard, gnu::always_inline]] inline T ray_parameter(const ShearedRay& ray, const Corners<T>& corners) {
  // Built at once: packs that are filled one by one are zeroed in memory first.
  const auto sheared = [&ray](const std::array<T, 3>& corner) {
    const T z = corner[2] - ray.origin[ray.along];
    return std::array<T, 3>{(corner[0] - ray.origin[ray.right]) - ray.shear_right * z,
                            (corner[1] - ray.origin[ray.up]) - ray.shear_up * z, z};
  };
  const std::array<T, 3> a = sheared(corners[0]), b = sheared(corners[1]), c = sheared(corners[2]);
  const T zero = 0.0;
  const T u = c[0] * b[1] - c[1] * b[0];
  const T v = a[0] * c[1] - a[1] * c[0];
  const T w = b[0] * a[1] - b[1] * a[0];
  const auto inside = ((u >= zero) & (v >= zero) & (w >= zero)) | ((u <= zero) & (v <= zero) & (w <= zero));
  if (!any(inside)) return Box3::infinity;  // mostly so, and a division is dear
  const T determinant = u + v + w;
  const T t = ray.scale * (u * a[2] + v * b[2] + w * c[2]) / determinant;
  return select(inside & (determinant != zero) & (t >= zero), t, T(Box3::infinity));
}

}  // namespace xpr
