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
/// same bits for every T.
template <class T>
[[nodiscard]] T ray_parameter(const ShearedRay& ray, const Corners<T>& corners) {
  std::array<T, 3> x, y, z;
  for (std::size_t i = 0; i < 3; ++i) {
    z[i] = corners[i][ray.along] - ray.origin[ray.along];
    x[i] = (corners[i][ray.right] - ray.origin[ray.right]) - ray.shear_right * z[i];
    y[i] = (corners[i][ray.up] - ray.origin[ray.up]) - ray.shear_up * z[i];
  }
  const T u = x[2] * y[1] - y[2] * x[1];
  const T v = x[0] * y[2] - y[0] * x[2];
  const T w = x[1] * y[0] - y[1] * x[0];
  const T determinant = u + v + w;
  const T t = ray.scale * (u * z[0] + v * z[1] + w * z[2]) / determinant;
  const auto inside = ((u >= T(0.0)) & (v >= T(0.0)) & (w >= T(0.0))) | ((u <= T(0.0)) & (v <= T(0.0)) & (w <= T(0.0)));
  return select(inside & (determinant != T(0.0)) & (t >= T(0.0)), t, T(Box3::infinity));
}

}  // namespace xpr
