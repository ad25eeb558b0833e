// Affine maps of space, as instances of a mesh use them: rotation, scale, shear, mirror, shift.
#pragma once

#include "core/geometry/vec3.hpp"

namespace xpr {

/// p -> x_axis p.x + y_axis p.y + z_axis p.z + shift: the columns of a 3 x 4 matrix. The identity as it begins.
struct Affine3 {
  Vec3 x_axis{1.0, 0.0, 0.0};
  Vec3 y_axis{0.0, 1.0, 0.0};
  Vec3 z_axis{0.0, 0.0, 1.0};
  Vec3 shift{};

  constexpr bool operator==(const Affine3&) const = default;

  [[nodiscard]] constexpr Vec3 direction(const Vec3& v) const { return v.x * x_axis + v.y * y_axis + v.z * z_axis; }
  [[nodiscard]] constexpr Vec3 point(const Vec3& p) const { return direction(p) + shift; }
  /// The transposed linear part applied to v. That of the inverse maps normals: those that point out of a solid still
  /// do, mirrored or not.
  [[nodiscard]] constexpr Vec3 transposed(const Vec3& v) const {
    return {dot(x_axis, v), dot(y_axis, v), dot(z_axis, v)};
  }
  [[nodiscard]] constexpr double determinant() const { return dot(x_axis, cross(y_axis, z_axis)); }
  [[nodiscard]] bool is_identity() const { return *this == Affine3{}; }
  /// The largest factor by which a coordinate of a vector may grow: the maximum norm of the linear part.
  [[nodiscard]] double norm() const;
  /// The inverse map. Throws std::invalid_argument where the map is not finite or has none to working precision.
  [[nodiscard]] Affine3 inverse() const;
};

/// First b, then a.
[[nodiscard]] constexpr Affine3 operator*(const Affine3& a, const Affine3& b) {
  return {a.direction(b.x_axis), a.direction(b.y_axis), a.direction(b.z_axis), a.point(b.shift)};
}

}  // namespace xpr
