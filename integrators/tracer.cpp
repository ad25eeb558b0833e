#include "integrators/tracer.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "integrators/projection.hpp"
#include "integrators/step_control.hpp"
#include "integrators/surface_watch.hpp"
#include "metrics/scalar/elementary.hpp"

namespace xpr {
namespace {

/// A covector this far off the cone is no light ray any more: |2H| of the size of its own terms.
constexpr double useless_residual = 0.5;

[[nodiscard]] bool all_finite(const PhaseState<double>& y) {
  // A sum is finite only if no part is NaN or infinite; only components near the largest double could mislead it.
  double sum = 0.0;
  for (const double component : y.c) sum += abs(component);
  return isfinite(sum);
}

[[nodiscard]] bool is_angle(CoordinateKind kind) {
  return kind == CoordinateKind::polar_angle || kind == CoordinateKind::azimuth || kind == CoordinateKind::latitude;
}

void check(const Spacetime& spacetime, const TraceSettings& settings, const MethodCard& method) {
  if (method.adaptive && !(settings.tol > 0.0 && settings.tol < 1.0)) {
    throw std::invalid_argument(fmt::format("tolerance {}, needs 0 < tol < 1", settings.tol));
  }
  if (!method.adaptive && !(settings.step > 0.0 && settings.step < unbounded)) {
    throw std::invalid_argument(fmt::format("step {}, needs a positive number", settings.step));
  }
  if (!(settings.length_unit > 0.0)) {
    throw std::invalid_argument(fmt::format("length unit {}, needs a positive number", settings.length_unit));
  }
  if (settings.max_steps < 0 || !(settings.lambda_max >= 0.0)) {
    throw std::invalid_argument(
        fmt::format("max_steps {} and lambda_max {} must not be negative", settings.max_steps, settings.lambda_max));
  }
  if (method.separable_only && !spacetime.separable()) {
    throw std::invalid_argument(fmt::format("method '{}' needs H = T(p) + V(x); that of {} ({}) does not separate",
                                            method.id, spacetime.card().metric, spacetime.card().chart));
  }
}

/// The built-in stops, then the user's events.
std::vector<Surface> surfaces_of(const Spacetime& spacetime, const TraceSettings& settings,
                                 std::span<const Event> events) {
  std::vector<Surface> out;
  const auto stop = [&](SurfaceKind kind, std::optional<double> level, int direction, Status status) {
    if (!level) return;
    out.push_back({.kind = kind, .level = *level, .direction = direction, .terminal = true, .status = status});
  };
  stop(SurfaceKind::radius, settings.r_min, -1, Status::captured);
  stop(SurfaceKind::radius, settings.r_max, +1, Status::escaped);
  stop(SurfaceKind::proper_distance, settings.l_min, -1, Status::crossed);
  stop(SurfaceKind::proper_distance, settings.l_max, +1, Status::crossed);
  if (const std::optional<double> rim = spacetime.interface_radius()) {
    out.push_back({.kind = SurfaceKind::radius, .level = *rim, .cuts = true});
  }
  const auto& coordinates = spacetime.card().coordinates;
  if (coordinates[1].name == "x" && coordinates[2].name == "y") out.push_back({.kind = SurfaceKind::half_plane});
  for (std::size_t i = 0; i < events.size(); ++i) {
    out.push_back({.kind = SurfaceKind::event,
                   .event = &events[i],
                   .index = i,
                   .direction = events[i].direction,
                   .terminal = events[i].terminal,
                   .status = events[i].status});
  }
  return out;
}

/// A sum that carries its round-off along, so that lambda of many equal steps stays exact.
class CompensatedSum {
 public:
  [[nodiscard]] double value() const { return sum_; }
  void add(double term) {
    const double corrected = term + rest_;
    const double next = sum_ + corrected;
    rest_ = corrected - (next - sum_);
    sum_ = next;
  }
  void set(double value) {
    sum_ = value;
    rest_ = 0.0;
  }

 private:
  double sum_ = 0.0;
  double rest_ = 0.0;
};

class RayTrace {
 public:
  RayTrace(const Spacetime& spacetime, const PhaseState<double>& start, int sheet, const TraceSettings& settings,
           std::span<const Event> events, const std::function<void(const StepView&)>& observer)
      : settings_(settings),
        observer_(observer),
        chart_(&spacetime),
        sheet_(sheet),
        y_(start),
        watch_(surfaces_of(spacetime, settings, events), settings.length_unit),
        projector_(settings.projection, spacetime, start, component_units(spacetime, start, settings.length_unit)) {}

  [[nodiscard]] RayEnd run();

 private:
  [[nodiscard]] PhaseState<double> counted_flow(const PhaseState<double>& y) {
    ++out_.evaluations;
    return chart_->flow(y);
  }
  void begin_chart();
  void first_step();
  [[nodiscard]] std::optional<Status> try_step();
  [[nodiscard]] std::optional<Status> accept(const StepOutcome& outcome, double h);
  [[nodiscard]] std::optional<Status> finish_step(const PhaseState<double>& begin, double h, double part);
  [[nodiscard]] double radial_change();
  [[nodiscard]] std::optional<Status> beyond_radius();
  void retreat_into_domain(const PhaseState<double>& begin, double lambda_begin, double h, double part);
  void record_hits(std::span<const Crossing> crossings, double h);
  void note_residual();
  [[nodiscard]] RayEnd ended(Status status);

  const TraceSettings& settings_;
  const std::function<void(const StepView&)>& observer_;
  const Spacetime* chart_;
  int sheet_;
  PhaseState<double> y_;
  CompensatedSum lambda_;
  SurfaceWatch watch_;
  Projector projector_;
  std::unique_ptr<Stepper> stepper_;
  MethodCard method_{};
  double h_ = 0.0;
  double h_first_ = 0.0;
  bool last_rejected_ = false;
  bool inside_interface_ = false;
  RayEnd out_;
};

void RayTrace::begin_chart() {
  StepperSettings settings;
  settings.error_scale = error_scale(*chart_, y_, settings_);
  settings.tao_omega = settings_.tao_omega;
  Flow flow = [chart = chart_](const PhaseState<double>& y) { return chart->flow(y); };
  if (chart_->interface_radius()) {
    flow = [chart = chart_, inside = inside_interface_](const PhaseState<double>& y) {
      return chart->flow_of_side(y, inside);
    };
  }
  if (stepper_) out_.evaluations += stepper_->evaluations();
  stepper_.reset();
  if (settings_.stepper_factory) stepper_ = settings_.stepper_factory(settings_.method, flow, settings);
  if (!stepper_) stepper_ = make_stepper(settings_.method, flow, settings);
  method_ = stepper_->card();
}

void RayTrace::first_step() {
  const double p_unit = component_units(*chart_, y_, 1.0)[4];
  h_ = settings_.step / p_unit;
  if (method_.adaptive) {
    const Flow flow = [this](const PhaseState<double>& y) { return counted_flow(y); };
    h_ = initial_step(flow, error_scale(*chart_, y_, settings_), y_, flow(y_), method_.error_power);
  }
  h_first_ = h_;
}

RayEnd RayTrace::run() {
  check(*chart_, settings_, method_card(settings_.method));
  if (!all_finite(y_)) return ended(Status::not_finite);
  if (!chart_->inside_domain(y_.x())) return ended(Status::outside_domain);
  if (!projector_.restore(*chart_, y_)) return ended(Status::constraint_violated);
  note_residual();
  if (!all_finite(counted_flow(y_))) return ended(Status::not_finite);
  if (const std::optional<double> rim = chart_->interface_radius()) {
    const double radius = chart_->radius(y_.x());
    inside_interface_ = radius < *rim || (radius == *rim && radial_change() < 0.0);
  }
  begin_chart();
  first_step();
  watch_.begin(*chart_, y_, sheet_);
  if (const std::optional<Status> status = beyond_radius()) return ended(*status);
  while (true) {
    if (lambda_.value() >= settings_.lambda_max) return ended(Status::max_affine);
    if (out_.steps >= settings_.max_steps) return ended(Status::max_steps);
    if (const std::optional<Status> status = try_step()) return ended(*status);
  }
}

/// One attempt. A rejected one only shortens the step.
std::optional<Status> RayTrace::try_step() {
  const double rest = settings_.lambda_max - lambda_.value();
  const double h = h_ < rest ? h_ : rest;
  const StepOutcome outcome = stepper_->step(y_, h);
  const bool numbers = all_finite(outcome.y) && isfinite(outcome.error_norm);
  if (!method_.adaptive) {
    if (!numbers) return Status::not_finite;
    if (!outcome.converged) return Status::step_underflow;
    return accept(outcome, h);
  }
  if (numbers && outcome.converged && outcome.error_norm <= 1.0) {
    const double factor = step_factor(outcome.error_norm, method_.error_power);
    const double proposed = outcome.next_step > 0.0 ? outcome.next_step : h * factor;
    // Right after a rejection the step must not grow: it would be rejected again.
    h_ = last_rejected_ && proposed > h ? h : proposed;
    last_rejected_ = false;
    return accept(outcome, h);
  }
  ++out_.rejected;
  last_rejected_ = true;
  h_ = outcome.next_step > 0.0 ? outcome.next_step : h * step_factor(outcome.error_norm, method_.error_power);
  // Below this the step drowns in the round-off of lambda, which is that of the path measured in first steps.
  constexpr double round_off = 4.0 * 2.220446049250313e-16;
  const double reached = lambda_.value() > h_first_ ? lambda_.value() : h_first_;
  if (h_ < round_off * reached) return numbers ? Status::step_underflow : Status::not_finite;
  return std::nullopt;
}

/// Takes a step of size h, or the part of it up to the first stop that it meets.
std::optional<Status> RayTrace::accept(const StepOutcome& outcome, double h) {
  const PhaseState<double> begin = y_;
  const double lambda_begin = lambda_.value();
  const std::span<const Crossing> crossings = watch_.crossings({*chart_, sheet_, begin, outcome.y, h, *stepper_});
  record_hits(crossings, h);
  const Surface* last = crossings.empty() ? nullptr : &watch_.surface(crossings.back().surface);
  const bool cut = last != nullptr && (last->terminal || last->cuts);
  y_ = cut ? crossings.back().y : outcome.y;
  const double fraction = cut ? crossings.back().theta : 1.0;
  lambda_.add(fraction * h);
  if (!cut && h == settings_.lambda_max - lambda_begin) lambda_.set(settings_.lambda_max);
  ++out_.steps;

  // The stepper may have repeated the step as the shorter one.
  const double part = cut && method_.dense_order >= method_.order - 1 ? fraction : 1.0;
  if (!chart_->inside_domain(y_.x())) {
    retreat_into_domain(begin, lambda_begin, fraction * h, part);
    note_residual();
    return Status::outside_domain;
  }
  const bool rises = cut && crossings.back().direction > 0;
  const std::optional<Status> trouble = finish_step(begin, fraction * h, part);
  if (cut && last->terminal) return last->status;
  if (cut) {
    inside_interface_ = !rises;
    begin_chart();
  }
  return trouble;
}

/// Projection, bookkeeping, the observer, and the next chart.
std::optional<Status> RayTrace::finish_step(const PhaseState<double>& begin, double h, double part) {
  if (!projector_.restore(*chart_, y_)) return Status::constraint_violated;
  note_residual();
  if (observer_) observer_({*chart_, sheet_, lambda_.value(), h, begin, y_, *stepper_, part});
  if (out_.null_residual > useless_residual) return Status::constraint_violated;
  if (const std::optional<Status> status = beyond_radius()) return status;
  if (const std::optional<ChartSwitch> next = chart_->atlas_switch(y_, sheet_)) {
    chart_ = next->chart;
    y_ = next->state;
    sheet_ = next->sheet;
    begin_chart();
    projector_.change_chart(*chart_, y_, component_units(*chart_, y_, settings_.length_unit));
    watch_.begin(*chart_, y_, sheet_);
    if (!all_finite(y_)) return Status::not_finite;
    if (!chart_->inside_domain(y_.x())) return Status::outside_domain;
  }
  return std::nullopt;
}

/// How the radius changes along the ray, over a move so short that the ray is straight.
double RayTrace::radial_change() {
  const PhaseState<double> rate = counted_flow(y_);
  double fastest = 0.0;
  for (std::size_t i = 1; i < 4; ++i) fastest = abs(rate[i]) > fastest ? abs(rate[i]) : fastest;
  const double ahead = 1e-6 * settings_.length_unit / fastest;
  Vec4<double> x = y_.x();
  for (std::size_t i = 1; i < 4; ++i) x[i] += ahead * rate[i];
  return chart_->radius(x) - chart_->radius(y_.x());
}

/// A ray beyond a radius that it never crossed: one that began there. It is done once it goes away from it.
std::optional<Status> RayTrace::beyond_radius() {
  if (!settings_.r_max && !settings_.r_min) return std::nullopt;
  const double radius = chart_->radius(y_.x());
  const bool outside = settings_.r_max && radius >= *settings_.r_max;
  const bool inside = settings_.r_min && radius <= *settings_.r_min;
  if (!outside && !inside) return std::nullopt;
  const double change = radial_change();
  if (outside && change > 0.0) return Status::escaped;
  if (inside && change < 0.0) return Status::captured;
  return std::nullopt;
}

/// The last point of the step that is inside the domain, by bisection of the dense output.
void RayTrace::retreat_into_domain(const PhaseState<double>& begin, double lambda_begin, double h, double part) {
  double inside = 0.0;
  double outside = 1.0;
  PhaseState<double> last = begin;
  for (int halving = 0; halving < 52; ++halving) {
    const double middle = 0.5 * (inside + outside);
    const PhaseState<double> y = stepper_->interpolate(part * middle);
    if (all_finite(y) && chart_->inside_domain(y.x())) {
      inside = middle;
      last = y;
    } else {
      outside = middle;
    }
  }
  y_ = last;
  lambda_.set(lambda_begin + inside * h);
}

void RayTrace::record_hits(std::span<const Crossing> crossings, double h) {
  for (const Crossing& crossing : crossings) {
    const Surface& surface = watch_.surface(crossing.surface);
    if (surface.kind == SurfaceKind::half_plane && crossing.y[1] < 0.0) out_.windings -= crossing.direction;
    if (surface.kind != SurfaceKind::event) continue;
    EventHit hit{surface.index, lambda_.value() + crossing.theta * h, crossing.y, chart_, sheet_};
    (void)projector_.restore(*chart_, hit.y);
    out_.hits.push_back(hit);
  }
}

void RayTrace::note_residual() {
  const bool defined = chart_->inverse_metric(y_.x())(0, 0) < 0.0;
  out_.null_residual = defined ? chart_->null_residual(y_) : std::numeric_limits<double>::quiet_NaN();
  if (out_.null_residual > out_.null_residual_max) out_.null_residual_max = out_.null_residual;
}

RayEnd RayTrace::ended(Status status) {
  if (stepper_) out_.evaluations += stepper_->evaluations();
  out_.status = status;
  out_.y = y_;
  out_.chart = chart_;
  out_.sheet = sheet_;
  out_.lambda = lambda_.value();
  return std::move(out_);
}

}  // namespace

std::array<double, 8> component_units(const Spacetime& spacetime, const PhaseState<double>& y, double length_unit) {
  double momentum = abs(y[4]);
  if (momentum == 0.0) {
    for (std::size_t i = 5; i < 8; ++i) momentum = abs(y[i]) > momentum ? abs(y[i]) : momentum;
  }
  std::array<double, 8> unit{};
  for (std::size_t mu = 0; mu < 4; ++mu) {
    const bool angle = is_angle(spacetime.card().coordinates[mu].kind);
    unit[mu] = angle ? 1.0 : length_unit;
    unit[4 + mu] = angle ? momentum * length_unit : momentum;
  }
  return unit;
}

ErrorScale error_scale(const Spacetime& spacetime, const PhaseState<double>& start, const TraceSettings& settings) {
  const std::array<double, 8> unit = component_units(spacetime, start, settings.length_unit);
  ErrorScale scale;
  for (std::size_t i = 0; i < 8; ++i) {
    scale.absolute[i] = settings.tol * unit[i];
    const bool relative = i < 4 && !is_angle(spacetime.card().coordinates[i].kind);
    scale.relative[i] = relative ? settings.tol : 0.0;
  }
  if (!settings.grade_time) scale.absolute[0] = unbounded;
  return scale;
}

RayEnd trace_ray(const Spacetime& spacetime, const PhaseState<double>& start, int sheet, const TraceSettings& settings,
                 std::span<const Event> events, const std::function<void(const StepView&)>& observer) {
  return RayTrace(spacetime, start, sheet, settings, events, observer).run();
}

}  // namespace xpr
