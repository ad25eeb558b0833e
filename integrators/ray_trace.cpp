#include "integrators/ray_trace.hpp"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>
#include <utility>

#include "metrics/scalar/elementary.hpp"

namespace xpr {
namespace {

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
  if (spacetime.interface_distance({})) out.push_back({.kind = SurfaceKind::interface, .cuts = true});
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

}  // namespace

RayTrace::RayTrace(const Spacetime& spacetime, const TraceSettings& settings, std::span<const Event> events,
                   std::function<void(const StepView&)> observer)
    : settings_(settings),
      home_(spacetime),
      events_(events),
      observer_(std::move(observer)),
      chart_(&spacetime),
      watch_(surfaces_of(spacetime, settings, events), settings.length_unit),
      projector_(settings.projection),
      method_(method_card(settings.method)) {
  check(spacetime, settings, method_);
}

PhaseState<double> RayTrace::counted_flow(const PhaseState<double>& y) {
  ++now_.evaluations;
  return chart_->flow(y);
}

void RayTrace::count_evaluations() {
  if (!stepper_) return;
  now_.evaluations += stepper_->evaluations() - evaluations_counted_;
  evaluations_counted_ = stepper_->evaluations();
}

void RayTrace::begin_chart() {
  count_evaluations();
  now_.last = {};
  if (keeps_stepper_ && stepper_chart_ == chart_) return;
  StepperSettings settings;
  settings.error_scale = error_scale(*chart_, now_.y, settings_);
  settings.tao_omega = settings_.tao_omega;
  Flow flow = [chart = chart_](const PhaseState<double>& y) { return chart->flow(y); };
  if (has_interface(*chart_)) {
    flow = [this](const PhaseState<double>& y) { return chart_->flow_of_side(y, now_.inside_interface); };
  }
  stepper_.reset();
  if (settings_.stepper_factory) stepper_ = settings_.stepper_factory(settings_.method, flow, settings);
  if (!stepper_) stepper_ = make_stepper(settings_.method, flow, settings);
  stepper_chart_ = chart_;
  evaluations_counted_ = 0;
  method_ = stepper_->card();
}

void RayTrace::first_step() {
  const double p_unit = component_units(*chart_, now_.y, 1.0)[4];
  now_.h = settings_.step / p_unit;
  if (method_.adaptive) {
    const Flow flow = [this](const PhaseState<double>& y) { return counted_flow(y); };
    const ErrorScale scale = error_scale(*chart_, now_.y, settings_);
    now_.h = initial_step(flow, scale, now_.y, first_rate_, method_.error_power);
  }
  now_.h_first = now_.h;
}

std::optional<Status> RayTrace::begin(const PhaseState<double>& start, int sheet, std::optional<double> r_max,
                                      std::size_t number) {
  number_ = number;
  r_max_ = r_max ? r_max : settings_.r_max;
  chart_ = &home_;
  sheet_ = sheet;
  now_ = {.y = start, .lambda = {}};
  hits_.clear();
  if (stepper_) evaluations_counted_ = stepper_->evaluations();
  if (!all_finite(now_.y)) return Status::not_finite;
  if (!chart_->inside_domain(now_.y.x())) return Status::outside_domain;
  projector_.begin(*chart_, now_.y, component_units(*chart_, now_.y, settings_.length_unit));
  if (!projector_.restore(*chart_, now_.y)) return Status::constraint_violated;
  note_residual();
  first_rate_ = counted_flow(now_.y);
  if (!all_finite(first_rate_)) return Status::not_finite;
  if (const std::optional<double> rim = chart_->interface_radius()) {
    const double radius = chart_->radius(now_.y.x());
    now_.inside_interface = radius < *rim || (radius == *rim && radial_change() < 0.0);
  }
  if (const std::optional<double> off = chart_->interface_distance(now_.y.x())) {
    const double ahead = *off != 0.0 ? *off : *chart_->interface_distance(a_little_ahead());
    now_.inside_interface = ahead < 0.0;
  }
  begin_chart();
  first_step();
  watch_.restart(r_max_);
  watch_.begin(*chart_, now_.y, sheet_);
  return beyond_radius();
}

std::optional<Status> RayTrace::spent() const {
  if (now_.lambda.sum >= settings_.lambda_max) return Status::max_affine;
  if (now_.steps >= settings_.max_steps) return Status::max_steps;
  return std::nullopt;
}

Status RayTrace::go_on() {
  while (true) {
    if (const std::optional<Status> status = spent()) return *status;
    if (const std::optional<Status> status = try_step()) return *status;
  }
}

/// One attempt. A rejected one only shortens the step.
std::optional<Status> RayTrace::try_step() {
  const double rest = settings_.lambda_max - now_.lambda.sum;
  const double h = now_.h < rest ? now_.h : rest;
  const StepOutcome outcome = stepper_->step(now_.y, h);
  const bool numbers = all_finite(outcome.y) && isfinite(outcome.error_norm);
  if (!method_.adaptive) {
    if (!numbers) return Status::not_finite;
    if (!outcome.converged) return Status::step_underflow;
    return accept(outcome, h);
  }
  if (numbers && outcome.converged && outcome.error_norm <= 1.0) {
    const double factor = step_factor_foreseen(h, outcome.error_norm, now_.last, method_.error_power);
    now_.last = StepMemory<double>::of(h, outcome.error_norm);
    const double proposed = outcome.next_step > 0.0 ? outcome.next_step : h * factor;
    // Right after a rejection the step must not grow: it would be rejected again.
    now_.h = now_.last_rejected && proposed > h ? h : proposed;
    now_.last_rejected = false;
    return accept(outcome, h);
  }
  ++now_.rejected;
  now_.last_rejected = true;
  now_.h = outcome.next_step > 0.0 ? outcome.next_step : h * step_factor(outcome.error_norm, method_.error_power);
  if (now_.h < least_step * reached()) return numbers ? Status::step_underflow : Status::not_finite;
  return std::nullopt;
}

/// Whether a step to an interface, `fraction` of what was tried, has to be made again because its stages lay beyond,
/// where this side's formula says little: the next try ends just past the interface. So light that came in with long
/// steps does not fly through a field with all stages on its far side.
bool RayTrace::looks_too_far(double h, double fraction) {
  constexpr double past = 1.001;
  if (!method_.adaptive || fraction * square(past) > 1.0 || h < least_step * reached()) return false;
  watch_.take_back();
  ++now_.rejected;
  now_.last_rejected = true;
  now_.last = {};
  now_.h = past * h;
  return true;
}

/// The path so far, measured in first steps where it has hardly begun.
double RayTrace::reached() const { return now_.lambda.sum > now_.h_first ? now_.lambda.sum : now_.h_first; }

/// Takes a step of size h, or the part of it up to the first stop that it meets.
std::optional<Status> RayTrace::accept(const StepOutcome& outcome, double h, std::uint32_t far_surfaces) {
  const PhaseState<double> begin = now_.y;
  const double lambda_begin = now_.lambda.sum;
  const std::span<const Crossing> crossings =
      watch_.crossings({*chart_, sheet_, begin, outcome.y, h, *stepper_}, far_surfaces);
  const Surface* last = crossings.empty() ? nullptr : &watch_.surface(crossings.back().surface);
  const bool cut = last != nullptr && (last->terminal || last->cuts);
  double fraction = cut ? crossings.back().theta : 1.0;
  if (cut && last->kind == SurfaceKind::interface && looks_too_far(fraction * h, fraction)) return std::nullopt;
  // The stepper may have repeated the step as the shorter one.
  double part = cut && method_.dense_order >= method_.order - 1 ? fraction : 1.0;
  PhaseState<double> end = cut ? crossings.back().y : outcome.y;
  const std::optional<double> thing =
      meeting({*chart_, sheet_, lambda_begin + fraction * h, fraction * h, begin, end, *stepper_, part},
              part == 1.0 ? end : outcome.y);
  if (thing) {
    part *= *thing;
    fraction *= *thing;
    end = stepper_->interpolate(part);
  }
  record_hits(crossings, h, fraction);
  now_.y = end;
  now_.lambda.add(fraction * h);
  if (fraction == 1.0 && h == settings_.lambda_max - lambda_begin) now_.lambda = {settings_.lambda_max, 0.0};
  ++now_.steps;
  if (!chart_->inside_domain(now_.y.x())) {
    retreat_into_domain(begin, lambda_begin, fraction * h, part);
    note_residual();
    return Status::outside_domain;
  }
  const bool rises = cut && crossings.back().direction > 0;
  const std::optional<Status> trouble = finish_step(begin, fraction * h, part);
  if (thing) return Status::hit;
  if (cut && last->terminal) return last->status;
  if (cut) {
    now_.inside_interface = !rises;
    begin_chart();
  }
  return trouble;
}

/// The first thing on a step, part of the one that the stepper made last and that ended at `stepped`.
std::optional<double> RayTrace::meeting(const StepView& step, const PhaseState<double>& stepped) const {
  if (things_ == nullptr) return std::nullopt;
  const PhaseState<double>&from = step.stepper.begin_rate(), &to = step.stepper.end_rate();
  std::array<double, 3> begin{}, end{}, bend{};
  for (std::size_t i = 1; i < 4; ++i) {
    begin[i - 1] = step.begin[i];
    end[i - 1] = step.end[i];
    // Of the whole step: a part of it bends less.
    bend[i - 1] = bend_of(step.h / step.part, step.begin[i], from[i], stepped[i], to[i]);
  }
  if (!things_->may_meet(begin, end, bend)) return std::nullopt;
  return things_->first_meeting(number_, step);
}

/// Projection, bookkeeping, the observer, and the next chart.
std::optional<Status> RayTrace::finish_step(const PhaseState<double>& begin, double h, double part) {
  if (!projector_.restore(*chart_, now_.y)) return Status::constraint_violated;
  note_residual();
  if (observer_) observer_({*chart_, sheet_, now_.lambda.sum, h, begin, now_.y, *stepper_, part});
  if (now_.null_residual > useless_residual) return Status::constraint_violated;
  if (const std::optional<Status> status = beyond_radius()) return status;
  if (const std::optional<ChartSwitch> next = chart_->atlas_switch(now_.y, sheet_)) {
    chart_ = next->chart;
    now_.y = next->state;
    sheet_ = next->sheet;
    begin_chart();
    projector_.change_chart(*chart_, now_.y, component_units(*chart_, now_.y, settings_.length_unit));
    watch_.begin(*chart_, now_.y, sheet_);
    if (!all_finite(now_.y)) return Status::not_finite;
    if (!chart_->inside_domain(now_.y.x())) return Status::outside_domain;
  }
  return std::nullopt;
}

/// A move along the ray so short that it is straight.
Vec4<double> RayTrace::a_little_ahead() {
  const PhaseState<double> rate = counted_flow(now_.y);
  double fastest = 0.0;
  for (std::size_t i = 1; i < 4; ++i) fastest = abs(rate[i]) > fastest ? abs(rate[i]) : fastest;
  const double ahead = 1e-6 * settings_.length_unit / fastest;
  Vec4<double> x = now_.y.x();
  for (std::size_t i = 1; i < 4; ++i) x[i] += ahead * rate[i];
  return x;
}

/// How the radius changes along the ray.
double RayTrace::radial_change() { return chart_->radius(a_little_ahead()) - chart_->radius(now_.y.x()); }

/// A ray beyond a radius that it never crossed: one that began there. It is done once it goes away from it.
std::optional<Status> RayTrace::beyond_radius() {
  if (!r_max_ && !settings_.r_min) return std::nullopt;
  const double radius = chart_->radius(now_.y.x());
  const bool outside = r_max_ && radius >= *r_max_;
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
  now_.y = last;
  now_.lambda = {lambda_begin + inside * h, 0.0};
}

/// Of the crossings up to fraction `last` of the step.
void RayTrace::record_hits(std::span<const Crossing> crossings, double h, double last) {
  for (const Crossing& crossing : crossings) {
    if (crossing.theta > last) return;
    const Surface& surface = watch_.surface(crossing.surface);
    if (surface.kind == SurfaceKind::half_plane && crossing.y[1] < 0.0) now_.windings -= crossing.direction;
    if (surface.kind != SurfaceKind::event) continue;
    EventHit hit{surface.index, now_.lambda.sum + crossing.theta * h, crossing.y, chart_, sheet_};
    (void)projector_.restore(*chart_, hit.y);
    hits_.push_back(hit);
  }
}

void RayTrace::note_residual() {
  const bool defined = chart_->inverse_metric(now_.y.x())(0, 0) < 0.0;
  now_.null_residual = defined ? chart_->null_residual(now_.y) : std::numeric_limits<double>::quiet_NaN();
  if (now_.null_residual > now_.null_residual_max) now_.null_residual_max = now_.null_residual;
}

RayEnd RayTrace::end(Status status) {
  count_evaluations();
  RayEnd out;
  out.status = status;
  out.y = now_.y;
  out.chart = chart_;
  out.sheet = sheet_;
  out.lambda = now_.lambda.sum;
  out.steps = now_.steps;
  out.rejected = now_.rejected;
  out.evaluations = now_.evaluations;
  out.null_residual = now_.null_residual;
  out.null_residual_max = now_.null_residual_max;
  out.windings = now_.windings;
  out.hits = std::move(hits_);
  return out;
}

}  // namespace xpr
