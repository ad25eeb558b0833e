// One ray through one spacetime: step control, events, chart switches and projection around any stepper.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "integrators/status.hpp"
#include "integrators/stepper.hpp"
#include "metrics/spacetime.hpp"

namespace xpr {

/// What is restored after each accepted step: nothing; H = 0 by rescaling p_t; H = 0 by rescaling the spatial momentum;
/// or H = 0 and all Killing constants at once, by the smallest change of (x, p).
enum class Projection { none, energy, momentum, full };

/// A surface g(y, sheet) = 0 in phase space.
struct Event {
  std::string name;
  std::function<double(const Spacetime& chart, const PhaseState<double>& y, int sheet)> g;
  int direction = 0;      ///< +1: only where g rises along the ray; -1: only where it falls; 0: both
  bool terminal = false;  ///< the ray ends there
  Status status = Status::crossed;
};

/// A meeting with an event, located on the dense output.
struct EventHit {
  std::size_t event = 0;  ///< index into the events given
  double lambda = 0.0;
  PhaseState<double> y;
  const Spacetime* chart = nullptr;
  int sheet = 1;
};

/// Makes the stepper of a method, as make_stepper does.
using StepperFactory =
    std::function<std::unique_ptr<Stepper>(std::string_view method, const Flow& flow, const StepperSettings& settings)>;

struct TraceSettings {
  std::string method = "dopri54";
  StepperFactory stepper_factory;  ///< empty: make_stepper; the suite plants wrong steppers here
  double tol = 1e-10;              ///< adaptive methods: see ErrorScale
  double step = 0.01;              ///< fixed-step methods: in lambda for |p_t| = 1
  double length_unit = 1.0;        ///< M where there is a mass, else b0 or the scene's
  bool grade_time = false;         ///< the error norm includes t
  Projection projection = Projection::none;
  double tao_omega = 1.0;
  std::optional<double> r_min;  ///< going inward -> captured
  std::optional<double> r_max;  ///< going outward -> escaped
  std::optional<double> l_min;  ///< signed proper distance -> crossed
  std::optional<double> l_max;
  double lambda_max = std::numeric_limits<double>::infinity();
  std::int64_t max_steps = 1'000'000;
};

/// A step as an observer sees it: both ends, and the dense output between.
struct StepView {
  const Spacetime& chart;
  int sheet;
  double lambda;  ///< at the step's end
  double h;
  const PhaseState<double>& begin;
  const PhaseState<double>& end;
  Stepper& stepper;
  double part;  ///< of the stepper's last step that was kept: less than 1 where a stop cut it

  /// The path at fraction theta in [0, 1] of this step, before any projection.
  [[nodiscard]] PhaseState<double> at(double theta) const { return stepper.interpolate(part * theta); }
};

struct RayEnd {
  Status status = Status::max_steps;
  PhaseState<double> y;              ///< in `chart`
  const Spacetime* chart = nullptr;  ///< the start's, unless the atlas switched
  int sheet = 1;
  double lambda = 0.0;
  std::int64_t steps = 0;
  std::int64_t rejected = 0;
  std::int64_t evaluations = 0;
  double null_residual = 0.0;  ///< at the end; NaN where g^{tt} >= 0, where it is not defined
  double null_residual_max = 0.0;
  /// Cartesian charts: signed crossings of the half-plane y = 0, x < 0, positive if counter-clockwise.
  int windings = 0;
  std::vector<EventHit> hits;
};

/// Traces one ray until a stop is met: lambda grows from 0, whichever way p points. A ray that begins beyond r_max and
/// goes outward has escaped at once; one that begins below r_min and goes inward is captured. Non-finite numbers,
/// domains and budgets become a status, never an exception; throws std::invalid_argument only for settings that make no
/// sense (unknown method, tol or step not positive, a method for separable Hamiltonians where the spacetime has none).
[[nodiscard]] RayEnd trace_ray(const Spacetime& spacetime, const PhaseState<double>& start, int sheet,
                               const TraceSettings& settings, std::span<const Event> events = {},
                               const std::function<void(const StepView&)>& observer = {});

/// What a component's change is measured in: the length unit for lengths, t and proper distances, 1 for angles, |p_t|
/// for momenta, times the length unit where they are conjugate to an angle. Where p_t = 0 the largest |p_i| takes its
/// place.
[[nodiscard]] std::array<double, 8> component_units(const Spacetime& spacetime, const PhaseState<double>& y,
                                                    double length_unit);

/// The error norm for a chart: x^i against tol (length unit + |x^i|), angles against tol, momenta
/// against tol |p_t| (times the length unit where they are conjugate to an angle), t not graded unless asked.
[[nodiscard]] ErrorScale error_scale(const Spacetime& spacetime, const PhaseState<double>& start,
                                     const TraceSettings& settings);

}  // namespace xpr
