#include "integrators/odeint.hpp"

#include <array>
#include <boost/numeric/odeint/algebra/array_algebra.hpp>
#include <boost/numeric/odeint/algebra/vector_space_algebra.hpp>
#include <boost/numeric/odeint/stepper/bulirsch_stoer.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <concepts>
#include <limits>

#include "integrators/flow_stepper.hpp"
#include "metrics/scalar/elementary.hpp"

namespace xpr {
namespace {

namespace odeint = boost::numeric::odeint;

using Array8 = std::array<double, 8>;

PhaseState<double> state_of(const Array8& components) {
  PhaseState<double> y;
  y.c = components;
  return y;
}

using OdeintDopri5 = odeint::runge_kutta_dopri5<Array8, double, Array8, double, odeint::array_algebra>;
using OdeintFehlberg78 = odeint::runge_kutta_fehlberg78<Array8, double, Array8, double, odeint::array_algebra>;

/// An embedded pair. dopri5 hands out the flow at the end of its step too; fehlberg78 does not.
template <class Pair>
class EmbeddedPair final : public FlowStepper {
 public:
  EmbeddedPair(const MethodCard& card, Flow flow, const ErrorScale& scale)
      : FlowStepper(card, std::move(flow)), scale_(scale) {}

  StepOutcome step(const PhaseState<double>& y, double h) override {
    begin_step(y, h);
    const auto system = [this](const Array8& x, Array8& dxdt, double) { dxdt = rate(state_of(x)).c; };
    StepOutcome out;
    PhaseState<double> error;
    if constexpr (std::same_as<Pair, OdeintDopri5>) {
      PhaseState<double> rate_there;
      pair_.do_step(system, y.c, begin_rate().c, 0.0, out.y.c, rate_there.c, h, error.c);
      end_step(out.y, rate_there);
    } else {
      pair_.do_step(system, y.c, begin_rate().c, 0.0, out.y.c, h, error.c);
      end_step(out.y);
    }
    out.error_norm = error_norm(scale_, y, out.y, error);
    return out;
  }

 private:
  ErrorScale scale_;
  Pair pair_;
};

/// Odeint's bulirsch_stoer calls pow on its value type for its choice of step and order: with this one it finds ours,
/// whose bits do not depend on the machine.
struct PortableReal {
  double value = 0.0;
  constexpr PortableReal() = default;
  constexpr PortableReal(double v) : value(v) {}  // implicit: Odeint mixes it with plain numbers
  constexpr operator double() const { return value; }
};
template <std::same_as<PortableReal> A, std::same_as<PortableReal> B>
PortableReal operator/(A a, B b) {
  return a.value / b.value;
}
PortableReal pow(PortableReal base, PortableReal exponent) { return xpr::pow(base.value, exponent.value); }

/// A state that brings its error scale along, since Odeint's error checker cannot be replaced: the quotient of two is
/// error over tolerance, component by component.
struct GradedState {
  Array8 c{};
  const ErrorScale* scale = nullptr;

  friend GradedState operator+(GradedState a, const GradedState& b) {
    for (std::size_t i = 0; i < 8; ++i) a.c[i] += b.c[i];
    return a;
  }
  friend GradedState operator*(double factor, GradedState a) {
    for (double& component : a.c) component *= factor;
    return a;
  }
  /// The absolute tolerance is in the scale; Odeint's own is set to zero.
  friend GradedState operator+(double, GradedState a) { return a; }
  friend GradedState operator/(GradedState error, const GradedState& size) {
    for (std::size_t i = 0; i < 8; ++i) {
      error.c[i] /= error.scale->absolute[i] + error.scale->relative[i] * size.c[i];
    }
    return error;
  }
  friend GradedState abs(GradedState a) {
    for (double& component : a.c) component = xpr::abs(component);
    return a;
  }
};

}  // namespace
}  // namespace xpr

namespace boost::numeric::odeint {
template <>
struct vector_space_norm_inf<xpr::GradedState> {
  using result_type = double;
  double operator()(const xpr::GradedState& ratio) const {
    double largest = 0.0;
    for (const double component : ratio.c) {
      if (!(component == component)) return std::numeric_limits<double>::infinity();
      largest = component > largest ? component : largest;
    }
    return largest;
  }
};
}  // namespace boost::numeric::odeint

namespace xpr {
namespace {

class BulirschStoer final : public FlowStepper {
 public:
  BulirschStoer(const MethodCard& card, Flow flow, const ErrorScale& scale)
      : FlowStepper(card, std::move(flow)), scale_(scale), stepper_(0.0, 1.0, 1.0, 0.0) {}

  StepOutcome step(const PhaseState<double>& y, double h) override {
    begin_step(y, h);
    const auto system = [this](const GradedState& x, GradedState& dxdt, double) {
      dxdt = {rate(state_of(x.c)).c, x.scale};
    };
    const GradedState in{y.c, &scale_};
    const GradedState rate_here{begin_rate().c, &scale_};
    GradedState result = in;
    double lambda = 0.0;
    double next = h;
    const bool success = stepper_.try_step(system, in, rate_here, lambda, result, next) == odeint::success;
    StepOutcome out;
    out.y = state_of(result.c);
    // It says only whether the step will do: half the tolerance stands for yes, twice for no.
    out.error_norm = success ? 0.5 : 2.0;
    out.next_step = next;
    end_step(out.y);
    return out;
  }

 private:
  ErrorScale scale_;
  odeint::bulirsch_stoer<GradedState, PortableReal, GradedState, double, odeint::vector_space_algebra> stepper_;
};

}  // namespace

std::unique_ptr<Stepper> make_odeint_dopri5(const MethodCard& card, Flow flow, const StepperSettings& settings) {
  return std::make_unique<EmbeddedPair<OdeintDopri5>>(card, std::move(flow), settings.error_scale);
}
std::unique_ptr<Stepper> make_odeint_rkf78(const MethodCard& card, Flow flow, const StepperSettings& settings) {
  return std::make_unique<EmbeddedPair<OdeintFehlberg78>>(card, std::move(flow), settings.error_scale);
}
std::unique_ptr<Stepper> make_odeint_bulirsch_stoer(const MethodCard& card, Flow flow,
                                                    const StepperSettings& settings) {
  return std::make_unique<BulirschStoer>(card, std::move(flow), settings.error_scale);
}

}  // namespace xpr
