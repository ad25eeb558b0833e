// One step of any explicit Runge-Kutta method whose tableau is given as data, over any scalar.
#pragma once

#include "integrators/butcher_tableau.hpp"
#include "integrators/flow_stepper.hpp"
#include "metrics/tensor.hpp"

namespace xpr {

/// A tableau rounded to double: what the kernel runs on.
struct RkCoefficients {
  static constexpr std::size_t max_stages = ButcherTableau::max_stages;
  using Row = std::array<double, max_stages>;

  std::size_t stages = 0;
  std::array<Row, max_stages> a{};
  Row b{};
  Row error{};  ///< b - bhat; zero without an embedded method
  Row dense{};  ///< zero without a dense output of its own
  bool embedded = false;
  bool first_same_as_last = false;
  bool own_dense = false;

  constexpr explicit RkCoefficients(const ButcherTableau& tableau)
      : stages(tableau.stages),
        embedded(tableau.embedded),
        first_same_as_last(tableau.first_same_as_last),
        own_dense(tableau.dense) {
    for (std::size_t i = 0; i < stages; ++i) {
      for (std::size_t j = 0; j < i; ++j) a[i][j] = tableau.a[i][j].value();
      b[i] = tableau.b[i].value();
      dense[i] = tableau.d[i].value();
      if (embedded) {
        const Fraction& p = tableau.b[i];
        const Fraction& q = tableau.b_embedded[i];
        error[i] =
            Fraction{p.numerator * q.denominator - q.numerator * p.denominator, p.denominator * q.denominator}.value();
      }
    }
  }
};

template <class T>
using RkStages = std::array<PhaseState<T>, RkCoefficients::max_stages>;

/// sum_i weight_i k_i over the stages; zero weights cost nothing.
template <class T>
[[nodiscard]] constexpr PhaseState<T> weighted_rate(const RkCoefficients::Row& weight, std::size_t stages,
                                                    const RkStages<T>& k) {
  PhaseState<T> sum{};
  for (std::size_t j = 0; j < stages; ++j) {
    if (weight[j] == 0.0) continue;
    for (std::size_t i = 0; i < 8; ++i) sum[i] = sum[i] + weight[j] * k[j][i];
  }
  return sum;
}

/// y + h rate. H is double, or a Pack with a step size for each lane.
template <class T, class H>
[[nodiscard]] constexpr PhaseState<T> advanced(const PhaseState<T>& y, const H& h, const PhaseState<T>& rate) {
  PhaseState<T> out;
  for (std::size_t i = 0; i < 8; ++i) out[i] = y[i] + h * rate[i];
  return out;
}

/// The end of one step. On entry k[0] holds flow(y); on return k holds all stages.
template <class T, class H, class FlowT>
[[nodiscard]] constexpr PhaseState<T> explicit_rk_step(const RkCoefficients& rk, FlowT&& flow, const PhaseState<T>& y,
                                                       const H& h, RkStages<T>& k) {
  PhaseState<T> stage = y;
  for (std::size_t s = 1; s < rk.stages; ++s) {
    stage = advanced(y, h, weighted_rate(rk.a[s], s, k));
    k[s] = flow(stage);
  }
  return rk.first_same_as_last ? stage : advanced(y, h, weighted_rate(rk.b, rk.stages, k));
}

/// An explicit Runge-Kutta method behind the stepper interface.
class ExplicitRkStepper final : public FlowStepper {
 public:
  ExplicitRkStepper(const MethodCard& card, const ButcherTableau& tableau, Flow flow, const ErrorScale& scale)
      : FlowStepper(card, std::move(flow)), rk_(tableau), scale_(scale) {}

  [[nodiscard]] StepOutcome step(const PhaseState<double>& y, double h) override;
  [[nodiscard]] PhaseState<double> interpolate(double theta) override;

 private:
  RkCoefficients rk_;
  ErrorScale scale_;
  RkStages<double> k_{};
};

}  // namespace xpr
