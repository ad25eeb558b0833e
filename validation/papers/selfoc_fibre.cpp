// The parabolic fibre n^2 = n0^2 (1 - g^2 rho^2): exact rays, not paraxial ones. [BornWolf1999]
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "validation/papers/flow_light.hpp"
#include "validation/papers/papers.hpp"
#include "validation/papers/quadrature.hpp"

namespace xpr::papers {

namespace {

constexpr double pi_ = std::numbers::pi;
constexpr double g = 0.3;  // n0 = 1
constexpr const char* paraxial_fault = "paper-selfoc-paraxial";

/// x along the fibre, y across it.
Flow fibre() {
  return medium_flow([](double, double y) { return Index{1.0 - g * g * y * y, 0.0, -2.0 * g * g * y}; });
}
PhaseState<double> launch(double y) { return {{0.0, 0.0, y, 0.0}, {-1.0, std::sqrt(1.0 - g * g * y * y), 0.0, 0.0}}; }

double period(const Lab& lab, double y) {
  return 2.0 * pi_ * (lab.planted(paraxial_fault) ? 1.0 : std::sqrt(1.0 - g * g * y * y)) / g;
}

/// Along the ray dz/dy = p_z/p_y: four times the integral from the axis to the turning point, y = sin(t).
double period_by_quadrature(long double y0) {
  const long double gg = g, p_z = std::sqrt(1.0L - gg * gg * y0 * y0);
  const Integral quarter = integral(
      [&](long double t) {
        // p_y^2 = g^2 (y0^2 - y^2) with y = y0 sin(t).
        const long double sine = std::sin(t), rest = std::sqrt((1.0L - sine) * (1.0L + sine));
        return rest > 0.0L ? p_z / gg * std::cos(t) / rest : p_z / gg;
      },
      0.0L, 0.5L * std::numbers::pi_v<long double>);
  return static_cast<double>(4.0L * quarter.value);
}

void run(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  ClaimSheet along = sheet.claim("period along the fibre of a ray launched at rho = 1, g = 0.3");
  along.exact({19.9792559142853, 5e-14}, "2 pi p_z/(n0 g), mpmath, 15 digits");
  along.ours("the formula", period(lab, 1.0), {1e-12, "twenty times the digits of the evaluation"});
  along.ours("quadrature of dz/drho", period_by_quadrature(1.0L),
             {1e-10, "a difference under the root, next to the turning point"});
  ClaimSheet at_ten = sheet.claim("x at z = 10 of the same ray");
  at_ten.exact({-0.999994680150556, 5e-16}, "cos(n0 g s) with z = p_z s, mpmath");
  at_ten.ours("the formula", std::cos(2.0 * pi_ * 10.0 / period(lab, 1.0)), {1e-14, "round-off"});
  for (const FixedSteps& how : flow_routes()) {
    const PhaseState<double> start = launch(1.0);
    // A period later the ray runs parallel again, p_y = 0 falling: dp_y = -g^2 y.
    const PhaseState<double> whole = follow_until(
        how, fibre(), start, 2.0 * pi_ / g, [](const PhaseState<double>& y) { return y[6]; },
        [](const PhaseState<double>& y) { return -g * g * y[2]; });
    along.ours(route_name(how), whole[1],
               {1e-11, "(0.02)^6 of the collocation method's steps over six radians; round-off"});
    const PhaseState<double> ten = follow(how, fibre(), start, 10.0 / start[5]);
    at_ten.ours(route_name(how), ten[2], {1e-12, "as above, where the path turns"});
  }
  ClaimSheet paraxial = sheet.claim("paraxial period, which the exact one is not");
  paraxial.exact({20.943951023932, 5e-13}, "2 pi/g");
  paraxial.ours("the formula", 2.0 * pi_ / g, {1e-11, "the digits of the evaluation"});
  paraxial.ours("exact period of a ray launched at rho = 1e-4", period_by_quadrature(1e-4L),
                {1e-8, "less by g^2 rho^2/2 = 5e-10 of itself"});
  std::vector<Series> rays;
  for (const double y : {0.2, 0.6, 1.0, 1.6, 2.2}) {
    Series ray = path_of(fibre(), launch(y), 45.0 / launch(y)[5], 200);
    ray.name = fmt::format("launched at {}", y);
    rays.push_back(std::move(ray));
  }
  sheet.figure() = {
      .title = "The parabolic fibre",
      .caption =
          "Exact rays launched parallel to the axis: the farther out, the shorter the period, so that "
          "they do not meet again.",
      .panels = {{.title = "Rays, g = 0.3", .x_label = "z", .y_label = "rho", .series = std::move(rays)}}};
}

}  // namespace

Paper selfoc_fibre() {
  return {.info = {.id = "selfoc-fibre",
                   .reference = "The parabolic (SELFOC) fibre, as in M. Born, E. Wolf, Principles of Optics",
                   .reproduced = "The exact period of rays in a parabolic index profile.",
                   .cites = "BornWolf1999",
                   .not_checked = {"A textbook result: no paper is named for it, and no printed number is known."}},
          .run = run,
          .faults = {{paraxial_fault, "the paraxial period for the exact one"}}};
}

}  // namespace xpr::papers
