// One step of one method: the interface that every integrator stands behind, our own and Boost.Odeint's alike.
//
// A stepper knows neither spacetimes nor events nor step control; it advances a point of phase space under an
// autonomous flow, estimates its own error where the method can, and interpolates over the step it made last.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "metrics/tensor.hpp"

namespace xpr {

/// Hamilton's equations as a stepper sees them: dy/dlambda at y. Called often, never stored beyond its stepper.
using Flow = std::function<PhaseState<double>(const PhaseState<double>&)>;

/// Which error is tolerated where; the norm is a maximum over components. Component i of the error is divided by
/// absolute[i] + relative[i] |y_i|; components with absolute[i] = infinity are not graded.
template <class T>
struct ErrorScaleOf {
  std::array<T, 8> absolute{};
  std::array<double, 8> relative{};
};
using ErrorScale = ErrorScaleOf<double>;

/// What users know of a method.
struct MethodCard {
  std::string_view id;          ///< as in `--method dopri54`
  std::string_view title;       ///< one line for people, with the citation key
  int order = 1;                ///< formal order of the end point
  bool adaptive = false;        ///< has an error estimate: takes --tol; fixed-step methods take --step
  bool symplectic = false;      ///< the step map is symplectic (Tao's: in the doubled phase space)
  bool separable_only = false;  ///< needs H = T(p) + V(x)
  int dense_order = 1;  ///< order of interpolate(); below order - 1 events are located by repeating the step shorter
  int error_power = 0;  ///< the error estimate shrinks as h to this power; 0 for fixed-step methods
};

/// What came of one step.
struct StepOutcome {
  PhaseState<double> y;     ///< at lambda + h
  double error_norm = 0.0;  ///< estimate in units of the tolerance: acceptable up to 1; 0 for methods without one
  bool converged = true;    ///< false: an implicit method's iteration did not settle
  double next_step = 0.0;   ///< the step the method itself proposes next; 0: the controller chooses
};

/// One method advancing one trajectory. Not shared between threads; cheap to make.
class Stepper {
 public:
  virtual ~Stepper() = default;
  [[nodiscard]] virtual const MethodCard& card() const = 0;
  /// Tries one step of size h (either sign) from y. A rejected try is simply followed by another from the same y.
  [[nodiscard]] virtual StepOutcome step(const PhaseState<double>& y, double h) = 0;
  /// The solution at fraction theta in [0, 1] of the last step made.
  [[nodiscard]] virtual PhaseState<double> interpolate(double theta) = 0;
  /// As interpolate, but never dearer than the flow at both ends: to see whether something is near.
  [[nodiscard]] virtual PhaseState<double> interpolate_coarse(double theta) = 0;
  /// The flow at the beginning and at the end of the last step made; kept, so that a step from there has it for
  /// nothing.
  [[nodiscard]] virtual const PhaseState<double>& begin_rate() = 0;
  [[nodiscard]] virtual const PhaseState<double>& end_rate() = 0;
  /// Flow evaluations so far.
  [[nodiscard]] virtual long evaluations() const = 0;
};

/// Settings that some methods need.
struct StepperSettings {
  ErrorScale error_scale;
  double tao_omega = 1.0;             ///< coupling of Tao's two copies of phase space
  int max_implicit_iterations = 200;  ///< fixed-point or Newton iterations before `converged` is false
};

/// All methods, in the order in which they are listed.
[[nodiscard]] const std::vector<MethodCard>& methods();

/// Card of a method id. Throws std::invalid_argument, naming the nearest known id.
[[nodiscard]] const MethodCard& method_card(std::string_view id);

/// Makes a stepper for a flow. Throws std::invalid_argument for an unknown id.
[[nodiscard]] std::unique_ptr<Stepper> make_stepper(std::string_view id, Flow flow, const StepperSettings& settings);

}  // namespace xpr
