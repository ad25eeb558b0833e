// Light in a flat atmosphere with n = n0 exp(-y/H): exact mirage rays. [BornWolf1999]
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "validation/papers/flow_light.hpp"
#include "validation/papers/papers.hpp"
#include "validation/papers/quadrature.hpp"

namespace xpr::papers {

namespace {

constexpr double pi_ = std::numbers::pi;
constexpr double H = 10.0;
constexpr double elevation = pi_ / 3.0;
constexpr const char* factor_fault = "paper-atmosphere-half-height";

Flow atmosphere() {
  return medium_flow([](double, double y) {
    const double n_squared = std::exp(-2.0 * y / H);
    return Index{n_squared, 0.0, -2.0 / H * n_squared};
  });
}
PhaseState<double> launch(double angle) {
  return {{0.0, 0.0, 0.0, 0.0}, {-1.0, std::cos(angle), std::sin(angle), 0.0}};
}

void run(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  ClaimSheet apex = sheet.claim("apex of light launched at 60 deg, H = 10");
  apex.exact({6.93147180559945, 5e-15}, "H ln(n0/k) = 10 ln 2");
  ClaimSheet where = sheet.claim("x of the apex");
  where.exact({10.471975511966, 5e-13}, "10 pi/3: the elevation turns linearly with x");
  ClaimSheet range = sheet.claim("x where it is back at the ground");
  range.exact({20.943951023932, 5e-13}, "twice that");
  const double factor = lab.planted(factor_fault) ? 0.5 : 1.0;
  const Tolerance digits{1e-11, "twenty times the digits of the evaluation"};
  apex.ours("Snell's invariant", factor * H * std::log(1.0 / std::cos(elevation)),
            {1e-13, "the digits of the evaluation"});
  where.ours("the formula", H * elevation, digits);
  range.ours("the formula", 2.0 * H * elevation, digits);
  // dx/dy = k/sqrt(n^2 - k^2) with y = y_apex - s^2: n^2/k^2 - 1 = expm1(2 s^2/H).
  const Integral to_apex =
      integral([](long double s) { return 2.0L * s / std::sqrt(std::expm1(2.0L * s * s / 10.0L)); }, 0.0L,
               std::sqrt(10.0L * std::log(2.0L)));
  where.ours("quadrature of dx/dy", static_cast<double>(to_apex.value), digits);
  range.ours("quadrature of dx/dy, twice", 2.0 * static_cast<double>(to_apex.value), digits);
  for (const FixedSteps& how : flow_routes()) {
    // At the apex p_y = 0; dp_y = -n^2/H.
    const auto p_y = [](const PhaseState<double>& y) { return y[6]; };
    const PhaseState<double> top =
        follow_until(how, atmosphere(), launch(elevation), 20.0, p_y,
                     [](const PhaseState<double>& y) { return -std::exp(-2.0 * y[2] / H) / H; });
    const PhaseState<double> ground = follow_until(
        how, atmosphere(), launch(elevation), 41.0, [](const PhaseState<double>& y) { return y[2]; }, p_y);
    const Tolerance tolerance{1e-10, "steps of 0.03 H: (0.03)^6 = 7e-10 of the collocation method, over six factorial"};
    apex.ours(route_name(how), top[2], tolerance);
    where.ours(route_name(how), top[1], tolerance);
    range.ours(route_name(how), ground[1], tolerance);
  }
  std::vector<Series> rays;
  for (const double degrees : {15.0, 30.0, 45.0, 60.0, 75.0}) {
    const double angle = degrees * pi_ / 180.0;
    Series ray{fmt::format("{:g} deg", degrees), Look::line, {}, {}};
    for (const double x : even_steps(0.0, 2.0 * H * angle, 120)) {
      ray.x.push_back(x), ray.y.push_back(H * std::log(std::cos((x - H * angle) / H) / std::cos(angle)));
    }
    rays.push_back(std::move(ray));
  }
  Series stepped{"stepped, 60 deg", Look::dots, {}, {}};
  PhaseState<double> y = launch(elevation);
  for (int k = 0; k < 13; ++k) {
    stepped.x.push_back(y[1]), stepped.y.push_back(y[2]);
    y = follow({"dop853", 20}, atmosphere(), y, 40.0 / 12.0);
  }
  rays.push_back(std::move(stepped));
  sheet.figure() = {
      .title = "Light in an exponential atmosphere",
      .caption = "y = H ln[(n0/k) cos((x - x_a)/H)]: the elevation turns linearly with x.",
      .panels = {{.title = "Rays, H = 10", .x_label = "x", .y_label = "y", .equal = true, .series = std::move(rays)}}};
}

}  // namespace

Paper exponential_atmosphere() {
  return {.info = {.id = "exponential-atmosphere",
                   .reference = "Flat-stratified exponential atmosphere, after Snell's law, as in M. Born, E. Wolf, "
                                "Principles of Optics",
                   .reproduced = "Apex and range of mirage rays in n = n0 exp(-y/H).",
                   .cites = "BornWolf1999",
                   .not_checked = {"A textbook result: no paper is named for it, and no printed number is known."}},
          .run = run,
          .faults = {{factor_fault, "H/2 for H"}}};
}

}  // namespace xpr::papers
