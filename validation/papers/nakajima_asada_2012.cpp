// Nakajima & Asada 2012; Chetouani & Clement 1984: the deflection of an Ellis wormhole. [NakajimaAsada2012]
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "metrics/ellis_exact.hpp"
#include "validation/papers/ellis_light.hpp"
#include "validation/papers/papers.hpp"
#include "validation/papers/quadrature.hpp"

namespace xpr::papers {

namespace {

namespace exact = ellis_exact;

constexpr double pi_ = std::numbers::pi;
constexpr const char* diverging_fault = "paper-nakajima-asada-diverging";
constexpr const char* modulus_fault = "paper-nakajima-asada-parameter";

double formula(const Lab& lab, double b) {
  const double k = lab.planted(modulus_fault) ? 1.0 / (b * b) : 1.0 / b;
  const double alpha = 2.0 * std::comp_ellint_1(k) - pi_;
  return lab.planted(diverging_fault) ? -alpha : alpha;
}

double weak(double b) {
  const double m = 1.0 / (b * b);
  return pi_ * m * (0.25 + m * (9.0 / 64.0 + m * 25.0 / 256.0));
}

/// mpmath, 18 digits; the weak series to three terms.
struct Line {
  double b, alpha, weak;
};
constexpr Line lines[] = {
    {1.001, 5.85059614364190603, 1.5288152564242},     {1.05, 2.08328556871952521, 1.3047741225986},
    {1.25, 0.849012901739665537, 0.76403533335304},    {3.0, 0.0931808176596716147, 0.093141461721495},
    {5.0, 0.0321430413185392362, 0.032142419837041},   {20.0, 0.00196626137679581861, 0.0019662613676018},
    {100.0, 7.85442345112335902e-5, 7.854423451121e-5}};

void run(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  for (const Line& line : lines) {
    const double condition = 1.0 + 1.0 / (line.b - 1.0);
    ClaimSheet claim = sheet.claim(fmt::format("deflection at b = {:g} b0", line.b), "rad");
    claim.exact({line.alpha, 2e-16 * condition * std::min(1.0, line.alpha)}, "mpmath, 50 digits");
    claim.ours("2 K(k = b0/b) - pi", formula(lab, line.b),
               {4e-15 * condition, "pi taken from an integral of that size, and b's round-off"});
    claim.ours("exact solutions' module", exact::deflection(1.0, line.b).value, {4e-15 * condition, "as above"});
    claim.ours("quadrature", ellis_deflection_by_quadrature(line.b), {4e-15 * condition, "round-off of b"});
    add_ellis_routes(claim, lab, line.b);
    ClaimSheet series = sheet.claim(fmt::format("three terms of the weak series at b = {:g} b0", line.b), "rad");
    series.exact({line.weak, 1e-13 * line.weak}, "mpmath, 13 digits");
    series.ours("the formula", weak(line.b), {2e-12 * line.weak, "twenty times the digits of the evaluation"});
    series.ours("the deflection itself", line.alpha,
                {pi_ * 0.075 * std::pow(line.b, -8.0) / (1.0 - 1.0 / (line.b * line.b)) + 1e-12 * line.weak,
                 "an approximation: a geometric series from the fourth term, (35/128)^2, bounds the rest"});
  }
  for (const auto& [b, swept] : {std::pair{0.5, 1.68575035481259604}, {0.95, 4.92102133866155232}}) {
    ClaimSheet claim = sheet.claim(fmt::format("angle swept through the throat at b = {} b0", b), "rad");
    claim.exact({swept, 1e-15}, "mpmath, 18 digits");
    claim.ours("2 (b/b0) K(k = b/b0)", 2.0 * b * std::comp_ellint_1(lab.planted(modulus_fault) ? b * b : b),
               {1e-13, "round-off of b, over 1 - b/b0"});
    claim.ours("exact solutions' module", exact::transit_angle(1.0, b).value, {1e-13, "as above"});
    add_ellis_routes(claim, lab, b);
  }
  ClaimSheet first = sheet.claim("weak field: alpha (b/b0)^2");
  first.exact({pi_ / 4.0, 1e-16}, "pi/4: the paper's leading order");
  for (const auto& [route, alpha] :
       {std::pair{"elliptic integral at b = 1000 b0", exact::deflection(1.0, 1000.0).value},
        {"quadrature at b = 1000 b0", ellis_deflection_by_quadrature(1000.0L)}}) {
    first.ours(route, 1e6 * alpha, {1e-6 + 2e-9, "the second term, 9 pi/64 of 1e-6, and round-off of alpha times 1e6"});
  }

  Series curve{"exact", Look::line, {}, {}}, approximate{"weak, 3 terms", Look::dashed, {}, {}};
  Series points{"mpmath", Look::dots, {}, {}};
  for (const double above : log_steps(1e-3, 20.0, 140)) {
    curve.x.push_back(1.0 + above), curve.y.push_back(exact::deflection(1.0, 1.0 + above).value);
    approximate.x.push_back(1.0 + above), approximate.y.push_back(weak(1.0 + above));
  }
  for (const Line& line : lines) {
    if (line.b < 21.0) points.x.push_back(line.b), points.y.push_back(line.alpha);
  }
  Series through{"through the throat", Look::line, {}, {}};
  for (const double b : even_steps(0.01, 0.999, 140)) {
    through.x.push_back(b), through.y.push_back(exact::transit_angle(1.0, b).value);
  }
  sheet.figure() = {
      .title = "Nakajima & Asada 2012: light at an Ellis wormhole",
      .caption =
          "Left: light that comes back is deflected towards the wormhole. Right: the angle swept by "
          "light that goes through.",
      .panels = {
          {.title = "Deflection, b > b0",
           .x_label = "b [b0]",
           .y_label = "deflection [rad]",
           .x_log = true,
           .y_log = true,
           .series = {curve, approximate, points}},
          {.title = "Transit, b < b0", .x_label = "b [b0]", .y_label = "swept angle [rad]", .series = {through}}}};
}

}  // namespace

Paper nakajima_asada_2012() {
  return {
      .info = {.id = "nakajima-asada-2012",
               .reference =
                   "K. Nakajima, H. Asada, Deflection angle of light in an Ellis wormhole geometry, Phys. Rev. "
                   "D 85, 107501 (2012); L. Chetouani, G. Clement, Gen. Relativ. Gravit. 16, 111 (1984)",
               .reproduced = "The exact deflection by the complete elliptic integral of the first kind, and transit.",
               .cites = "NakajimaAsada2012 ChetouaniClement1984 Perlick2004",
               .not_checked = {"Which earlier closed form the abstract corrects, and its magnifications.",
                               "Printed numbers: none is known from a source."}},
      .run = run,
      .faults = {{diverging_fault, "the wormhole taken for a diverging lens"},
                 {modulus_fault, "the parameter k^2 given where the library wants the modulus k"}}};
}

}  // namespace xpr::papers
