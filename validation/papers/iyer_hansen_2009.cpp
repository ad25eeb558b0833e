// Iyer & Hansen 2009: the exact deflection in the equatorial plane of Kerr. [IyerHansen2009]
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "metrics/kerr_exact.hpp"
#include "validation/families/kerr.hpp"
#include "validation/papers/kerr_light.hpp"
#include "validation/papers/papers.hpp"

namespace xpr::papers {

namespace {

namespace exact = kerr_exact;

constexpr double pi_ = std::numbers::pi;
constexpr const char* sign_fault = "paper-iyer-hansen-plus";

/// mpmath, 50 digits.
struct Line {
  double a, b, alpha, r0;
};
constexpr Line lines[] = {{0.5, 6.0, 1.2263997980084294142, 4.815124439894567},
                          {0.9, 4.0, 2.1782904489070825181, 2.942454458726617},
                          {0.9, -8.0, 1.2532938661300810946, 6.101196816389851},
                          {0.9, 10.0, 0.50463298400067238183, 8.986685319386695},
                          {0.9, -10.0, 0.72050361395396128304, 8.425386636234732}};

double closest_approach(double a, double b) {
  const double w = a / b;
  return 2.0 * std::abs(b) / std::sqrt(3.0) * std::sqrt(1.0 - w * w) *
         std::cos(
             std::acos(-3.0 * std::sqrt(3.0) * (1.0 - w) * (1.0 - w) / (std::abs(b) * std::pow(1.0 - w * w, 1.5))) /
             3.0);
}

/// The formula with Legendre's integrals of the standard library (modulus k, parameter n, phi). `sign` is that of
/// w0/2 inside Omega_-: -1 as it must be.
double formula(double a, double b, double sign) {
  const double w = a / b, w0 = a * a, h = 1.0 / closest_approach(a, b), hs = (1.0 + w) / (1.0 - w);
  const double S = std::sqrt((1.0 - 2.0 * h / hs) * (1.0 + 6.0 * h / hs));
  const double m = (S + 6.0 * h / hs - 1.0) / (2.0 * S);
  const double psi = std::asin(std::sqrt((1.0 - 2.0 * h / hs - S) / (1.0 - 6.0 * h / hs - S)));
  const double R = std::sqrt(1.0 - w0), k = std::sqrt(m);
  const double common = w0 * hs / 4.0 * (1.0 - 2.0 * h / hs - S);
  const double omega_plus = ((1.0 + R) * (1.0 - w) - w0 / 2.0) / (R * (1.0 + R - common));
  const double omega_minus = -((1.0 - R) * (1.0 - w) + sign * w0 / 2.0) / (R * (1.0 - R - common));
  const auto third = [&](double s) {
    const double n = (1.0 - 6.0 * h / hs - S) / (1.0 - 2.0 * h / hs - S - 4.0 / (w0 * hs) * (1.0 + s * R));
    return std::comp_ellint_3(k, n) - std::ellint_3(k, n, psi);
  };
  return -pi_ + 4.0 / (1.0 - w) * std::sqrt(1.0 / (hs * S)) * (omega_plus * third(1.0) + omega_minus * third(-1.0));
}

void run(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  for (const Line& line : lines) {
    ClaimSheet alpha = sheet.claim(fmt::format("deflection at a = {} M, b = {:+g} M", line.a, line.b), "rad");
    alpha.exact({line.alpha, 1e-16}, "mpmath, 50 digits");
    const double condition = kerr_family::deflection_condition(line.a, line.b);
    alpha.ours(
        "the paper's formula", formula(line.a, line.b, lab.planted(sign_fault) ? 1.0 : -1.0),
        {1e-12 * condition, "Omega and n are quotients of differences of order 0.1: a hundred units of round-off"});
    alpha.ours("exact solutions' module", exact::equatorial_deflection(1.0, line.a, line.b).value,
               {5e-15 * condition, "round-off of b amplified by the ray's condition"});
    add_kerr_deflection_routes(alpha, lab, line.a, line.b);
    alpha.wrong_formula("a public transcription, + w0/2 in Omega_-", formula(line.a, line.b, 1.0), 1.0,
                        "wrong by more than a radian");
    ClaimSheet r0 = sheet.claim(fmt::format("closest approach at a = {} M, b = {:+g} M", line.a, line.b), "M");
    r0.exact({line.r0, 5e-16}, "mpmath, 50 digits");
    const Tolerance round_off{1e-13, "round-off amplified by the root's condition, below 10"};
    r0.ours("the paper's formula", closest_approach(line.a, line.b), round_off);
    r0.ours("root of the radial polynomial", static_cast<double>(kerr_periapsis(line.a, line.b)), round_off);
  }
  sheet.finding(
      "a public transcription of the formula",
      fmt::format("it has (1 - R)(1 - w) + w0/2 in Omega_-. At a = 0.9 M, b = 4 M: with the plus sign {:.9f}, "
                  "with the minus sign {:.9f}; quadrature of dphi/du {:.9f}, the module's Carlson forms {:.9f} "
                  "rad. The paper itself was not seen; its sign is not blamed.",
                  formula(0.9, 4.0, 1.0), formula(0.9, 4.0, -1.0), kerr_deflection_by_quadrature(0.9L, 4.0L),
                  exact::equatorial_deflection(1.0, 0.9, 4.0).value));

  std::vector<Series> curves;
  for (const double a : {0.0, 0.5, 0.9}) {
    for (const double sign : {1.0, -1.0}) {
      if (a == 0.0 && sign < 0.0) continue;
      const double critical = std::abs(
          exact::critical_impact_parameter(1.0, a, sign > 0.0 ? exact::Sense::prograde : exact::Sense::retrograde)
              .value);
      Series curve{a == 0.0 ? "a = 0" : fmt::format("a = {} M, {}", a, sign > 0.0 ? "prograde" : "retrograde"),
                   sign > 0.0 ? Look::line : Look::dashed,
                   {},
                   {}};
      for (const double above : log_steps(2e-3, 12.0, 90)) {
        curve.x.push_back(critical + above);
        curve.y.push_back(exact::equatorial_deflection(1.0, a, sign * (critical + above)).value);
      }
      curves.push_back(std::move(curve));
    }
  }
  Series points{"a = 0.5 and 0.9 M, table above", Look::dots, {}, {}};
  for (const Line& line : lines) points.x.push_back(std::abs(line.b)), points.y.push_back(line.alpha);
  curves.push_back(std::move(points));
  sheet.figure() = {
      .title = "Iyer & Hansen 2009: deflection in the equatorial plane of Kerr",
      .caption = "Light that goes with the rotation comes closer before it is deflected as much.",
      .panels = {
          {.title = "Deflection", .x_label = "|b| [M]", .y_label = "deflection [rad]", .series = std::move(curves)}}};
}

}  // namespace

Paper iyer_hansen_2009() {
  return {
      .info = {.id = "iyer-hansen-2009",
               .reference = "S. V. Iyer, E. C. Hansen, Light's bending angle in the equatorial plane of a Kerr black "
                            "hole, Phys. Rev. D 80, 124023 (2009)",
               .reproduced = "The exact equatorial deflection of Kerr by elliptic integrals of the third kind.",
               .cites = "IyerHansen2009",
               .not_checked = {"The paper's strong-field series, and its equation numbers beyond those that a public "
                               "transcription names."}},
      .run = run,
      .faults = {{sign_fault, "+ w0/2 for - w0/2 in Omega_-, as a public transcription has it"}}};
}

}  // namespace xpr::papers
