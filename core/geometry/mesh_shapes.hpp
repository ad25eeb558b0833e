// Meshes by formula: plane, box, spheres, and shapes of 200,000 triangles for tests of speed. The same bits everywhere.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "core/geometry/triangle_mesh.hpp"
#include "metrics/catalogue.hpp"

namespace xpr {

/// A shape that can be asked for by its key.
struct MeshShape {
  std::string_view key;
  std::string_view text;  ///< what it is, one line
  std::vector<ParameterCard> parameters;
};

/// All of them, in the order in which they are listed.
[[nodiscard]] const std::vector<MeshShape>& mesh_shapes();

/// The shape with the parameters given, the others as its card has them. Closed shapes have their outside outside.
/// Throws std::invalid_argument: an unknown shape or parameter (names the nearest known one), a value out of range (a
/// size that is not positive, a count that is no whole number, more than 2^24 triangles).
[[nodiscard]] TriangleMesh generate_mesh(std::string_view key, std::span<const NamedValue> values = {});

}  // namespace xpr
