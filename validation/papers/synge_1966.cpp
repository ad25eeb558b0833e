// Synge 1966: the cone within which a static observer sees a Schwarzschild hole black. [Synge1966]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "metrics/schwarzschild_exact.hpp"
#include "validation/papers/papers.hpp"
#include "validation/papers/schwarzschild_light.hpp"

namespace xpr::papers {

namespace {

namespace exact = schwarzschild_exact;

constexpr double degree = std::numbers::pi / 180.0;
constexpr const char* branch_fault = "paper-synge-wrong-branch";

/// sin^2 psi = 27 (1 - 2/r)/r^2 with psi > pi/2 inside the photon sphere; cos^2 = (r - 3)^2 (r + 6)/r^3 gives the sign
/// and no cancellation at r = 3.
double cone_angle(const Lab& lab, double r) {
  const double cosine = (r - 3.0) * std::sqrt((r + 6.0) / (r * r * r));
  const double sine = std::sqrt(27.0 * (1.0 - 2.0 / r)) / r;
  return std::atan2(sine, lab.planted(branch_fault) ? std::abs(cosine) : cosine);
}

/// The same from the fate of rays: going inward from r > 3 those with b > b_c escape, outward from r < 3 those below.
double psi_from_rays(const Lab& lab, const Charts& at, const MethodAt& method, double r) {
  TraceSettings settings = trace_settings(method);
  settings.r_min = 2.01;
  settings.r_max = std::max(50.0, 1.1 * r);
  const bool inward = r > 3.0;
  const double b = bisect_fate(5.15, 5.25, 1e-14, [&](double trial) {
    const ChartState start = equatorial_light(*at.classical, *at.transport, r, trial, inward);
    const bool escapes = lab.trace(*at.transport, start.state, 1, settings).status == Status::escaped;
    return escapes == inward;
  });
  const double sine = b * std::sqrt(1.0 - 2.0 / r) / r;
  return inward ? std::asin(sine) : std::numbers::pi - std::asin(sine);
}

void run(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  struct Member {
    double r, degrees, error;
  };
  const Tolerance round_off{1e-12, "round-off of an arc tangent and its argument, in degrees"};
  for (const Member& at : {Member{6.0, 45.0, 0.0}, Member{3.0, 90.0, 0.0}, Member{100.0, 2.94855519767808, 5e-15}}) {
    ClaimSheet claim = sheet.claim(fmt::format("half-angle of the shadow seen from r = {:g} M", at.r), "degree");
    claim.exact({at.degrees, at.error}, at.error > 0.0 ? "mpmath, 15 digits" : "sin^2 psi = 27 (1 - 2/r)/r^2");
    claim.ours("arc tangent of both sides", cone_angle(lab, at.r) / degree, round_off);
    claim.ours("exact solutions' module", exact::escape_cone_angle(1.0, at.r).value / degree, round_off);
    for (const Route& route : schwarzschild_routes()) {
      if (at.r == 3.0) continue;  // light that starts tangentially on the photon sphere stays: no fate to bisect on
      const Charts charts = schwarzschild_charts(lab, route.chart);
      claim.from_rays("fate of rays", *charts.transport, route.method,
                      psi_from_rays(lab, charts, route.method, at.r) / degree,
                      {1e-8, "promised: b_c below 1e-10, and degrees"});
    }
  }
  ClaimSheet inside = sheet.claim("half-angle of the shadow seen from r = 2.5 M", "degree");
  inside.exact({180.0 - std::asin(std::sqrt(0.864)) / degree, 3e-14}, "sin^2 psi = 27 (1 - 2/r)/r^2 = 0.864, psi > 90");
  inside.ours("arc tangent of both sides", cone_angle(lab, 2.5) / degree, round_off);
  for (const Route& route : schwarzschild_routes()) {
    const Charts charts = schwarzschild_charts(lab, route.chart);
    inside.from_rays("fate of rays", *charts.transport, route.method,
                     psi_from_rays(lab, charts, route.method, 2.5) / degree,
                     {1e-8, "promised: b_c below 1e-10, and degrees"});
  }

  Series curve{"exact", Look::line, {}, {}}, traced{"fate of rays", Look::dots, {}, {}};
  for (const double r : log_steps(2.02, 60.0, 160)) {
    curve.x.push_back(r);
    curve.y.push_back(exact::escape_cone_angle(1.0, r).value / degree);
  }
  const Charts charts = schwarzschild_charts(lab, "kerr-schild");
  for (const double r : {2.1, 2.3, 2.6, 3.3, 4.0, 6.0, 10.0, 20.0, 40.0}) {
    traced.x.push_back(r);
    traced.y.push_back(psi_from_rays(lab, charts, {"dop853", 1e-11}, r) / degree);
  }
  sheet.figure() = {.title = "Synge 1966: how much of the sky a Schwarzschild hole takes",
                    .caption =
                        "Half-angle of the black part of the sky of a static observer: 90 degrees on the photon "
                        "sphere, the whole sky at the horizon.",
                    .panels = {{.title = "Half-angle of the shadow",
                                .x_label = "r [M]",
                                .y_label = "half-angle [degree]",
                                .x_log = true,
                                .series = {{"r = 3 M", Look::dotted, {3.0, 3.0}, {0.0, 180.0}}, curve, traced}}}};
}

}  // namespace

Paper synge_1966() {
  return {
      .info = {.id = "synge-1966",
               .reference = "J. L. Synge, The escape of photons from gravitationally intense stars, Mon. Not. R. "
                            "Astron. Soc. 131, 463 (1966)",
               .reproduced = "The half-angle of the shadow that a static observer sees, at any radius.",
               .cites = "Synge1966",
               .not_checked = {"Printed numbers: none is known from a source."}},
      .run = run,
      .faults = {{branch_fault, "psi < pi/2 everywhere: the wrong branch of the arc sine inside the photon sphere"}}};
}

}  // namespace xpr::papers
