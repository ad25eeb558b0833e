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
using StepperFactory = std::function<std::unique_ptr<Stepper>(std::string_view method, const Flow& flow,
                                                              const StepperSettings& settings)>;

struct TraceSettings {
  std::string method = "dopri54";
  StepperFactory stepper_factory;  ///< empty: make_stepper; the suite plants wrong steppers here
  double tol = 1e-10;        ///< adaptive methods: see ErrorScale
  double step = 0.01;        ///< fixed-step methods: in lambda for |p_t| = 1
  double length_unit = 1.0;  ///< M where there is a mass, else b0 or the scene's
  bool grade_time = false;   ///< the error norm includes t
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
  double null_residual = 0.0;
  double null_residual_max = 0.0;
  int windings =
      0;  ///< Cartesian charts: signed crossings of the half-plane y = 0, x < 0 (positive: counter-clockwise)
  std::vector<EventHit> hits;
};

/// Traces one ray until a stop is met. Non-finite numbers, domains and budgets become a status, never an exception;
/// throws std::invalid_argument only for settings that make no sense (unknown method, tol or step not positive).
[[nodiscard]] RayEnd trace_ray(const Spacetime& spacetime, const PhaseState<double>& start, int sheet,
                               const TraceSettings& settings, std::span<const Event> events = {},
                               const std::function<void(const StepView&)>& observer = {});

/// The error norm of DESIGN section 4 for a chart: x^i against tol (length unit + |x^i|), angles against tol, momenta
/// against tol |p_t| (times the length unit where they are conjugate to an angle), t not graded unless asked.
[[nodiscard]] ErrorScale error_scale(const Spacetime& spacetime, const PhaseState<double>& start,
                                     const TraceSettings& settings);

}  // namespace xpr
