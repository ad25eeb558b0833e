#include "core/geometry/bvh4.hpp"

#include <cmath>
#include <limits>
#include <numeric>

namespace xpr {
namespace {

constexpr std::size_t bins = 16;

struct Bin {
  Box3 box;
  std::uint32_t count = 0;
};

/// Which bin a centre falls into.
struct Binning {
  double lo = 0.0, scale = 0.0;
  std::size_t axis = 0;

  Binning(const Box3& centres, std::size_t along) : lo(centres.lo[along]), axis(along) {
    const double extent = centres.hi[along] - lo;
    scale = extent > 0.0 ? static_cast<double>(bins) / extent : 0.0;
    if (!std::isfinite(scale)) scale = 0.0;
  }
  [[nodiscard]] std::size_t operator()(const Vec3& centre) const {
    return std::min(bins - 1, static_cast<std::size_t>((centre[axis] - lo) * scale));
  }
};

/// The nearest single-precision number that is not above x, or not below it.
[[nodiscard]] float below(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}
[[nodiscard]] float above(double x) { return -below(-x); }

}  // namespace

ThickLine Bvh4::line(const Vec3& origin, const Vec3& direction, double t_max, double margin) const {
  constexpr double least = 1e-200;  // below it a direction counts as zero: 0 / 0 would be neither in nor out
  const Vec3 from = local(origin);
  const double thick = scale_ * margin;
  const auto inverse = [&](std::size_t axis) {
    const double d = scale_ * direction[axis];
    return std::fabs(d) > least ? 1.0 / d : std::copysign(1.0 / least, d);
  };
  const std::array<double, 3> by{inverse(0), inverse(1), inverse(2)};
  const auto shift = [&](std::size_t axis) { return by[axis] < 0.0 ? -thick : thick; };
  return {.near = {by[0] < 0.0 ? 1U : 0U, by[1] < 0.0 ? 3U : 2U, by[2] < 0.0 ? 5U : 4U},
          .near_origin = {from.x + shift(0), from.y + shift(1), from.z + shift(2)},
          .far_origin = {from.x - shift(0), from.y - shift(1), from.z - shift(2)},
          .inverse = {by[0], by[1], by[2]},
          .t_max = t_max};
}

/// Grows a tree of two children a node over ranges of `order_`, then folds it.
class Bvh4Builder {
 public:
  Bvh4Builder(Bvh4& tree, std::span<const Box3> boxes) : tree_(tree), boxes_(boxes), order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    centres_.reserve(boxes.size());
    for (const Box3& box : boxes) centres_.push_back(box.centre());
    const std::uint32_t root = grow(0, static_cast<std::uint32_t>(boxes.size()), 0);
    const Box3& all = tree_.bounds_ = twos_[root].box;
    tree_.centre_ = all.centre();
    const double half = 0.5 * largest_magnitude(all.hi - all.lo);
    if (half > 0.0) tree_.scale_ = std::ldexp(1.0, -std::ilogb(half) - 1);
    fold(root);
  }

 private:
  struct Two {
    Box3 box;
    std::uint32_t begin, end;           // of order_
    std::uint32_t left = 0, right = 0;  // 0: a leaf
  };

  std::uint32_t grow(std::uint32_t begin, std::uint32_t end, std::size_t level) {
    const auto index = static_cast<std::uint32_t>(twos_.size());
    twos_.push_back({{}, begin, end});
    Box3 box, centres;
    for (std::uint32_t i = begin; i < end; ++i) {
      box.add(boxes_[order_[i]]);
      centres.add(centres_[order_[i]]);
    }
    twos_[index].box = box;
    if (end - begin <= Bvh4::leaf_size) return index;
    const std::uint32_t middle = split(begin, end, centres, level);
    const std::uint32_t left = grow(begin, middle, level + 1);
    const std::uint32_t right = grow(middle, end, level + 1);
    twos_[index].left = left;
    twos_[index].right = right;
    return index;
  }

  /// Parts [begin, end) and returns where.
  std::uint32_t split(std::uint32_t begin, std::uint32_t end, const Box3& centres, std::size_t level) {
    // Halving from here on ends 2^31 items on the last level.
    constexpr std::size_t last_free_level = Bvh4::most_levels - 34;
    double least = Box3::infinity;
    Binning best(centres, 0);
    std::size_t boundary = 0;
    for (std::size_t axis = 0; axis < 3 && level < last_free_level; ++axis) {
      const Binning binning(centres, axis);
      if (binning.scale == 0.0) continue;
      const auto [at, cost] = cheapest_boundary(begin, end, binning);
      if (cost < least) {
        least = cost;
        best = binning;
        boundary = at;
      }
    }
    const auto first = order_.begin() + begin, last = order_.begin() + end;
    if (least < Box3::infinity) {
      const auto middle = std::partition(first, last, [&](std::uint32_t i) { return best(centres_[i]) < boundary; });
      if (middle != first && middle != last) return static_cast<std::uint32_t>(middle - order_.begin());
    }
    return begin + (end - begin) / 2;
  }

  /// The bin with which the right side begins at least cost, and that cost.
  [[nodiscard]] std::pair<std::size_t, double> cheapest_boundary(std::uint32_t begin, std::uint32_t end,
                                                                 const Binning& binning) const {
    std::array<Bin, bins> bin;
    for (std::uint32_t i = begin; i < end; ++i) {
      Bin& into = bin[binning(centres_[order_[i]])];
      into.box.add(boxes_[order_[i]]);
      ++into.count;
    }
    // A block of triangles costs as much as one: count blocks.
    const auto cost = [](const Box3& box, std::uint32_t count) {
      return box.half_area() * static_cast<double>((count + Bvh4::leaf_size - 1) / Bvh4::leaf_size);
    };
    std::array<double, bins> left{};
    Bin sum;
    for (std::size_t b = 0; b + 1 < bins; ++b) {
      sum.box.add(bin[b].box);
      sum.count += bin[b].count;
      left[b + 1] = sum.count > 0 ? cost(sum.box, sum.count) : Box3::infinity;
    }
    sum = {};
    std::pair<std::size_t, double> best{0, Box3::infinity};
    for (std::size_t b = bins - 1; b > 0; --b) {
      sum.box.add(bin[b].box);
      sum.count += bin[b].count;
      if (sum.count == 0) continue;
      const double both = left[b] + cost(sum.box, sum.count);
      if (both < best.second) best = {b, both};
    }
    return best;
  }

  /// Makes the node of four for a node of two, and all below; returns its number.
  std::uint32_t fold(std::uint32_t two) {
    const auto index = static_cast<std::uint32_t>(tree_.nodes_.size());
    tree_.nodes_.emplace_back();
    std::array<std::uint32_t, 4> children{two, 0, 0, 0};
    std::size_t count = 1;
    while (count < 4) {
      std::size_t widest = 4;
      for (std::size_t k = 0; k < count; ++k) {
        if (twos_[children[k]].left == 0) continue;
        if (widest == 4 || twos_[children[k]].box.half_area() > twos_[children[widest]].box.half_area()) widest = k;
      }
      if (widest == 4) break;
      children[count++] = twos_[children[widest]].right;
      children[widest] = twos_[children[widest]].left;
    }
    for (std::size_t k = 0; k < 4; ++k) {
      Box3 box;
      if (k < count) box = {tree_.local(twos_[children[k]].box.lo), tree_.local(twos_[children[k]].box.hi)};
      const std::uint32_t child = k < count ? child_of(children[k]) : Bvh4::no_item;
      Bvh4::Node& node = tree_.nodes_[index];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        node.planes[2 * axis][k] = below(box.lo[axis]);
        node.planes[2 * axis + 1][k] = above(box.hi[axis]);
      }
      node.child[k] = child;
    }
    return index;
  }

  std::uint32_t child_of(std::uint32_t two) {
    const Two& from = twos_[two];
    if (from.left != 0) return fold(two);
    Bvh4::Leaf leaf;
    for (std::uint32_t i = from.begin; i < from.end; ++i) leaf.items[leaf.count++] = order_[i];
    tree_.leaves_.push_back(leaf);
    return static_cast<std::uint32_t>(tree_.leaves_.size() - 1) | Bvh4::leaf_bit;
  }

  Bvh4& tree_;
  std::span<const Box3> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Vec3> centres_;
  std::vector<Two> twos_;
};

Bvh4::Bvh4(std::span<const Box3> boxes) {
  if (!boxes.empty()) Bvh4Builder(*this, boxes);
}

}  // namespace xpr
