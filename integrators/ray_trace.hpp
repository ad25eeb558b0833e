// One ray on its way: what trace_ray runs from begin to end, and what a batch keeps for every lane, where steps are
// made for many rays at once and only what is out of the ordinary is looked at ray by ray.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "integrators/path_watch.hpp"
#include "integrators/projection.hpp"
#include "integrators/step_control.hpp"
#include "integrators/surface_watch.hpp"
#include "integrators/tracer.hpp"

namespace xpr {

/// A covector this far off the cone is no light ray any more: |2H| of the size of its own terms.
inline constexpr double useless_residual = 0.5;

/// Below this part of the path covered a step drowns in the round-off of lambda.
inline constexpr double least_step = 4.0 * 2.220446049250313e-16;

/// A sum that carries its round-off along, so that lambda of many equal steps stays exact.
template <class T>
struct CompensatedSum {
  T sum = T(0.0);
  T rest = T(0.0);

  constexpr void add(const T& term) {
    const T corrected = term + rest;
    const T next = sum + corrected;
    rest = corrected - (next - sum);
    sum = next;
  }
};

/// Where a ray stands between two steps.
struct RayProgress {
  PhaseState<double> y;
  CompensatedSum<double> lambda;
  double h = 0.0;  ///< the next step to try
  StepMemory<double> last = {};
  double h_first = 0.0;  ///< the first that was tried in this chart
  bool last_rejected = false;
  bool inside_interface = false;
  std::int64_t steps = 0;
  std::int64_t rejected = 0;
  std::int64_t evaluations = 0;
  int windings = 0;
  double null_residual = 0.0;
  double null_residual_max = 0.0;
};

/// Whether no component is NaN or infinite, nor their sum (that of a million of the largest doubles).
template <class T>
[[nodiscard]] constexpr MaskOf<T> all_finite(const PhaseState<T>& y) {
  T sum = abs(y[0]);
  for (std::size_t i = 1; i < 8; ++i) sum = sum + abs(y[i]);
  return isfinite(sum);
}

/// Whether rays of this chart are on one side or the other of an interface.
[[nodiscard]] inline bool has_interface(const Spacetime& chart) {
  return chart.interface_radius().has_value() || chart.interface_distance({}).has_value();
}

class RayTrace {
 public:
  /// Throws std::invalid_argument as trace_ray does. The spacetime, and the events must outlive this.
  RayTrace(const Spacetime& spacetime, const TraceSettings& settings, std::span<const Event> events = {},
           std::function<void(const StepView&)> observer = {});
  RayTrace(const RayTrace&) = delete;
  RayTrace& operator=(const RayTrace&) = delete;

  /// Keeps the stepper from ray to ray: for a batch, which makes the steps itself and only lets the stepper
  /// interpolate.
  void keep_stepper() { keeps_stepper_ = true; }
  /// Ends rays at the things that they meet.
  void look_for(PathWatch* things) { things_ = things; }

  /// Sets out from `start` as ray `number` of a batch, with its own r_max where one is given. A status where the ray
  /// ends before the first step.
  [[nodiscard]] std::optional<Status> begin(const PhaseState<double>& start, int sheet,
                                            std::optional<double> r_max = std::nullopt, std::size_t number = 0);
  /// Steps until the ray ends.
  [[nodiscard]] Status go_on();
  /// Whether a budget is spent.
  [[nodiscard]] std::optional<Status> spent() const;
  /// Takes a step of size h, which the stepper made last, or the part of it up to the first stop that it meets.
  /// `far_surfaces` has bit i set where surface i of the watch is known not to be met.
  [[nodiscard]] std::optional<Status> accept(const StepOutcome& outcome, double h, std::uint32_t far_surfaces = 0);
  /// The ray's end; begin() sets out anew.
  [[nodiscard]] RayEnd end(Status status);

  [[nodiscard]] RayProgress& progress() { return now_; }
  [[nodiscard]] const Spacetime& chart() const { return *chart_; }
  [[nodiscard]] int sheet() const { return sheet_; }
  [[nodiscard]] SurfaceWatch& watch() { return watch_; }
  [[nodiscard]] Stepper& stepper() { return *stepper_; }
  /// The flow at the start.
  [[nodiscard]] const PhaseState<double>& first_rate() const { return first_rate_; }

 private:
  [[nodiscard]] PhaseState<double> counted_flow(const PhaseState<double>& y);
  void begin_chart();
  void first_step();
  [[nodiscard]] std::optional<Status> try_step();
  [[nodiscard]] bool looks_too_far(double h, double fraction);
  [[nodiscard]] double reached() const;
  [[nodiscard]] std::optional<double> meeting(const StepView& step, const PhaseState<double>& stepped) const;
  [[nodiscard]] std::optional<Status> finish_step(const PhaseState<double>& begin, double h, double part);
  [[nodiscard]] Vec4<double> a_little_ahead();
  [[nodiscard]] double radial_change();
  [[nodiscard]] std::optional<Status> beyond_radius();
  void retreat_into_domain(const PhaseState<double>& begin, double lambda_begin, double h, double part);
  void record_hits(std::span<const Crossing> crossings, double h, double last);
  void note_residual();
  void count_evaluations();

  TraceSettings settings_;
  std::optional<double> r_max_;
  const Spacetime& home_;  ///< the chart of the start
  std::span<const Event> events_;
  std::function<void(const StepView&)> observer_;
  const Spacetime* chart_;
  int sheet_ = 1;
  RayProgress now_;
  PhaseState<double> first_rate_;
  SurfaceWatch watch_;
  Projector projector_;
  std::unique_ptr<Stepper> stepper_;
  const Spacetime* stepper_chart_ = nullptr;
  bool keeps_stepper_ = false;
  long evaluations_counted_ = 0;
  MethodCard method_;
  std::vector<EventHit> hits_;
  PathWatch* things_ = nullptr;
  std::size_t number_ = 0;
};

}  // namespace xpr
