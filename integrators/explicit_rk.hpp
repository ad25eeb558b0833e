// One step of any explicit Runge-Kutta method whose tableau is given as data, over any scalar.
#pragma once

#include <type_traits>
#include <utility>

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

/// sum_j weight_j k_j over the first N stages.
template <std::size_t N, class T>
[[nodiscard, gnu::always_inline]] constexpr PhaseState<T> weighted_rate(const RkCoefficients::Row& weight,
                                                                        const RkStages<T>& k) {
  return [&]<std::size_t... J>(std::index_sequence<J...>) __attribute__((always_inline)) {
    return PhaseState<T>::of([&](auto i) __attribute__((always_inline)) {
      return ((weight[0] * k[0][i]) + ... + (weight[J + 1] * k[J + 1][i]));
    });
  }
  (std::make_index_sequence<N - 1>{});
}

/// y + h rate. H is double, or a Pack with a step size for each lane.
template <class T, class H>
[[nodiscard, gnu::always_inline]] constexpr PhaseState<T> advanced(const PhaseState<T>& y, const H& h,
                                                                   const PhaseState<T>& rate) {
  return PhaseState<T>::of([&](auto i) __attribute__((always_inline)) { return y[i] + h * rate[i]; });
}

/// The end of one step of a method with N stages. On entry k[0] holds flow(y); on return k holds all stages.
template <std::size_t N, class T, class H, class FlowT>
[[nodiscard]] PhaseState<T> explicit_rk_step(const RkCoefficients& rk, FlowT&& flow, const PhaseState<T>& y, const H& h,
                                             RkStages<T>& k) {
  PhaseState<T> stage = y;
  [&]<std::size_t... S>(std::index_sequence<S...>) {
    ((stage = advanced(y, h, weighted_rate<S + 1>(rk.a[S + 1], k)), put_rate(flow, stage, k[S + 1])), ...);
  }
  (std::make_index_sequence<N - 1>{});
  return rk.first_same_as_last ? stage : advanced(y, h, weighted_rate<N>(rk.b, k));
}

/// Calls f with the number of stages as a constant, for loops that the compiler can lay out flat.
template <class F>
constexpr auto with_stages(std::size_t stages, const F& f) {
  switch (stages) {
    case 1:
      return f(std::integral_constant<std::size_t, 1>{});
    case 2:
      return f(std::integral_constant<std::size_t, 2>{});
    case 3:
      return f(std::integral_constant<std::size_t, 3>{});
    case 4:
      return f(std::integral_constant<std::size_t, 4>{});
    case 5:
      return f(std::integral_constant<std::size_t, 5>{});
    case 6:
      return f(std::integral_constant<std::size_t, 6>{});
    default:
      return f(std::integral_constant<std::size_t, 7>{});
  }
}

template <class T, class H, class FlowT>
[[nodiscard]] PhaseState<T> explicit_rk_step(const RkCoefficients& rk, FlowT&& flow, const PhaseState<T>& y, const H& h,
                                             RkStages<T>& k) {
  return with_stages(rk.stages, [&](auto stages) { return explicit_rk_step<stages>(rk, flow, y, h, k); });
}

/// The error estimate of a step in tolerances, for an embedded method with N stages.
template <std::size_t N, class T>
[[nodiscard]] T error_of_step(const RkCoefficients& rk, const ErrorScaleOf<T>& scale, const PhaseState<T>& y,
                              const PhaseState<T>& end, const T& h, const RkStages<T>& k) {
  const PhaseState<T> error = weighted_rate<N>(rk.error, k);
  return error_norm(
      error_weights(scale, y, end), [&](auto i) __attribute__((always_inline)) { return h * error[i]; });
}

/// An explicit Runge-Kutta method behind the stepper interface.
class ExplicitRkStepper final : public FlowStepper {
 public:
  ExplicitRkStepper(const MethodCard& card, const ButcherTableau& tableau, Flow flow, const ErrorScale& scale)
      : FlowStepper(card, std::move(flow)), rk_(tableau), scale_(scale) {}

  [[nodiscard]] StepOutcome step(const PhaseState<double>& y, double h) override;
  [[nodiscard]] PhaseState<double> interpolate(double theta) override;
  [[nodiscard]] const RkCoefficients& coefficients() const { return rk_; }
  /// Takes over a step made elsewhere: k are its stages.
  void adopt(const PhaseState<double>& y, double h, const RkStages<double>& k, const PhaseState<double>& end,
             const PhaseState<double>& end_rate) {
    k_ = k;
    take_over(y, h, k[0], end, end_rate);
  }

 private:
  RkCoefficients rk_;
  ErrorScale scale_;
  RkStages<double> k_{};
};

}  // namespace xpr
