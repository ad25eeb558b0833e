// Iyer & Petters 2007: the deflection as a series far from the hole and next to the photon sphere. [IyerPetters2007]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "metrics/schwarzschild_exact.hpp"
#include "validation/papers/papers.hpp"
#include "validation/papers/schwarzschild_light.hpp"

namespace xpr::papers {

namespace {

namespace exact = schwarzschild_exact;

constexpr double pi_ = std::numbers::pi;
const double sqrt3 = std::sqrt(3.0);
const double critical_b = 3.0 * sqrt3;
constexpr const char* logarithm_fault = "paper-iyer-petters-five-lambda";

/// a_1 ... a_10 of alpha = sum a_n (M/b)^n.
constexpr std::array<double, 10> weak_coefficients{4.0,
                                                   15.0 * pi_ / 4.0,
                                                   128.0 / 3.0,
                                                   3465.0 * pi_ / 64.0,
                                                   3584.0 / 5.0,
                                                   255255.0 * pi_ / 256.0,
                                                   98304.0 / 7.0,
                                                   334639305.0 * pi_ / 16384.0,
                                                   18743296.0 / 63.0,
                                                   29113619535.0 * pi_ / 65536.0};

/// The deflection at b = 100 and 1000 M: mpmath, 50 digits.
constexpr double alpha_at_100 = 0.041222539749273651709;
constexpr double alpha_at_1000 = 0.0040118238099253647101;

double weak_series(double b, int terms) {
  double sum = 0.0;
  for (int n = terms; n >= 1; --n) sum = (sum + weak_coefficients[static_cast<std::size_t>(n - 1)]) / b;
  return sum;
}

/// The strong series in x = 1 - b_c/b, to order 0...3.
double strong_series(double x, int order, bool wrong) {
  const double lambda = std::log(216.0 * (7.0 - 4.0 * sqrt3) / x);
  const std::array<double, 4> terms{-pi_ + lambda, (-17.0 + 4.0 * sqrt3 + (wrong ? 4.0 : 5.0) * lambda) * x / 18.0,
                                    (-879.0 + 236.0 * sqrt3 + 205.0 * lambda) * x * x / 1296.0,
                                    (-321590.0 + 90588.0 * sqrt3 + 68145.0 * lambda) * x * x * x / 629856.0};
  double sum = 0.0;
  for (std::size_t k = 0; k <= static_cast<std::size_t>(order); ++k) sum += terms[k];
  return sum;
}

void add_weak(PaperSheet& sheet) {
  struct Member {
    double b;
    int terms;
  };
  for (const Member& at : {Member{1000.0, 4}, Member{1000.0, 6}, Member{100.0, 6}, Member{100.0, 10}}) {
    ClaimSheet claim = sheet.claim(fmt::format("deflection at b = {:g} M, {} terms", at.b, at.terms), "rad");
    const double alpha = at.b > 500.0 ? alpha_at_1000 : alpha_at_100;
    claim.exact({alpha, 1e-16 * alpha}, "Darwin's elliptic integral by mpmath, 50 digits");
    const double next = at.terms < 10 ? weak_coefficients[static_cast<std::size_t>(at.terms)] : 8e6;
    claim.ours("the printed series", weak_series(at.b, at.terms),
               {1.1 * next * std::pow(at.b, -at.terms - 1) + 2e-15 * alpha,
                "the first coefficient left out, a tenth for those after it, and round-off"});
    add_deflection_routes(claim, sheet.lab(), at.b);
  }
}

/// Each coefficient from the exact deflection at b = 100 M, the nine others as printed.
void add_coefficients(PaperSheet& sheet) {
  constexpr double b = 100.0;
  const double closed = alpha_at_100;
  const double quadrature = deflection_by_quadrature(periapsis_of(b)).value;
  for (int n = 1; n <= 5; ++n) {
    const double a_n = weak_coefficients[static_cast<std::size_t>(n - 1)];
    const double power = std::pow(b, n);
    const auto measured = [&](double alpha) { return (alpha - (weak_series(b, 10) - a_n / power)) * power; };
    ClaimSheet claim = sheet.claim(fmt::format("coefficient a_{} of (M/b)^{}", n, n));
    claim.exact({a_n, 2e-16 * a_n}, "as printed: 4, 15 pi/4, 128/3, 3465 pi/64, 3584/5");
    // The terms fall by a factor of 19 each here: a_11 is 8e6 at most.
    const double left_out = 1.1 * 8e6 * std::pow(b, n - 11);
    claim.ours("from the elliptic integral, 50 digits", measured(closed),
               {left_out + 4e-17 * power, "terms from the eleventh on, and round-off of alpha = 0.04 times b^n"});
    claim.ours("from the quadrature", measured(quadrature),
               {left_out + 4e-17 * power, "terms from the eleventh on, and round-off of alpha = 0.04 times b^n"});
  }
}

void add_strong(PaperSheet& sheet) {
  const bool wrong = sheet.lab().planted(logarithm_fault);
  for (const double x : {1e-5, 1e-3, 0.1}) {
    const double b = critical_b / (1.0 - x);
    ClaimSheet claim = sheet.claim(fmt::format("deflection at 1 - b_c/b = {:g}, series to third order", x), "rad");
    claim.exact(exact::deflection(1.0, b), "Darwin's elliptic integral, 113 bits, at the stored b");
    claim.ours("the printed series", strong_series(x, 3, wrong),
               {0.3 * std::log(1500.0 / x) * std::pow(x, 4) + 2e-16 * deflection_condition(b),
                "order x^4 log x, its coefficients a third as those before it; round-off of b times the condition"});
    add_deflection_routes(claim, sheet.lab(), b);
  }
}

void draw(PaperSheet& sheet) {
  Series curve{"exact", Look::line, {}, {}};
  std::array<Series, 2> weak{Series{"weak, 4 terms", Look::dashed, {}, {}},
                             Series{"weak, 10 terms", Look::dashed, {}, {}}};
  std::array<Series, 2> strong{Series{"strong, order 0", Look::dashed, {}, {}},
                               Series{"strong, order 3", Look::dashed, {}, {}}};
  std::array<Series, 4> off = {
      Series{"weak, 4 terms", Look::dashed, {}, {}}, Series{"weak, 10 terms", Look::dashed, {}, {}},
      Series{"strong, order 0", Look::dashed, {}, {}}, Series{"strong, order 3", Look::dashed, {}, {}}};
  for (const double x : even_steps(0.004, 0.97, 180)) {
    const double b = critical_b / (1.0 - x);
    const double alpha = exact::deflection(1.0, b).value;
    const std::array<double, 4> values{weak_series(b, 4), weak_series(b, 10), strong_series(x, 0, false),
                                       strong_series(x, 3, false)};
    curve.x.push_back(x);
    curve.y.push_back(alpha);
    for (std::size_t k = 0; k < 4; ++k) {
      off[k].x.push_back(x);
      off[k].y.push_back(std::abs(values[k] / alpha - 1.0));
      Series& shown = k < 2 ? weak[k] : strong[k - 2];
      shown.x.push_back(x);
      shown.y.push_back(values[k]);
    }
  }
  Series traced{"traced", Look::dots, {}, {}};
  const Charts at = schwarzschild_charts(sheet.lab(), "kerr-schild");
  for (const double x : even_steps(0.05, 0.95, 13)) {
    const double b = critical_b / (1.0 - x);
    traced.x.push_back(x);
    traced.y.push_back(
        traced_deflection(there_and_back(sheet.lab(), at, b, std::max(50.0, 2.0 * b), {"dop853", 1e-12}), b));
  }
  sheet.figure() = {.title = "Iyer & Petters 2007: from the photon sphere to infinity",
                    .caption =
                        "The exact deflection and both series against 1 - b_c/b, 0 at the photon sphere and 1 far "
                        "away; right: how far each series is off. They hand over near 0.4.",
                    .panels = {{.title = "Deflection",
                                .x_label = "1 - b_c/b",
                                .y_label = "deflection [rad]",
                                .series = {curve, weak[0], weak[1], strong[0], strong[1], traced}},
                               {.title = "Relative error of the series",
                                .x_label = "1 - b_c/b",
                                .y_label = "|series/exact - 1|",
                                .y_log = true,
                                .series = {off.begin(), off.end()}}}};
}

void run(PaperSheet& sheet) {
  add_coefficients(sheet);
  add_weak(sheet);
  add_strong(sheet);
  draw(sheet);
}

}  // namespace

Paper iyer_petters_2007() {
  return {.info = {.id = "iyer-petters-2007",
                   .reference = "S. V. Iyer, A. O. Petters, Light's bending angle due to black holes: from the photon "
                                "sphere to infinity, Gen. Relativ. Gravit. 39, 1563 (2007)",
                   .reproduced = "The weak series to ten terms and the strong series to third order against the exact "
                                 "deflection.",
                   .cites = "IyerPetters2007 KeetonPetters2005",
                   .not_checked = {"The value of 1 - b_c/b at which the paper hands over from one series to the other: "
                                   "known from a public code only."}},
          .run = run,
          .faults = {{logarithm_fault, "4 Lambda for 5 Lambda in the strong series' first order"}}};
}

}  // namespace xpr::papers
