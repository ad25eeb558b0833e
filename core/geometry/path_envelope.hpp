// Paths of steps: points, pieces, and the segments that are proven to enclose them.
#pragma once

#include <utility>

#include "core/geometry/affine3.hpp"
#include "core/geometry/box3.hpp"
#include "core/geometry/ray_path.hpp"

namespace xpr {

/// x(theta).
[[nodiscard]] Vec3 point(const RayPath& path, double theta);
/// dx/dtheta.
[[nodiscard]] Vec3 velocity(const RayPath& path, double theta);
/// The path's parts over [0, 1/2] and [1/2, 1], each over [0, 1] anew.
[[nodiscard]] std::pair<RayPath, RayPath> halves(const RayPath& path);
/// The path under a map: Bernstein form goes with affine maps.
[[nodiscard]] RayPath mapped(const RayPath& path, const Affine3& map);
/// Around the control points, and so around the path.
[[nodiscard]] Box3 control_box(const RayPath& path);

/// The distance of p from the segment ab.
[[nodiscard]] double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b);

/// The chord of the path with a radius that encloses it: the largest distance of a control point from the chord.
///
/// That is a bound: the distance to a convex set, here the chord, is a convex function f of the point; x(theta) = sum_k
/// B_k(theta) c_k is an average of the control points (B_k >= 0, sum 1); so f(x(theta)) <= sum_k B_k f(c_k) <= max_k
/// f(c_k). Rounding is added: 2^-47 of the largest coordinate, eight times what the evaluation of either side can lose.
/// Not below half of the true distance for parabolas, and nearer for them the higher the degree in which they are
/// written. `travelled` is the length of the chain before this segment.
[[nodiscard]] RaySegment enclosing_segment(const RayPath& path, double travelled = 0.0);

/// How loose a segment's radius is: the radius over the path's largest distance from the chord, at `samples` + 1 points
/// of equal steps of theta. Not below 1 but where the samples miss the largest distance.
[[nodiscard]] double slack(const RayPath& path, const RaySegment& segment, int samples = 64);

}  // namespace xpr
