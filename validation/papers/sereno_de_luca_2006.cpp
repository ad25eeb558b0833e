// Sereno & De Luca 2006: the equatorial deflection of Kerr as a series in 1/b. [SerenoDeLuca2006] [EderyGodin2006]
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "metrics/kerr_exact.hpp"
#include "validation/papers/kerr_light.hpp"
#include "validation/papers/papers.hpp"

namespace xpr::papers {

namespace {

namespace exact = kerr_exact;

constexpr double pi_ = std::numbers::pi;
constexpr const char* drag_fault = "paper-sereno-drag-sign";

/// Coefficients of b^-1 ... b^-5; a > 0 prograde.
std::array<double, 5> coefficients(double a) {
  const double a2 = a * a;
  return {4.0, 15.0 * pi_ / 4.0 - 4.0 * a, 128.0 / 3.0 - 10.0 * pi_ * a + 4.0 * a2,
          15.0 * pi_ / 64.0 * (76.0 * a2 + 231.0) - 4.0 * a * (a2 + 48.0),
          3584.0 / 5.0 + 4.0 * a2 * (a2 + 128.0) - 4.5 * pi_ * a * (6.0 * a2 + 77.0)};
}

double series(double a, double b, int terms) {
  const std::array<double, 5> c = coefficients(a);
  double sum = 0.0;
  for (int n = terms; n >= 1; --n) sum = (sum + c[static_cast<std::size_t>(n - 1)]) / b;
  return sum;
}

void run(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  for (const double a : {0.5, 0.9, -0.9}) {
    for (const double b : {100.0, 1000.0}) {
      // The module takes a >= 0 with b signed: a < 0 is retrograde.
      const double signed_b = a < 0.0 ? -b : b, spin = std::abs(a);
      ClaimSheet claim = sheet.claim(fmt::format("deflection at a = {:+g} M, b = {:g} M", a, b), "rad");
      claim.exact(exact::equatorial_deflection(1.0, spin, signed_b), "elliptic integrals of the third kind, 113 bits");
      const double used = lab.planted(drag_fault) ? -a : a;
      for (const int terms : {2, 5}) {
        // The series ends at the critical b: coefficients grow from one to the next by 7 M at most, b_c of a = -M.
        const double next =
            terms < 5 ? std::abs(coefficients(a)[static_cast<std::size_t>(terms)]) : 7.0 * coefficients(a)[4];
        claim.ours(terms == 2 ? "two terms, as Edery and Godin" : "five terms", series(used, b, terms),
                   {1.2 * next * std::pow(b, -terms - 1) + 2e-13,
                    "the first coefficient left out, a fifth for those after it, and the closed form's error"});
      }
      add_kerr_deflection_routes(claim, lab, spin, signed_b);
    }
  }
  std::vector<Series> off;
  for (const int terms : {1, 2, 3, 5}) {
    Series one{fmt::format("{} term{}", terms, terms > 1 ? "s" : ""), Look::line, {}, {}};
    for (const double b : log_steps(8.0, 500.0, 60)) {
      one.x.push_back(b);
      one.y.push_back(std::abs(series(0.9, b, terms) / kerr_deflection_by_quadrature(0.9L, b) - 1.0));
    }
    off.push_back(std::move(one));
  }
  sheet.figure() = {.title = "Sereno & De Luca 2006: Kerr's weak deflection as a series",
                    .caption = "Relative error of the series, a = 0.9 M, prograde; two terms are Edery and Godin's.",
                    .panels = {{.title = "What the series leaves out",
                                .x_label = "b [M]",
                                .y_label = "|series/exact - 1|",
                                .x_log = true,
                                .y_log = true,
                                .series = std::move(off)}}};
}

}  // namespace

Paper sereno_de_luca_2006() {
  return {
      .info = {.id = "sereno-de-luca-2006",
               .reference = "M. Sereno, F. De Luca, Analytical Kerr black hole lensing in the weak deflection limit "
                            "(2006); A. Edery, J. Godin, Second order Kerr deflection, Gen. Relativ. Gravit. 38, 1715 "
                            "(2006)",
               .reproduced = "Five terms of Kerr's equatorial deflection in 1/b, prograde and retrograde.",
               .cites = "SerenoDeLuca2006 EderyGodin2006",
               .not_checked = {"Light off the equator and image positions.",
                               "The series was read in a later work that quotes it (arXiv:1405.2919), not in the "
                               "paper."}},
      .run = run,
      .faults = {{drag_fault, "frame dragging with the wrong sign: prograde and retrograde exchanged"}}};
}

}  // namespace xpr::papers
