// Eiroa, Romero & Torres 2002: lensing by a Reissner-Nordstrom hole. [EiroaRomeroTorres2002]
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "validation/papers/flow_light.hpp"
#include "validation/papers/papers.hpp"
#include "validation/papers/quadrature.hpp"

namespace xpr::papers {

namespace {

constexpr double pi_ = std::numbers::pi;
constexpr double charge = 0.6;
constexpr const char* charge_fault = "paper-eiroa-charge-sign";

long double lapse(long double r, long double q2) { return 1.0L - 2.0L / r + q2 / (r * r); }
double charge_squared(const Lab& lab) { return (lab.planted(charge_fault) ? -1.0 : 1.0) * charge * charge; }

/// Largest root of r^2 = b^2 f(r).
long double periapsis(long double b, long double q2) {
  const long double photon = 0.5L * (3.0L + std::sqrt(9.0L - 8.0L * q2));
  return zero_of([=](long double r) { return r * r - b * b * lapse(r, q2); }, photon, b);
}

/// 2 int du/sqrt(1/b^2 - u^2 + 2u^3 - Q^2 u^4) - pi, the turning point's root taken out.
double deflection_by_quadrature(long double b, long double q2) {
  const long double u2 = 1.0L / periapsis(b, q2);
  const Integral swept = integral(
      [=](long double s) {
        const long double w = s * s;
        const long double rest = 2.0L * u2 - 6.0L * u2 * u2 + 4.0L * q2 * u2 * u2 * u2 +
                                 (-1.0L + 6.0L * u2 - 6.0L * q2 * u2 * u2) * w + (-2.0L + 4.0L * q2 * u2) * w * w -
                                 q2 * w * w * w;
        return 4.0L / std::sqrt(rest);
      },
      0.0L, std::sqrt(u2));
  return static_cast<double>(swept.value - std::numbers::pi_v<long double>);
}

double weak_series(double b, double q2) {
  return 4.0 / b + (15.0 * pi_ / 4.0 - 3.0 * pi_ * q2 / 4.0) / (b * b) + (128.0 / 3.0 - 16.0 * q2) / (b * b * b) +
         pi_ / 64.0 * (3465.0 - 1890.0 * q2 + 105.0 * q2 * q2) / (b * b * b * b);
}

/// Binet's equation u'' = -u + 3u^2 - 2 Q^2 u^3 in the azimuth, from the periapsis to u = 0: y[1] = u, y[5] = u'.
Flow binet(double q2) {
  return [q2](const PhaseState<double>& y) {
    PhaseState<double> rate;
    for (std::size_t i = 0; i < 8; ++i) rate[i] = 0.0;
    rate[0] = 1.0;
    rate[1] = y[5];
    rate[5] = -y[1] + 3.0 * y[1] * y[1] - 2.0 * q2 * y[1] * y[1] * y[1];
    return rate;
  };
}
double deflection_by_steps(const FixedSteps& how, double b, double q2, double guess) {
  PhaseState<double> start;
  for (std::size_t i = 0; i < 8; ++i) start[i] = 0.0;
  start[1] = static_cast<double>(1.0L / periapsis(b, q2));
  const PhaseState<double> end = follow_until(
      how, binet(q2), start, 0.5 * (pi_ + guess), [](const PhaseState<double>& y) { return y[1]; },
      [](const PhaseState<double>& y) { return y[5]; });
  return 2.0 * end[0] - pi_;
}

void run(PaperSheet& sheet) {
  const double q2 = charge_squared(sheet.lab()), right = charge * charge;
  const Tolerance digits{1e-13, "the digits of the evaluation, and Q = 0.6 in binary"};
  ClaimSheet sphere = sheet.claim("photon sphere, Q = 0.6 M", "M");
  sphere.exact({2.736931687685298, 1e-15}, "mpmath, 16 digits");
  const double photon = 0.5 * (3.0 + std::sqrt(9.0 - 8.0 * q2));
  sphere.ours("(3 + sqrt(9 - 8 Q^2))/2", photon, digits);
  // r^2/f is least there: r f' = 2 f.
  sphere.ours("zero of r^2 - 3 r + 2 Q^2",
              static_cast<double>(zero_of(
                  [&](long double r) { return r * r - 3.0L * r + 2.0L * static_cast<long double>(q2); }, 2.0L, 3.5L)),
              digits);
  ClaimSheet critical = sheet.claim("critical impact parameter, Q = 0.6 M", "M");
  critical.exact({4.858694193246851, 1e-15}, "mpmath, 16 digits");
  critical.ours("r/sqrt(f) at the photon sphere", photon / std::sqrt(static_cast<double>(lapse(photon, q2))), digits);
  double least = 1e9;
  for (const double r : even_steps(2.6, 2.9, 30001))
    least = std::min(least, r / std::sqrt(static_cast<double>(lapse(r, q2))));
  critical.ours("least r/sqrt(f) on a grid", least, {1e-9, "a minimum met within 1e-5 M: second order in that"});

  struct Line {
    double b, alpha;  ///< mpmath, 18 digits
  };
  for (const Line& line :
       {Line{5.5, 1.96204439412186535}, Line{10.0, 0.569213307142473873}, Line{1000.0, 0.00401096978700086526}}) {
    ClaimSheet claim = sheet.claim(fmt::format("deflection at b = {:g} M, Q = 0.6 M", line.b), "rad");
    claim.exact({line.alpha, 1e-15 * line.alpha}, "mpmath, 50 digits");
    claim.ours("quadrature of the orbit equation", deflection_by_quadrature(line.b, q2),
               {1e-13 * line.alpha, "round-off of Q^2 and b, amplified by the condition, below 10"});
    for (const FixedSteps& how : flow_routes()) {
      claim.ours(route_name(how), deflection_by_steps(how, line.b, right, line.alpha),
                 {2e-13 + 1e-12 * line.alpha, "round-off of some hundred steps; truncation below it"});
    }
    if (line.b < 6.0) continue;
    // The fifth coefficient is below Schwarzschild's 3584/5.
    claim.ours(
        "weak series to four terms", weak_series(line.b, q2),
        {1.8 * 717.0 * std::pow(line.b, -5.0) + 1e-15, "the fifth term, below 717, and those after it at b = 10 M"});
  }
  std::vector<Series> curves;
  for (const double q : {0.0, 0.6, 0.9, 1.0}) {
    const double sphere_radius = 0.5 * (3.0 + std::sqrt(9.0 - 8.0 * q * q));
    const double b_c = sphere_radius / std::sqrt(static_cast<double>(lapse(sphere_radius, q * q)));
    Series curve{fmt::format("Q = {} M", q), Look::line, {}, {}};
    for (const double above : log_steps(1e-3, 10.0, 80)) {
      curve.x.push_back(b_c + above), curve.y.push_back(deflection_by_quadrature(b_c + above, q * q));
    }
    curves.push_back(std::move(curve));
  }
  Series points{"stepped, Q = 0.6 M", Look::dots, {}, {}};
  for (const double b : {4.9, 5.1, 5.5, 6.5, 8.0, 11.0}) {
    points.x.push_back(b);
    points.y.push_back(deflection_by_steps(flow_routes()[0], b, right, deflection_by_quadrature(b, right)));
  }
  curves.push_back(std::move(points));
  sheet.figure() = {
      .title = "Eiroa, Romero & Torres 2002: deflection by a charged hole",
      .caption = "Charge makes the hole smaller, and light comes closer before it is captured.",
      .panels = {
          {.title = "Deflection", .x_label = "b [M]", .y_label = "deflection [rad]", .series = std::move(curves)}}};
}

}  // namespace

Paper eiroa_romero_torres_2002() {
  return {
      .info =
          {.id = "eiroa-romero-torres-2002",
           .reference = "E. F. Eiroa, G. E. Romero, D. F. Torres, Reissner-Nordstrom black hole lensing, Phys. Rev. D "
                        "66, 024010 (2002)",
           .reproduced = "Photon sphere, critical impact parameter and deflection of a charged hole.",
           .cites = "EiroaRomeroTorres2002",
           .not_checked = {"Image positions and magnifications; sections not verified, no printed number is known."}},
      .run = run,
      .faults = {{charge_fault, "the sign of Q^2 turned"}}};
}

}  // namespace xpr::papers
