#include "integrators/dop853.hpp"

#include "metrics/scalar/elementary.hpp"

namespace xpr {

StepOutcome Dop853Stepper::step(const PhaseState<double>& y, double h) {
  begin_step(y, h);
  dense_ready_ = false;
  k_[0] = begin_rate();
  StepOutcome out;
  out.y = dop853::step(counted_flow(), y, h, k_);
  end_step(out.y);

  // The estimate of order 5, damped by that of order 3 so that the whole shrinks as h^8 (Hairer's combination).
  PhaseState<double> fifth = dop853::weighted_rate<dop853::error_estimates, 0>(k_);
  PhaseState<double> third = dop853::weighted_rate<dop853::error_estimates, 1>(k_);
  for (std::size_t i = 0; i < 8; ++i) {
    fifth[i] *= h;
    third[i] *= h;
  }
  const double norm5 = error_norm(scale_, y, out.y, fifth);
  const double norm3 = error_norm(scale_, y, out.y, third);
  out.error_norm = norm5 == 0.0 ? 0.0 * norm3 : norm5 * norm5 / sqrt(norm5 * norm5 + 0.01 * norm3 * norm3);
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
