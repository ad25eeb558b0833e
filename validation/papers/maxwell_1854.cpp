// Maxwell 1854: the fish-eye, in which every point has a perfect image. [Maxwell1854]
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "metrics/medium_exact.hpp"
#include "validation/papers/papers.hpp"
#include "validation/papers/quadrature.hpp"
#include "validation/papers/schwarzschild_light.hpp"

namespace xpr::papers {

namespace {

namespace exact = medium_exact;

constexpr double pi_ = std::numbers::pi;
constexpr const char* image_fault = "paper-maxwell-upright-image";

PhaseState<double> light_from(double x, double angle) {
  const double n = 2.0 / (1.0 + x * x);
  return {{0.0, x, 0.0, 0.0}, {-1.0, n * std::cos(angle), n * std::sin(angle), 0.0}};
}

std::array<Event, 1> at_path(double t) {
  return {{{.name = "optical path",
            .g = [t](const Spacetime&, const PhaseState<double>& y, int) { return y[0] - t; },
            .terminal = true}}};
}

void run(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  const std::array<NamedValue, 1> values{{{"R", 1.0}}};
  const auto eye = lab.spacetime("maxwell-fisheye", "cartesian", values);
  const double sign = lab.planted(image_fault) ? 1.0 : -1.0;
  for (const double degrees : {40.0, 90.0, 130.0}) {
    const double angle = degrees * pi_ / 180.0;
    const PhaseState<double> start = light_from(0.5, angle);
    ClaimSheet x = sheet.claim(fmt::format("x of the image of (0.5, 0), light at {:g} deg", degrees), "R");
    x.exact({-2.0, 0.0}, "-x0/|x0|^2 after the optical path pi");
    x.ours("-x0/|x0|^2", sign * 0.5 / 0.25, {1e-15, "round-off"});
    x.ours("great circle of the 3-sphere",
           exact::fisheye_ray(1.0, {0.5, 0.0, 0.0}, {start[5], start[6], 0.0}, pi_).position[0],
           {1e-13, "round-off of a stereographic projection far out"});
    ClaimSheet y = sheet.claim(fmt::format("y of the image of (0.5, 0), light at {:g} deg", degrees), "R");
    y.exact({0.0, 0.0}, "-x0/|x0|^2 after the optical path pi");
    y.ours("great circle of the 3-sphere",
           exact::fisheye_ray(1.0, {0.5, 0.0, 0.0}, {start[5], start[6], 0.0}, pi_).position[1],
           {1e-13, "round-off of a stereographic projection far out"});
    ClaimSheet closed =
        sheet.claim(fmt::format("distance from the start after the path 2 pi, light at {:g} deg", degrees), "R");
    closed.exact({0.0, 0.0}, "rays are circles");
    const auto around = exact::fisheye_ray(1.0, {0.5, 0.0, 0.0}, {start[5], start[6], 0.0}, 2.0 * pi_).position;
    closed.ours("great circle of the 3-sphere", std::hypot(around[0] - 0.5, around[1]), {1e-13, "round-off"});
    const exact::RayCircle circle = exact::fisheye_circle(1.0, {0.5, 0.0, 0.0}, {start[5], start[6], 0.0});
    const double reach = std::hypot(circle.centre[0], circle.centre[1]) + circle.radius;
    for (const MethodAt& method : {MethodAt{"dop853", 1e-14}, MethodAt{"dopri54", 1e-12}}) {
      const RayEnd half = lab.trace(*eye, start, 1, trace_settings(method), at_path(pi_));
      const RayEnd whole = lab.trace(*eye, start, 1, trace_settings(method), at_path(2.0 * pi_));
      const Tolerance tolerance = accumulated(whole, method.setting, 4.0 * (1.0 + reach) * (1.0 + reach));
      x.traced({*eye, method, half, Status::crossed}, half.y[1], tolerance);
      y.traced({*eye, method, half, Status::crossed}, half.y[2], tolerance);
      closed.traced({*eye, method, whole, Status::crossed}, std::hypot(whole.y[1] - 0.5, whole.y[2]), tolerance);
    }
  }
  Series rays{"traced rays", Look::line, {}, {}};
  for (const double step_of_angle : even_steps(-6.5, 6.5, 14)) {
    // None along the axis: that one passes through the centre and reaches infinity.
    const double angle = (step_of_angle < 0.0 ? -0.15 : 0.15) * pi_ + step_of_angle * 0.1 * pi_;
    const PhaseState<double> start = light_from(0.5, angle);
    rays.x.push_back(start[1]), rays.y.push_back(start[2]);
    const RayEnd end =
        lab.trace(*eye, start, 1, trace_settings({"dop853", 1e-10}), at_path(2.0 * pi_), [&](const StepView& step) {
          for (const double part : {0.2, 0.4, 0.6, 0.8, 1.0}) {
            const PhaseState<double> at = step.at(part);
            rays.x.push_back(at[1]), rays.y.push_back(at[2]);
          }
        });
    (void)end;
    rays.x.push_back(std::nan("")), rays.y.push_back(std::nan(""));
  }
  sheet.figure() = {.title = "Maxwell's fish-eye",
                    .caption = "Rays are circles; all light from a point meets again at its image.",
                    .panels = {{.title = "Light from (0.5, 0)",
                                .x_label = "x [R]",
                                .y_label = "y [R]",
                                .equal = true,
                                .series = {rays, {"image", Look::printed, {-2.0}, {0.0}}}}}};
}

}  // namespace

Paper maxwell_1854() {
  return {.info = {.id = "maxwell-1854",
                   .reference = "J. C. Maxwell, Solutions of problems, Camb. Dublin Math. J. (1854); as in M. Born, E. "
                                "Wolf, Principles of Optics",
                   .reproduced = "Image and closed rays of n = 2/(1 + r^2).",
                   .cites = "Maxwell1854 BornWolf1999",
                   .not_checked = {"Printed numbers: none is known from a source."}},
          .run = run,
          .faults = {{image_fault, "the image on the same side as the source"}}};
}

}  // namespace xpr::papers
