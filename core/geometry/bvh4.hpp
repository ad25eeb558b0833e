// A tree of boxes, four to a node, and the walk of a thick straight line through it, nearest boxes first.
//
// Split by the surface area heuristic over 16 bins an axis, then folded from two to four children. The tree decides
// only what is looked at, never what is hit: queries widen boxes by a margin that covers all rounding. Cites:
// [Wald2007]
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/box3.hpp"
#include "metrics/scalar/elementary.hpp"

namespace xpr {

/// o + t d for 0 <= t <= t_max, thickened along each axis, in a tree's own frame.
struct ThickLine {
  std::array<std::size_t, 3> near{};   ///< which of a node's planes is met first: 2 axis or 2 axis + 1
  std::array<Pack<4>, 3> near_origin;  ///< origin, moved by the margin so that boxes seem larger
  std::array<Pack<4>, 3> far_origin;
  std::array<Pack<4>, 3> inverse;  ///< 1 / direction; +-1e200 for directions that vanish
  double t_max = 0.0;              ///< may shrink while the walk goes on
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

  /// The line origin + t direction, 0 <= t <= t_max, and all points within `margin` of it along each axis.
  [[nodiscard]] ThickLine line(const Vec3& origin, const Vec3& direction, double t_max, double margin) const;

  /// Calls on_leaf(leaf's number, line) for every leaf whose boxes the line meets, nearer ones first as well as boxes
  /// can tell. on_leaf may shorten line.t_max. Returns how many nodes were looked at. Where it is given, `data` is what
  /// on_leaf will read first: one element a leaf, asked for from memory as soon as the leaf is seen.
  template <class OnLeaf, class Data = char>
  std::size_t walk(ThickLine& line, const OnLeaf& on_leaf, const Data* data = nullptr) const;

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
  static constexpr double most = 1e300;  ///< less than the infinity that stands for a miss

  struct alignas(64) Node {
    std::array<std::array<float, 4>, 6> planes;  ///< lo.x, hi.x, lo.y, hi.y, lo.z, hi.z of four boxes
    std::array<std::uint32_t, 4> child;          ///< a node, a leaf with leaf_bit, or none

    [[nodiscard, gnu::always_inline]] Pack<4> plane(std::size_t which) const {
#if defined(__AVX__)
      return Pack<4>::wrap(reinterpret_cast<Pack<4>::Register>(_mm256_cvtps_pd(_mm_load_ps(planes[which].data()))));
#else
      Pack<4> out;
      for (int k = 0; k < 4; ++k) set_lane(out, k, static_cast<double>(planes[which][static_cast<std::size_t>(k)]));
      return out;
#endif
    }
  };
  struct Visit {
    double t;
    std::uint32_t child;
  };

  /// Puts what is met on the stack, the nearest last, and asks for it from memory.
  template <class Data>
  void put(std::array<Visit, stack_size>& stack, std::size_t& top, const Node& node, const Pack<4>& entry, double limit,
           const Data* data) const {
    const auto t = std::bit_cast<std::array<double, 4>>(entry);
    const std::size_t begin = top;
    for (std::size_t k = 0; k < 4; ++k) {
      if (!(t[k] <= limit)) continue;
      const std::uint32_t child = node.child[k];
      if ((child & leaf_bit) == 0) {
        __builtin_prefetch(&nodes_[child]);
      } else if (data != nullptr) {
        __builtin_prefetch(data + (child & ~leaf_bit));
      }
      std::size_t place = top++;
      for (; place > begin && stack[place - 1].t < t[k]; --place) stack[place] = stack[place - 1];
      stack[place] = {t[k], child};
    }
  }

  /// A point in the tree's frame, where boxes lie within about [-1, 1].
  [[nodiscard]] Vec3 local(const Vec3& p) const { return scale_ * (p - centre_); }

  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
  Box3 bounds_;
  Vec3 centre_;
  double scale_ = 1.0;  ///< a power of two
};

template <class OnLeaf, class Data>
std::size_t Bvh4::walk(ThickLine& line, const OnLeaf& on_leaf, const Data* data) const {
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
      return (node.plane(line.near[axis]) - line.near_origin[axis]) * line.inverse[axis];
    };
    const auto exit = [&](std::size_t axis) {
      return (node.plane(line.near[axis] ^ 1U) - line.far_origin[axis]) * line.inverse[axis];
    };
    const Pack<4> in = max(max(entry(0), entry(1)), max(entry(2), Pack<4>(0.0)));
    const Pack<4> out = min(min(exit(0), exit(1)), min(exit(2), Pack<4>(line.t_max)));
    const Mask<4> met = in <= out;
    if (!any(met)) continue;
    put(stack, top, node, select(met, in, Pack<4>(Box3::infinity)), std::min(line.t_max, most), data);
  }
  return looked_at;
}

template <class OnLeaf>
void Bvh4::walk_from(const Vec3& point, double limit_squared, const OnLeaf& on_leaf) const {
  if (nodes_.empty()) return;
  const Vec3 there = local(point);
  const double unit = scale_ * scale_;
  std::array<Visit, stack_size> stack;
  stack[0] = {0.0, 0};
  std::size_t top = 1;
  while (top > 0) {
    const Visit visit = stack[--top];
    if (visit.t > unit * limit_squared) continue;
    if ((visit.child & leaf_bit) != 0) {
      limit_squared = on_leaf(visit.child & ~leaf_bit);
      continue;
    }
    const Node& node = nodes_[visit.child];
    Pack<4> squared = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Pack<4> p = there[axis];
      const Pack<4> outside = max(max(node.plane(2 * axis) - p, p - node.plane(2 * axis + 1)), Pack<4>(0.0));
      squared += outside * outside;
    }
    put(stack, top, node, squared, std::min(unit * limit_squared, most), static_cast<const char*>(nullptr));
  }
}

}  // namespace xpr
