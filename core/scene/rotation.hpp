// Rotations as scene files give them: an axis and an angle.
#pragma once

#include "core/geometry/affine3.hpp"

namespace xpr {

/// The rotation by `angle` (radians) about a unit vector, counter-clockwise seen against it.
[[nodiscard]] Affine3 rotation(const Vec3& unit_axis, double angle);

}  // namespace xpr
