// Directions on the sphere as unit vectors, and the angle between two of them: no wrap of phi, no pole.
#pragma once

#include <array>
#include <cmath>

namespace xpr {

using Direction = std::array<double, 3>;

[[nodiscard]] inline Direction unit_direction(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// The angle between two unit vectors, exact for small ones too.
[[nodiscard]] inline double angle_between(const Direction& a, const Direction& b) {
  double apart = 0.0;
  double along = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    apart += (a[i] - b[i]) * (a[i] - b[i]);
    along += (a[i] + b[i]) * (a[i] + b[i]);
  }
  return 2.0 * std::atan2(std::sqrt(apart), std::sqrt(along));
}

}  // namespace xpr
