#include "core/geometry/mesh_tree.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/path_envelope.hpp"
#include "core/geometry/triangle_contact.hpp"

namespace xpr {
namespace {

using Four = Pack<4>;
using Four3 = std::array<Four, 3>;

[[nodiscard, gnu::always_inline]] inline Four of(double a, double b, double c, double d) {
  if constexpr (registers::native_lanes >= 4) {
    return Four::wrap(Four::Register{a, b, c, d});
  } else {
    Four out;
    set_lane(out, 0, a);
    set_lane(out, 1, b);
    set_lane(out, 2, c);
    set_lane(out, 3, d);
    return out;
  }
}
[[nodiscard]] Four absolute(const Four& a) { return max(a, -a); }
[[nodiscard]] Four largest(const Four3& a) { return max(max(absolute(a[0]), absolute(a[1])), absolute(a[2])); }
[[nodiscard]] Four sum_of_magnitudes(const Four3& a) { return absolute(a[0]) + absolute(a[1]) + absolute(a[2]); }
[[nodiscard]] Four3 minus(const Four3& a, const Four3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
[[nodiscard]] Four3 spread(const Vec3& p) { return {Four(p.x), Four(p.y), Four(p.z)}; }
[[nodiscard]] Four inner(const Four3& a, const Four3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
[[nodiscard]] Four3 outer(const Four3& a, const Four3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// How far the path has come along its chord at the control points never falls.
[[nodiscard]] bool advances(const RayPath& path, const Vec3& chord) {
  for (std::size_t k = 1; k <= static_cast<std::size_t>(path.degree); ++k) {
    if (!(dot(path.control[k] - path.control[k - 1], chord) >= 0.0)) return false;
  }
  return true;
}

}  // namespace

MeshTree::MeshTree(const TriangleMesh& mesh) : mesh_(&mesh) {
  std::vector<Box3> boxes(mesh.triangles.size());
  for (std::size_t t = 0; t < boxes.size(); ++t) {
    for (const Vec3& p : mesh.corners(t)) boxes[t].add(p);
  }
  tree_ = Bvh4(boxes);
  blocks_.reserve(tree_.leaves().size());
  double sizes = 0.0;
  std::vector<std::uint32_t> place(mesh.vertices.size(), Bvh4::no_item);
  for (const Bvh4::Leaf& leaf : tree_.leaves()) {
    Block& block = blocks_.emplace_back();
    Box3 around;
    for (std::size_t k = 0; k < 4; ++k) {
      block.triangle[k] = leaf.items[std::min<std::size_t>(k, leaf.count - 1)];
      around.add(boxes[block.triangle[k]]);
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t vertex = mesh.triangles[block.triangle[k]][i];
        if (place[vertex] == Bvh4::no_item) {
          place[vertex] = static_cast<std::uint32_t>(vertices_.size());
          const Vec3& p = mesh.vertices[vertex];
          vertices_.push_back({p.x, p.y, p.z});
        }
        block.corner[i][k] = place[vertex];
      }
    }
    sizes += length(around.hi - around.lo);
  }
  // By trial (docs/performance.md): thicker pieces meet more triangles, thinner ones are more pieces.
  constexpr double share_of_leaf = 0.02;
  if (!blocks_.empty()) thin_ = share_of_leaf * sizes / static_cast<double>(blocks_.size());
}

[[gnu::always_inline]] inline Corners<Pack<4>> MeshTree::corners(const Block& block, std::size_t first,
                                                                 std::size_t second, std::size_t third) const {
  const auto corner = [&](const std::array<std::uint32_t, 4>& at) {
    const auto &a = vertices_[at[0]], &b = vertices_[at[1]], &c = vertices_[at[2]], &d = vertices_[at[3]];
    return std::array<Four, 3>{of(a[first], b[first], c[first], d[first]),
                               of(a[second], b[second], c[second], d[second]),
                               of(a[third], b[third], c[third], d[third])};
  };
  return {corner(block.corner[0]), corner(block.corner[1]), corner(block.corner[2])};
}

/// True in lanes whose triangle the capsule around ab is not near to: on one side of its plane, or beyond an edge in
/// it. Both are linear, so that ends and radius bound them; rounding of the normal is relative to the sides' product.
Mask<4> MeshTree::apart(const Corners<Four>& v, const Vec3& a, const Vec3& b, double radius, double rounding) {
  const Four3 first = minus(v[1], v[0]), second = minus(v[2], v[0]);
  const Four3 normal = outer(first, second);
  const Four sides = largest(first) * largest(second);
  const Four3 end_a = spread(a), end_b = spread(b);

  const Four reach = radius * sum_of_magnitudes(normal) + (8.0 * rounding) * sides;
  const Four at_a = inner(normal, minus(end_a, v[0])), at_b = inner(normal, minus(end_b, v[0]));
  Mask<4> out = ((at_a > reach) & (at_b > reach)) | ((at_a < -reach) & (at_b < -reach));
  for (std::size_t i = 0; i < 3 && !all(out); ++i) {
    const Four3 side = minus(v[(i + 1) % 3], v[i]);
    const Four3 inward = outer(normal, side);
    const Four below =
        -((radius + 8.0 * rounding) * sum_of_magnitudes(inward) + (32.0 * rounding) * (sides * largest(side)));
    out = out | ((inner(inward, minus(end_a, v[i])) < below) & (inner(inward, minus(end_b, v[i])) < below));
  }
  return out;
}

/// One path on its way through the tree.
struct MeshTree::Search {
  struct Piece {
    RayPath path;
    double lo, hi;
    int halvings;
  };
  static constexpr int most_halvings = 6;

  const MeshTree& mesh;
  const RayPath& path;
  double rounding;
  GeometryCounts& counts;
  Nearest best;

  void run() {
    std::array<Piece, most_halvings + 2> stack;
    stack[0] = {path, 0.0, 1.0, 0};
    std::size_t top = 1;
    const Box3 reach = mesh.tree_.bounds().grown(8.0 * rounding);
    while (top > 0) {
      const Piece piece = stack[--top];
      if (best.parameter < piece.lo) return;
      if (!control_box(piece.path).overlaps(reach)) continue;
      const RaySegment segment = enclosing_segment(piece.path);
      if (segment.radius > mesh.thin_ && piece.halvings < most_halvings) {
        const auto [first, second] = halves(piece.path);
        const double middle = 0.5 * (piece.lo + piece.hi);
        stack[top++] = {second, middle, piece.hi, piece.halvings + 1};
        stack[top++] = {first, piece.lo, middle, piece.halvings + 1};
      } else {
        follow(piece, segment);
      }
    }
  }

  void follow(const Piece& piece, const RaySegment& segment) {
    ++counts.pieces;
    const Vec3 chord = segment.b - segment.a;
    const bool ordered = advances(piece.path, chord);
    ThickLine line = mesh.tree_.line(segment.a, chord, 1.0, segment.radius + 8.0 * rounding);
    counts.nodes += mesh.tree_.walk(
        line,
        [&](std::uint32_t leaf, ThickLine& walked) {
          const Block& block = mesh.blocks_[leaf];
          const Mask<4> away = apart(mesh.corners(block, 0, 1, 2), segment.a, segment.b, segment.radius, rounding);
          if (all(away)) return;
          const double before = best.parameter;
          for (std::size_t k = 0; k < 4; ++k) {
            const bool repeated = k > 0 && block.triangle[k] == block.triangle[k - 1];
            if (!repeated && !lane(away, static_cast<int>(k))) test(block.triangle[k]);
          }
          // Where the piece goes forward along its chord, what lies farther along than the best hit on it comes later.
          if (ordered && best.parameter < before && best.parameter <= piece.hi) {
            const double come = dot(point(path, best.parameter) - segment.a, chord) / dot(chord, chord);
            walked.t_max = std::min(walked.t_max, come + 8.0 * rounding / length(chord));
          }
        },
        mesh.blocks_.data());
  }

  void test(std::uint32_t triangle) {
    ++counts.triangles;
    const std::optional<PathContact> contact = first_contact(path, mesh.mesh_->corners(triangle), rounding);
    if (!contact || contact->theta > best.parameter) return;
    if (contact->theta == best.parameter && triangle >= best.triangle) return;
    best = {contact->theta, triangle, contact->kind};
  }
};

MeshTree::Nearest MeshTree::first_on(const RayPath& path, double rounding, double longest,
                                     GeometryCounts& counts) const {
  Search search{*this, path, rounding, counts, {.parameter = longest, .triangle = Bvh4::no_item}};
  search.run();
  if (search.best.triangle == Bvh4::no_item) search.best.parameter = Box3::infinity;
  return search.best;
}

MeshTree::Nearest MeshTree::first_on(const StraightRay& ray, double rounding, GeometryCounts& counts) const {
  Nearest best;
  const ShearedRay sheared(ray);
  ThickLine line = tree_.line(ray.origin, ray.direction, ray.t_max, 8.0 * rounding);
  counts.nodes += tree_.walk(
      line,
      [&](std::uint32_t leaf, ThickLine& walked) {
        const Block& block = blocks_[leaf];
        counts.triangles += 4;
        const Four t = ray_parameter(sheared, corners(block, sheared.right, sheared.up, sheared.along));
        if (!any(t <= Four(walked.t_max))) return;
        for (std::size_t k = 0; k < 4; ++k) {
          const double at = lane(t, static_cast<int>(k));
          // Beyond t_max, and infinite where t_max is.
          if (!(at <= walked.t_max) || at == Box3::infinity) continue;
          if (at == best.parameter && block.triangle[k] > best.triangle) continue;
          best = {at, block.triangle[k], Contact::crossing};
          walked.t_max = at;
        }
      },
      blocks_.data());
  return best;
}

}  // namespace xpr
