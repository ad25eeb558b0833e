// Gralla, Holz & Wald 2019: lensing ring and photon ring of a Schwarzschild hole. [GrallaHolzWald2019]
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "metrics/schwarzschild_exact.hpp"
#include "validation/papers/papers.hpp"
#include "validation/papers/quadrature.hpp"
#include "validation/papers/schwarzschild_light.hpp"

namespace xpr::papers {

namespace {

namespace exact = schwarzschild_exact;

constexpr double pi_ = std::numbers::pi;
const double critical_b = 3.0 * std::sqrt(3.0);
constexpr const char* half_fault = "paper-gralla-holz-wald-half-turn";

/// Azimuth swept outside the horizon by light that falls in: int_0^{1/2} du/sqrt(1/b^2 - u^2 + 2 u^3).
double plunging_sweep(long double b) {
  // 1/b^2 - 1/27 + (u - 1/3)^2 (2u + 1/3): next to b_c the difference is small, and the polynomial keeps its digits.
  const long double gap = 1.0L / (b * b) - 1.0L / 27.0L;
  const auto f = [gap](long double u) {
    const long double d = u - 1.0L / 3.0L;
    return 1.0L / std::sqrt(gap + d * d * (2.0L * u + 1.0L / 3.0L));
  };
  return static_cast<double>(integral(f, 0.0L, 1.0L / 3.0L).value + integral(f, 1.0L / 3.0L, 0.5L).value);
}

/// n(b), the number of turns outside the horizon.
double turns(const Lab& lab, double b) {
  const double swept = b < critical_b ? plunging_sweep(b) : pi_ + deflection_by_quadrature(periapsis_of(b)).value;
  return swept / (lab.planted(half_fault) ? pi_ : 2.0 * pi_);
}

/// The same by Carlson's integrals.
double turns_in_closed_form(double b) {
  constexpr double far = std::numeric_limits<double>::infinity();
  const double horizon = std::nextafter(2.0, 3.0);
  const double swept =
      b < critical_b ? exact::swept_angle(1.0, b, far, horizon, false).value : pi_ + exact::deflection(1.0, b).value;
  return swept / (2.0 * pi_);
}

SweptRay ray_of(const Lab& lab, const Charts& at, double b, const MethodAt& method) {
  TraceSettings settings = trace_settings(method);
  settings.r_max = 50.0;
  settings.r_min = 2.0 + 1e-9;
  return trace_swept(lab, *at.classical, *at.transport, equatorial_light(*at.classical, *at.transport, 50.0, b),
                     settings);
}

/// The same from a traced ray in Kerr-Schild, which ends at the horizon.
double traced_turns(const SweptRay& ray, double b) {
  constexpr double far = std::numeric_limits<double>::infinity();
  const double near_end = b < critical_b ? 0.25 * b * 1e-9  // du = dr/r^2, dphi/du = b at the horizon
                                         : exact::swept_angle(1.0, b, ray.end_classical[1], far, false).value;
  return (std::abs(ray.azimuth()) + exact::swept_angle(1.0, b, ray.start_classical[1], far, false).value + near_end) /
         (2.0 * pi_);
}

struct Edge {
  const char* name;
  double n, b;  ///< mpmath, 15 digits
  const char* rounded;
  double low, high;
};
constexpr Edge edges[] = {{"inner edge of the lensing ring", 0.75, 5.01513549419833, "5.02", 4.5, 5.1},
                          {"outer edge of the lensing ring", 0.75, 6.16756676476801, "6.17", 5.6, 7.0},
                          {"inner edge of the photon ring", 1.25, 5.18780817487607, "5.19", 5.1, 5.195},
                          {"outer edge of the photon ring", 1.25, 5.22793860853384, "5.23", 5.2, 5.5}};

void add_edges(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  for (const Edge& edge : edges) {
    ClaimSheet claim = sheet.claim(fmt::format("b at the {}, n = {}", edge.name, edge.n), "M");
    claim.exact({edge.b, 5e-15}, "mpmath, 15 digits");
    claim.not_established(edge.rounded, "the paper's rounded edges are from memory; they agree");
    const auto solved = [&](const auto& n) {
      return static_cast<double>(
          zero_of([&](long double b) { return static_cast<long double>(n(static_cast<double>(b)) - edge.n); }, edge.low,
                  edge.high));
    };
    const double goal_slope = (turns_in_closed_form(edge.b + 1e-6) - turns_in_closed_form(edge.b - 1e-6)) / 2e-6;
    const Tolerance round_off{1e-13, "round-off of n over its slope, 0.1 per M and more, and the digits"};
    // Newton's step with the exact slope: it says how far off b is even where n never reaches its goal.
    claim.ours("quadrature of n", edge.b + (edge.n - turns(lab, edge.b)) / goal_slope, round_off);
    claim.ours("Carlson's integrals solved for n", solved(turns_in_closed_form), round_off);
    for (const MethodAt& method : {MethodAt{"dop853", 1e-14}, MethodAt{"dopri54", 1e-13}}) {
      const Charts at = schwarzschild_charts(lab, "kerr-schild");
      const SweptRay ray = ray_of(lab, at, edge.b, method);
      // One step of Newton's from the exact edge: what the traced ray's own n makes of b.
      const double b = edge.b + (edge.n - traced_turns(ray, edge.b)) / goal_slope;
      Tolerance tolerance = accumulated(ray.end, method.setting, 100.0 / std::abs(goal_slope));
      tolerance.value += 1e-12;
      tolerance.reason =
          "over the slope of n, and the last 1e-9 M above the horizon to first order; " + tolerance.reason;
      claim.traced({*at.transport, method, ray.end, edge.b < critical_b ? Status::captured : Status::escaped}, b,
                   tolerance);
    }
  }
}

void draw(PaperSheet& sheet) {
  Series n_of_b{"n(b)", Look::line, {}, {}}, traced_n{"traced", Look::dots, {}, {}};
  for (const double b : even_steps(0.1, 10.0, 400)) {
    if (std::abs(b - critical_b) < 1e-4) continue;
    n_of_b.x.push_back(b), n_of_b.y.push_back(turns_in_closed_form(b));
  }
  const Charts at = schwarzschild_charts(sheet.lab(), "kerr-schild");
  // Direct, lensed and photon-ring light, each a series with gaps between its rays.
  std::array<Series, 3> rays{Series{"n < 3/4: direct", Look::line, {}, {}},
                             Series{"3/4 < n < 5/4: lensing ring", Look::line, {}, {}},
                             Series{"n > 5/4: photon ring", Look::line, {}, {}}};
  std::vector<double> impact = even_steps(0.4, 9.6, 24);
  for (const double b : {5.03, 5.1, 5.17, 5.19, 5.2, 5.225, 5.26, 5.4, 5.6, 5.8, 6.1}) impact.push_back(b);
  for (const double b : impact) {
    const double n = turns_in_closed_form(b);
    Series& series = rays[n < 0.75 ? 0 : (n < 1.25 ? 1 : 2)];
    const ChartState start = equatorial_light(*at.classical, *at.transport, 50.0, b);
    TraceSettings settings = trace_settings({"dop853", 1e-10});
    settings.r_max = 50.0;
    settings.r_min = 2.0;
    // Turned so that light leaves for the observer at the right: mirrored, the way back in time.
    const double turn = -exact::swept_angle(1.0, b, 50.0, std::numeric_limits<double>::infinity(), false).value;
    const RayEnd end = sheet.lab().trace(*at.transport, start.state, 1, settings, {}, [&](const StepView& step) {
      for (const double part : {0.2, 0.4, 0.6, 0.8, 1.0}) {
        const PhaseState<double> y = step.at(part);
        if (std::hypot(y[1], y[2]) > 12.0) continue;
        series.x.push_back(y[1] * std::cos(turn) + y[2] * std::sin(turn));
        series.y.push_back(-y[1] * std::sin(turn) + y[2] * std::cos(turn));
      }
    });
    (void)end;
    series.x.push_back(std::nan("")), series.y.push_back(std::nan(""));
    const SweptRay whole = ray_of(sheet.lab(), at, b, {"dop853", 1e-10});
    traced_n.x.push_back(b), traced_n.y.push_back(traced_turns(whole, b));
  }
  Series hole{"", Look::area, {}, {}};
  for (const double angle : even_steps(0.0, 2.0 * pi_, 97))
    hole.x.push_back(2.0 * std::cos(angle)), hole.y.push_back(2.0 * std::sin(angle));
  sheet.figure() = {
      .title = "Gralla, Holz & Wald 2019: black hole shadows, photon rings and lensing rings",
      .caption =
          "Left: turns of light outside the horizon; 3/4 and 5/4 bound the lensing ring and the photon ring. "
          "Right: traced rays of an observer far to the right.",
      .panels = {{.title = "Turns",
                  .x_label = "b [M]",
                  .y_label = "n",
                  .series = {{"3/4 and 5/4",
                              Look::dotted,
                              {0.0, 10.0, std::nan(""), 0.0, 10.0},
                              {0.75, 0.75, std::nan(""), 1.25, 1.25}},
                             n_of_b,
                             traced_n}},
                 {.title = "Rays",
                  .x_label = "x [M]",
                  .y_label = "y [M]",
                  .equal = true,
                  .series = {hole, rays[0], rays[1], rays[2]}}}};
}

void run(PaperSheet& sheet) {
  add_edges(sheet);
  draw(sheet);
}

}  // namespace

Paper gralla_holz_wald_2019() {
  return {.info = {.id = "gralla-holz-wald-2019",
                   .reference =
                       "S. E. Gralla, D. E. Holz, R. M. Wald, Black hole shadows, photon rings, and lensing rings, "
                       "Phys. Rev. D 100, 024018 (2019)",
                   .reproduced = "Edges of the lensing ring and of the photon ring, and light's turns against b.",
                   .cites = "GrallaHolzWald2019",
                   .not_checked = {"The rounded edges as printed: from memory only.",
                                   "Observed intensities of the paper's emission models."}},
          .run = run,
          .faults = {{half_fault, "half turns counted as turns"}}};
}

}  // namespace xpr::papers
