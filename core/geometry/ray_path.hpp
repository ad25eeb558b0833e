// What transport hands to geometry: a ray's path, step by step, as polynomials, and the segments that enclose it.
#pragma once

#include <array>

#include "core/geometry/vec3.hpp"

namespace xpr {

/// The path over one step, a polynomial in Bernstein form: x(theta) = sum_k binomial(n, k) theta^k (1 - theta)^(n-k)
/// control[k], theta in [0, 1], n = degree. It lies in the convex hull of its control points.
struct RayPath {
  static constexpr int max_degree = 7;  ///< of DOP853's dense output

  int degree = 1;
  std::array<Vec3, max_degree + 1> control{};
};

/// A straight piece that stands for a step: no point of the path between a and b is further than `radius` from the
/// segment ab.
struct RaySegment {
  Vec3 a, b;
  double travelled = 0.0;  ///< Euclidean length of the chain up to b
  double radius = 0.0;     ///< a bound, never below the true distance
};

}  // namespace xpr
