// Bounds on how fast fields bend light, true everywhere and with every gain in them, and the tree that says which
// fields are where.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/geometry/vec3.hpp"
#include "metrics/fields/field_model.hpp"

namespace xpr {

/// An axis-aligned box; empty where low > high.
struct FieldBox {
  Vec3 low, high;
};

/// No smaller than |grad ln n|, and so than the curvature of any ray, anywhere in the box. Infinite for a power below
/// zero whose rim lies in it.
[[nodiscard]] double curvature_bound(const FieldModel& fields, const FieldBox& box);

/// The radius that a chord of length |B - A| of a curve of at most this curvature needs around it; the chord may be no
/// longer than 2 / curvature. The sagitta of an arc on the chord c is r - sqrt(r^2 - c^2/4), and no curve of less
/// curvature goes further.
[[nodiscard]] double sagitta_bound(double curvature, double chord);

/// The step that keeps the error of position K dt^2 / 2 below epsilon: clamp(sqrt(2 epsilon / max(1e-8, K)), dt_min,
/// dt_max); dt_max where K <= 0.
[[nodiscard]] double step_for_curvature(double curvature, double epsilon, double dt_min, double dt_max);

/// A tree of boxes over the fields' supports. Answers are indices into FieldModel::fields(), ascending.
class FieldTlas {
 public:
  explicit FieldTlas(const FieldModel& fields);

  void query_point(const Vec3& x, std::vector<std::uint32_t>& found) const { query_box({x, x}, found); }
  void query_box(const FieldBox& box, std::vector<std::uint32_t>& found) const;

 private:
  struct Node {
    FieldBox box;
    std::uint32_t first = 0;  ///< leaf: in order_; else the left child, the right one after it
    std::uint32_t count = 0;  ///< 0: no leaf
  };
  void split(std::uint32_t node, std::uint32_t first, std::uint32_t last);

  std::vector<FieldBox> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

/// Bounds in cells of a box, looked up in constant time. Outside the box the answer is the bound of all space, never
/// zero.
class CurvatureBoundGrid {
 public:
  /// Throws std::invalid_argument for an empty box or no cells.
  CurvatureBoundGrid(std::shared_ptr<const FieldModel> fields, const FieldBox& box, std::array<std::size_t, 3> cells);

  /// No smaller than |grad ln n| at x.
  [[nodiscard]] double at(const Vec3& x) const;

 private:
  FieldBox box_;
  std::array<std::size_t, 3> cells_;
  std::vector<double> bounds_;
  double everywhere_;
};

/// grad ln n on a lattice, interpolated linearly between its points: exact on them, off by the square of the cell
/// elsewhere. It knows nothing outside its box, and says so.
class FieldGrid {
 public:
  /// `points` along each axis, at least two. Throws std::invalid_argument.
  FieldGrid(const FieldModel& fields, const FieldBox& box, std::array<std::size_t, 3> points);

  /// Nothing outside the box: ask the fields themselves.
  [[nodiscard]] std::optional<Vec3> at(const Vec3& x) const;
  /// A point of the lattice.
  [[nodiscard]] Vec3 point(std::size_t i, std::size_t j, std::size_t k) const;

 private:
  [[nodiscard]] std::size_t index(std::size_t i, std::size_t j, std::size_t k) const {
    return (i * points_[1] + j) * points_[2] + k;
  }

  FieldBox box_;
  std::array<std::size_t, 3> points_;
  std::vector<Vec3> values_;
};

}  // namespace xpr
