#include "core/transport.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "integrators/batch_tracer.hpp"
#include "integrators/stepper.hpp"
#include "metrics/catalogue.hpp"
#include "metrics/null_cone.hpp"

namespace xpr {
namespace {

void need(bool good, const std::string& what) {
  if (!good) throw std::invalid_argument(what);
}

// Settings that make no sense are refused before the first ray.
void check(const TraceSettings& trace, const Spacetime& transport) {
  const MethodCard& method = method_card(trace.method);
  const auto number = [](double value) { return fmt::format("{}", value); };
  if (method.adaptive) {
    need(trace.tol > 0.0 && trace.tol < 1.0, "tol = " + number(trace.tol) + ", needs 0 < tol < 1");
  } else {
    need(trace.step > 0.0 && std::isfinite(trace.step), "step = " + number(trace.step) + ", needs step > 0");
  }
  need(!method.separable_only || transport.separable(),
       "method " + std::string(method.id) + " needs a Hamiltonian that separates, T(p) + V(x); " +
           std::string(transport.card().metric) + " in " + std::string(transport.card().chart) + " does not");
  need(trace.lambda_max > 0.0, "lambda-max = " + number(trace.lambda_max) + ", needs lambda-max > 0");
  need(trace.max_steps > 0, "max-steps = " + std::to_string(trace.max_steps) + ", needs max-steps > 0");
  need(!trace.r_min || *trace.r_min >= 0.0, "r-min = " + number(trace.r_min.value_or(0.0)) + ", needs r-min >= 0");
  need(!trace.r_max || *trace.r_max > 0.0, "r-max = " + number(trace.r_max.value_or(0.0)) + ", needs r-max > 0");
  need(!trace.r_min || !trace.r_max || *trace.r_min < *trace.r_max, "r-min needs to be less than r-max");
  need(!trace.l_min || !trace.l_max || *trace.l_min < *trace.l_max, "l-min needs to be less than l-max");
}

bool all_finite(const PhaseState<double>& y) {
  return std::all_of(y.c.begin(), y.c.end(), [](double c) { return std::isfinite(c); });
}

// p^t: positive for rays that run forward in time.
double time_rate(const Spacetime& spacetime, const PhaseState<double>& y) {
  return raise_index(spacetime.inverse_metric(y.x()), y.p())[0];
}

// Whether physics and chart admit a start: inside the chart, polar angles in [0, pi], a direction in time.
bool admissible(const Spacetime& chart, const PhaseState<double>& y) {
  if (!all_finite(y) || !chart.inside_domain(y.x())) return false;
  for (std::size_t mu = 0; mu < 4; ++mu) {
    const bool polar = chart.card().coordinates[mu].kind == CoordinateKind::polar_angle;
    if (polar && !(y[mu] >= 0.0 && y[mu] <= std::numbers::pi)) return false;
  }
  const double rate = time_rate(chart, y);
  return std::isfinite(rate) && rate != 0.0;
}

std::unique_ptr<Spacetime> make_transport_chart(const TransportSettings& settings, bool future_directed) {
  const std::string_view chart = settings.transport_chart.empty() ? transport_chart(settings.metric, future_directed)
                                                                  : std::string_view(settings.transport_chart);
  return make_spacetime(settings.metric, chart, settings.parameters);
}

}  // namespace

double length_unit_of(const Spacetime& spacetime) {
  constexpr std::array<std::string_view, 4> scales{"M", "b0", "R", "a_axis"};
  for (const std::string_view scale : scales) {
    for (const NamedValue& parameter : spacetime.parameters()) {
      if (parameter.name == scale) return parameter.value;
    }
  }
  return 1.0;
}

Transport::Transport(TransportSettings settings)
    : settings_(std::move(settings)),
      chart_(make_spacetime(settings_.metric, settings_.chart, settings_.parameters)),
      forward_(make_transport_chart(settings_, true)),
      backward_(make_transport_chart(settings_, false)) {
  settings_.chart = chart_->card().chart;
  settings_.parameters = chart_->parameters();  // all of them, with names that live as long as the program
  settings_.trace.length_unit = length_unit_of(*chart_);
  if (!settings_.trace.r_min) settings_.trace.r_min = forward_->default_r_min();
  check(settings_.trace, *forward_);
  const bool two_sided = chart_->proper_distance({0.0, 1.0, 1.0, 1.0}, 1).has_value();
  need(two_sided || (!settings_.trace.l_min && !settings_.trace.l_max),
       "l-min and l-max need a wormhole; " + settings_.metric + " has no throat to measure from");
}

Transport::~Transport() = default;

double Transport::off_cone(const Ray& ray) const { return chart_->null_residual(ray.start); }

Ray Transport::renormalised(const Ray& ray) const {
  const double rate = time_rate(*chart_, ray.start);
  Ray out = ray;
  if (const auto p = null_momentum(*chart_, ray.start.x(), ray.start.p(), rate)) {
    out.start = {ray.start.x(), *p};
  }
  return out;
}

bool Transport::admits(const Ray& ray) const {
  if (!admissible(*chart_, ray.start)) return false;
  if (ray.sheet != 1 && !(ray.sheet == -1 && chart_->proper_distance(ray.start.x(), ray.sheet))) return false;
  const ChartState inside = change_chart(*chart_, *forward_, ray.start, ray.sheet);
  return admissible(*forward_, inside.state);
}

namespace {

/// The row of a ray that never set out.
TracedRay refused(const Ray& ray) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  return {.id = ray.id,
          .status = Status::outside_domain,
          .sheet = ray.sheet,
          .end = ray.start,
          .null_residual = nan,
          .null_residual_max = nan};
}

}  // namespace

std::optional<Transport::Departure> Transport::departure(const Ray& ray) const {
  if (!admits(ray)) return std::nullopt;
  Departure out{forward_.get(), change_chart(*chart_, *forward_, ray.start, ray.sheet), 0.0};
  if (time_rate(*out.chart, out.start.state) < 0.0) {
    out.chart = backward_.get();
    out.start = change_chart(*chart_, *backward_, ray.start, ray.sheet);
    if (!admissible(*out.chart, out.start.state)) return std::nullopt;
  }
  const double far = std::max(1000.0 * settings_.trace.length_unit, 2.0 * out.chart->radius(out.start.state.x()));
  out.r_max = settings_.trace.r_max.value_or(far);
  return out;
}

TracedRay Transport::arrival(const Ray& ray, const RayEnd& end, const RayAngles& angles) const {
  ChartState back = change_chart(*end.chart, *chart_, end.y, end.sheet);
  // A chart that covers both sides of a wormhole tells them apart by the sign of l.
  if (const auto l = chart_->proper_distance(back.state.x(), back.sheet)) back.sheet = *l < 0.0 ? -1 : 1;
  return {.id = ray.id,
          .status = end.status,
          .sheet = back.sheet,
          .end = end.lambda == 0.0 ? ray.start : angles.continued(end, back.state),  // stopped where it began
          .lambda = end.lambda,
          .steps = end.steps,
          .rejected = end.rejected,
          .evaluations = end.evaluations,
          .null_residual = end.null_residual,
          .null_residual_max = end.null_residual_max};
}

TracedRay Transport::trace(const Ray& ray) const {
  const std::optional<Departure> from = departure(ray);
  if (!from) return refused(ray);
  TraceSettings trace = settings_.trace;
  trace.r_max = from->r_max;
  RayAngles angles(*chart_, *from->chart, ray.start, from->start);
  const RayEnd end = trace_ray(*from->chart, from->start.state, from->start.sheet, trace, {}, angles.observer());
  return arrival(ray, end, angles);
}

void Transport::trace(std::span<const Ray> rays, int lanes, std::span<TracedRay> out) const {
  std::vector<Departure> departures(rays.size());
  std::vector<std::size_t> forward;
  std::vector<std::size_t> backward;
  for (std::size_t k = 0; k < rays.size(); ++k) {
    const std::optional<Departure> from = departure(rays[k]);
    if (!from) {
      out[k] = refused(rays[k]);
      continue;
    }
    departures[k] = *from;
    // Rays that have to be followed step by step go alone.
    if (RayAngles(*chart_, *from->chart, rays[k].start, from->start).follows_steps()) {
      out[k] = trace(rays[k]);
    } else {
      (from->chart == forward_.get() ? forward : backward).push_back(k);
    }
  }
  trace_in_lanes(rays, *forward_, departures, forward, lanes, out);
  trace_in_lanes(rays, *backward_, departures, backward, lanes, out);
}

void Transport::trace_in_lanes(std::span<const Ray> rays, const Spacetime& chart, std::span<const Departure> departures,
                               std::span<const std::size_t> places, int lanes, std::span<TracedRay> out) const {
  std::vector<BatchRay> batch;
  batch.reserve(places.size());
  for (const std::size_t k : places) {
    batch.push_back({departures[k].start.state, departures[k].start.sheet, departures[k].r_max});
  }
  if (batch.empty()) return;
  TraceSettings trace = settings_.trace;
  trace.r_max = batch.front().r_max;  // every ray has its own
  std::vector<RayEnd> ends(batch.size());
  trace_rays(chart, batch, trace, lanes, ends);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::size_t k = places[i];
    out[k] = arrival(rays[k], ends[i], RayAngles(*chart_, chart, rays[k].start, departures[k].start));
  }
}

}  // namespace xpr
