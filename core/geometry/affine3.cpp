#include "core/geometry/affine3.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace xpr {

double Affine3::norm() const {
  const auto row = [&](std::size_t i) { return std::fabs(x_axis[i]) + std::fabs(y_axis[i]) + std::fabs(z_axis[i]); };
  return std::max({row(0), row(1), row(2)});
}

Affine3 Affine3::inverse() const {
  if (!is_finite(x_axis) || !is_finite(y_axis) || !is_finite(z_axis) || !is_finite(shift)) {
    throw std::invalid_argument("a transform has an element that is not finite");
  }
  const double volume = determinant();
  const double box = length(x_axis) * length(y_axis) * length(z_axis);
  // Below this the cross products have no digit that rounding did not make.
  constexpr double least_volume = 0x1p-46;
  if (!(std::fabs(volume) > least_volume * box)) {
    throw std::invalid_argument(fmt::format(
        "a transform has no inverse: its axes span a volume of {} where their lengths make {}", volume, box));
  }
  const Vec3 a = (1.0 / volume) * cross(y_axis, z_axis);
  const Vec3 b = (1.0 / volume) * cross(z_axis, x_axis);
  const Vec3 c = (1.0 / volume) * cross(x_axis, y_axis);
  Affine3 out{{a.x, b.x, c.x}, {a.y, b.y, c.y}, {a.z, b.z, c.z}, {}};
  out.shift = -out.direction(shift);
  return out;
}

}  // namespace xpr
