// What every stepper shares: the flow with its count of evaluations, the rates kept at both ends of the last step, and
// the cubic Hermite interpolant through them.
#pragma once

#include <limits>
#include <new>
#include <type_traits>
#include <utility>

#include "integrators/stepper.hpp"
#include "metrics/scalar/elementary.hpp"

namespace xpr {

/// The cubic through both ends of a step with the rates there, at fraction theta: local error O(h^4).
[[nodiscard]] PhaseState<double> hermite_cubic(const PhaseState<double>& y0, const PhaseState<double>& rate0,
                                               const PhaseState<double>& y1, const PhaseState<double>& rate1, double h,
                                               double theta);

/// 1 / (absolute_i + relative_i max(|y0_i|, |y1_i|)): what makes an error in component i one in tolerances.
template <class T>
[[nodiscard]] constexpr PhaseState<T> error_weights(const ErrorScaleOf<T>& scale, const PhaseState<T>& y0,
                                                    const PhaseState<T>& y1) {
  return PhaseState<T>::of([&](auto i) __attribute__((always_inline)) {
    return 1.0 / (scale.absolute[i] + scale.relative[i] * max(abs(y1[i]), abs(y0[i])));
  });
}

/// max_i |error(i)| weight_i; NaN where any component is.
template <class T, class F>
[[nodiscard]] constexpr T error_norm(const PhaseState<T>& weight, const F& error) {
  const PhaseState<T> ratio =
      PhaseState<T>::of([&](auto i) __attribute__((always_inline)) { return abs(error(i)) * weight[i]; });
  const auto larger = [](const T& a, const T& b) { return select(a > b, a, b); };
  const T sum = ((ratio[0] + ratio[1]) + (ratio[2] + ratio[3])) + ((ratio[4] + ratio[5]) + (ratio[6] + ratio[7]));
  const T largest = larger(larger(larger(ratio[0], ratio[1]), larger(ratio[2], ratio[3])),
                           larger(larger(ratio[4], ratio[5]), larger(ratio[6], ratio[7])));
  return select(sum == sum, largest, T(std::numeric_limits<double>::quiet_NaN()));
}
template <class T>
[[nodiscard]] constexpr T error_norm(const ErrorScaleOf<T>& scale, const PhaseState<T>& y0, const PhaseState<T>& y1,
                                     const PhaseState<T>& error) {
  return error_norm(
      error_weights(scale, y0, y1), [&](auto i) __attribute__((always_inline)) { return error[i]; });
}

/// Makes `where` the flow at y without a copy: a copy would read at once, in wide words, what the flow has just written
/// number by number, and processors stall on that (15 % of a Dormand-Prince step).
template <class FlowT, class T>
void put_rate(FlowT&& flow, const PhaseState<T>& y, PhaseState<T>& where) {
  if constexpr (std::is_invocable_v<FlowT, const PhaseState<T>&, PhaseState<T>&>) {
    flow(y, where);
  } else {
    ::new (static_cast<void*>(&where)) PhaseState<T>(flow(y));
  }
}

/// Base of the steppers. A derived step() calls begin_step, then end_step.
class FlowStepper : public Stepper {
 public:
  FlowStepper(const MethodCard& card, Flow flow) : card_(card), flow_(std::move(flow)) {}

  [[nodiscard]] const MethodCard& card() const final { return card_; }
  [[nodiscard]] long evaluations() const final { return evaluations_; }
  [[nodiscard]] const PhaseState<double>& begin_rate() final;
  [[nodiscard]] const PhaseState<double>& end_rate() final;
  [[nodiscard]] PhaseState<double> interpolate_coarse(double theta) final { return hermite(theta); }
  [[nodiscard]] PhaseState<double> interpolate(double theta) override { return hermite(theta); }

 protected:
  [[nodiscard]] PhaseState<double> rate(const PhaseState<double>& y) {
    ++evaluations_;
    return flow_(y);
  }
  /// The flow as a function object that counts, for the kernels.
  [[nodiscard]] auto counted_flow() {
    return [this](const PhaseState<double>& y) { return rate(y); };
  }

  /// Notes where the step begins; keeps the rate there if the last step ended or began at the same point.
  void begin_step(const PhaseState<double>& y, double h);
  void end_step(const PhaseState<double>& y) {
    end_ = y;
    end_rate_known_ = false;
  }
  void end_step(const PhaseState<double>& y, const PhaseState<double>& rate_there) {
    end_ = y;
    end_rate_ = rate_there;
    end_rate_known_ = true;
  }

  /// Takes over a step that was made elsewhere, with the rates at both ends.
  void take_over(const PhaseState<double>& y, double h, const PhaseState<double>& rate, const PhaseState<double>& end,
                 const PhaseState<double>& end_rate) {
    begin_ = y;
    h_ = h;
    begin_rate_ = rate;
    end_ = end;
    end_rate_ = end_rate;
    stepped_ = begin_rate_known_ = end_rate_known_ = true;
  }

  [[nodiscard]] const PhaseState<double>& begin() const { return begin_; }
  [[nodiscard]] const PhaseState<double>& end() const { return end_; }
  [[nodiscard]] double step_size() const { return h_; }
  [[nodiscard]] PhaseState<double> hermite(double theta);

 private:
  MethodCard card_;
  Flow flow_;
  long evaluations_ = 0;
  double h_ = 0.0;
  bool stepped_ = false;
  bool begin_rate_known_ = false;
  bool end_rate_known_ = false;
  PhaseState<double> begin_, end_, begin_rate_, end_rate_;
};

}  // namespace xpr
