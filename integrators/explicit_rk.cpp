#include "integrators/explicit_rk.hpp"

namespace xpr {

StepOutcome ExplicitRkStepper::step(const PhaseState<double>& y, double h) {
  begin_step(y, h);
  k_[0] = begin_rate();
  StepOutcome out;
  out.y = explicit_rk_step(rk_, counted_flow(), y, h, k_);
  if (rk_.first_same_as_last) {
    end_step(out.y, k_[rk_.stages - 1]);
  } else {
    end_step(out.y);
  }
  if (rk_.embedded) {
    out.error_norm =
        with_stages(rk_.stages, [&](auto stages) { return error_of_step<stages>(rk_, scale_, y, out.y, h, k_); });
  }
  return out;
}

PhaseState<double> ExplicitRkStepper::interpolate(double theta) {
  PhaseState<double> y = hermite(theta);
  if (rk_.own_dense) {
    const double rest = 1.0 - theta;
    y = advanced(y, step_size() * (theta * theta * rest * rest),
                 weighted_rate<RkCoefficients::max_stages>(rk_.dense, k_));
  }
  return y;
}

}  // namespace xpr
