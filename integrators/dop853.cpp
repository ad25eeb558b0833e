#include "integrators/dop853.hpp"

namespace xpr {

StepOutcome Dop853Stepper::step(const PhaseState<double>& y, double h) {
  begin_step(y, h);
  dense_ready_ = false;
  k_[0] = begin_rate();
  StepOutcome out;
  out.y = dop853::step(counted_flow(), y, h, k_);
  end_step(out.y);
  out.error_norm = dop853::error_of_step(scale_, y, out.y, h, k_);
  return out;
}

PhaseState<double> Dop853Stepper::interpolate(double theta) {
  if (!dense_ready_) {
    k_[12] = end_rate();
    dop853::dense_stages_of(counted_flow(), begin(), step_size(), k_);
    dense_ = {dop853::weighted_rate<dop853::d, 0>(k_), dop853::weighted_rate<dop853::d, 1>(k_),
              dop853::weighted_rate<dop853::d, 2>(k_), dop853::weighted_rate<dop853::d, 3>(k_)};
    dense_ready_ = true;
  }
  PhaseState<double> y = hermite(theta);
  const double rest = 1.0 - theta;
  const double bump = step_size() * (theta * theta * rest * rest);
  for (std::size_t i = 0; i < 8; ++i) {
    y[i] += bump * (dense_[0][i] + theta * (dense_[1][i] + rest * (dense_[2][i] + theta * dense_[3][i])));
  }
  return y;
}

}  // namespace xpr
