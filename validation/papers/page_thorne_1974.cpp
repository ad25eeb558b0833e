// Page & Thorne 1974: the flux of a thin disk around a Kerr hole. [PageThorne1974] [Luminet1979]
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "metrics/kerr_exact.hpp"
#include "validation/families/kerr.hpp"
#include "validation/papers/papers.hpp"
#include "validation/papers/quadrature.hpp"

namespace xpr::papers {

namespace {

namespace exact = kerr_exact;

constexpr double pi_ = std::numbers::pi;
constexpr const char* third_fault = "paper-page-thorne-third";

double isco(double a) { return exact::isco_radius(1.0, a, exact::Sense::prograde).value; }

/// F/Mdot in closed form, the logarithms' common factor taken out of Schwarzschild's where a = 0.
double closed_form(const Lab& lab, double a, double r) {
  const double x = std::sqrt(r), x0 = std::sqrt(isco(a));
  const double third = std::acos(a) / 3.0;
  const std::array<double, 3> root{2.0 * std::cos(third - pi_ / 3.0), 2.0 * std::cos(third + pi_ / 3.0),
                                   -2.0 * std::cos(third)};
  double sum = x - x0 - 1.5 * a * std::log(x / x0);
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::abs(root[i]) < 1e-14) continue;  // a = 0: the term vanishes in the limit
    const double j = root[(i + 1) % 3], k = root[(i + 2) % 3];
    const double factor = lab.planted(third_fault) ? 2.0 : 3.0;
    sum -= factor * (root[i] - a) * (root[i] - a) / (root[i] * (root[i] - j) * (root[i] - k)) *
           std::log((x - root[i]) / (x0 - root[i]));
  }
  return 3.0 / (8.0 * pi_) * sum / (x * x * x * x * (x * x * x - 3.0 * x + 2.0 * a));
}

/// Schwarzschild's form with a coefficient of the logarithm: sqrt3/2 as it must be.
double schwarzschild_form(double r, double coefficient) {
  const double x = std::sqrt(r), x0 = std::sqrt(6.0), s = std::sqrt(3.0);
  const double logarithm = std::log((x + s) * (x0 - s) / ((x - s) * (x0 + s)));
  return 3.0 / (8.0 * pi_) / ((r - 3.0) * r * r * x) * (x - x0 + coefficient * logarithm);
}

/// Energy and angular momentum of the circular orbit at r from the Kerr module's own metric components.
struct Orbit {
  double energy, momentum, omega;
};
Orbit orbit_of(const Spacetime& chart, double a, double r) {
  const SymTensor4<double> g = chart.metric({0.0, r, pi_ / 2.0, 0.0});
  const double omega = 1.0 / (std::pow(r, 1.5) + a);
  const double u_t = 1.0 / std::sqrt(-(g(0, 0) + 2.0 * omega * g(0, 3) + omega * omega * g(3, 3)));
  return {-u_t * (g(0, 0) + omega * g(0, 3)), u_t * (g(0, 3) + omega * g(3, 3)), omega};
}

/// -(Omega_,r/(4 pi r)) (E - Omega L)^-2 int (E - Omega L) L_,r dr with textbook E and L in long double.
double integral_form(double spin, double radius) {
  const long double a = spin;
  const auto momentum = [a](long double r) {
    const long double q = std::sqrt(r);
    return (r * r - 2.0L * a * q + a * a) / (q * std::sqrt(r * r - 3.0L * r + 2.0L * a * q));
  };
  const auto binding = [a](long double r) {  // E - Omega L = 1/u^t
    const long double q = std::sqrt(r);
    return std::sqrt(r * r - 3.0L * r + 2.0L * a * q) * q / (r * q + a);
  };
  // By parts: int (E - Omega L) dL = [(E - Omega L) L] - int L d(E - Omega L), no derivative of L needed; d(E - Omega
  // L) = -L dOmega since dE = Omega dL.
  const auto slope = [a](long double r) {
    const long double q = std::sqrt(r), d = r * q + a;
    return -1.5L * q / (d * d);
  };
  const long double r0 = isco(spin), r = radius;
  const Integral rest = integral([&](long double x) { return momentum(x) * momentum(x) * slope(x); }, r0, r);
  const long double value = binding(r) * momentum(r) - binding(r0) * momentum(r0) + rest.value;
  return static_cast<double>(-slope(r) / (4.0L * std::numbers::pi_v<long double> * r) / (binding(r) * binding(r)) *
                             value);
}

/// The same from the metric module: E and L from its components, the integral by Simpson's rule over L itself.
double module_form(const Lab& lab, double a, double r) {
  const auto chart = kerr_family::charts(lab, a, "boyer-lindquist").classical;
  constexpr int panels = 400;
  const double r0 = isco(a), h = (r - r0) / panels;
  // As above by parts, so that only values of E, L and Omega of the module enter, and Omega's slope.
  const auto slope = [a](double x) { return -1.5 * std::sqrt(x) / std::pow(std::pow(x, 1.5) + a, 2.0); };
  double sum = 0.0;
  for (int k = 0; k <= panels; ++k) {
    const double x = r0 + k * h, weight = k == 0 || k == panels ? 1.0 : (k % 2 == 1 ? 4.0 : 2.0);
    const double L = orbit_of(*chart, a, x).momentum;
    sum += weight * h / 3.0 * L * L * slope(x);
  }
  const Orbit from = orbit_of(*chart, a, r0), to = orbit_of(*chart, a, r);
  const auto binding = [](const Orbit& o) { return o.energy - o.omega * o.momentum; };
  const double value = binding(to) * to.momentum - binding(from) * from.momentum + sum;
  return -slope(r) / (4.0 * pi_ * r) / (binding(to) * binding(to)) * value;
}

struct Point {
  double a, r, flux;  ///< mpmath, 15 digits
};
constexpr Point points[] = {{0.0, 7.0, 6.11501027352178e-6},  {0.0, 10.0, 1.35687546380469e-5},
                            {0.0, 20.0, 4.72514406575524e-6}, {0.5, 8.0, 3.78600574595478e-5},
                            {0.9, 4.0, 3.10137708328437e-4},  {0.9, 10.0, 4.80416866912601e-5}};

void add_fluxes(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  for (const Point& point : points) {
    ClaimSheet claim = sheet.claim(fmt::format("F/Mdot at a = {} M, r = {:g} M", point.a, point.r), "M-2");
    claim.exact({point.flux, 5e-15 * point.flux}, "mpmath, 15 digits");
    const Tolerance cancelled{1e-10 * point.flux, "terms of order 0.1 that cancel to F (r - 3) r^2.5: 1e-15 over 1e-4"};
    claim.ours("closed form", closed_form(lab, point.a, point.r), cancelled);
    claim.ours("the integral", integral_form(point.a, point.r), cancelled);
    claim.ours("the integral with E and L of the Kerr module", module_form(lab, point.a, point.r),
               {1e-7 * point.flux, "Simpson's rule with 400 panels: fourth order, and the same cancellation"});
    if (point.a != 0.0) continue;
    claim.ours("Schwarzschild's form, sqrt3/2", schwarzschild_form(point.r, std::sqrt(3.0) / 2.0), cancelled);
    claim.wrong_formula("in circulation: sqrt3/3 and ln", schwarzschild_form(point.r, std::sqrt(3.0) / 3.0),
                        0.05 * point.flux, "wrong by more than five per cent");
    claim.wrong_formula("in circulation: sqrt3/3 and log10",
                        schwarzschild_form(point.r, std::sqrt(3.0) / 3.0 / std::log(10.0)), 0.05 * point.flux,
                        "wrong by more than five per cent");
  }
}

void add_peak(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  ClaimSheet peak = sheet.claim("radius of the greatest flux, a = 0", "M");
  peak.exact({9.55092807794387, 5e-15}, "mpmath, 15 digits");
  const auto peak_of = [](const auto& flux) {
    const double h = 1e-3;
    return static_cast<double>(zero_of(
        [&](long double r) {
          const double x = static_cast<double>(r);
          return static_cast<long double>(flux(x - 2.0 * h) - 8.0 * flux(x - h) + 8.0 * flux(x + h) -
                                          flux(x + 2.0 * h));
        },
        6.1L, 14.0L));
  };
  const Tolerance slope{1e-6, "a slope by five-point differences over 1e-3: their round-off, 1e-11 of F, over F''"};
  peak.ours("closed form", peak_of([&](double r) { return closed_form(lab, 0.0, r); }), slope);
  peak.ours("the integral", peak_of([](double r) { return integral_form(0.0, r); }), slope);
  sheet.finding(
      "the coefficient sqrt3/3 in re-implementations of Luminet's disk",
      fmt::format("F/Mdot at r = 7 M: the integral gives {:.9e}; sqrt3/2 with ln {:.9e}; sqrt3/3 with ln {:.3e}; "
                  "sqrt3/3 with log10 {:.3e}. Luminet's text was not seen; the slip is that of public code.",
                  integral_form(0.0, 7.0), schwarzschild_form(7.0, std::sqrt(3.0) / 2.0),
                  schwarzschild_form(7.0, std::sqrt(3.0) / 3.0),
                  schwarzschild_form(7.0, std::sqrt(3.0) / 3.0 / std::log(10.0))));
}

void draw(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  std::vector<Series> curves;
  for (const double a : {0.0, 0.5, 0.9, 0.99}) {
    Series curve{fmt::format("a = {} M", a), Look::line, {}, {}};
    for (const double r : log_steps(isco(a) * 1.002, 50.0, 150)) {
      curve.x.push_back(r), curve.y.push_back(closed_form(lab, a, r));
    }
    curves.push_back(std::move(curve));
  }
  Series integrated{"the integral", Look::dots, {}, {}};
  for (const Point& point : points) {
    integrated.x.push_back(point.r), integrated.y.push_back(integral_form(point.a, point.r));
  }
  curves.push_back(std::move(integrated));
  Series wrong{"sqrt3/3, a = 0: wrong", Look::dotted, {}, {}};
  for (const double r : log_steps(6.02, 50.0, 100)) {
    const double flux = schwarzschild_form(r, std::sqrt(3.0) / 3.0);
    if (flux <= 0.0) continue;
    wrong.x.push_back(r), wrong.y.push_back(flux);
  }
  curves.push_back(std::move(wrong));
  sheet.figure() = {.title = "Page & Thorne 1974: the flux of a thin disk",
                    .caption =
                        "Flux from one side of the disk per accretion rate, from the innermost stable orbit "
                        "outward.",
                    .panels = {{.title = "Flux",
                                .x_label = "r [M]",
                                .y_label = "F/Mdot [1/M^2]",
                                .x_log = true,
                                .y_log = true,
                                .series = std::move(curves)}}};
}

void run(PaperSheet& sheet) {
  add_fluxes(sheet);
  add_peak(sheet);
  draw(sheet);
}

}  // namespace

Paper page_thorne_1974() {
  return {
      .info = {.id = "page-thorne-1974",
               .reference = "D. N. Page, K. S. Thorne, Disk-accretion onto a black hole: time-averaged structure of "
                            "accretion disk, Astrophys. J. 191, 499 (1974)",
               .reproduced = "The flux of a thin disk in closed form and as an integral, and a coefficient in "
                             "circulation that is wrong.",
               .cites = "PageThorne1974 Luminet1979",
               .not_checked = {"The disk's structure and evolution; nothing here is a ray, so nothing is traced.",
                               "Printed numbers: none is known from a source."}},
      .run = run,
      .faults = {{third_fault, "two for three in front of the logarithms, which makes Schwarzschild's sqrt3/3"}}};
}

}  // namespace xpr::papers
