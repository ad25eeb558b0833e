// Luneburg 1944: the lens that brings parallel light to a point on its rim. [Luneburg1964]
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
constexpr const char* focus_fault = "paper-luneburg-thin-lens";

/// int n^2 ds along x = x_in cos s + sin s (y: y0 cos s), a quarter period.
double path_by_quadrature(const Lab& lab, double y) {
  const long double x_in = -std::sqrt(1.0L - static_cast<long double>(y) * y);
  const long double n_most = lab.planted(focus_fault) ? 2.25L : 2.0L;
  const Integral path = integral(
      [=](long double s) {
        const long double x = x_in * std::cos(s) + std::sin(s), h = y * std::cos(s);
        return n_most - x * x - h * h;
      },
      0.0L, std::numbers::pi_v<long double> / 2.0L);
  return static_cast<double>(path.value);
}

PhaseState<double> parallel_light(double y) { return {{0.0, -2.0, y, 0.0}, {-1.0, 1.0, 0.0, 0.0}}; }

RayEnd to_focus(const Lab& lab, const Spacetime& lens, double y, const MethodAt& method) {
  TraceSettings settings = trace_settings(method);
  // Outside |p| = 1 and lambda is the length; inside, a quarter period.
  settings.lambda_max = 2.0 - std::sqrt(1.0 - y * y) + 0.5 * pi_;
  return lab.trace(lens, parallel_light(y), 1, settings);
}

void run(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  const std::array<NamedValue, 1> values{{{"R", 1.0}}};
  const auto lens = lab.spacetime("luneburg", "cartesian", values);
  const std::array<MethodAt, 3> methods{{{"dop853", 1e-14}, {"dopri54", 1e-12}, {"gl6", 0.02}}};
  const Tolerance traced_error{1e-10, "steps' local errors below 1e-12 each; (h)^6 = 6e-11 for the collocation method"};
  for (const double y : {0.6, 0.2, 0.9}) {
    const double rim = std::sqrt(1.0 - y * y);
    ClaimSheet path = sheet.claim(fmt::format("optical path from the entry at y = {} R to the focus", y), "R");
    path.exact({y == 0.6 ? 2.3707963267949 : 0.5 * pi_ + rim, y == 0.6 ? 5e-14 : 3e-16}, "pi/2 + sqrt(1 - y^2)");
    const Tolerance digits{1e-12, "the digits of the evaluation"};
    path.ours("exact solutions' module", exact::luneburg_path_to_focus(1.0, y).value, digits);
    path.ours("quadrature of n^2 along the ray", path_by_quadrature(lab, y), digits);
    ClaimSheet height = sheet.claim(fmt::format("height at the focus of light that enters at y = {} R", y), "R");
    height.exact({0.0, 0.0}, "all parallel light meets at (R, 0, 0)");
    height.ours("closed ray", exact::luneburg_ray(1.0, {-rim, y, 0.0}, {1.0, 0.0, 0.0}, 0.5 * pi_).position[1],
                {1e-15, "round-off"});
    ClaimSheet slope = sheet.claim(fmt::format("p_y at the focus of light that enters at y = {} R", y));
    slope.exact({-y, 0.0}, "momentum (sqrt(1 - y^2), -y)");
    slope.ours("closed ray", exact::luneburg_ray(1.0, {-rim, y, 0.0}, {1.0, 0.0, 0.0}, 0.5 * pi_).momentum[1],
               {1e-14, "round-off"});
    for (const MethodAt& method : methods) {
      const RayEnd end = to_focus(lab, *lens, y, method);
      const TracedRoute route{*lens, method, end, Status::max_affine};
      path.traced(route, end.y[0] - (2.0 - rim), traced_error);
      height.traced(route, end.y[2], traced_error);
      slope.traced(route, end.y[6], traced_error);
    }
  }
  Series rays{"traced rays", Look::line, {}, {}}, rim{"", Look::dotted, {}, {}};
  for (const double angle : even_steps(0.0, 2.0 * pi_, 97))
    rim.x.push_back(std::cos(angle)), rim.y.push_back(std::sin(angle));
  for (const double y : even_steps(-0.95, 0.95, 15)) {
    rays.x.push_back(-2.0), rays.y.push_back(y);
    TraceSettings settings = trace_settings({"dop853", 1e-10});
    settings.lambda_max = 2.0 - std::sqrt(1.0 - y * y) + 0.5 * pi_ + 0.8;
    const RayEnd end = lab.trace(*lens, parallel_light(y), 1, settings, {}, [&](const StepView& step) {
      for (const double part : {0.25, 0.5, 0.75, 1.0}) {
        const PhaseState<double> at = step.at(part);
        rays.x.push_back(at[1]), rays.y.push_back(at[2]);
      }
    });
    (void)end;
    rays.x.push_back(std::nan("")), rays.y.push_back(std::nan(""));
  }
  sheet.figure() = {.title = "Luneburg's lens",
                    .caption = "Parallel light meets on the rim; all optical paths to there are equal.",
                    .panels = {{.title = "Parallel light",
                                .x_label = "x [R]",
                                .y_label = "y [R]",
                                .equal = true,
                                .series = {rim, rays, {"focus", Look::printed, {1.0}, {0.0}}}}}};
}

}  // namespace

Paper luneburg_1944() {
  return {
      .info = {.id = "luneburg-1944",
               .reference = "R. K. Luneburg, Mathematical Theory of Optics (lectures of 1944; University of California "
                            "Press 1964)",
               .reproduced = "Focus, direction and optical path of parallel light in n^2 = 2 - r^2.",
               .cites = "Luneburg1964",
               .not_checked = {"The general lens with other foci; printed numbers: none is known from a source."}},
      .run = run,
      .faults = {{focus_fault, "n = 1.5 in the middle instead of sqrt2"}}};
}

}  // namespace xpr::papers
