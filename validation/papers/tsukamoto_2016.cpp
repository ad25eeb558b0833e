// Tsukamoto 2016: the strong deflection limit of the Ellis wormhole. [Tsukamoto2016]
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "metrics/ellis_exact.hpp"
#include "validation/papers/ellis_light.hpp"
#include "validation/papers/papers.hpp"

namespace xpr::papers {

namespace {

namespace exact = ellis_exact;

constexpr double pi_ = std::numbers::pi;
constexpr const char* logarithm_fault = "paper-tsukamoto-two-ln-two";

double limit(const Lab& lab, double b) {
  return -std::log(b - 1.0) + (lab.planted(logarithm_fault) ? 2.0 : 3.0) * std::log(2.0) - pi_;
}

struct Line {
  double b, limit;  ///< mpmath, 14 digits
};
constexpr Line lines[] = {{1.001, 5.8456041670722}, {1.05, 1.9335811616440}, {1.25, 0.32414324920993}};

void run(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  for (const Line& line : lines) {
    const double x = line.b - 1.0;
    ClaimSheet claim = sheet.claim(fmt::format("strong deflection limit at b = {} b0", line.b), "rad");
    claim.exact({line.limit, 5e-14 + 2e-16 / x}, "mpmath, 14 digits");
    const Tolerance digits{1e-12 + 4e-15 / x, "the digits of the evaluation, and round-off of b over b - b0"};
    claim.ours("the formula", limit(lab, line.b), digits);
    claim.ours("exact solutions' module", exact::strong_field_logarithm(1.0, line.b).value, digits);
    claim.ours("the deflection itself, by quadrature", ellis_deflection_by_quadrature(line.b),
               {x * (1.0 + std::abs(std::log(x))), "an approximation: it leaves out order x |ln x|"});
  }
  ClaimSheet constant = sheet.claim("the limit's constant term", "rad");
  constant.exact({3.0 * std::log(2.0) - pi_, 5e-16}, "3 ln 2 - pi");
  for (const double x : {1e-5, 1e-7}) {
    const double b = 1.0 + x;
    const Tolerance left_out{x * (1.0 + std::abs(std::log(x))) + 4e-16 / x,
                             "order x |ln x|, and round-off of b over x"};
    constant.ours(fmt::format("elliptic integral at b/b0 - 1 = {:g}", x),
                  exact::deflection(1.0, b).value + std::log(b - 1.0), left_out);
  }
  ClaimSheet near = sheet.claim("deflection at b = 1.001 b0", "rad");
  near.exact({5.85059614364190603, 3e-13}, "mpmath, 50 digits");
  near.ours("quadrature", ellis_deflection_by_quadrature(1.001L), {4e-12, "round-off of b over b - b0"});
  add_ellis_routes(near, lab, 1.001);

  Series curve{"exact", Look::line, {}, {}}, approximate{"strong deflection limit", Look::dashed, {}, {}};
  Series off{"limit less exact", Look::line, {}, {}}, foretold{"x (1 + |ln x|)", Look::dotted, {}, {}};
  for (const double x : log_steps(1e-6, 1.0, 120)) {
    const double alpha = exact::deflection(1.0, 1.0 + x).value, sdl = -std::log(x) + 3.0 * std::log(2.0) - pi_;
    curve.x.push_back(x), curve.y.push_back(alpha);
    approximate.x.push_back(x), approximate.y.push_back(sdl);
    off.x.push_back(x), off.y.push_back(std::abs(sdl - alpha));
    foretold.x.push_back(x), foretold.y.push_back(x * (1.0 + std::abs(std::log(x))));
  }
  sheet.figure() = {.title = "Tsukamoto 2016: the strong deflection limit of the Ellis wormhole",
                    .caption =
                        "Deflection against the distance from the throat's photon orbit, and what the limit leaves "
                        "out.",
                    .panels = {{.title = "Deflection",
                                .x_label = "b/b0 - 1",
                                .y_label = "deflection [rad]",
                                .x_log = true,
                                .series = {curve, approximate}},
                               {.title = "What the limit leaves out",
                                .x_label = "b/b0 - 1",
                                .y_label = "|difference| [rad]",
                                .x_log = true,
                                .y_log = true,
                                .series = {off, foretold}}}};
}

}  // namespace

Paper tsukamoto_2016() {
  return {
      .info = {.id = "tsukamoto-2016",
               .reference = "N. Tsukamoto, Strong deflection limit analysis and gravitational lensing of an Ellis "
                            "wormhole, Phys. Rev. D 94, 124001 (2016)",
               .reproduced = "The logarithm and the constant of the deflection next to the throat.",
               .cites = "Tsukamoto2016",
               .not_checked = {"Image positions and magnifications of the lensing analysis: no number is at hand."}},
      .run = run,
      .faults = {{logarithm_fault, "2 ln 2 for 3 ln 2"}}};
}

}  // namespace xpr::papers
