// Where a path first meets a triangle: roots of Bernstein polynomials, found to rounding.
//
// The signed distance of x(theta) from the triangle's plane (times twice its area) is a polynomial with the
// coefficients N . (c_k - v_0). Where these are of one sign there is no root; where they change sign once there is one,
// found by a bracketing method; elsewhere the interval is halved [LaneRiesenfeld1981]. A value within `band` of zero is
// one whose sign rounding may have made.
//
// Whether a root lies in the triangle is asked of the edges' functions in the coordinate plane that the triangle faces
// most, widened by rounding. Where that fails, the whole stretch of theta on which the plane's polynomial stays within
// its band is asked: two neighbours with slightly different roots near their common edge then cannot both deny it, even
// at grazing incidence, where the roots differ by much. Every hit lies within 4 x rounding of the triangle's own box,
// so that a tree of boxes widened by that much never hides one.
#pragma once

#include <array>
#include <optional>

#include "core/geometry/box3.hpp"
#include "core/geometry/ray_path.hpp"
#include "core/geometry/scene_geometry.hpp"

namespace xpr {

/// What rounding may do to a position on a path near a mesh, both with coordinates up to the given magnitudes: 2^-45 of
/// their sum. The evaluation of a polynomial of degree 7 loses up to 28 units (2^-53) of its largest coefficient, of
/// edges' functions and plane distances (differences of coordinates, products of two of them, three terms) 80, so that
/// 256 leave a factor of three.
[[nodiscard]] constexpr double contact_rounding(double path_magnitude, double mesh_magnitude) {
  return 0x1p-45 * (path_magnitude + mesh_magnitude);
}

struct PathContact {
  double theta = 0.0;
  Contact kind = Contact::crossing;
};

/// The first contact of the path with the triangle, `rounding` as above, the same for all triangles of a mesh.
[[nodiscard]] std::optional<PathContact> first_contact(const RayPath& path, const std::array<Vec3, 3>& corners,
                                                       double rounding);

/// Barycentric coordinates of the point of a triangle's plane below p, seen along the axis that the triangle faces
/// most.
[[nodiscard]] std::array<double, 3> barycentric_at(const std::array<Vec3, 3>& corners, const Vec3& p);

}  // namespace xpr
