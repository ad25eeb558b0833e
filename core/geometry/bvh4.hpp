// A tree of boxes, four to a node, and the walk of a thick straight line through it, nearest boxes first.
//
// Split by the surface area heuristic over 16 bins an axis, then folded from two to four children. The tree decides
// only what is looked at, never what is hit: queries widen boxes by a margin that covers all rounding. Cites:
// [Wald2007]
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/box3.hpp"
#include "metrics/scalar/elementary.hpp"

namespace xpr {

/// The points a + t (b - a) or o + t d for 0 <= t <= t_max, and all within `margin` of them along each axis.
struct ThickLine {
  ThickLine(const Vec3& origin, const Vec3& direction, double longest, double margin);

  std::array<std::size_t, 3> near{};   ///< which of a node's planes is met first: 2 axis or 2 axis + 1
  std::array<Pack<4>, 3> near_origin;  ///< origin, moved by the margin so that boxes seem larger
  std::array<Pack<4>, 3> far_origin;
  std::array<Pack<4>, 3> inverse;  ///< 1 / direction; +-1e200 for directions that vanish
  double t_max;                    ///< may shrink while the walk goes on
};

class Bvh4 {
 public:
  static constexpr std::size_t leaf_size = 4;
  static constexpr std::uint32_t no_item = 0xffffffffU;  ///< a number that no item has

  Bvh4() = default;
  /// Over boxes that are not empty; what they hold is known by its index.
  explicit Bvh4(std::span<const Box3> boxes);

  /// The items of a leaf.
  struct Leaf {
    std::array<std::uint32_t, leaf_size> items{};
    std::uint32_t count = 0;
  };
  [[nodiscard]] std::span<const Leaf> leaves() const { return leaves_; }
  [[nodiscard]] std::size_t node_count() const { return nodes_.size(); }
  [[nodiscard]] const Box3& bounds() const { return bounds_; }

  /// Calls on_leaf(leaf's number, line) for every leaf whose boxes the line meets, nearer ones first as well as boxes
  /// can tell. on_leaf may shorten line.t_max. Returns how many nodes were looked at.
  template <class OnLeaf>
  std::size_t walk(ThickLine& line, const OnLeaf& on_leaf) const;

  /// Calls on_leaf(leaf's number) for every leaf with a box nearer than the limit to the point, by the square of the
  /// distance, nearer ones first; on_leaf returns the new limit.
  template <class OnLeaf>
  void walk_from(const Vec3& point, double limit_squared, const OnLeaf& on_leaf) const;

 private:
  friend class Bvh4Builder;
  /// With four children of lesser depth at most, three are put aside on each level.
  static constexpr std::size_t most_levels = 80;
  static constexpr std::size_t stack_size = 3 * most_levels + 4;
  static constexpr std::uint32_t leaf_bit = 0x80000000U;

  struct Node {
    std::array<Pack<4>, 6> planes;       ///< lo.x, hi.x, lo.y, hi.y, lo.z, hi.z of four boxes
    std::array<std::uint32_t, 4> child;  ///< a node, a leaf with leaf_bit, or none
  };
  struct Visit {
    double t;
    std::uint32_t child;
  };

  /// Puts what is met on the stack, the nearest last.
  static void put(std::array<Visit, stack_size>& stack, std::size_t& top, const Node& node,
                  const std::array<double, 4>& t, double limit) {
    const std::size_t begin = top;
    for (std::size_t k = 0; k < 4; ++k) {
      if (!(t[k] <= limit)) continue;
      std::size_t place = top++;
      for (; place > begin && stack[place - 1].t < t[k]; --place) stack[place] = stack[place - 1];
      stack[place] = {t[k], node.child[k]};
    }
  }

  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
  Box3 bounds_;
};

template <class OnLeaf>
std::size_t Bvh4::walk(ThickLine& line, const OnLeaf& on_leaf) const {
  if (nodes_.empty()) return 0;
  std::array<Visit, stack_size> stack;
  stack[0] = {0.0, 0};
  std::size_t top = 1, looked_at = 0;
  while (top > 0) {
    const Visit visit = stack[--top];
    if (visit.t > line.t_max) continue;
    if ((visit.child & leaf_bit) != 0) {
      on_leaf(visit.child & ~leaf_bit, line);
      continue;
    }
    const Node& node = nodes_[visit.child];
    ++looked_at;
    const auto entry = [&](std::size_t axis) {
      return (node.planes[line.near[axis]] - line.near_origin[axis]) * line.inverse[axis];
    };
    const auto exit = [&](std::size_t axis) {
      return (node.planes[line.near[axis] ^ 1U] - line.far_origin[axis]) * line.inverse[axis];
    };
    const Pack<4> in = max(max(entry(0), entry(1)), max(entry(2), Pack<4>(0.0)));
    const Pack<4> out = min(min(exit(0), exit(1)), min(exit(2), Pack<4>(line.t_max)));
    std::array<double, 4> t;
    select(in <= out, in, Pack<4>(Box3::infinity)).store(t.data());
    put(stack, top, node, t, std::min(line.t_max, 1e300));
  }
  return looked_at;
}

template <class OnLeaf>
void Bvh4::walk_from(const Vec3& point, double limit_squared, const OnLeaf& on_leaf) const {
  if (nodes_.empty()) return;
  std::array<Visit, stack_size> stack;
  stack[0] = {0.0, 0};
  std::size_t top = 1;
  while (top > 0) {
    const Visit visit = stack[--top];
    if (visit.t > limit_squared) continue;
    if ((visit.child & leaf_bit) != 0) {
      limit_squared = on_leaf(visit.child & ~leaf_bit);
      continue;
    }
    const Node& node = nodes_[visit.child];
    Pack<4> squared = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Pack<4> p = point[axis];
      const Pack<4> outside = max(max(node.planes[2 * axis] - p, p - node.planes[2 * axis + 1]), Pack<4>(0.0));
      squared += outside * outside;
    }
    std::array<double, 4> t;
    squared.store(t.data());
    put(stack, top, node, t, std::min(limit_squared, 1e300));
  }
}

}  // namespace xpr
