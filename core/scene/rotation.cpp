#include "core/scene/rotation.hpp"

#include "metrics/scalar/elementary.hpp"

namespace xpr {

Affine3 rotation(const Vec3& unit_axis, double angle) {
  // Rodrigues: v cos + (k x v) sin + k (k.v)(1 - cos).
  const double c = cos(angle), s = sin(angle);
  const auto turned = [&](const Vec3& v) {
    return c * v + s * cross(unit_axis, v) + ((1.0 - c) * dot(unit_axis, v)) * unit_axis;
  };
  return {turned({1.0, 0.0, 0.0}), turned({0.0, 1.0, 0.0}), turned({0.0, 0.0, 1.0}), {}};
}

}  // namespace xpr
