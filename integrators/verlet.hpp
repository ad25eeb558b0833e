// Stoermer-Verlet, kick-drift-kick, for H = T(p_i) + V(x^i, p_t) with p_t constant: a static medium, or mechanics.
//
// The flow is asked at mixed states: spatial velocities depend on spatial momenta alone, forces and dt/dlambda on
// positions and p_t alone. Symplectic, symmetric, order 2. Sums over steps carry their round-off along.
// Cites: [HairerLubichWanner2006]
#pragma once

#include "integrators/carried_state.hpp"
#include "integrators/flow_stepper.hpp"

namespace xpr {

namespace verlet {

/// Adds h times the rates that positions determine: those of t and of p.
template <class T>
constexpr void kick(PhaseState<T>& y, const PhaseState<T>& rate, double h, PhaseState<T>& rest) {
  y[0] = add_compensated(y[0], T(h * rate[0]), rest[0]);
  for (std::size_t i = 4; i < 8; ++i) y[i] = add_compensated(y[i], T(h * rate[i]), rest[i]);
}

/// One step from y, whose flow is `rate`; `rest` is the round-off carried along.
template <class T, class FlowT>
[[nodiscard]] constexpr PhaseState<T> step(FlowT&& flow, PhaseState<T> y, const PhaseState<T>& rate, double h,
                                           PhaseState<T>& rest) {
  kick(y, rate, 0.5 * h, rest);
  const PhaseState<T> drift = flow(y);
  for (std::size_t i = 1; i < 4; ++i) y[i] = add_compensated(y[i], T(h * drift[i]), rest[i]);
  kick(y, flow(y), 0.5 * h, rest);
  return y;
}

}  // namespace verlet

class VerletStepper final : public FlowStepper {
 public:
  using FlowStepper::FlowStepper;

  [[nodiscard]] StepOutcome step(const PhaseState<double>& y, double h) override {
    begin_step(y, h);
    PhaseState<double> rest = rest_.at(y, {});
    StepOutcome out;
    out.y = verlet::step(counted_flow(), y, begin_rate(), h, rest);
    rest_.set_end(out.y, rest);
    end_step(out.y);
    return out;
  }

 private:
  CarriedState<PhaseState<double>> rest_;
};

}  // namespace xpr
