// Boxes along the axes: what trees of triangles and of instances are made of.
#pragma once

#include <algorithm>
#include <limits>

#include "core/geometry/vec3.hpp"

namespace xpr {

/// All points p with lo <= p <= hi, component by component; empty as it begins.
struct Box3 {
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  Vec3 lo{infinity, infinity, infinity};
  Vec3 hi{-infinity, -infinity, -infinity};

  constexpr void add(const Vec3& p) {
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y), std::min(lo.z, p.z)};
    hi = {std::max(hi.x, p.x), std::max(hi.y, p.y), std::max(hi.z, p.z)};
  }
  constexpr void add(const Box3& other) {
    add(other.lo);
    add(other.hi);
  }
  [[nodiscard]] constexpr bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }
  [[nodiscard]] constexpr Vec3 centre() const { return 0.5 * (lo + hi); }
  /// Half of the surface: to it the chance that a random line meets the box is proportional. 0 where empty.
  [[nodiscard]] constexpr double half_area() const {
    if (empty()) return 0.0;
    const Vec3 side = hi - lo;
    return side.x * side.y + side.y * side.z + side.z * side.x;
  }
  /// The largest |coordinate|, 0 where empty.
  [[nodiscard]] constexpr double magnitude() const {
    return empty() ? 0.0 : std::max({-lo.x, -lo.y, -lo.z, hi.x, hi.y, hi.z});
  }
  [[nodiscard]] constexpr Box3 grown(double margin) const {
    const Vec3 m{margin, margin, margin};
    return {lo - m, hi + m};
  }
  [[nodiscard]] constexpr bool contains(const Vec3& p) const {
    return lo.x <= p.x && p.x <= hi.x && lo.y <= p.y && p.y <= hi.y && lo.z <= p.z && p.z <= hi.z;
  }
  [[nodiscard]] constexpr bool overlaps(const Box3& o) const {
    return lo.x <= o.hi.x && o.lo.x <= hi.x && lo.y <= o.hi.y && o.lo.y <= hi.y && lo.z <= o.hi.z && o.lo.z <= hi.z;
  }
};

}  // namespace xpr
