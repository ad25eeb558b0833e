#include "validation/kit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "core/ray_angles.hpp"
#include "metrics/scalar/elementary.hpp"

namespace xpr {

std::string method_label(const MethodAt& method) {
  switch (method.projection) {
    case Projection::none:
      return method.method;
    case Projection::energy:
      return method.method + "+energy";
    case Projection::momentum:
      return method.method + "+momentum";
    case Projection::full:
      return method.method + "+full";
  }
  throw std::invalid_argument("unknown projection");
}

TraceSettings trace_settings(const MethodAt& method, double length_unit) {
  TraceSettings settings;
  settings.method = method.method;
  (method_card(method.method).adaptive ? settings.tol : settings.step) = method.setting;
  settings.projection = method.projection;
  settings.length_unit = length_unit;
  return settings;
}

CaseInfo closed_form_case(std::string_view family, std::string_view name, std::string claim, std::string physics,
                          std::string truth, std::string cites) {
  return {.id = fmt::format("{}/{}", family, name),
          .family = std::string(family),
          .claim = std::move(claim),
          .physics = std::move(physics),
          .truth = std::move(truth),
          .rank = TruthRank::closed_form,
          .grades_metric = true,
          .cites = std::move(cites),
          .source = fmt::format("validation/families/{}.cpp", family)};
}

Row make_row(std::string label, const Spacetime& chart, const MethodAt& method, std::vector<RowParameter> parameters) {
  Row row;
  row.label = std::move(label);
  row.parameters = std::move(parameters);
  row.metric = chart.card().metric;
  row.chart = chart.card().chart;
  row.method = method.method.empty() ? "" : method_label(method);
  row.setting = method.setting;
  return row;
}

void grade(Row& row, double value, const Truth& truth, const Tolerance& tolerance) {
  row.value = value;
  row.reference = truth.value;
  row.reference_error = truth.error;
  row.tolerance = tolerance.value;
  row.tolerance_reason = tolerance.reason;
  judge(row);
}

void grade_bound(Row& row, double quantity, const Tolerance& bound) { grade(row, quantity, {0.0, 0.0}, bound); }

Row skipped_row(std::string label, std::string reason, std::string unit) {
  Row row;
  row.unit = std::move(unit);
  row.label = std::move(label);
  row.note = std::move(reason);
  row.verdict = Verdict::skipped;
  return row;
}

ChartState general_light(const Spacetime& classical, const Spacetime& chart, double r, double theta, double L,
                         double p_theta, bool inward) {
  const Vec4<double> x = {0.0, r, theta, 0.0};
  const SymTensor4<double> g = classical.inverse_metric(x);
  const Vec4<double> transverse = {-1.0, 0.0, p_theta, L};
  const double p_r_squared = -contract(transverse, raise_index(g, transverse)) / g(1, 1);
  if (!(p_r_squared >= 0.0)) {
    throw std::domain_error(fmt::format("no light at r = {}, theta = {} with L = {}, p_theta = {}: p_r^2 = {}", r,
                                        theta, L, p_theta, p_r_squared));
  }
  const double p_r = (inward ? -1.0 : 1.0) * std::sqrt(p_r_squared);
  return change_chart(classical, chart, {x, {-1.0, p_r, p_theta, L}}, r < 0.0 ? -1 : 1);
}

ChartState equatorial_light(const Spacetime& classical, const Spacetime& chart, double r, double b, bool inward) {
  return general_light(classical, chart, r, 0.5 * pi<double>(), b, 0.0, inward);
}

PhaseState<double> reversed(const PhaseState<double>& y) {
  PhaseState<double> out = y;
  for (std::size_t i = 4; i < 8; ++i) out[i] = -out[i];
  return out;
}

SweptRay trace_swept(const Lab& lab, const Spacetime& classical, const Spacetime& chart, const ChartState& start,
                     const TraceSettings& settings, std::span<const Event> events) {
  SweptRay ray;
  ray.start_classical = change_chart(chart, classical, start.state, start.sheet).state;
  RayAngles angles(classical, chart, ray.start_classical, start);
  ray.end = lab.trace(chart, start.state, start.sheet, settings, events, angles.observer());
  const ChartState back = change_chart(*ray.end.chart, classical, ray.end.y, ray.end.sheet);
  ray.end_classical = angles.continued(ray.end, back.state);
  return ray;
}

double angle_between(const PhaseState<double>& a, const PhaseState<double>& b) {
  const auto direction = [](const PhaseState<double>& y) {
    return std::array<double, 3>{std::sin(y[2]) * std::cos(y[3]), std::sin(y[2]) * std::sin(y[3]), std::cos(y[2])};
  };
  const auto u = direction(a), v = direction(b);
  const double cross = std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
  return std::atan2(cross, u[0] * v[0] + u[1] * v[1] + u[2] * v[2]);
}

double killing_constant(const Spacetime& chart, const PhaseState<double>& y, std::string_view name) {
  for (const KillingVector& k : chart.killing_vectors(y.x())) {
    if (k.name == name) return k.sign * contract(k.component, y.p());
  }
  throw std::invalid_argument(
      fmt::format("{} in chart {} has no Killing constant '{}'", chart.card().metric, chart.card().chart, name));
}

double impact_parameter(const Spacetime& chart, const PhaseState<double>& y) {
  return killing_constant(chart, y, "L_z") / killing_constant(chart, y, "E");
}

Tolerance accumulated(const RayEnd& ray, double tol, double condition) {
  const double steps = static_cast<double>(ray.steps);
  const double round_off = std::numeric_limits<double>::epsilon();
  return {steps * (tol + round_off) * condition,
          fmt::format("{} steps, each within tol = {:g} and round-off, amplified by at most the ray's condition {:.3g}",
                      ray.steps, tol, condition)};
}

Tolerance deflection_tolerance(const RayEnd& ray, const MethodAt& method, double ratio, double condition,
                               double deflection) {
  if (method.setting <= 2e-15 && ratio >= 1.1) {
    return {1e-12 * std::max(1.0, deflection), "promised: 1e-12 max(1 rad, alpha) for b >= 1.1 b_c"};
  }
  return accumulated(ray, method.setting, condition);
}

Charts charts(const Lab& lab, std::string_view metric, std::string_view classical, std::string_view transport,
              std::span<const NamedValue> values) {
  return {lab.spacetime(metric, classical, values), lab.spacetime(metric, transport, values)};
}

bool ended_as(Row& row, const RayEnd& end, Status wanted) {
  row.evaluations += end.evaluations;
  if (end.status == wanted) return true;
  row.verdict = Verdict::error;
  row.note = fmt::format("the ray ended as '{}', not as '{}'", to_string(end.status), to_string(wanted));
  return false;
}

}  // namespace xpr
