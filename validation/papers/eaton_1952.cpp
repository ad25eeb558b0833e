// Eaton 1952: the lens that sends light back where it came from. n^2 = 2/r - 1 for r <= 1. [BornWolf1999]
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "validation/papers/flow_light.hpp"
#include "validation/papers/papers.hpp"
#include "validation/papers/quadrature.hpp"

namespace xpr::papers {

namespace {

constexpr double pi_ = std::numbers::pi;
constexpr const char* repelling_fault = "paper-eaton-repelling";

/// H = p^2/2 - 1/r + 1/2: Kepler's problem with unit semi-major axis.
Flow lens() {
  return medium_flow([](double x, double y) {
    const double r = std::hypot(x, y);
    return Index{2.0 / r - 1.0, -2.0 * x / (r * r * r), -2.0 * y / (r * r * r)};
  });
}
/// Light along +x where it meets the rim at height y.
PhaseState<double> entry(double y) { return {{0.0, -std::sqrt(1.0 - y * y), y, 0.0}, {-1.0, 1.0, 0.0, 0.0}}; }

/// From rim to rim by Kepler's equation: the ellipse of eccentricity e = sqrt(1 - y^2) meets r = 1 at eccentric anomaly
/// 90 and 270 degrees; the time between them, through the pericentre, is 2 (pi/2 - e).
double time_inside(double y) { return pi_ - 2.0 * std::sqrt(1.0 - y * y); }

/// Turning angle of the direction inside, by the swept angle: 2 int y dr/(r sqrt(2 r - r^2 - y^2)).
double swept_by_quadrature(long double y) {
  const long double least = 1.0L - std::sqrt(1.0L - y * y), most = 2.0L - least;
  const Integral half = integral(
      [&](long double s) {  // r = least + s^2
        const long double r = least + s * s;
        return 2.0L * y / (r * std::sqrt(most - r));
      },
      0.0L, std::sqrt(1.0L - least));
  return static_cast<double>(2.0L * half.value);
}

void run(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  for (const double y : {0.3, 0.5}) {
    ClaimSheet height = sheet.claim(fmt::format("height of the light that leaves, entering at y = {}", y));
    height.exact({-y, 0.0}, "it leaves at -y");
    ClaimSheet direction = sheet.claim(fmt::format("p_x of the light that leaves, entering at y = {}", y));
    direction.exact({-1.0, 0.0}, "antiparallel");
    // Clockwise from the entry at polar angle pi - asin(y), by the swept angle; the velocity is mirrored in the apse
    // line and reversed.
    const double swept = swept_by_quadrature(y) * (lab.planted(repelling_fault) ? -1.0 : 1.0);
    const double entry_angle = pi_ - std::asin(y);
    height.ours("Kepler's ellipse, swept angle by quadrature", std::sin(entry_angle - swept), {1e-12, "round-off"});
    direction.ours("Kepler's ellipse, turn of the velocity", std::cos(2.0 * entry_angle - swept + pi_),
                   {1e-12, "round-off"});
    ClaimSheet time = sheet.claim(fmt::format("parameter from rim to rim, entering at y = {}", y));
    time.exact({time_inside(y), 4e-16}, "Kepler's equation: pi - 2 sqrt(1 - y^2)");
    const long double least = 1.0L - std::sqrt(1.0L - static_cast<long double>(y) * y), most = 2.0L - least;
    const Integral half = integral(
        [&](long double s) {
          const long double r = least + s * s;
          return 2.0L * r / std::sqrt(most - r);
        },
        0.0L, std::sqrt(1.0L - least));
    time.ours("quadrature of the radial equation", static_cast<double>(2.0L * half.value), {1e-13, "round-off"});
    for (const FixedSteps& how : {FixedSteps{"dop853", 1200}, FixedSteps{"gl6", 6000}}) {
      const PhaseState<double> end = follow(how, lens(), entry(y), time_inside(y));
      const Tolerance tolerance{1e-9,
                                "pericentre at 0.05 R passed with hundreds of steps: measured convergence, eighth "
                                "and sixth order"};
      height.ours(route_name(how), end[2], tolerance);
      direction.ours(route_name(how), end[5], tolerance);
      time.ours(route_name(how) + ", rim met",
                time_inside(y) + (1.0 - std::hypot(end[1], end[2])) * std::hypot(end[1], end[2]) /
                                     (end[1] * end[5] + end[2] * end[6]),
                tolerance);
    }
  }
  std::vector<Series> rays;
  Series rim{"", Look::dotted, {}, {}};
  for (const double angle : even_steps(0.0, 2.0 * pi_, 97))
    rim.x.push_back(std::cos(angle)), rim.y.push_back(std::sin(angle));
  rays.push_back(std::move(rim));
  for (const double y : {0.15, 0.3, 0.5, 0.7, 0.9}) {
    Series ray = path_of(lens(), entry(y), time_inside(y), 300);
    ray.name = fmt::format("y = {}", y);
    ray.x.insert(ray.x.begin(), -1.8), ray.y.insert(ray.y.begin(), y);
    ray.x.push_back(-1.8), ray.y.push_back(-y);
    rays.push_back(std::move(ray));
  }
  sheet.figure() = {.title = "Eaton's lens",
                    .caption =
                        "Light that comes in parallel goes back antiparallel, after half of a Kepler ellipse about "
                        "the centre.",
                    .panels = {{.title = "Retro-reflection",
                                .x_label = "x [R]",
                                .y_label = "y [R]",
                                .equal = true,
                                .series = std::move(rays)}}};
}

}  // namespace

Paper eaton_1952() {
  return {.info = {.id = "eaton-1952",
                   .reference = "The Eaton lens, n^2 = 2/r - 1, a retro-reflector (J. E. Eaton, 1952)",
                   .reproduced = "Light leaves antiparallel at the mirrored height.",
                   .cites = "BornWolf1999",
                   .not_checked = {"The paper was not seen and is not in the bibliography; the index itself is what is "
                                   "tested.",
                                   "Light through the centre, where n has no bound."}},
          .run = run,
          .faults = {{repelling_fault, "the swept angle the other way round: a repelling centre"}}};
}

}  // namespace xpr::papers
