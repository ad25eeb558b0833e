// The fields of a scene made ready: ln n(x) = sum_i ln n_i(x) and its gradient, for doubles, lanes and duals.
//
// Across the surfaces where a derivative of ln n jumps (rims, cores, kinks of a curve, the diagonal planes of boxes) an
// integrator must end a step. All of them are one surface here: interface_distance(x), whose size never exceeds the
// distance to the nearest and whose sign is the parity of those that x is inside of (< 0: of an odd number). A ray on
// that side of it whose step looks a little further gets the near side's formula: evaluate_side takes the point as
// being on the ray's side of the surface that is nearest.
//
// A box's radius is r_outer max_i |q_i| / half_size_i; its gradient turns where two of the |q_i| / half_size_i are
// equal.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "metrics/fields/field_profile.hpp"

namespace xpr {

template <class T>
using FieldVector = std::array<T, 3>;

/// ln n and its gradient.
template <class T>
struct IndexAt {
  T log_index = T(0.0);
  FieldVector<T> gradient{T(0.0), T(0.0), T(0.0)};
};

/// A source with its place: what of it depends on x.
class PlacedField {
 public:
  /// Throws std::invalid_argument: the source's name, the value and the allowed range.
  PlacedField(const FieldSource& source, const FieldGains& gains);

  [[nodiscard]] const FieldSource& source() const { return source_; }
  [[nodiscard]] const FieldProfile& profile() const { return profile_; }
  /// Bounds of the support, axis by axis.
  [[nodiscard]] const std::array<std::array<double, 2>, 3>& bounds() const { return bounds_; }
  /// No smaller than |grad r| anywhere: lengths of the source's frame per length of the world.
  [[nodiscard]] double stretch() const { return 1.0 / contraction_; }
  /// Whether ln n depends on the distance from origin() alone.
  [[nodiscard]] bool spherical() const { return spherical_; }
  [[nodiscard]] const FieldVector<double>& origin() const { return source_.world_from_local.origin; }

  /// Where a point is among the source's surfaces.
  template <class T>
  struct Place {
    T r;
    FieldVector<T> local;
    T distance;         ///< to the nearest surface, or less
    PlainOf<T> sign;    ///< of the parity
    PlainOf<T> region;  ///< as FieldProfile counts them
    PlainOf<T> across;  ///< the region beyond the nearest surface
    PlainOf<T> axis;    ///< of a box: the one that |q_i| / half_size_i is largest along
    PlainOf<T> axis_across;
  };

  template <class T>
  [[nodiscard]] Place<T> place(const FieldVector<T>& x) const {
    const FieldVector<T> q = to_local(x);
    if (source_.shape == FieldShape::box) return place_in_box(q);
    const T r = sqrt(square(q[0]) + square(q[1]) + square(q[2]));
    Place<T> at{r, q, T(far_away), 1.0, 0.0, 0.0, 0.0, 0.0};
    find_region(at);
    return at;
  }
  /// Adds ln n and its gradient, by the formulas of the place.
  template <class T>
  void add(const Place<T>& at, IndexAt<T>& sum) const {
    // What is outside everywhere adds nothing: sums are never -0, so leaving it out keeps the bits.
    if (!any(at.region < PlainOf<T>(static_cast<double>(profile_.seams().size())))) return;
    const LogIndex<T> n = profile_.in_region(at.r, at.region);
    sum.log_index = sum.log_index + n.value;
    FieldVector<T> rise;  // n.slope times the gradient of r over q
    if (source_.shape == FieldShape::box) {
      for (std::size_t i = 0; i < 3; ++i) {
        const T slope = n.slope * (copysign(T(1.0), value_of(at.local[i])) * box_scale_[i]);
        rise[i] = select(at.axis == PlainOf<T>(static_cast<double>(i)), slope, T(0.0));
      }
    } else {
      const auto centre = at.r == T(0.0);
      const T per_length = select(centre, T(0.0), n.slope / select(centre, T(1.0), at.r));
      for (std::size_t i = 0; i < 3; ++i) rise[i] = per_length * at.local[i];
    }
    for (std::size_t k = 0; k < 3; ++k) {
      sum.gradient[k] = sum.gradient[k] + (local_from_world_[0][k] * rise[0] + local_from_world_[1][k] * rise[1] +
                                           local_from_world_[2][k] * rise[2]);
    }
  }
  /// The radius at x: |q|, or the box's.
  [[nodiscard]] double radius(const FieldVector<double>& x) const { return place(x).r; }
  /// No larger than the distance from x to the core, negative inside it.
  [[nodiscard]] double core_distance(const FieldVector<double>& x) const {
    return (radius(x) - profile_.r_inner()) * contraction_;
  }

 private:
  static constexpr double far_away = 1e100;

  template <class T>
  [[nodiscard]] FieldVector<T> to_local(const FieldVector<T>& x) const {
    const FieldVector<double>& o = origin();
    const T d0 = x[0] - o[0], d1 = x[1] - o[1], d2 = x[2] - o[2];
    if (only_moved_) return {d0, d1, d2};
    const auto row = [&](const FieldVector<double>& l) { return T(l[0] * d0 + l[1] * d1 + l[2] * d2); };
    return {row(local_from_world_[0]), row(local_from_world_[1]), row(local_from_world_[2])};
  }
  /// Among the seams of the profile.
  template <class T>
  void find_region(Place<T>& at) const {
    using P = PlainOf<T>;
    const std::vector<double>& seams = profile_.seams();
    for (std::size_t j = 0; j < seams.size(); ++j) {
      const P below = P(static_cast<double>(j)), above = P(static_cast<double>(j + 1));
      const auto passed = at.r >= T(seams[j]);
      at.region = select(passed, above, at.region);
      at.sign = select(passed, at.sign, P(-at.sign));
      const T distance = abs(at.r - seams[j]) * contraction_;
      const auto closer = distance < at.distance;
      at.distance = select(closer, distance, at.distance);
      at.across = select(closer, select(passed, below, above), at.across);
    }
  }
  template <class T>
  [[nodiscard]] Place<T> place_in_box(const FieldVector<T>& q) const {
    using P = PlainOf<T>;
    const T m[3] = {abs(q[0]) * box_scale_[0], abs(q[1]) * box_scale_[1], abs(q[2]) * box_scale_[2]};
    // The largest and the second of the three.
    const auto swap = m[1] > m[0];
    T first = select(swap, m[1], m[0]), second = select(swap, m[0], m[1]);
    P axis = select(swap, P(1.0), P(0.0)), next = select(swap, P(0.0), P(1.0));
    const auto above = m[2] > first, between = m[2] > second;
    second = select(above, first, select(between, m[2], second));
    next = select(above, axis, select(between, P(2.0), next));
    first = select(above, m[2], first);
    axis = select(above, P(2.0), axis);
    Place<T> at{first, q, T(far_away), 1.0, 0.0, 0.0, axis, axis};
    find_region(at);
    // The planes in which two are equal: |grad (m_i - m_j)| is at most sqrt(2) of the steepest r. Those where nothing
    // turns count too, so that two sides of a surface always differ in parity.
    constexpr double root_half = 0.7071;
    for (const auto& [i, j] : {std::array<std::size_t, 2>{0, 1}, {1, 2}, {2, 0}}) {
      const T gap = m[i] - m[j];
      at.sign = select(gap < T(0.0), P(-at.sign), at.sign);
      const T distance = abs(gap) * (root_half * contraction_);
      const auto closer = distance < at.distance;
      at.distance = select(closer, distance, at.distance);
      at.across = select(closer, at.region, at.across);
    }
    const auto diagonal = (first - second) * (root_half * contraction_) <= at.distance;
    at.axis_across = select(diagonal, next, axis);
    return at;
  }
  void find_bounds();

  FieldSource source_;
  FieldProfile profile_;
  std::array<FieldVector<double>, 3> local_from_world_{};
  FieldVector<double> box_scale_{};  ///< r_outer / half_size
  double contraction_ = 1.0;
  bool only_moved_ = true;
  bool spherical_ = true;
  std::array<std::array<double, 2>, 3> bounds_{};
};

/// Immutable; safe to share between threads.
class FieldModel {
 public:
  FieldModel() = default;
  /// Throws std::invalid_argument: the source's name, what is wrong, what would be right. Sources that bend nothing
  /// are checked and left out, unless they absorb; absorbing cores that overlap are refused.
  explicit FieldModel(const FieldSet& set);

  [[nodiscard]] const std::vector<PlacedField>& fields() const { return fields_; }

  /// ln n and its gradient.
  template <class T>
  [[nodiscard]] IndexAt<T> evaluate(const FieldVector<T>& x) const {
    IndexAt<T> sum;
    for (const PlacedField& field : fields_) field.add(field.place(x), sum);
    return sum;
  }
  /// The same as seen from the side of the nearest surface that `inside` (an odd parity) names.
  template <class T>
  [[nodiscard]] IndexAt<T> evaluate_side(const FieldVector<T>& x, const MaskOf<T>& inside) const {
    IndexAt<T> sum;
    if (fields_.empty()) return sum;
    const T wanted = select(inside, T(-1.0), T(1.0));
    if (fields_.size() == 1) {
      auto at = fields_[0].place(x);
      cross(MaskOf<T>(at.sign != wanted), at);
      fields_[0].add(at, sum);
      return sum;
    }
    T sign = T(1.0), nearest = T(unbounded_distance), owner = T(-1.0);
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      const auto at = fields_[i].place(x);
      sign = sign * at.sign;
      const auto closer = at.distance < nearest;
      nearest = select(closer, at.distance, nearest);
      owner = select(closer, T(static_cast<double>(i)), owner);
    }
    const MaskOf<T> beyond = sign != wanted;
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      auto at = fields_[i].place(x);
      cross(MaskOf<T>(beyond & (owner == T(static_cast<double>(i)))), at);
      fields_[i].add(at, sum);
    }
    return sum;
  }
  template <class T>
  [[nodiscard]] T interface_distance(const FieldVector<T>& x) const {
    T nearest = T(unbounded_distance);
    PlainOf<T> sign = 1.0;
    for (const PlacedField& field : fields_) {
      const auto at = field.place(x);
      sign = sign * at.sign;
      nearest = select(at.distance < nearest, at.distance, nearest);
    }
    return sign * nearest;
  }
  /// No larger than the distance to the nearest absorbing core, negative inside one; infinite where none absorbs.
  [[nodiscard]] double absorber_distance(const FieldVector<double>& x) const;
  [[nodiscard]] bool absorbs() const;
  /// The one point about which all fields are spheres, where there is one.
  [[nodiscard]] const FieldVector<double>* centre() const;

 private:
  static constexpr double unbounded_distance = 1e100;

  template <class T, class M>
  static void cross(const M& beyond, PlacedField::Place<T>& at) {
    at.region = select(beyond, at.across, at.region);
    at.axis = select(beyond, at.axis_across, at.axis);
  }

  std::vector<PlacedField> fields_;
};

}  // namespace xpr
