// DOP853, the explicit Runge-Kutta method of order 8 by Dormand and Prince in the form that Hairer gave it: an error
// estimate that shrinks as h^8 and a dense output of order 7. Cites: [HairerNorsettWanner1993]
#pragma once

#include <utility>

#include "integrators/dop853_coefficients.hpp"
#include "integrators/flow_stepper.hpp"

namespace xpr {
namespace dop853 {

template <class T>
using Stages = std::array<PhaseState<T>, dense_stages>;

/// Component i of sum_j row_j k_j over the non-zero entries of row R of a table that is known at compile time. The
/// first entry of every row is one of them.
template <const auto& table, std::size_t R, class T>
[[nodiscard, gnu::always_inline]] constexpr T weighted_component(const Stages<T>& k, std::size_t i) {
  return [&]<std::size_t... J>(std::index_sequence<J...>) __attribute__((always_inline)) {
    T sum = table[R][0] * k[0][i];
    ((table[R][J + 1] != 0.0 ? void(sum = sum + table[R][J + 1] * k[J + 1][i]) : void()), ...);
    return sum;
  }
  (std::make_index_sequence<dense_stages - 1>{});
}

template <const auto& table, std::size_t R, class T>
[[nodiscard]] constexpr PhaseState<T> weighted_rate(const Stages<T>& k) {
  return PhaseState<T>::of([&](auto i) __attribute__((always_inline)) { return weighted_component<table, R>(k, i); });
}

/// y + h times the rate that row R of `a` weighs.
template <std::size_t R, class T, class H>
[[nodiscard, gnu::always_inline]] constexpr PhaseState<T> stage(const PhaseState<T>& y, const H& h,
                                                                const Stages<T>& k) {
  return PhaseState<T>::of([&](auto i)
                               __attribute__((always_inline)) { return y[i] + h * weighted_component<a, R>(k, i); });
}

/// The end of one step. On entry k[0] holds flow(y); on return k[0] to k[11] hold the stages.
template <class T, class H, class FlowT>
[[nodiscard]] PhaseState<T> step(FlowT&& flow, const PhaseState<T>& y, const H& h, Stages<T>& k) {
  [&]<std::size_t... S>(std::index_sequence<S...>) { (put_rate(flow, stage<S + 1>(y, h, k), k[S + 1]), ...); }
  (std::make_index_sequence<stages - 1>{});
  return stage<stages>(y, h, k);
}

/// The error estimate of a step in tolerances: that of order 5, damped by that of order 3 so that the whole shrinks as
/// h^8 (Hairer's combination).
template <class T>
[[nodiscard]] T error_of_step(const ErrorScaleOf<T>& scale, const PhaseState<T>& y, const PhaseState<T>& end,
                              const T& h, const Stages<T>& k) {
  const PhaseState<T> weight = error_weights(scale, y, end);
  const T norm5 = error_norm(
      weight, [&](auto i) __attribute__((always_inline)) { return h * weighted_component<error_estimates, 0>(k, i); });
  const T norm3 = error_norm(
      weight, [&](auto i) __attribute__((always_inline)) { return h * weighted_component<error_estimates, 1>(k, i); });
  const T damped = norm5 * norm5 / sqrt(norm5 * norm5 + 0.01 * norm3 * norm3);
  return select(norm5 == 0.0, 0.0 * norm3, damped);
}

/// The three further stages of the dense output. On entry k[0] to k[12] are known, k[12] being the flow at the end.
template <class T, class H, class FlowT>
void dense_stages_of(FlowT&& flow, const PhaseState<T>& y, const H& h, Stages<T>& k) {
  put_rate(flow, stage<13>(y, h, k), k[13]);
  put_rate(flow, stage<14>(y, h, k), k[14]);
  put_rate(flow, stage<15>(y, h, k), k[15]);
}

}  // namespace dop853

/// DOP853 behind the stepper interface. The dense output costs three evaluations, made when it is first asked for.
class Dop853Stepper final : public FlowStepper {
 public:
  Dop853Stepper(const MethodCard& card, Flow flow, const ErrorScale& scale)
      : FlowStepper(card, std::move(flow)), scale_(scale) {}

  [[nodiscard]] StepOutcome step(const PhaseState<double>& y, double h) override;
  [[nodiscard]] PhaseState<double> interpolate(double theta) override;
  /// Takes over a step made elsewhere: k[0] to k[11] are its stages.
  void adopt(const PhaseState<double>& y, double h, const dop853::Stages<double>& k, const PhaseState<double>& end,
             const PhaseState<double>& end_rate) {
    k_ = k;
    dense_ready_ = false;
    take_over(y, h, k[0], end, end_rate);
  }

 private:
  ErrorScale scale_;
  dop853::Stages<double> k_{};
  bool dense_ready_ = false;
  std::array<PhaseState<double>, dop853::dense_rows> dense_{};
};

}  // namespace xpr
