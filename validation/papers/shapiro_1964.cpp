// Shapiro 1964: light takes longer past a mass. [Shapiro1964]
#include <fmt/format.h>

#include <cmath>

#include "metrics/schwarzschild_exact.hpp"
#include "validation/papers/papers.hpp"
#include "validation/papers/quadrature.hpp"
#include "validation/papers/schwarzschild_light.hpp"

namespace xpr::papers {

namespace {

namespace exact = schwarzschild_exact;

constexpr const char* logarithm_fault = "paper-shapiro-half-the-logarithm";

struct Path {
  double r0, R, time, first_order;  ///< mpmath, 50 digits
};
constexpr Path paths[] = {{10.0, 100.0, 107.538319744579237, 106.38972343665},
                          {10.0, 1000.0, 1012.74432511251929, 1011.5366329849},
                          {1000.0, 1e6, 1000015.7105980219822, 1000015.7008047935843}};

double impact_parameter_of(double r0) { return std::sqrt(r0 * r0 * r0 / (r0 - 2.0)); }

double first_order(const Lab& lab, double r0, double R) {
  const double along = std::sqrt((R - r0) * (R + r0));
  const double factor = lab.planted(logarithm_fault) ? 1.0 : 2.0;
  return along + factor * std::log((R + along) / r0) + std::sqrt((R - r0) / (R + r0));
}

/// int dr/[(1 - 2/r) sqrt(1 - b^2 (1 - 2/r)/r^2)] with r = r0 + s^2 and the root at r0 taken out.
Integral time_by_quadrature(long double r0, long double R) {
  return integral(
      [r0](long double s) {
        const long double r = r0 + s * s;
        const long double rest = r * r0 * (r + r0) - 2.0L * (r * r + r * r0 + r0 * r0);
        return 2.0L * std::sqrt(r * r * r * (r0 - 2.0L) / rest) / (1.0L - 2.0L / r);
      },
      0.0L, std::sqrt(R - r0));
}

/// From R inward and back out: twice the time.
void add_traced_time(ClaimSheet& claim, const Lab& lab, double r0, double R) {
  const double b = impact_parameter_of(r0);
  for (const Route& route : schwarzschild_routes()) {
    const Charts at = schwarzschild_charts(lab, route.chart);
    const SweptRay ray = there_and_back(lab, at, b, R, route.method, true);
    claim.traced({*at.transport, route.method, ray.end}, 0.5 * (ray.end_classical[0] - ray.start_classical[0]),
                 accumulated(ray.end, route.method.setting, deflection_condition(b) * b + 2.0 * R));
  }
}

void add_radial(PaperSheet& sheet) {
  ClaimSheet claim = sheet.claim("radial light from 100 M to 3 M", "M");
  claim.exact({106.1699349573411, 5e-14}, "97 + 2 ln 98");
  const Tolerance tolerance{1e-12, "round-off of times of 100 M, and the thirteen digits after the point"};
  claim.ours("the formula", 97.0 + 2.0 * std::log(98.0), tolerance);
  claim.ours("quadrature",
             static_cast<double>(integral([](long double r) { return 1.0L / (1.0L - 2.0L / r); }, 3.0L, 100.0L).value),
             tolerance);
  for (const Route& route : schwarzschild_routes()) {
    const Charts at = schwarzschild_charts(sheet.lab(), route.chart);
    TraceSettings settings = trace_settings(route.method);
    settings.r_min = 3.0;
    settings.grade_time = true;
    const SweptRay ray = trace_swept(sheet.lab(), *at.classical, *at.transport,
                                     equatorial_light(*at.classical, *at.transport, 100.0, 0.0), settings);
    claim.traced({*at.transport, route.method, ray.end, Status::captured},
                 ray.end_classical[0] - ray.start_classical[0], accumulated(ray.end, route.method.setting, 200.0));
  }
}

void run(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  for (const Path& path : paths) {
    ClaimSheet time = sheet.claim(fmt::format("time from r0 = {:g} M to R = {:g} M", path.r0, path.R), "M");
    time.exact({path.time, 2e-16 * path.time}, "mpmath, 50 digits");
    const Tolerance relative{4e-15 * path.time + 1e-13, "round-off of r0 and b: twenty units of the time"};
    time.ours(
        "exact solutions' module",
        [&] {
          const double b = impact_parameter_of(path.r0);
          // There and back, halved: the turning point is then the ray's own, not that of a rounded r0.
          return 0.5 * exact::coordinate_time(1.0, b, path.R, path.R, true).value;
        }(),
        relative);
    time.ours("quadrature", static_cast<double>(time_by_quadrature(path.r0, path.R).value), relative);
    add_traced_time(time, lab, path.r0, path.R);
    ClaimSheet first =
        sheet.claim(fmt::format("first-order time from r0 = {:g} M to R = {:g} M", path.r0, path.R), "M");
    first.exact({path.first_order, 1e-13 * path.first_order}, "mpmath");
    first.ours("the formula", first_order(lab, path.r0, path.R), {1e-11 * path.first_order, "its thirteen digits"});
    first.ours("the exact time", path.time, {15.0 / path.r0, "an approximation: it leaves out 12 M^2/r0 at most here"});
  }
  add_radial(sheet);

  Series curve{"exact", Look::line, {}, {}}, approximate{"first order", Look::dashed, {}, {}};
  Series traced{"traced", Look::dots, {}, {}};
  constexpr double R = 1000.0;
  const auto delay = [](double time, double r0) { return time - std::sqrt(R * R - r0 * r0); };
  for (const double r0 : log_steps(3.05, 300.0, 80)) {
    curve.x.push_back(r0), curve.y.push_back(delay(static_cast<double>(time_by_quadrature(r0, R).value), r0));
    approximate.x.push_back(r0), approximate.y.push_back(delay(first_order(lab, r0, R), r0));
  }
  const Charts at = schwarzschild_charts(lab, "kerr-schild");
  for (const double r0 : log_steps(3.2, 250.0, 11)) {
    const SweptRay ray = there_and_back(lab, at, impact_parameter_of(r0), R, {"dop853", 1e-12}, true);
    traced.x.push_back(r0), traced.y.push_back(delay(0.5 * (ray.end_classical[0] - ray.start_classical[0]), r0));
  }
  sheet.figure() = {.title = "Shapiro 1964: the delay of light past a mass",
                    .caption =
                        "One-way time from the closest approach to R = 1000 M, less that of a straight ray in "
                        "flat space.",
                    .panels = {{.title = "Delay on the way to 1000 M",
                                .x_label = "closest approach r0 [M]",
                                .y_label = "delay [M]",
                                .x_log = true,
                                .series = {curve, approximate, traced}}}};
}

}  // namespace

Paper shapiro_1964() {
  return {.info = {.id = "shapiro-1964",
                   .reference = "I. I. Shapiro, Fourth test of general relativity, Phys. Rev. Lett. 13, 789 (1964)",
                   .reproduced = "The coordinate time of light past a mass, exact and to first order.",
                   .cites = "Shapiro1964",
                   .not_checked = {"Microseconds for the planets: the paper's numbers are not at hand.",
                                   "The series is as in textbooks; its form in the paper was not seen."}},
          .run = run,
          .faults = {{logarithm_fault, "half the logarithm: Newtonian time alone"}}};
}

}  // namespace xpr::papers
