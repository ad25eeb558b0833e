// One field along its radius: ln n(r) and its slope, in closed form where the curve has one, else from a table that is
// good to round-off. Curves, lengths, signs: field_source.hpp.
//
//   ln n = A S F(u) in the support (S = r_outer - r_inner), A (S F(0) + f(0) (r_inner - r)) inside r_inner, 0 outside
//
// The radii at which a derivative of ln n jumps (seams) cut the line into regions, counted from the centre. Every
// region's own formula goes on smoothly past its ends, where a step of an integrator may look, but for powers that
// are no whole numbers.
#pragma once

#include <limits>
#include <vector>

#include "metrics/fields/field_source.hpp"
#include "metrics/fields/profile_table.hpp"

namespace xpr {

template <class T>
struct LogIndex {
  T value;  ///< ln n
  T slope;  ///< d ln n / dr
};

class FieldProfile {
 public:
  /// `bending` is A. Throws std::invalid_argument: the source's name, the value and the allowed range.
  FieldProfile(const FieldSource& source, double bending);

  /// Ascending; the last is r_outer.
  [[nodiscard]] const std::vector<double>& seams() const { return seams_; }
  [[nodiscard]] double bending() const { return bending_; }
  [[nodiscard]] double r_inner() const { return r_inner_; }

  /// By the formula of the region: a whole number, how many seams lie below.
  template <class T>
  [[nodiscard]] LogIndex<T> in_region(const T& r, const PlainOf<T>& region) const {
    using P = PlainOf<T>;
    const T u = (r - r_inner_) * inverse_span_;
    const CurveAndIntegral<T> curve = curve_at(u, P(region - P(has_core_ ? 1.0 : 0.0)));
    const auto outside = region >= P(static_cast<double>(seams_.size()));
    T value = scale_ * curve.integral;
    T slope = -bending_ * curve.f;
    if (has_core_) {
      const auto core = region < P(1.0);
      value = select(core, T(scale_ * integral_at_core_ + bending_ * f_at_core_ * (r_inner_ - r)), value);
      slope = select(core, T(-bending_ * f_at_core_), slope);
    }
    return {select(outside, T(0.0), value), select(outside, T(0.0), slope)};
  }

  /// f(u), u clamped, edge ramp in it.
  [[nodiscard]] double curve(double u) const;
  /// No smaller than |f| anywhere in low <= u <= high.
  [[nodiscard]] double most(double low, double high) const;
  /// u of a radius, not clamped.
  [[nodiscard]] double normalised(double r) const { return (r - r_inner_) * inverse_span_; }

 private:
  template <class T>
  [[nodiscard]] CurveAndIntegral<T> curve_at(const T& u, const PlainOf<T>& piece) const {
    if (tabulated_) return table_.in_piece(u, piece);
    const T w = 1.0 - u;
    switch (curve_) {
      case FieldCurve::power:
        return power_at(w);
      case FieldCurve::polynomial:
        return {a_ + u * (b_ + u * c_), w * (a_ + b_ * (1.0 + u) / 2.0 + c_ * (1.0 + u * (1.0 + u)) / 3.0)};
      case FieldCurve::exponential: {
        const T f = exp(-a_ * u);
        return {f, (f - f_at_edge_) / a_};
      }
      default:
        return {w, 0.5 * square(w)};
    }
  }
  template <class T>
  [[nodiscard]] CurveAndIntegral<T> power_at(const T& w) const {
    if (whole_power_ >= 0) {
      const T f = whole_power(w, whole_power_);
      return {f, w * f / (a_ + 1.0)};
    }
    const auto inside = w > 0.0;
    const T f = select(inside, pow(select(inside, w, T(1.0)), a_), T(0.0));
    return {f, w * f / (a_ + 1.0)};
  }
  static constexpr double unbounded_curve = std::numeric_limits<double>::infinity();
  [[nodiscard]] double bare_curve(double u) const;
  [[nodiscard]] std::vector<double> breaks() const;

  FieldCurve curve_;
  double a_, b_, c_;
  std::vector<double> values_;  ///< of the custom curve
  double softness_;
  double r_inner_, r_outer_, inverse_span_;
  double bending_, scale_;
  bool has_core_;
  bool tabulated_ = false;
  int whole_power_ = -1;  ///< the power where it is a small whole number
  double f_at_edge_ = 0.0, f_at_core_ = 0.0, integral_at_core_ = 0.0;
  ProfileTable table_;
  std::vector<double> seams_;
};

}  // namespace xpr
