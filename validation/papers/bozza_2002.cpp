// Bozza 2002: the strong deflection limit in Schwarzschild, and the ladder of images it foretells. [Bozza2002]
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "metrics/schwarzschild_exact.hpp"
#include "validation/papers/papers.hpp"
#include "validation/papers/quadrature.hpp"
#include "validation/papers/schwarzschild_light.hpp"

namespace xpr::papers {

namespace {

namespace exact = schwarzschild_exact;

constexpr double pi_ = std::numbers::pi;
const double sqrt3 = std::sqrt(3.0);
const double critical_b = 3.0 * sqrt3;
constexpr double bbar_digits = -0.40023003975526165328;  // mpmath, 50 digits
constexpr const char* units_fault = "paper-bozza-half-the-unit";

/// -ln(b/b_c - 1) + bbar; planted: b_c = 3 sqrt3/2, as in the papers' units 2M = 1.
double limit(const Lab& lab, double b) {
  return -std::log(b / (lab.planted(units_fault) ? 0.5 * critical_b : critical_b) - 1.0) + bbar_digits;
}

/// bbar = -pi + b_R + abar ln 6 with b_R the regular part's integral over z = 1 - r_0/r.
ExactValue bbar_by_regular_part() {
  // 2 [1/(z sqrt(1 - 2z/3)) - 1/z], the divergence taken out: (4/3)/(s (1 + s)) with s = sqrt(1 - 2z/3).
  const Integral regular = integral(
      [](long double z) {
        const long double s = std::sqrt(1.0L - 2.0L * z / 3.0L);
        return (4.0L / 3.0L) / (s * (1.0L + s));
      },
      0.0L, 1.0L);
  return {static_cast<double>(regular.value) - pi_ + std::log(6.0), regular.error + 4e-16};
}

/// alpha + ln(b/b_c - 1) at two distances, extrapolated: what it leaves out falls as x ln x.
double bbar_from(double first, double second, double x_first, double x_second) {
  const double weight_first = x_first * std::log(x_first), weight_second = x_second * std::log(x_second);
  return (second * weight_first - first * weight_second) / (weight_first - weight_second);
}

void add_constants(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  ClaimSheet bbar = sheet.claim("bbar", "rad");
  bbar.exact({bbar_digits, 1e-16}, "ln[216 (7 - 4 sqrt3)] - pi, mpmath, 50 digits");
  bbar.printed("-0.400230039755", "a public code that cites the paper; the paper's own -0.4002 is from memory", 2.0);
  bbar.ours("closed form in doubles", std::log(216.0 * (7.0 - 4.0 * sqrt3)) - pi_,
            {2e-14, "7 - 4 sqrt3 cancels to 0.07: a round-off of 9e-16 over that"});
  const ExactValue regular = bbar_by_regular_part();
  bbar.ours("Bozza's regular part by quadrature", regular.value,
            {1e-14 + regular.error, "round-off of three terms and the quadrature's error"});
  for (const Route& route : schwarzschild_routes()) {
    const Charts at = schwarzschild_charts(lab, route.chart);
    constexpr double x[] = {1e-4, 1e-5};
    double rest[2];
    double traced_error = 0.0;
    for (int k = 0; k < 2; ++k) {
      const double b = (1.0 + x[k]) * critical_b;
      const SweptRay ray = there_and_back(lab, at, b, 50.0, route.method);
      rest[k] = traced_deflection(ray, b) + std::log(b / critical_b - 1.0);
      traced_error = accumulated(ray.end, route.method.setting, deflection_condition(b)).value;
    }
    bbar.from_rays(
        "two rays' deflections extrapolated to b_c", *at.transport, route.method,
        bbar_from(rest[0], rest[1], x[0], x[1]),
        {0.5 * x[0] + traced_error, "order x at x = 1e-4, which x ln x does not take out, and the rays' own"});
  }
}

void add_limits(PaperSheet& sheet) {
  struct Member {
    double b, sdl;
  };
  for (const Member& at : {Member{5.2, 6.807999996455453}, Member{5.5, 2.438917487043399}}) {
    ClaimSheet claim = sheet.claim(fmt::format("strong deflection limit at b = {} M", at.b), "rad");
    claim.exact({at.sdl, 2e-16 / (at.b / critical_b - 1.0)}, "mpmath, 50 digits");
    const Tolerance round_off{2e-14 / (at.b / critical_b - 1.0), "round-off of b over b/b_c - 1"};
    claim.ours("the formula", limit(sheet.lab(), at.b), round_off);
    // The limit is that of the true deflection: what is between them is bounded, and falls with b - b_c.
    const ExactValue bounded = exact::strong_field_logarithm(1.0, at.b);
    claim.ours("the same from the exact solutions' module", bounded.value, round_off);
    const double x = at.b / critical_b - 1.0;
    const ExactValue quadrature = deflection_by_quadrature(periapsis_of(at.b));
    claim.ours("the deflection itself, by quadrature", quadrature.value,
               {x * (1.0 + std::abs(std::log(x))), "an approximation: it leaves out x |ln x| and less"});
  }
}

void add_images(PaperSheet& sheet) {
  // Where the deflection is 2 pi n: the ladder itself, not its limit.
  const auto ring = [](int n) {
    return static_cast<double>(zero_of(
        [n](long double P) { return static_cast<long double>(deflection_by_quadrature(P).value) - 2.0L * pi_ * n; },
        3.0000001L, 4.0L));
  };
  const auto excess = [](double P) {  // b/b_c - 1 of a periapsis, without cancellation: 27(P-2) = P^3 - (P-3)^2 (P+6)
    const double d = (P - 3.0) * (P - 3.0) * (P + 6.0) / (27.0 * (P - 2.0));
    return d / (1.0 + std::sqrt(1.0 + d));
  };
  ClaimSheet separation = sheet.claim("separation s/theta_inf of the first image from the others");
  separation.exact({0.00125149637085, 5e-15}, "exp(bbar - 2 pi)");
  separation.ours("the formula", std::exp(bbar_digits - 2.0 * pi_),
                  {1e-13, "ten times the twelve digits of the evaluation"});
  separation.ours("ring of one turn, by quadrature", excess(ring(1)) - excess(ring(4)),
                  {1e-2 * 0.00125, "the limit at x = 1e-3 leaves out x |ln x| = 0.7 per cent"});
  separation.not_established("s = 0.0211 muas for theta_inf = 16.87 muas (Sgr A*)",
                             "the row of the paper's table is from memory; its ratio 0.00125 agrees");
  ClaimSheet flux = sheet.claim("flux of the first image over all others, in magnitudes", "mag");
  flux.exact({6.821881769209207, 5e-16}, "2.5 * 2 pi / ln 10");
  flux.ours("the formula", 5.0 * pi_ / std::log(10.0), {1e-14, "round-off"});
  flux.ours("rings of two and three turns, by quadrature", 2.5 * std::log10(excess(ring(2)) / excess(ring(3))),
            {1e-3, "the ratio is that of the limit up to x |ln x| = 3e-5 at two turns, 2.5/ln 10 of it in magnitudes"});
  flux.not_established("r_m = 6.82", "the paper's table is from memory; it agrees with the formula");
}

void draw(PaperSheet& sheet) {
  Series curve{"exact", Look::line, {}, {}}, limit_curve{"strong deflection limit", Look::dashed, {}, {}};
  Series off{"limit less exact", Look::line, {}, {}}, foretold{"x |ln x|", Look::dotted, {}, {}};
  Series traced{"traced", Look::dots, {}, {}}, traced_off{"limit less traced", Look::dots, {}, {}};
  const auto x_of = [](double b) { return b / critical_b - 1.0; };
  for (const double x : log_steps(1e-7, 0.5, 120)) {
    const double b = critical_b * (1.0 + x);
    const double alpha = exact::deflection(1.0, b).value, sdl = -std::log(x_of(b)) + bbar_digits;
    curve.x.push_back(x), curve.y.push_back(alpha);
    limit_curve.x.push_back(x), limit_curve.y.push_back(sdl);
    off.x.push_back(x), off.y.push_back(std::abs(sdl - alpha));
    foretold.x.push_back(x), foretold.y.push_back(x * std::abs(std::log(x)));
  }
  const Charts at = schwarzschild_charts(sheet.lab(), "kerr-schild");
  for (const double x : log_steps(1e-6, 0.3, 12)) {
    const double b = critical_b * (1.0 + x);
    const double alpha = traced_deflection(there_and_back(sheet.lab(), at, b, 50.0, {"dop853", 1e-13}), b);
    traced.x.push_back(x), traced.y.push_back(alpha);
    traced_off.x.push_back(x), traced_off.y.push_back(std::abs(-std::log(x_of(b)) + bbar_digits - alpha));
  }
  sheet.figure() = {.title = "Bozza 2002: the strong deflection limit",
                    .caption =
                        "Deflection against the distance from the critical impact parameter, and what the limit "
                        "leaves out of it.",
                    .panels = {{.title = "Deflection",
                                .x_label = "b/b_c - 1",
                                .y_label = "deflection [rad]",
                                .x_log = true,
                                .series = {curve, limit_curve, traced}},
                               {.title = "What the limit leaves out",
                                .x_label = "b/b_c - 1",
                                .y_label = "|difference| [rad]",
                                .x_log = true,
                                .y_log = true,
                                .series = {off, foretold, traced_off}}}};
}

void run(PaperSheet& sheet) {
  add_constants(sheet);
  add_limits(sheet);
  add_images(sheet);
  draw(sheet);
}

}  // namespace

Paper bozza_2002() {
  return {
      .info = {.id = "bozza-2002",
               .reference = "V. Bozza, Gravitational lensing in the strong field limit, Phys. Rev. D 66, 103001 (2002)",
               .reproduced = "The strong deflection limit of Schwarzschild, its constants, and the ladder of images.",
               .cites = "Bozza2002",
               .not_checked = {"Reissner-Nordstrom and Janis-Newman-Winicour, the paper's other metrics: no printed "
                               "number of them is at hand.",
                               "The table of observables for Sgr A*: its numbers are from memory only."}},
      .run = run,
      .faults = {{units_fault, "b_c = 3 sqrt3/2: the papers' units 2M = 1 taken for M = 1"}}};
}

}  // namespace xpr::papers
