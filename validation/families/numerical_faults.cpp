// Steppers as someone would have got them wrong, each with the case that must catch it.
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "integrators/explicit_rk.hpp"
#include "integrators/gauss_legendre.hpp"
#include "integrators/tao.hpp"
#include "validation/families.hpp"

namespace xpr {

namespace {

/// A stepper that passes everything on to the right one, for faults to override.
class Altered : public Stepper {
 public:
  Altered(std::string_view method, const Flow& flow, const StepperSettings& settings)
      : right_(make_stepper(method, flow, settings)) {}
  [[nodiscard]] const MethodCard& card() const override { return right_->card(); }
  [[nodiscard]] StepOutcome step(const PhaseState<double>& y, double h) override { return right_->step(y, h); }
  [[nodiscard]] PhaseState<double> interpolate(double theta) override { return right_->interpolate(theta); }
  [[nodiscard]] PhaseState<double> interpolate_coarse(double theta) override { return interpolate(theta); }
  [[nodiscard]] const PhaseState<double>& begin_rate() override { return right_->begin_rate(); }
  [[nodiscard]] const PhaseState<double>& end_rate() override { return right_->end_rate(); }
  [[nodiscard]] long evaluations() const override { return right_->evaluations(); }

 protected:
  [[nodiscard]] Stepper& right() { return *right_; }

 private:
  std::unique_ptr<Stepper> right_;
};

/// The order on the card is `order`, whatever the method does.
class Mislabelled final : public Altered {
 public:
  Mislabelled(std::string_view method, const Flow& flow, const StepperSettings& settings, int order)
      : Altered(method, flow, settings), card_(Altered::card()) {
    card_.order = order;
  }
  [[nodiscard]] const MethodCard& card() const override { return card_; }

 private:
  MethodCard card_;
};

/// Adds `weight` h (f(y) - f(y')) to the step, as two weights off by that much would.
class WeightsOff final : public Altered {
 public:
  WeightsOff(std::string_view method, const Flow& flow, const StepperSettings& settings, double weight)
      : Altered(method, flow, settings), weight_(weight) {}
  [[nodiscard]] StepOutcome step(const PhaseState<double>& y, double h) override {
    StepOutcome out = Altered::step(y, h);
    const PhaseState<double> first = begin_rate();
    const PhaseState<double> last = end_rate();
    for (std::size_t i = 0; i < 8; ++i) out.y[i] += weight_ * h * (first[i] - last[i]);
    return out;
  }

 private:
  double weight_;
};

/// Reports a thousandth of the error estimate.
class TooSure final : public Altered {
 public:
  using Altered::Altered;
  [[nodiscard]] StepOutcome step(const PhaseState<double>& y, double h) override {
    StepOutcome out = Altered::step(y, h);
    out.error_norm *= 1e-3;
    return out;
  }
};

/// Remembers both ends of the last step.
class BetweenEnds : public Altered {
 public:
  using Altered::Altered;
  [[nodiscard]] StepOutcome step(const PhaseState<double>& y, double h) override {
    begin_ = y;
    const StepOutcome out = Altered::step(y, h);
    end_ = out.y;
    return out;
  }

 protected:
  PhaseState<double> begin_, end_;
};

class LinearInside final : public BetweenEnds {
 public:
  using BetweenEnds::BetweenEnds;
  [[nodiscard]] PhaseState<double> interpolate(double theta) override {
    PhaseState<double> y;
    for (std::size_t i = 0; i < 8; ++i) y[i] = (1.0 - theta) * begin_[i] + theta * end_[i];
    return y;
  }
};

/// Knows the ends of a step only: whatever happens inside happens at its end.
class EventAtStepEnd final : public BetweenEnds {
 public:
  using BetweenEnds::BetweenEnds;
  [[nodiscard]] PhaseState<double> interpolate(double theta) override { return theta < 1.0 ? begin_ : end_; }
};

/// Dormand-Prince whose first stage after a rejected try is the rejected try's last one.
class StaleStage final : public FlowStepper {
 public:
  StaleStage(const Flow& flow, const StepperSettings& settings)
      : FlowStepper(method_card("dopri54"), flow), rk_(tableaux::dopri54), scale_(settings.error_scale) {}
  [[nodiscard]] StepOutcome step(const PhaseState<double>& y, double h) override {
    begin_step(y, h);
    k_[0] = stepped_ ? k_[rk_.stages - 1] : begin_rate();
    stepped_ = true;
    StepOutcome out;
    out.y = explicit_rk_step(rk_, counted_flow(), y, h, k_);
    end_step(out.y);
    PhaseState<double> error = weighted_rate<RkCoefficients::max_stages>(rk_.error, k_);
    for (double& component : error.c) component *= h;
    out.error_norm = error_norm(scale_, y, out.y, error);
    return out;
  }

 private:
  RkCoefficients rk_;
  ErrorScale scale_;
  RkStages<double> k_{};
  bool stepped_ = false;
};

/// A full kick before a full drift, called Stoermer-Verlet: symplectic, of order 1.
class KickThenDrift final : public FlowStepper {
 public:
  explicit KickThenDrift(const Flow& flow) : FlowStepper(method_card("verlet"), flow) {}
  [[nodiscard]] StepOutcome step(const PhaseState<double>& y, double h) override {
    begin_step(y, h);
    StepOutcome out{.y = y};
    const PhaseState<double> kick = begin_rate();
    for (const std::size_t i : {0U, 4U, 5U, 6U, 7U}) out.y[i] += h * kick[i];
    const PhaseState<double> drift = rate(out.y);
    for (std::size_t i = 1; i < 4; ++i) out.y[i] += h * drift[i];
    end_step(out.y);
    return out;
  }
};

/// Tao's method that begins every step with two equal copies.
class ForgetfulTao final : public FlowStepper {
 public:
  ForgetfulTao(const Flow& flow, double omega) : FlowStepper(method_card("tao2"), flow), omega_(omega) {}
  [[nodiscard]] StepOutcome step(const PhaseState<double>& y, double h) override {
    begin_step(y, h);
    DoubledState<double> z{y, y};
    tao::step2(counted_flow(), z, omega_, h);
    const StepOutcome out{.y = z.first};
    end_step(out.y);
    return out;
  }

 private:
  double omega_;
};

/// Solves H = 0 for p_t after every step and takes the root of the other time direction.
class WrongRoot final : public Altered {
 public:
  WrongRoot(std::string_view method, const Flow& flow, const StepperSettings& settings)
      : Altered(method, flow, settings), flow_(flow) {}
  [[nodiscard]] StepOutcome step(const PhaseState<double>& y, double h) override {
    StepOutcome out = Altered::step(y, h);
    // dx/dlambda is linear in p: its parts at p = dt and at the spatial p are g^{mu t} and g^{mu i} p_i.
    const Vec4<double> p = out.y.p();
    const PhaseState<double> of_time = flow_({out.y.x(), {1.0, 0.0, 0.0, 0.0}});
    const PhaseState<double> of_space = flow_({out.y.x(), {0.0, p[1], p[2], p[3]}});
    const double a = of_time[0], half_b = of_space[0];
    const double c = of_space[1] * p[1] + of_space[2] * p[2] + of_space[3] * p[3];
    const double root = std::sqrt(half_b * half_b - a * c);
    const double time_direction = a * p[0] + half_b;
    out.y[4] = (-half_b - (time_direction < 0.0 ? -root : root)) / a;
    return out;
  }

 private:
  Flow flow_;
};

/// A fault that replaces the steppers of one method.
template <class Maker>
Fault wrong_method(std::string id, std::string description, std::string case_id, std::string method, Maker make) {
  Fault fault{.id = std::move(id), .description = std::move(description), .case_id = std::move(case_id)};
  fault.stepper = [method = std::move(method), make](std::string_view wanted, const Flow& flow,
                                                     const StepperSettings& settings) -> std::unique_ptr<Stepper> {
    if (wanted != method) return nullptr;
    return make(flow, settings);
  };
  return fault;
}

Fault wrong_tableau(std::string id, std::string description, std::string case_id, std::string method,
                    const ButcherTableau& tableau) {
  return wrong_method(std::move(id), std::move(description), std::move(case_id), method,
                      [method, tableau](const Flow& flow, const StepperSettings& settings) {
                        return std::make_unique<ExplicitRkStepper>(method_card(method), tableau, flow,
                                                                   settings.error_scale);
                      });
}

template <std::size_t S>
Fault wrong_gauss(std::string id, std::string description, std::string case_id, std::string method,
                  const GaussCoefficients<S>& coefficients, int iterations = 200) {
  return wrong_method(std::move(id), std::move(description), std::move(case_id), method,
                      [method, coefficients, iterations](const Flow& flow, const StepperSettings&) {
                        return std::make_unique<GaussStepper<S>>(method_card(method), coefficients, flow, iterations);
                      });
}

/// A fault that replaces Dormand-Prince by a class that wraps it.
template <class T, class... Extra>
Fault wrapped(std::string id, std::string description, std::string case_id, std::string method, Extra... extra) {
  return wrong_method(std::move(id), std::move(description), std::move(case_id), method,
                      [method, extra...](const Flow& flow, const StepperSettings& settings) {
                        return std::make_unique<T>(method, flow, settings, extra...);
                      });
}

std::vector<Fault> coefficient_faults() {
  std::vector<Fault> faults;
  ButcherTableau dopri54 = tableaux::dopri54;
  dopri54.a[4][2].numerator += 6;
  faults.push_back(wrong_tableau("dopri54-coefficient", "Dormand-Prince's a_53 wrong in its fourth digit",
                                 "numerical/order-fisheye", "dopri54", dopri54));
  ButcherTableau rk4 = tableaux::rk4;
  std::swap(rk4.b[1], rk4.b[3]);
  faults.push_back(wrong_tableau("rk4-weights-swapped", "RK4 with weights 1/6, 1/6, 1/3, 1/3",
                                 "numerical/order-fisheye", "rk4", rk4));
  faults.push_back(wrapped<Mislabelled>("heun2-called-order-3", "Heun's method of order 2 with order 3 on its card",
                                        "numerical/order-fisheye", "heun2", 3));
  faults.push_back(wrapped<WeightsOff>("dop853-coefficient", "two of DOP853's weights off by 1e-6",
                                       "numerical/order-fisheye", "dop853", 1e-6));
  faults.push_back(wrapped<WeightsOff>("dop853-unseen-by-its-estimate",
                                       "two of DOP853's weights off by 1e-6, which its error estimate cannot see",
                                       "numerical/fifty-digits", "dop853", 1e-6));
  faults.push_back(wrapped<WeightsOff>("dopri54-tenth-digit", "two of Dormand-Prince's weights off by 1e-9",
                                       "numerical/against-odeint", "dopri54", 1e-9));
  faults.push_back(wrong_gauss<3>("gl6-coefficient",
                                  "a coefficient of Gauss-Legendre's order 6 typed in another's place",
                                  "numerical/order-kerr-scattering", "gl6",
                                  {gauss::three_stages.b,
                                   {{{0.5, 1.0 - gauss::mu21_of_three, 1.0 - gauss::mu21_of_three},
                                     {gauss::mu21_of_three, 0.5, 1.0 - gauss::mu21_of_three},
                                     {gauss::mu21_of_three, gauss::mu21_of_three, 0.5}}}}));
  faults.push_back(wrong_gauss<2>("gl4-node-sign", "the sign of sqrt(3) wrong in one stage of Gauss-Legendre's order 4",
                                  "numerical/symplectic", "gl4",
                                  {gauss::two_stages.b, {{{0.5, gauss::mu21_of_two}, {gauss::mu21_of_two, 0.5}}}}));
  faults.push_back(wrong_gauss<1>("midpoint-at-the-end", "the implicit midpoint rule with its stage at the step's end",
                                  "numerical/time-reversal", "implicit-midpoint", {{1.0}, {{{1.0}}}}));
  return faults;
}

std::vector<Fault> procedure_faults() {
  std::vector<Fault> faults;
  faults.push_back(wrapped<TooSure>("error-estimate-a-thousandth",
                                    "an error estimate that is a thousand times too small", "numerical/error-estimate",
                                    "dopri54"));
  const auto scaled = [](double tolerance) {
    return [tolerance](std::string_view method, const Flow& flow, StepperSettings settings) {
      if (!(settings.error_scale.absolute[1] < tolerance)) return make_stepper(method, flow, settings);
      for (std::size_t i = 1; i < 8; ++i) settings.error_scale.absolute[i] = tolerance;
      settings.error_scale.relative.fill(0.0);
      return make_stepper(method, flow, settings);
    };
  };
  Fault floor{.id = "tolerance-clamped",
              .description = "tolerances below 1e-6 silently taken as 1e-6",
              .case_id = "numerical/tolerance-kerr"};
  floor.stepper = scaled(1e-6);
  faults.push_back(floor);
  floor.id = "tolerance-clamped-media";
  floor.description = "tolerances below 1e-5 silently taken as 1e-5";
  floor.case_id = "numerical/tolerance-fisheye";
  floor.stepper = scaled(1e-5);
  faults.push_back(floor);
  faults.push_back(wrong_method("verlet-kick-drift", "a full kick before a full drift for Stoermer-Verlet's half kicks",
                                "numerical/order-fisheye", "verlet", [](const Flow& flow, const StepperSettings&) {
                                  return std::make_unique<KickThenDrift>(flow);
                                }));
  faults.push_back(wrong_gauss<1>("implicit-stopped-early", "the implicit midpoint rule's iteration stopped after two",
                                  "numerical/long-run-fisheye", "implicit-midpoint", gauss::one_stage, 2));
  faults.push_back(wrong_method("tao-copies-forgotten", "Tao's method with equal copies at the start of every step",
                                "numerical/long-run-kerr", "tao2",
                                [](const Flow& flow, const StepperSettings& settings) {
                                  return std::make_unique<ForgetfulTao>(flow, settings.tao_omega);
                                }));
  faults.push_back(wrong_method(
      "fsal-stage-stale", "the stage kept from a rejected try taken for the next one's first",
      "numerical/repeated-steps", "dopri54",
      [](const Flow& flow, const StepperSettings& settings) { return std::make_unique<StaleStage>(flow, settings); }));
  faults.push_back(wrapped<LinearInside>("dense-output-linear", "dense output that joins the ends of a step by a line",
                                         "numerical/dense-output", "dopri54"));
  faults.push_back(wrapped<EventAtStepEnd>("event-at-step-end", "events put at the end of the step that meets them",
                                           "numerical/events", "dopri54"));
  return faults;
}

std::vector<Fault> projection_faults() {
  Fault moves{.id = "full-projection-moves-b",
              .description = "`full` projection that rescales the spatial momentum and so moves the impact parameter",
              .case_id = "numerical/projection-residual"};
  moves.settings = [](TraceSettings& settings) {
    if (settings.projection == Projection::full) settings.projection = Projection::momentum;
  };
  Fault none{.id = "projection-forgotten",
             .description = "energy projection that is asked for and not made",
             .case_id = "numerical/projection-residual"};
  none.settings = [](TraceSettings& settings) {
    if (settings.projection == Projection::energy) settings.projection = Projection::none;
  };
  Fault sign{.id = "energy-projection-sign",
             .description = "energy projection that takes the root of the other time direction",
             .case_id = "numerical/projection-order"};
  sign.settings = [](TraceSettings& settings) {
    if (settings.projection != Projection::energy) return;
    settings.projection = Projection::none;
    settings.stepper_factory = [](std::string_view method, const Flow& flow, const StepperSettings& wanted) {
      return std::make_unique<WrongRoot>(method, flow, wanted);
    };
  };
  return {moves, none, sign};
}

}  // namespace

std::vector<Fault> numerical_faults() {
  std::vector<Fault> all = coefficient_faults();
  for (const auto part : {procedure_faults, projection_faults}) {
    for (Fault& fault : part()) all.push_back(std::move(fault));
  }
  return all;
}

}  // namespace xpr
