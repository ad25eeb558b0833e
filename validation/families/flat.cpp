// Light in flat spacetime: straight lines in both charts, through the axis too; aberration.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "metrics/chart_map.hpp"
#include "metrics/scalar/elementary.hpp"
#include "validation/families.hpp"
#include "validation/kit.hpp"

namespace xpr {

namespace {

struct Launch {
  std::string_view name;
  std::array<double, 3> x, d;
};
// Past the axis, almost through it, through it exactly, through the origin's neighbourhood.
constexpr std::array<Launch, 4> launches{{{"generic", {10.0, -3.0, 4.0}, {-2.0 / 3.0, 1.0 / 3.0, -2.0 / 3.0}},
                                          {"past the axis within 1e-8", {5.0, 1e-8, 2.0}, {-1.0, 0.0, 0.0}},
                                          {"through the axis", {5.0, 0.0, 2.0}, {-1.0, 0.0, 0.0}},
                                          {"near the origin", {6.0, 1e-3, 0.0}, {-1.0, 0.0, 0.0}}}};

constexpr double length = 12.0;

PhaseState<double> light(const Launch& launch) {
  return {{0.0, launch.x[0], launch.x[1], launch.x[2]}, {-1.0, launch.d[0], launch.d[1], launch.d[2]}};
}

/// Distance from where a straight line of `length` ends.
double off_target(const PhaseState<double>& y, const Launch& launch) {
  return std::hypot(y[1] - (launch.x[0] + length * launch.d[0]), y[2] - (launch.x[1] + length * launch.d[1]),
                    y[3] - (launch.x[2] + length * launch.d[2]));
}

constexpr const char* quarter_turn_fault = "flat-axis-crossing-without-half-turn";

std::vector<Row> straight_rows(const Lab& lab) {
  std::vector<Row> rows;
  const auto cartesian = lab.spacetime("minkowski", "cartesian");
  for (const MethodCard& card : methods()) {
    const MethodAt method{std::string(card.id), card.adaptive ? 1e-12 : 0.25};
    for (const Launch& launch : launches) {
      TraceSettings settings = trace_settings(method);
      settings.lambda_max = length;
      const RayEnd end = lab.trace(*cartesian, light(launch), 1, settings);
      Row row = make_row(fmt::format("{}, {}", launch.name, method_label(method)), *cartesian, method, {});
      row.evaluations = end.evaluations;
      grade_bound(row, off_target(end.y, launch),
                  {static_cast<double>(end.steps + 4) * 4e-15,
                   "a straight line is exact in every method: two units of round-off of lengths of 10, once a step"});
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

std::vector<Row> spherical_rows(const Lab& lab) {
  std::vector<Row> rows;
  const auto cartesian = lab.spacetime("minkowski", "cartesian");
  const auto spherical = lab.spacetime("minkowski", "spherical");
  for (const Launch& launch : launches) {
    for (const bool polar_transport : {false, true}) {
      // The polar chart has no way through its own axis; past it at 1e-8 it needs steps of that size, and finds them.
      if (polar_transport && launch.x[1] == 0.0) continue;
      const Spacetime& chart = polar_transport ? *spherical : *cartesian;
      const MethodAt method{"dop853", 1e-13};
      TraceSettings settings = trace_settings(method);
      settings.lambda_max = length;
      const ChartState start = change_chart(*cartesian, chart, light(launch));
      const SweptRay ray = trace_swept(lab, *spherical, chart, start, settings);
      PhaseState<double> end = ray.end_classical;
      if (lab.planted(quarter_turn_fault)) end[3] = ray.start_classical[3] + 0.5 * ray.azimuth();
      const PhaseState<double> back = change_chart(*spherical, *cartesian, end).state;
      Row row = make_row(fmt::format("{}, transported in {}", launch.name, chart.card().chart), chart, method, {});
      row.evaluations = ray.end.evaluations;
      const double closest = std::hypot(launch.x[1], launch.x[2]);
      grade_bound(row, off_target(back, launch),
                  polar_transport ? accumulated(ray.end, method.setting, length / std::min(1.0, closest))
                                  : Tolerance{1e-13, "round-off of two chart maps at lengths of 10, once a step"});
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

constexpr const char* aberration_fault = "flat-aberration-sign";

/// A bundle of light from all around, traced to an observer at the origin who moves along z: his angles against the
/// formula. Directions are those towards the sources.
std::vector<Row> aberration_rows(const Lab& lab) {
  std::vector<Row> rows;
  const auto chart = lab.spacetime("minkowski", "cartesian");
  for (const double beta : {0.1, 0.5, 0.99}) {
    const double gamma = 1.0 / std::sqrt((1.0 - beta) * (1.0 + beta));
    for (const double degrees : {10.0, 60.0, 90.0, 150.0}) {
      const double theta = degrees * pi<double>() / 180.0;
      const MethodAt method{"dop853", 1e-13};
      TraceSettings settings = trace_settings(method);
      settings.lambda_max = 100.0;
      const Launch ray{"", {100.0 * sin(theta), 0.0, 100.0 * cos(theta)}, {-sin(theta), 0.0, -cos(theta)}};
      const RayEnd end = lab.trace(*chart, light(ray), 1, settings);
      // His frequency -p.u and the component of p along his own z axis, e_z = gamma (beta, 0, 0, 1).
      const double frequency = -gamma * (end.y[4] + beta * end.y[7]);
      const double along = gamma * (beta * end.y[4] + end.y[7]);
      const double sign = lab.planted(aberration_fault) ? -1.0 : 1.0;
      const double expected = (cos(theta) + sign * beta) / (1.0 + sign * beta * cos(theta));
      Row row = make_row(fmt::format("cos theta' at beta = {}, theta = {} deg", beta, degrees), *chart, method,
                         {{"beta", beta, "1"}, {"theta", degrees, "degree"}});
      const Tolerance tolerance{1e-14 * square(gamma), "round-off, amplified by gamma^2 in the boost"};
      grade(row, -along / frequency, {expected, 4e-16}, tolerance);
      rows.push_back(row);
      row.label = fmt::format("Doppler factor at beta = {}, theta = {} deg", beta, degrees);
      grade(row, frequency, {gamma * (1.0 + sign * beta * cos(theta)), 4e-16 * gamma}, tolerance);
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace

std::vector<Case> flat_cases() {
  return {
      {closed_form_case("flat", "straight", "Light runs straight, to round-off, in every method.",
                        "Distance from x0 + lambda p after lambda = 12, in the Cartesian chart.", "the straight line",
                        "MisnerThorneWheeler1973"),
       true, straight_rows},
      {closed_form_case(
           "flat", "spherical", "The same lines in spherical coordinates, past the axis and through it.",
           "Transported in either chart, read in spherical angles that are continuous along the ray, and compared in "
           "space.",
           "the straight line", "MisnerThorneWheeler1973"),
       true, spherical_rows},
      {closed_form_case(
           "flat", "aberration", "A moving observer sees light aberrated and shifted.",
           "cos theta' = (cos theta + beta)/(1 + beta cos theta), frequency gamma (1 + beta cos theta), for traced "
           "rays that arrive at an observer who moves towards theta = 0.",
           "the closed forms of special relativity", "MisnerThorneWheeler1973"),
       true, aberration_rows}};
}

std::vector<Fault> flat_faults() {
  return {{.id = quarter_turn_fault,
           .description = "phi swept by half of what it is when a ray passes the axis",
           .case_id = "flat/spherical"},
          {.id = aberration_fault,
           .description = "aberration and Doppler shift with the sign of the velocity turned",
           .case_id = "flat/aberration"}};
}

}  // namespace xpr
