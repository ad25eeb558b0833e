// Isotropic Schwarzschild as a medium: the same light curves, t the optical path.
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

constexpr const char* power_fault = "paper-isotropic-index-square-for-cube";

long double index_of(long double rho) {
  const long double x = 0.5L / rho;
  return (1.0L + x) * (1.0L + x) * (1.0L + x) / (1.0L - x);
}

double index_as_written(const Lab& lab, double rho) {
  const double x = 0.5 / rho;
  return std::pow(1.0 + x, lab.planted(power_fault) ? 2.0 : 3.0) / (1.0 - x);
}

/// The turning point rho n = b outside the photon sphere.
long double turning_point(long double b) {
  return zero_of([b](long double rho) { return rho * index_of(rho) - b; }, 1.8660254037844386468L, b);
}

/// Bouguer: alpha = 2 int b drho/(rho sqrt(n^2 rho^2 - b^2)) - pi, with rho = rho0/(1 - s^2).
double deflection_by_bouguer(long double b) {
  const long double rho0 = turning_point(b);
  const Integral half = integral(
      [&](long double s) {
        const long double x = 1.0L - s * s, rho = rho0 / x, n_rho = index_of(rho) * rho;
        return 2.0L * s / x * b / std::sqrt((n_rho - b) * (n_rho + b));
      },
      0.0L, 1.0L);
  return static_cast<double>(2.0L * half.value - std::numbers::pi_v<long double>);
}

/// int n dl = int n^2 rho drho/sqrt(n^2 rho^2 - b^2) from the turning point to rho.
double optical_path(long double b, long double rho_end) {
  const long double rho0 = turning_point(b);
  const Integral path = integral(
      [&](long double s) {
        const long double rho = rho0 + s * s, n_rho = index_of(rho) * rho;
        return 2.0L * s * n_rho * index_of(rho) / std::sqrt((n_rho - b) * (n_rho + b));
      },
      0.0L, std::sqrt(rho_end - rho0));
  return static_cast<double>(path.value);
}

void add_index(PaperSheet& sheet) {
  const Charts at = schwarzschild_charts(sheet.lab(), "isotropic");
  struct Member {
    double rho, n;
  };
  for (const Member& point : {Member{2.0, 2.60416666666667}, Member{10.0, 1.21855263157895}}) {
    ClaimSheet claim = sheet.claim(fmt::format("n at rho = {:g} M", point.rho));
    claim.exact({point.n, 5e-15}, "mpmath, 15 digits");
    const Tolerance digits{1e-13, "ten times the digits of the evaluation"};
    claim.ours("the formula", index_as_written(sheet.lab(), point.rho), digits);
    claim.ours("exact solutions' module", exact::refractive_index(1.0, point.rho).value, digits);
    const SymTensor4<double> g = at.transport->inverse_metric({0.0, point.rho, 0.0, 0.0});
    claim.ours("sqrt(g^tt/g^xx) of the isotropic chart", std::sqrt(-g(0, 0) / g(1, 1)), digits);
  }
  ClaimSheet sphere = sheet.claim("photon sphere, where rho n is least", "M");
  sphere.exact({1.86602540378444, 5e-15}, "(2 + sqrt3)/2");
  const long double least = zero_of(
      [](long double rho) {
        const long double h = 1e-6L;
        return ((rho + h) * index_of(rho + h) - (rho - h) * index_of(rho - h)) / (2.0L * h);
      },
      1.5L, 2.5L);
  sphere.ours("zero of d(rho n)/drho", static_cast<double>(least),
              {1e-10, "central difference over 1e-6: 1e-12, and round-off 1e-19/1e-6"});
  sphere.ours("exact solutions' module", exact::isotropic_from_areal(1.0, 3.0).value,
              {1e-13, "ten times the digits of the evaluation"});
}

void run(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  add_index(sheet);
  ClaimSheet deflection = sheet.claim("deflection at b = 8 M", "rad");
  deflection.exact({0.85873001807909526024, 2e-16}, "mpmath, 50 digits, in the areal chart");
  deflection.ours("Bouguer's integral in the medium", deflection_by_bouguer(8.0L),
                  {1e-12, "the root under the integral is a difference: 1e-19 over 1e-9 next to the turning point"});
  ClaimSheet path = sheet.claim("optical path at b = 8 M from the turning point to r = 100 M", "M");
  const ExactValue time = exact::coordinate_time(1.0, 8.0, 100.0, 100.0, true);
  path.exact({0.5 * time.value, time.error}, "half the Schwarzschild time there and back, long double quadrature");
  const double rho_end = exact::isotropic_from_areal(1.0, 100.0).value;
  path.ours("int n dl in the medium", optical_path(8.0L, rho_end), {1e-10, "as above, over a path of 100 M"});
  for (const Route& route : {Route{"isotropic", {"dop853", 1e-14}}, Route{"areal", {"dopri54", 1e-12}}}) {
    const Charts at = schwarzschild_charts(lab, route.chart);
    const SweptRay ray = there_and_back(lab, at, 8.0, 100.0, route.method, true);
    deflection.traced({*at.transport, route.method, ray.end}, traced_deflection(ray, 8.0),
                      accumulated(ray.end, route.method.setting, deflection_condition(8.0)));
    path.traced({*at.transport, route.method, ray.end}, 0.5 * (ray.end_classical[0] - ray.start_classical[0]),
                accumulated(ray.end, route.method.setting, 200.0 + 8.0 * deflection_condition(8.0)));
  }
  Series n{"n(rho)", Look::line, {}, {}}, n_rho{"rho n(rho) [M]", Look::line, {}, {}};
  for (const double rho : log_steps(0.6, 30.0, 160)) {
    n.x.push_back(rho), n.y.push_back(static_cast<double>(index_of(rho)));
    n_rho.x.push_back(rho), n_rho.y.push_back(rho * static_cast<double>(index_of(rho)));
  }
  const double least = 0.5 * (2.0 + std::sqrt(3.0));
  sheet.figure() = {.title = "Schwarzschild as a medium",
                    .caption =
                        "Index of refraction in the isotropic radius; light circles where rho n is least, at "
                        "3 sqrt 3 M.",
                    .panels = {{.title = "Index of refraction",
                                .x_label = "isotropic radius rho [M]",
                                .y_label = "n, rho n",
                                .x_log = true,
                                .y_log = true,
                                .series = {{"photon sphere", Look::dotted, {least, least}, {1.0, 100.0}}, n, n_rho}}}};
}

}  // namespace

Paper isotropic_index() {
  return {.info = {.id = "isotropic-index",
                   .reference = "The Schwarzschild field as a medium, after W. Gordon, Ann. Phys. 377, 421 (1923)",
                   .reproduced = "Index, photon sphere, deflection and optical path of the medium with Schwarzschild's "
                                 "light.",
                   .cites = "Gordon1923 MisnerThorneWheeler1973",
                   .not_checked = {"A textbook result: no printed number is known from a source."}},
          .run = run,
          .faults = {{power_fault, "(1 + 1/2 rho)^2 for its cube"}}};
}

}  // namespace xpr::papers
