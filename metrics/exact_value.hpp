// What every closed form returns: the number and how wrong it can be.
#pragma once

namespace xpr {

/// An exact result as a double. `value` is the quantity at the stored doubles of the arguments (a = double(0.9), not
/// 0.9); `error` >= 0 is an absolute bound on |value - truth|: rounding times conditioning of the formula as it is
/// evaluated, quadrature included. What the rounding of the arguments themselves does is not in it.
struct ExactValue {
  double value = 0.0;
  double error = 0.0;
};

}  // namespace xpr
