// Tao's explicit symplectic method for Hamiltonians that do not separate: two copies (q, p) and (x, y) of phase space
// under H(q, y) + H(x, p) + omega/2 (|q - x|^2 + |p - y|^2), each term of which can be solved exactly.
//
// The step is symplectic in the doubled space, not in the single one. The copies are kept across steps and start equal.
// What is given out is their mean: exchanging the copies leaves the doubled flow alone, so the mean feels their
// difference only in second order, while either copy carries it in first. omega must bind the copies (large against
// the rates of the flow's own divergence) and resolve the rotation (omega h small); it is measured in 1/lambda, with
// lengths and momenta in the units in which the state is given. Cites: [Tao2016]
#pragma once

#include <array>

#include "integrators/carried_state.hpp"
#include "integrators/flow_stepper.hpp"
#include "metrics/scalar/elementary.hpp"

namespace xpr {

/// Both copies: `first` is (q, p), `second` is (x, y).
template <class T>
struct DoubledState {
  PhaseState<T> first, second;

  [[nodiscard]] constexpr PhaseState<T> mean() const {
    PhaseState<T> out;
    for (std::size_t i = 0; i < 8; ++i) out[i] = 0.5 * (first[i] + second[i]);
    return out;
  }
};

namespace tao {

/// Flow of H(position of `a`, momentum of `b`): changes the momentum of a and the position of b.
template <class T, class FlowT>
constexpr void mixed_flow(FlowT&& flow, PhaseState<T>& a, PhaseState<T>& b, double h) {
  const PhaseState<T> rate = flow(PhaseState<T>(a.x(), b.p()));
  for (std::size_t i = 0; i < 4; ++i) {
    a[4 + i] = a[4 + i] + h * rate[4 + i];
    b[i] = b[i] + h * rate[i];
  }
}

/// The coupling: differences of positions and momenta turn into each other by the angle 2 omega h.
template <class T>
constexpr void couple(DoubledState<T>& z, double omega, double h) {
  const SinCos<double> turn = sincos(2.0 * omega * h);
  for (std::size_t i = 0; i < 4; ++i) {
    const T position_sum = z.first[i] + z.second[i];
    const T momentum_sum = z.first[4 + i] + z.second[4 + i];
    const T position = z.first[i] - z.second[i];
    const T momentum = z.first[4 + i] - z.second[4 + i];
    const T turned_position = turn.cos * position + turn.sin * momentum;
    const T turned_momentum = turn.cos * momentum - turn.sin * position;
    z.first[i] = 0.5 * (position_sum + turned_position);
    z.second[i] = 0.5 * (position_sum - turned_position);
    z.first[4 + i] = 0.5 * (momentum_sum + turned_momentum);
    z.second[4 + i] = 0.5 * (momentum_sum - turned_momentum);
  }
}

/// The symmetric composition of order 2.
template <class T, class FlowT>
constexpr void step2(FlowT&& flow, DoubledState<T>& z, double omega, double h) {
  mixed_flow(flow, z.first, z.second, 0.5 * h);
  mixed_flow(flow, z.second, z.first, 0.5 * h);
  couple(z, omega, h);
  mixed_flow(flow, z.second, z.first, 0.5 * h);
  mixed_flow(flow, z.first, z.second, 0.5 * h);
}

/// The triple jump: order 4.
template <class T, class FlowT>
constexpr void step4(FlowT&& flow, DoubledState<T>& z, double omega, double h) {
  constexpr double outer = 1.3512071919596576340;  // 1 / (2 - 2^(1/3))
  constexpr double inner = 1.0 - 2.0 * outer;
  step2(flow, z, omega, outer * h);
  step2(flow, z, omega, inner * h);
  step2(flow, z, omega, outer * h);
}

}  // namespace tao

class TaoStepper final : public FlowStepper {
 public:
  /// Throws std::invalid_argument unless omega is positive.
  TaoStepper(const MethodCard& card, Flow flow, double omega);

  [[nodiscard]] StepOutcome step(const PhaseState<double>& y, double h) override;

 private:
  double omega_;
  CarriedState<DoubledState<double>> copies_;
};

}  // namespace xpr
