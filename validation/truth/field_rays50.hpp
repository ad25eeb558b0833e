// Light through several fields f = (1 - u)^g at 50 digits, n = exp(sum ln n_i) written out again: the truth of scenes
// with more than one centre, which have no closed form. Nothing of the code that renders takes part.
#pragma once

#include <array>
#include <span>

#include "metrics/fields/grin_exact.hpp"

namespace xpr {

/// A field with r_inner = 0.
struct PowerField {
  std::array<double, 3> centre;
  double bending = 1.0;  ///< A
  double r_outer = 1.0;
  double power = 1.0;
};

/// Where light from outside all fields, along `direction`, goes in the end; Gragg's extrapolated rule [Gragg1965] to
/// `tol` a step. The errors are those of rounding to doubles. Throws
/// std::runtime_error where a ray does not leave within 5000 pieces of a fiftieth of the largest rim.
[[nodiscard]] grin_exact::Line outgoing50(std::span<const PowerField> fields, const std::array<double, 3>& from,
                                          const std::array<double, 3>& direction, double tol = 1e-18);

}  // namespace xpr
