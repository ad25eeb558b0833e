// Triangles over shared vertices, and the weeding of those that bound nothing.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry/box3.hpp"
#include "core/geometry/vec3.hpp"

namespace xpr {

/// A surface in its own frame. The side from which a triangle's corners go round counter-clockwise is its outside.
struct TriangleMesh {
  std::string name;  ///< a file or a generator, for messages
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< corners, as indices into `vertices`
  std::vector<Vec3> normals;                            ///< one a vertex, for shading; or none
  std::vector<std::array<double, 2>> uv;                ///< one a vertex; or none
  std::vector<std::uint32_t> materials;                 ///< one a triangle, as indices into `material_names`; or none
  std::vector<std::string> material_names;

  /// Throws std::invalid_argument: a corner that is no vertex, a list of a wrong length, more than 2^31 triangles.
  void validate() const;
  [[nodiscard]] std::array<Vec3, 3> corners(std::size_t triangle) const {
    const auto& t = triangles[triangle];
    return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
  }
  /// Of the vertices that triangles use.
  [[nodiscard]] Box3 bounds() const;
};

/// What cleaning found, by the numbers that the triangles had before.
struct MeshDefects {
  std::vector<std::uint32_t> not_finite;  ///< a corner with a coordinate that is NaN or infinite
  std::vector<std::uint32_t> degenerate;  ///< the three corners on one line, to rounding
  std::size_t triangles = 0;              ///< before cleaning
  std::uint32_t first_bad_vertex = 0;     ///< of the first in not_finite

  [[nodiscard]] bool any() const { return !not_finite.empty() || !degenerate.empty(); }
  /// One line: how many were dropped, why, and the first of each kind by name. Empty where there are none.
  [[nodiscard]] std::string text(const std::string& mesh_name) const;
};

/// Drops triangles that have no plane: with a corner that is not finite, or whose least height is within rounding of
/// the largest coordinate of the corners (what they leave open is narrower than what neighbours' edges cover).
[[nodiscard]] MeshDefects drop_defects(TriangleMesh& mesh);

/// Edges, by the place of their ends, that do not have as many triangles on one side as on the other: 0 where the mesh
/// bounds a solid.
[[nodiscard]] std::size_t open_edges(const TriangleMesh& mesh);

}  // namespace xpr
