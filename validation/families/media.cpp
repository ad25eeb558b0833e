// Light in static media with exact rays: uniform, the Luneburg lens, Maxwell's fish-eye.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "metrics/medium_exact.hpp"
#include "metrics/scalar/elementary.hpp"
#include "validation/families.hpp"
#include "validation/kit.hpp"

namespace xpr {

namespace {

namespace exact = medium_exact;

constexpr double R = 1.0;

std::unique_ptr<Spacetime> medium(const Lab& lab, std::string_view id) {
  if (id == "medium-uniform") {
    const std::array<NamedValue, 1> values{{{"n", 1.5}}};
    return lab.spacetime(id, "cartesian", values);
  }
  const std::array<NamedValue, 1> values{{{"R", R}}};
  return lab.spacetime(id, "cartesian", values);
}

/// Light at x along the unit vector d: |p| = n E with n^2 = -g^{tt}, E = 1.
PhaseState<double> light(const Spacetime& chart, const std::array<double, 3>& x, const std::array<double, 3>& d) {
  const Vec4<double> event = {0.0, x[0], x[1], x[2]};
  const double n = std::sqrt(-chart.inverse_metric(event)(0, 0));
  return {event, {-1.0, n * d[0], n * d[1], n * d[2]}};
}

double distance(const PhaseState<double>& y, const std::array<double, 3>& point) {
  return std::hypot(y[1] - point[0], y[2] - point[1], y[3] - point[2]);
}

std::array<Event, 1> at_optical_path(double t) {
  return {{{.name = "optical path",
            .g = [t](const Spacetime&, const PhaseState<double>& y, int) { return y[0] - t; },
            .terminal = true}}};
}

/// Largest frequency of the ray equation x'' = grad(n^2)/2 in lambda: sqrt of its stiffest second derivative.
constexpr double luneburg_frequency = 1.0 / R;
constexpr double fisheye_frequency = 2.8284271247461903 / R;  // sqrt 8 at the centre, where n^2/2 = 2 - 4 r^2

/// Steps' local errors for adaptive methods; for fixed steps (frequency h)^order over a path of ten radians of phase.
Tolerance method_tolerance(const RayEnd& end, const MethodAt& method, double frequency, double condition) {
  const MethodCard& card = method_card(method.method);
  if (card.adaptive) return accumulated(end, method.setting, condition);
  const double truncation = 10.0 * std::pow(frequency * method.setting, card.order);
  const double round_off = static_cast<double>(end.steps) * 2.2e-16;
  return {condition * (truncation + round_off),
          fmt::format("({:.3g} h)^{} over ten radians, and {} steps' round-off, amplified by at most {:.3g}", frequency,
                      card.order, end.steps, condition)};
}

std::vector<MethodAt> media_methods(const Lab& lab) {
  std::vector<MethodAt> methods = {{"dop853", 1e-13}, {"dopri54", 1e-10}, {"rk4", 0.01}, {"gl4", 0.02}};
  if (lab.full()) {
    methods.insert(methods.end(), {{"gl6", 0.05},
                                   {"verlet", 1e-3},
                                   {"implicit-midpoint", 1e-3},
                                   {"tao4", 0.005},
                                   {"dop853", 1e-10, Projection::full},
                                   {"odeint:rkf78", 1e-12}});
  }
  return methods;
}

std::vector<Row> uniform_rows(const Lab& lab) {
  std::vector<Row> rows;
  const auto chart = medium(lab, "medium-uniform");
  for (const MethodAt& method : {MethodAt{"dop853", 1e-12}, MethodAt{"rk4", 0.1}, MethodAt{"verlet", 0.1}}) {
    TraceSettings settings = trace_settings(method);
    const PhaseState<double> start = light(*chart, {1.0, -2.0, 0.5}, {2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0});
    const RayEnd end = lab.trace(*chart, start, 1, settings, at_optical_path(30.0));
    Row row = make_row(fmt::format("optical path 30 in n = 1.5, {}", method_label(method)), *chart, method, {});
    grade_bound(row, distance(end.y, {1.0 + 20.0 * 2.0 / 3.0, -2.0 - 20.0 / 3.0, 0.5 + 20.0 * 2.0 / 3.0}),
                {static_cast<double>(end.steps + 2) * 8e-15,
                 "a straight line is exact in every method: round-off of lengths of 20, once a step"});
    row.evaluations = end.evaluations;
    rows.push_back(std::move(row));
  }
  return rows;
}

constexpr const char* focal_length_fault = "luneburg-focus-at-two-thirds";

std::vector<Row> luneburg_rows(const Lab& lab) {
  std::vector<Row> rows;
  const auto chart = medium(lab, "luneburg");
  for (const double y0 : {0.0, 0.1, 0.6, 0.9, 0.99}) {
    for (const MethodAt& method : media_methods(lab)) {
      const std::array<double, 3> from = {-2.0 * R, y0 * cos(0.7), y0 * sin(0.7)};
      TraceSettings settings = trace_settings(method);
      const double rim = std::sqrt(1.0 - square(y0));
      // Outside p = 1, so lambda is the length; inside x = x0 cos lambda + p0 sin lambda: a quarter period to the
      // focus.
      settings.lambda_max = 2.0 * R - rim + 0.5 * pi<double>() * R;
      const RayEnd end = lab.trace(*chart, light(*chart, from, {1.0, 0.0, 0.0}), 1, settings);
      const exact::ExactPoint focus = exact::luneburg_focus(R);
      const double aim = lab.planted(focal_length_fault) ? 2.0 / 3.0 : 1.0;
      Row row = make_row(fmt::format("focus, height {} R, {} {:g}", y0, method_label(method), method.setting), *chart,
                         method, {{"height", y0, "R"}});
      row.unit = "R";
      row.evaluations = end.evaluations;
      grade_bound(row, distance(end.y, {aim * focus.position[0], focus.position[1], focus.position[2]}),
                  method_tolerance(end, method, luneburg_frequency, 4.0));
      rows.push_back(row);
      row.label = fmt::format("optical path, height {} R, {} {:g}", y0, method_label(method), method.setting);
      const ExactValue path = exact::luneburg_path_to_focus(R, y0 * R);
      grade(row, end.y[0], {2.0 * R - rim + path.value, path.error},
            method_tolerance(end, method, luneburg_frequency, 4.0));
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

struct Launch {
  std::string_view name;
  std::array<double, 3> x;
  std::array<double, 3> d;
};

const std::array<Launch, 4> launches{{{"across", {0.5, 0.0, 0.0}, {0.0, 1.0, 0.0}},
                                      {"oblique", {0.5, 0.0, 0.0}, {0.6, 0.0, 0.8}},
                                      {"inward", {0.3, -0.6, 0.2}, {-0.48, 0.64, 0.6}},
                                      {"far out", {0.2, 0.1, 0.0}, {0.8, 0.0, 0.6}}}};

/// How far the ray goes out, over R: errors far out are seen from the dense middle through this many times as much.
double reach(const exact::RayCircle& circle) {
  return (std::hypot(circle.centre[0], circle.centre[1], circle.centre[2]) + circle.radius) / R;
}

std::vector<Row> image_rows(const Lab& lab) {
  std::vector<Row> rows;
  const auto chart = medium(lab, "maxwell-fisheye");
  for (const Launch& launch : launches) {
    for (const MethodAt& method : media_methods(lab)) {
      const PhaseState<double> start = light(*chart, launch.x, launch.d);
      const exact::RayCircle circle = exact::fisheye_circle(R, launch.x, {start[5], start[6], start[7]});
      const exact::ExactPoint image = exact::fisheye_image(R, launch.x);
      for (const double turns : {0.5, 1.0}) {
        const RayEnd end = lab.trace(*chart, start, 1, trace_settings(method),
                                     at_optical_path(turns * exact::fisheye_optical_period(R).value));
        Row row = make_row(fmt::format("{} {}, {} {:g}", launch.name, turns < 1.0 ? "to the image" : "once around",
                                       method_label(method), method.setting),
                           *chart, method, {{"turns", turns, "1"}});
        row.unit = "R";
        row.evaluations = end.evaluations;
        grade_bound(row, distance(end.y, turns < 1.0 ? image.position : launch.x),
                    method_tolerance(end, method, fisheye_frequency, 4.0 * square(1.0 + reach(circle))));
        row.reference_error = image.error;
        rows.push_back(std::move(row));
      }
    }
  }
  return rows;
}

std::vector<Row> circle_rows(const Lab& lab) {
  std::vector<Row> rows;
  const auto chart = medium(lab, "maxwell-fisheye");
  for (const Launch& launch : launches) {
    for (const MethodAt& method : media_methods(lab)) {
      const PhaseState<double> start = light(*chart, launch.x, launch.d);
      const exact::RayCircle circle = exact::fisheye_circle(R, launch.x, {start[5], start[6], start[7]});
      double worst = 0.0;
      const RayEnd end = lab.trace(*chart, start, 1, trace_settings(method), at_optical_path(2.0 * pi<double>() * R),
                                   [&](const StepView& step) {
                                     const double off = distance(step.end, circle.centre) - circle.radius;
                                     worst = std::max(worst, std::abs(off));
                                   });
      Row row = make_row(fmt::format("{}, {} {:g}", launch.name, method_label(method), method.setting), *chart, method,
                         {{"radius", circle.radius, "R"}});
      row.unit = "R";
      row.evaluations = end.evaluations;
      grade_bound(row, worst, method_tolerance(end, method, fisheye_frequency, 4.0 * square(1.0 + reach(circle))));
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace

std::vector<Case> media_cases() {
  return {
      {closed_form_case("media", "uniform", "In a uniform medium light runs straight and t is n times the length.",
                        "The end point after an optical path of 30 in n = 1.5.", "x0 + (t/n) d", "BornWolf1999"),
       true, uniform_rows},
      {closed_form_case(
           "media", "luneburg", "A Luneburg lens brings parallel light to a point on its rim, all paths equal.",
           "n^2 = 2 - r^2: x = x0 cos(lambda) + p0 sin(lambda). The distance from (R, 0, 0) a quarter period after the "
           "rim, and the optical path pi/2 + sqrt(1 - y^2) from there.",
           "the closed form of the ray", "Luneburg1964"),
       true, luneburg_rows},
      {closed_form_case("media", "fisheye-image",
                        "Maxwell's fish-eye images every point at its antipode after an optical path of pi R.",
                        "n = 2/(1 + r^2): x0 -> -x0/|x0|^2 after pi, back to x0 after 2 pi.",
                        "the closed form of the image", "Maxwell1854 BornWolf1999"),
       true, image_rows},
      {closed_form_case("media", "fisheye-circle", "Rays of Maxwell's fish-eye are circles.",
                        "Largest distance of the traced ray from its exact circle over one turn.",
                        "centre and radius from the great circle of the 3-sphere", "Maxwell1854 BornWolf1999"),
       true, circle_rows},
  };
}

std::vector<Fault> media_faults() {
  return {{.id = focal_length_fault,
           .description = "the focus of the Luneburg lens expected at two thirds of its radius",
           .case_id = "media/luneburg"}};
}

}  // namespace xpr
