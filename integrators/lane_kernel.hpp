// One step of an explicit method for W rays at once, each with its own step size. The arithmetic is that of the scalar
// steppers, whose templates these are, so a lane's step has the bits of the same step made alone.
#pragma once

#include <memory>

#include "integrators/dop853.hpp"
#include "integrators/explicit_rk.hpp"
#include "metrics/lane_chart.hpp"

namespace xpr {

/// W rays before a step.
template <int W>
struct LaneStart {
  const LaneChart<W>& chart;
  Mask<W> inside{};  ///< on which side of the chart's interface
  PhaseState<Pack<W>> y{};
  PhaseState<Pack<W>> rate{};  ///< the flow at y
  Pack<W> h{};
  ErrorScaleOf<Pack<W>> scale{};
};

/// And after it.
template <int W>
struct LaneEnd {
  PhaseState<Pack<W>> y;
  PhaseState<Pack<W>> rate;  ///< the flow at y
  Pack<W> error_norm;        ///< in tolerances; 0 for methods without an estimate
};

template <int W>
class LaneKernel {
 public:
  virtual ~LaneKernel() = default;
  virtual void step(const LaneStart<W>& from, LaneEnd<W>& to) = 0;
  /// Gives lane i's step to the scalar stepper of the same method, which then interpolates.
  virtual void hand_over(int i, const LaneStart<W>& from, const LaneEnd<W>& to, Stepper& stepper) const = 0;
  /// Flow evaluations a step.
  [[nodiscard]] virtual int evaluations() const = 0;
};

/// Any tableau: explicit fixed-step methods, embedded pairs.
template <int W, std::size_t Stages>
class TableauKernel final : public LaneKernel<W> {
 public:
  using T = Pack<W>;
  explicit TableauKernel(const RkCoefficients& rk) : rk_(rk) {}

  void step(const LaneStart<W>& from, LaneEnd<W>& to) override {
    const auto flow = [&](const PhaseState<T>& y, PhaseState<T>& rate) { from.chart.flow(y, from.inside, rate); };
    k_[0] = from.rate;
    to.y = explicit_rk_step<Stages>(rk_, flow, from.y, from.h, k_);
    if (rk_.first_same_as_last) {
      to.rate = k_[Stages - 1];
    } else {
      from.chart.flow(to.y, from.inside, to.rate);
    }
    to.error_norm = rk_.embedded ? error_of_step<Stages>(rk_, from.scale, from.y, to.y, from.h, k_) : T(0.0);
  }

  void hand_over(int i, const LaneStart<W>& from, const LaneEnd<W>& to, Stepper& stepper) const override {
    RkStages<double> k{};
    for (std::size_t s = 0; s < Stages; ++s) k[s] = lane_of<W>(k_[s], i);
    dynamic_cast<ExplicitRkStepper&>(stepper).adopt(lane_of<W>(from.y, i), lane(from.h, i), k, lane_of<W>(to.y, i),
                                                    lane_of<W>(to.rate, i));
  }

  [[nodiscard]] int evaluations() const override { return static_cast<int>(Stages) - (rk_.first_same_as_last ? 1 : 0); }

 private:
  RkCoefficients rk_;
  RkStages<T> k_{};
};

template <int W>
class Dop853Kernel final : public LaneKernel<W> {
 public:
  using T = Pack<W>;

  void step(const LaneStart<W>& from, LaneEnd<W>& to) override {
    const auto flow = [&](const PhaseState<T>& y, PhaseState<T>& rate) { from.chart.flow(y, from.inside, rate); };
    k_[0] = from.rate;
    to.y = dop853::step(flow, from.y, from.h, k_);
    from.chart.flow(to.y, from.inside, to.rate);
    to.error_norm = dop853::error_of_step(from.scale, from.y, to.y, from.h, k_);
  }

  void hand_over(int i, const LaneStart<W>& from, const LaneEnd<W>& to, Stepper& stepper) const override {
    dop853::Stages<double> k{};
    for (std::size_t s = 0; s < dop853::stages; ++s) k[s] = lane_of<W>(k_[s], i);
    dynamic_cast<Dop853Stepper&>(stepper).adopt(lane_of<W>(from.y, i), lane(from.h, i), k, lane_of<W>(to.y, i),
                                                lane_of<W>(to.rate, i));
  }

  [[nodiscard]] int evaluations() const override { return static_cast<int>(dop853::stages); }

 private:
  dop853::Stages<T> k_{};
};

/// The kernel of the method whose scalar stepper this is; null for methods that have none. Compiled a file for each
/// width.
template <int W>
[[nodiscard]] std::unique_ptr<LaneKernel<W>> make_lane_kernel(const Stepper& stepper);

template <int W>
std::unique_ptr<LaneKernel<W>> make_lane_kernel(const Stepper& stepper) {
  if (dynamic_cast<const Dop853Stepper*>(&stepper) != nullptr) return std::make_unique<Dop853Kernel<W>>();
  const auto* explicit_rk = dynamic_cast<const ExplicitRkStepper*>(&stepper);
  if (explicit_rk == nullptr) return nullptr;
  const RkCoefficients& rk = explicit_rk->coefficients();
  return with_stages(rk.stages, [&](auto stages) -> std::unique_ptr<LaneKernel<W>> {
    return std::make_unique<TableauKernel<W, stages>>(rk);
  });
}

extern template std::unique_ptr<LaneKernel<1>> make_lane_kernel<1>(const Stepper&);
extern template std::unique_ptr<LaneKernel<2>> make_lane_kernel<2>(const Stepper&);
extern template std::unique_ptr<LaneKernel<4>> make_lane_kernel<4>(const Stepper&);
extern template std::unique_ptr<LaneKernel<8>> make_lane_kernel<8>(const Stepper&);

}  // namespace xpr
