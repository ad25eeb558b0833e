// The tree over one mesh's triangles, in the mesh's frame.
//
// A path goes through it in pieces, halved until their envelopes are about as thin as triangles are large: a capsule
// around each piece's chord is walked through the boxes, triangles are put away four at a time by their planes and
// edges, and what is left is tested on the whole path's curve, so that the hit does not depend on the pieces.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/bvh4.hpp"
#include "core/geometry/ray_triangle.hpp"
#include "core/geometry/scene_geometry.hpp"

namespace xpr {

class MeshTree {
 public:
  /// The mesh must outlive the tree, have finite corners, and validate.
  explicit MeshTree(const TriangleMesh& mesh);

  struct Nearest {
    double parameter = Box3::infinity;
    std::uint32_t triangle = 0;
    Contact contact = Contact::crossing;
  };
  /// The first contact not behind `best`, or best; equal parameters go to the lesser triangle. `rounding` as
  /// contact_rounding has it.
  [[nodiscard]] Nearest first_on(const RayPath& path, double rounding, double longest, GeometryCounts& counts) const;
  [[nodiscard]] Nearest first_on(const StraightRay& ray, double rounding, GeometryCounts& counts) const;

  [[nodiscard]] const Bvh4& tree() const { return tree_; }

 private:
  /// Four triangles of a leaf, in one line of the cache; a leaf with fewer repeats its last.
  struct alignas(64) Block {
    std::array<std::array<std::uint32_t, 4>, 3> corner{};  ///< of vertices_
    std::array<std::uint32_t, 4> triangle{};
  };
  struct Search;

  /// The corners of a block, their axes in the order asked for.
  [[nodiscard]] Corners<Pack<4>> corners(const Block& block, std::size_t first, std::size_t second,
                                         std::size_t third) const;
  [[nodiscard]] static Mask<4> apart(const Corners<Pack<4>>& corners, const Vec3& a, const Vec3& b, double radius,
                                     double rounding);

  const TriangleMesh* mesh_;
  Bvh4 tree_;
  std::vector<Block> blocks_;                    ///< one a leaf
  std::vector<std::array<double, 3>> vertices_;  ///< the mesh's, in the order in which leaves use them
  double thin_ = 0.0;                            ///< pieces of paths are halved until their radius is below
};

}  // namespace xpr
