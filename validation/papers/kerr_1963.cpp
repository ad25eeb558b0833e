// Kerr 1963: the principal null rays, along which r is affine. [Kerr1963] [Carter1968]
#include <fmt/format.h>

#include <cmath>

#include "metrics/kerr_exact.hpp"
#include "validation/families/kerr.hpp"
#include "validation/papers/papers.hpp"
#include "validation/papers/quadrature.hpp"
#include "validation/papers/schwarzschild_light.hpp"

namespace xpr::papers {

namespace {

namespace exact = kerr_exact;

constexpr double spin = 0.9;
constexpr double outer = 100.0, inner = 3.0;
constexpr const char* spin_fault = "paper-kerr-spin-left-out";

/// int (r^2 + a^2)/Delta dr or int a/Delta dr.
double by_quadrature(const Lab& lab, bool time) {
  const long double a = lab.planted(spin_fault) ? 0.0L : static_cast<long double>(spin);
  return static_cast<double>(
      integral([a, time](long double r) { return (time ? r * r + a * a : a) / (r * r - 2.0L * r + a * a); }, inner,
               outer)
          .value);
}

SweptRay principal_ray(const Lab& lab, const Charts& at, double theta, const MethodAt& method) {
  const double sine = std::sin(theta);
  TraceSettings settings = trace_settings(method);
  settings.r_min = inner;
  settings.grade_time = true;
  return trace_swept(lab, *at.classical, *at.transport,
                     general_light(*at.classical, *at.transport, outer, theta, spin * sine * sine, 0.0), settings);
}

void run(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  ClaimSheet time = sheet.claim("time from r = 100 M to 3 M, a = 0.9 M", "M");
  time.exact({105.8486894565526, 5e-14}, "mpmath, 16 digits");
  ClaimSheet angle = sheet.claim("azimuth from r = 100 M to 3 M, a = 0.9 M", "rad");
  angle.exact({0.4482442491241231, 5e-17}, "mpmath, 16 digits");
  ClaimSheet affine = sheet.claim("affine length from r = 100 M to 3 M", "M");
  affine.exact({97.0, 0.0}, "dr/dlambda = -1");
  ClaimSheet cone = sheet.claim("change of theta", "rad");
  cone.exact({0.0, 0.0}, "theta is constant");
  const Tolerance round_off{2e-12, "round-off of a time of 100 M"};
  time.ours("closed form", exact::principal_null_time(1.0, spin, outer, inner).value, round_off);
  time.ours("quadrature", by_quadrature(lab, true), round_off);
  angle.ours("closed form", exact::principal_null_angle(1.0, spin, outer, inner).value, {1e-14, "round-off"});
  angle.ours("quadrature", by_quadrature(lab, false), {1e-14, "round-off"});
  for (const Route& route : {Route{"kerr-schild", {"dop853", 1e-13}}, Route{"boyer-lindquist", {"dopri54", 1e-12}}}) {
    const Charts at = kerr_family::charts(lab, spin, route.chart);
    for (const double theta : {0.7, 1.9}) {
      const SweptRay ray = principal_ray(lab, at, theta, route.method);
      const TracedRoute traced{*at.transport, route.method, ray.end, Status::captured,
                               fmt::format("theta = {}", theta)};
      const Tolerance tolerance = accumulated(ray.end, route.method.setting, 200.0);
      time.traced(traced, ray.end_classical[0] - ray.start_classical[0], tolerance);
      angle.traced(traced, ray.azimuth(), tolerance);
      affine.traced(traced, ray.end.lambda, tolerance);
      cone.traced(traced, ray.end_classical[2] - ray.start_classical[2], tolerance);
    }
  }

  std::vector<Series> curves;
  for (const double a : {0.5, 0.9, 0.998}) {
    Series curve{fmt::format("a = {} M", a), Look::line, {}, {}};
    for (const double r : log_steps(2.0, 12.0, 80)) {
      const double swept = exact::principal_null_angle(1.0, a, 1e6, r).value;
      curve.x.push_back(r * std::cos(swept)), curve.y.push_back(r * std::sin(swept));
    }
    curves.push_back(std::move(curve));
  }
  Series traced{"traced, a = 0.9 M", Look::dots, {}, {}};
  const Charts at = kerr_family::charts(lab, spin, "kerr-schild");
  const SweptRay whole = principal_ray(lab, at, 0.7, {"dop853", 1e-12});
  for (const double r : {3.0, 4.0, 6.0, 10.0}) {
    TraceSettings settings = trace_settings({"dop853", 1e-12});
    settings.r_min = r;
    const SweptRay part = trace_swept(lab, *at.classical, *at.transport,
                                      change_chart(*at.classical, *at.transport, whole.start_classical), settings);
    const double swept = part.azimuth() + exact::principal_null_angle(1.0, spin, 1e6, outer).value;
    traced.x.push_back(r * std::cos(swept)), traced.y.push_back(r * std::sin(swept));
  }
  curves.push_back(std::move(traced));
  sheet.figure() = {.title = "Kerr 1963: principal null rays",
                    .caption =
                        "Rays that come in from the right, seen along the axis: r turned by the swept azimuth, the "
                        "same on every cone theta.",
                    .panels = {{.title = "Seen along the axis",
                                .x_label = "r cos phi [M]",
                                .y_label = "r sin phi [M]",
                                .series = std::move(curves)}}};
}

}  // namespace

Paper kerr_1963() {
  return {.info = {.id = "kerr-1963",
                   .reference = "R. P. Kerr, Gravitational field of a spinning mass as an example of algebraically "
                                "special metrics, Phys. Rev. Lett. 11, 237 (1963)",
                   .reproduced = "Principal null rays: theta constant, r affine, time and azimuth in closed form.",
                   .cites = "Kerr1963 Carter1968",
                   .not_checked = {"The metric's derivation; the field equations are checked by `conform kerr`."}},
          .run = run,
          .faults = {{spin_fault, "the spin left out: Schwarzschild's radial light"}}};
}

}  // namespace xpr::papers
