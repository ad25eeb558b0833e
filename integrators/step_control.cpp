#include "integrators/step_control.hpp"

#include "integrators/flow_stepper.hpp"

namespace xpr {

double initial_step(const Flow& flow, const ErrorScale& scale, const PhaseState<double>& y,
                    const PhaseState<double>& rate, int error_power) {
  const double size = error_norm(scale, y, y, y);
  const double speed = error_norm(scale, y, y, rate);
  const double first = size < 1e-5 || speed < 1e-5 ? 1e-6 : 0.01 * size / speed;
  PhaseState<double> ahead;
  for (std::size_t i = 0; i < 8; ++i) ahead[i] = y[i] + first * rate[i];
  PhaseState<double> turn = flow(ahead);
  for (std::size_t i = 0; i < 8; ++i) turn[i] = (turn[i] - rate[i]) / first;
  const double bend = error_norm(scale, y, y, turn);
  const double fastest = speed > bend ? speed : bend;
  if (!isfinite(fastest)) return first;  // the trial left the domain: begin short, the controller does the rest
  const double second = fastest <= 1e-15 ? 1e-3 * first : inverse_root(100.0 * fastest, error_power);
  return second < 100.0 * first ? second : 100.0 * first;
}

}  // namespace xpr
