// Exact rays of one radial gradient-index field (field_source.hpp): Bouguer's invariant and quadratures, no stepping,
// and nothing of the code that traces: the curves are written out again here.
//   n r sin(psi) = b,   swept angle = int b dr / (r sqrt(n^2 r^2 - b^2)),
//   deflection = 2 [int_{r0}^{R} b dr / (r sqrt(n^2 r^2 - b^2)) + asin(b / R)] - pi,   n(r0) r0 = b
// towards the centre for an attractive field; r = r0 + t^2 takes out the root of the turning point. R is r_outer, where
// n = 1. Fields are spheres; of the source's frame only the origin counts here, so that lengths are the world's.
// In long double; the errors given are the rounding to doubles and what a finer quadrature changes.
// Cites: [BornWolf1999]
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "metrics/exact_value.hpp"
#include "metrics/fields/field_source.hpp"

namespace xpr::grin_exact {

using Vector = std::array<double, 3>;

/// A field's index as a function of the radius.
class RadialIndex {
 public:
  /// Throws std::domain_error for a source that is no plain sphere: a box, a turned or scaled frame.
  RadialIndex(const FieldSource& source, const FieldGains& gains);

  /// f(u), edge ramp in it.
  [[nodiscard]] long double curve(long double u) const;
  /// F(u) = int_u^1 f.
  [[nodiscard]] long double integral(long double u) const;
  /// ln n at r >= 0.
  [[nodiscard]] long double log_index(long double r) const;
  /// -d ln n / dr: how fast light bends across the radius.
  [[nodiscard]] long double bending(long double r) const;
  /// Radii at which a derivative of n jumps, ascending, r_outer last.
  [[nodiscard]] const std::vector<long double>& seams() const { return seams_; }
  [[nodiscard]] long double r_outer() const { return outer_; }
  [[nodiscard]] const Vector& centre() const { return centre_; }

 private:
  FieldCurve curve_;
  long double a_, b_, c_, softness_, inner_, outer_, bending_;
  std::vector<double> table_;
  std::vector<long double> breaks_;
  std::vector<long double> seams_;
  Vector centre_;
};

/// Radii where a circle is a ray, r bending(r) = 1, outermost first.
[[nodiscard]] std::vector<double> photon_spheres(const RadialIndex& index);
/// Where a ray that comes in from the radius `from` turns: the largest r < from with n r = b; 0 for b = 0. Needs
/// n(from) from >= b.
[[nodiscard]] double turning_radius(const RadialIndex& index, double from, double b);
/// The deflection of light from far away with impact parameter b >= 0; exactly 0 for b >= r_outer and for b = 0.
[[nodiscard]] ExactValue deflection(const RadialIndex& index, double b);

/// A straight line on which light goes on.
struct Line {
  Vector point;      ///< where it left the field; the start, where it never met it
  Vector direction;  ///< unit
  double point_error = 0.0;
  double direction_error = 0.0;  ///< radian
};
/// Where light from `from` along `direction` (any length) goes in the end. Nothing where it never leaves the field:
/// b >= r_outer inside it, or a turning point on the way out.
[[nodiscard]] std::optional<Line> outgoing(const RadialIndex& index, const Vector& from, const Vector& direction);

}  // namespace xpr::grin_exact
