// Events and dense output: where a ray meets a surface, and the path between the ends of a step.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "metrics/ellis_exact.hpp"
#include "metrics/medium_exact.hpp"
#include "validation/bundle.hpp"
#include "validation/convergence.hpp"
#include "validation/families/numerical.hpp"
#include "validation/kit.hpp"

namespace xpr::numerical {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

const std::array<MethodAt, 5> tracers = {MethodAt{"rkf45", 1e-9}, MethodAt{"dopri54", 1e-10}, MethodAt{"dop853", 1e-12},
                                         MethodAt{"odeint:dopri5", 1e-10}, MethodAt{"odeint:bulirsch-stoer", 1e-10}};

/// How nearly a straight ray meets a sphere of radius 3: sharp, and down to all but tangent.
constexpr std::array<double, 4> heights = {0.0, 1.5, 2.999, 3.0 - 1e-9};

/// Straight light along x at height y meets a sphere: the exact lambda of the first meeting, from x = -10.
double sphere_entry(double height, double radius) { return 10.0 - std::sqrt((radius - height) * (radius + height)); }

Event sphere_event(double radius) {
  return {.name = "sphere", .g = [radius](const Spacetime&, const PhaseState<double>& y, int) {
            return (y[1] - radius) * (y[1] + radius) + y[2] * y[2] + y[3] * y[3];
          }};
}

/// The stop at a radius, and a sphere as an event of its own, on rays whose meetings are known.
std::vector<Row> straight_rows(const Lab& lab, const MethodAt& method) {
  std::vector<Row> rows;
  const std::unique_ptr<Spacetime> flat = lab.spacetime("minkowski", "cartesian");
  const Event sphere = sphere_event(3.0);
  for (const double height : heights) {
    PhaseState<double> start({0.0, -10.0, height, 0.0}, {-1.0, 1.0, 0.0, 0.0});
    const double exact = sphere_entry(height, 3.0);
    // Moving the sphere by one rounding of the point moves a nearly tangent meeting by that over the sine.
    const double sine = std::sqrt((3.0 - height) * (3.0 + height)) / 3.0;
    const Tolerance tolerance = {
        16.0 * epsilon * 10.0 / sine,
        fmt::format("16 roundings of x near 10, over the sine of the angle of meeting, {:.2g}; "
                    "the ray itself is straight to round-off",
                    sine)};
    const auto row = [&](std::string_view what, double lambda, const RayEnd& end) {
      Row out = make_row(fmt::format("{} at height {} with {}", what, height, method.method), *flat, method,
                         {{"height", height, "1"}});
      out.evaluations = end.evaluations;
      grade(out, lambda, {exact, epsilon * exact}, tolerance);
      rows.push_back(out);
    };
    TraceSettings settings = trace_settings(method);
    settings.lambda_max = 20.0;
    const RayEnd through = lab.trace(*flat, start, 1, settings, {&sphere, 1});
    row("sphere", through.hits.empty() ? 20.0 : through.hits.front().lambda, through);
    settings.r_min = 3.0;
    const RayEnd stopped = lab.trace(*flat, start, 1, settings);
    row("radius", stopped.lambda, stopped);
  }
  return rows;
}

/// Where the great circle of a fish-eye's ray crosses a plane through the origin: its optical path.
double plane_crossing(const PhaseState<double>& y, const std::array<double, 3>& normal) {
  const double n = 2.0 / (1.0 + y[1] * y[1] + y[2] * y[2] + y[3] * y[3]);
  const double x_dot_p = y[1] * y[5] + y[2] * y[6] + y[3] * y[7];
  double A = 0.0, B = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    A += normal[k] * n * y[1 + k];
    B += normal[k] * (y[5 + k] / n - y[1 + k] * x_dot_p);
  }
  const double path = std::atan2(-A, B);
  return path > 0.0 ? path : path + std::numbers::pi;
}

/// The largest distance, over rays, between where a plane was met and where the great circle meets it.
Row plane_row(const Lab& lab, const MethodAt& method) {
  const Bundle bundle = fisheye_orbits(lab, lab.full() ? 32 : 16, FisheyePath::closed);
  SeededNumbers seeded(0x2718);
  double worst = 0.0;
  std::int64_t evaluations = 0, steps = 0;
  for (std::size_t i = 0; i < bundle.starts.size(); ++i) {
    const PhaseState<double>& start = bundle.starts[i];
    const std::array<double, 3> normal = seeded.direction();
    const Event plane = {.name = "plane",
                         .g = [normal](const Spacetime&, const PhaseState<double>& y,
                                       int) { return normal[0] * y[1] + normal[1] * y[2] + normal[2] * y[3]; },
                         .terminal = true};
    TraceSettings settings = trace_settings(method);
    settings.lambda_max = bundle.spans[i];
    const RayEnd end = lab.trace(*bundle.chart, start, 1, settings, {&plane, 1});
    const medium_exact::RayPoint exact = medium_exact::fisheye_ray(
        1.0, {start[1], start[2], start[3]}, {start[5], start[6], start[7]}, plane_crossing(start, normal));
    for (std::size_t k = 0; k < 3; ++k) worst = std::max(worst, std::abs(end.y[1 + k] - exact.position[k]));
    evaluations += end.evaluations;
    steps = std::max(steps, end.steps);
  }
  Row row = make_row(fmt::format("plane in the fish-eye with {}", method.method), *bundle.chart, method,
                     {{"rays", static_cast<double>(bundle.starts.size()), "1"}});
  row.evaluations = evaluations;
  grade_bound(
      row, worst,
      {static_cast<double>(steps) * method.setting * 16.0,
       fmt::format("{} steps, each within tol = {:g} of |x| up to 4, carried on by at most 4", steps, method.setting)});
  return row;
}

/// phi swept from l = 10 to the throat, where l_min stops the ray.
Row throat_row(const Lab& lab, const MethodAt& method, double b) {
  const std::unique_ptr<Spacetime> chart = lab.spacetime("ellis", "isotropic");
  const std::unique_ptr<Spacetime> classical = lab.spacetime("ellis", "proper-distance");
  const ChartState start = equatorial_light(*classical, *chart, 10.0, b);
  TraceSettings settings = trace_settings(method);
  settings.l_min = 0.0;
  const SweptRay ray = trace_swept(lab, *classical, *chart, start, settings);
  const double l_start = ray.start_classical[1];
  const ExactValue exact = ellis_exact::swept_angle(1.0, b, l_start, 0.0, false);
  Row row = make_row(fmt::format("throat at b = {} with {}", b, method.method), *chart, method, {{"b/b0", b, "1"}});
  row.unit = "rad";
  row.evaluations = ray.end.evaluations;
  // d phi / d l at the throat and d phi / d b along the way are below 1 / sqrt(1 - b^2).
  grade(row, ray.azimuth(), {exact.value, exact.error},
        accumulated(ray.end, method.setting, 10.0 / std::sqrt(1.0 - b * b)));
  return row;
}

std::vector<Row> event_rows(const Lab& lab) {
  std::vector<Row> rows;
  for (const MethodAt& method : tracers) {
    for (Row& row : straight_rows(lab, method)) rows.push_back(std::move(row));
    rows.push_back(plane_row(lab, method));
    for (const double b : {0.3, 0.9}) rows.push_back(throat_row(lab, method, b));
  }
  return rows;
}

/// Largest error of the interpolant inside one step, root mean square over starts.
double interpolation_error(const Lab& lab, const Bundle& bundle, std::string_view method, double h) {
  const Flow flow = bundle.flow();
  std::vector<double> errors;
  for (const PhaseState<double>& start : bundle.starts) {
    const std::unique_ptr<Stepper> stepper = lab.stepper(method, flow, {});
    (void)stepper->step(start, h);
    double worst = 0.0;
    for (const double theta : {0.2, 0.4, 0.6, 0.8}) {
      const PhaseState<double> inside = stepper->interpolate(theta);
      const PhaseState<double> truth = walk(*make_stepper("dop853", flow, {}), start, theta * h, 16).y;
      for (std::size_t k = 1; k < 8; ++k) worst = std::max(worst, std::abs(inside[k] - truth[k]));
    }
    errors.push_back(worst);
  }
  return root_mean_square(errors);
}

std::vector<Row> dense_rows(const Lab& lab) {
  const Bundle bundle = fisheye_orbits(lab, 16, FisheyePath::arc);
  std::vector<Row> rows;
  for (const MethodCard& card : methods()) {
    if (card.id == "odeint:bulirsch-stoer") continue;  // takes its order as it goes
    const double h = card.dense_order > 5 ? 0.16 : 0.02;
    const double coarse = interpolation_error(lab, bundle, card.id, h);
    const double fine = interpolation_error(lab, bundle, card.id, 0.5 * h);
    Row row = make_row(fmt::format("order of the dense output of {}", card.id), *bundle.chart,
                       {std::string(card.id), h}, {{"rays", static_cast<double>(bundle.starts.size()), "1"}});
    row.note = fmt::format("errors inside a step {:.2g}, at half the step {:.2g}", coarse, fine);
    grade(row, order_between(h, coarse, 0.5 * h, fine), {card.dense_order + 1.0, 0.0},
          {0.25, "one step errs as h^(q+1); the next term of its series makes up to 19 % (2^0.25 = 1.19)"});
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

std::vector<Case> event_cases() {
  return {
      {.info = info("events",
                    "radius, sphere, plane and throat are met where the closed forms say, to the tolerance of the ray",
                    "Straight rays against a sphere, down to one that all but touches it (as a stop and as an event); "
                    "great circles of the fish-eye against planes; light into the Ellis throat.",
                    "x = -sqrt(R^2 - y^2); the great circle's crossing; Ellis's swept angle", TruthRank::closed_form,
                    "Maxwell1854 Ellis1973 Chandrupatla1997", "numerical_events.cpp"),
       .run = event_rows},
      {.info = info("dense-output", "between the ends of a step the path is known to the order on the method's card",
                    "The largest error of the interpolant at four points inside one step falls as h^(q+1).",
                    "the same part of the step in sixteen steps of DOP853", TruthRank::self_convergence,
                    "HairerNorsettWanner1993 Shampine1986", "numerical_events.cpp"),
       .run = dense_rows},
  };
}

}  // namespace xpr::numerical
