// Teo 2003: spherical photon orbits around a Kerr hole. [Teo2003]
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "metrics/kerr_exact.hpp"
#include "validation/families/kerr.hpp"
#include "validation/papers/papers.hpp"
#include "validation/papers/quadrature.hpp"
#include "validation/papers/schwarzschild_light.hpp"

namespace xpr::papers {

namespace {

namespace exact = kerr_exact;

constexpr const char* drag_fault = "paper-teo-no-dragging";
const double sqrt2 = std::sqrt(2.0), sqrt3 = std::sqrt(3.0);

/// Phi and Q of the orbit at r.
struct Constants {
  long double phi, q;
};
Constants constants(long double a, long double r) {
  if (a == 1.0L) return {-(r * r - 2.0L * r - 1.0L), r * r * r * (4.0L - r)};  // the factor r - 1 cancelled
  const long double d = r - 1.0L;
  return {-(r * r * r - 3.0L * r * r + a * a * (r + 1.0L)) / (a * d),
          -r * r * r * (r * r * r - 6.0L * r * r + 9.0L * r - 4.0L * a * a) / (a * a * d * d)};
}

/// Azimuth over a full oscillation: cos theta = sqrt(u+) sin psi, dtau = dpsi/(a sqrt(-u-) sqrt(1 - (u+/u-) sin^2
/// psi)).
double azimuth_by_quadrature(const Lab& lab, double a, double r, bool dragging_alone = false) {
  const Constants at = constants(a, r);
  const long double b = at.phi * at.phi + at.q - a * a, root = std::sqrt(b * b + 4.0L * a * a * at.q);
  const long double u_plus = 2.0L * at.q / (b + root), minus_u_minus = (b + root) / (2.0L * a * a);
  const long double dragging =
      lab.planted(drag_fault) ? 0.0L : a * (r * r + a * a - a * at.phi) / (r * r - 2.0L * r + a * a) - a;
  const Integral quarter = integral(
      [&](long double psi) {
        const long double s = std::sin(psi) * std::sin(psi);
        const long double dtau = 1.0L / (a * std::sqrt(minus_u_minus) * std::sqrt(1.0L + u_plus / minus_u_minus * s));
        return dtau * ((dragging_alone ? 0.0L : at.phi / (1.0L - u_plus * s)) + dragging);
      },
      0.0L, std::numbers::pi_v<long double> / 2.0L);
  return static_cast<double>(4.0L * quarter.value);
}

struct Orbit {
  double a, r;
  const char* name;
  double azimuth;  ///< over a full oscillation, mpmath
};
const std::array<Orbit, 8> orbits{{{1.0, 1.0 + sqrt2, "a = M, r = (1 + sqrt2) M", 3.176118755006392},
                                   {1.0, 1.0 + sqrt3, "a = M, r = (1 + sqrt3) M", -3.713759403902877},
                                   {1.0, 3.0, "a = M, r = 3 M", -4.072767165430038},
                                   {1.0, 1.0 + 2.0 * sqrt2, "a = M, r = (1 + 2 sqrt2) M", -4.744968901749167},
                                   {1.0, 2.0, "a = M, r = 2 M", 10.84278803951935},
                                   {1.0, 1.0316, "a = M, r = 1.0316 M", 159.5289420696549},
                                   {0.9, 2.5, "a = 0.9 M, r = 2.5 M", 9.047483696980271},
                                   {0.5, 3.2, "a = 0.5 M, r = 3.2 M", -5.228305227328578}}};

/// Azimuth of a traced oscillation: from the equator to the next passage the same way.
void add_traced_azimuth(ClaimSheet& claim, const Lab& lab, const Orbit& orbit, const Route& route) {
  const Charts at = kerr_family::charts(lab, orbit.a, route.chart);
  const exact::SphericalOrbit truth = exact::spherical_orbit(1.0, orbit.a, orbit.r);
  const bool cartesian = route.chart != "boyer-lindquist";
  const auto height = [cartesian](const Spacetime&, const PhaseState<double>& y, int) {
    return cartesian ? y[3] : std::numbers::pi / 2.0 - y[2];
  };
  ChartState start = change_chart(
      *at.classical, *at.transport,
      {{0.0, orbit.r, std::numbers::pi / 2.0, 0.0}, {-1.0, 0.0, -std::sqrt(truth.eta.value), truth.xi.value}});
  double azimuth = 0.0;
  SweptRay half;
  for (const int direction : {-1, 1}) {
    const std::array<Event, 1> passage{{{.name = "equator", .g = height, .direction = direction, .terminal = true}}};
    half = trace_swept(lab, *at.classical, *at.transport, start, trace_settings(route.method), passage);
    azimuth += half.azimuth();
    start = {half.end.y, half.end.sheet};
  }
  const double growth = std::exp(2.0 * truth.lyapunov_half_orbit.value);
  Tolerance tolerance = accumulated(half.end, route.method.setting, 4.0 * growth);
  tolerance.reason =
      "local errors of two half orbits, grown by e^(2 gamma): the orbit is unstable; " + tolerance.reason;
  claim.traced({*at.transport, route.method, half.end, Status::crossed}, azimuth, tolerance);
}

void add_azimuths(PaperSheet& sheet) {
  for (const Orbit& orbit : orbits) {
    ClaimSheet claim = sheet.claim(fmt::format("azimuth of a full oscillation, {}", orbit.name), "rad");
    const double size = std::abs(orbit.azimuth);
    // Next to the horizon a rounding of r = 1.0316 is amplified by 1/(r - 1)^2.
    const double condition = 1.0 + 1.0 / ((orbit.r - 1.0) * (orbit.r - 1.0));
    claim.exact({orbit.azimuth, 2e-16 * size * condition}, "mpmath, 16 digits");
    const Tolerance round_off{4e-15 * (1.0 + size) * condition, "round-off of r and of the sum, over (r - M)^2"};
    const exact::SphericalOrbit closed = exact::spherical_orbit(1.0, orbit.a, orbit.r);
    if (std::abs(constants(orbit.a, orbit.r).phi) < 1e-9L) {
      // Over the poles: the rounding of r decides on which side of the axis the orbit passes, a turn of 2 pi either way
      // that the catalogued number does not count. The dragging alone remains.
      const double turn = 2.0 * std::numbers::pi * (closed.xi.value > 0.0 ? 1.0 : closed.xi.value < 0.0 ? -1.0 : 0.0);
      claim.ours("elliptic integrals, less the turn about the axis", closed.azimuth.value - turn, round_off);
      claim.ours("quadrature of the dragging", azimuth_by_quadrature(sheet.lab(), orbit.a, orbit.r, true), round_off);
      continue;  // a traced ray turns by pi at each pole
    }
    claim.ours("elliptic integrals, 113 bits", closed.azimuth.value, round_off);
    claim.ours("quadrature in the latitude's phase", azimuth_by_quadrature(sheet.lab(), orbit.a, orbit.r), round_off);
    if (orbit.r < 1.5) continue;  // a turn of 160 rad next to the horizon: gamma small, but Boyer-Lindquist fails there
    for (const Route& route : {Route{"kerr-schild", {"dop853", 1e-15}}, Route{"boyer-lindquist", {"dopri54", 1e-14}}}) {
      if (route.chart == "boyer-lindquist" && !sheet.lab().full()) continue;
      add_traced_azimuth(claim, sheet.lab(), orbit, route);
    }
  }
}

void add_examples(PaperSheet& sheet) {
  struct Example {
    const char* name;
    double r, phi, q;
  };
  const std::array<Example, 5> examples{{{"(0, 11 + 8 sqrt2)", 1.0 + sqrt2, 0.0, 11.0 + 8.0 * sqrt2},
                                         {"(-1, 12 + 8 sqrt3)", 1.0 + sqrt3, -1.0, 12.0 + 8.0 * sqrt3},
                                         {"(-2, 27)", 3.0, -2.0, 27.0},
                                         {"(-6, -13 + 16 sqrt2)", 1.0 + 2.0 * sqrt2, -6.0, -13.0 + 16.0 * sqrt2},
                                         {"(1, 16)", 2.0, 1.0, 16.0}}};
  const Tolerance round_off{2e-13, "round-off of r, amplified by dQ/dr < 70"};
  for (const Example& example : examples) {
    const exact::SphericalOrbit closed = exact::spherical_orbit(1.0, 1.0, example.r);
    ClaimSheet phi = sheet.claim(fmt::format("Phi of the orbit printed as {}", example.name), "M");
    phi.exact({example.phi, 0.0}, "as listed from the paper by a public test suite");
    phi.ours("-(r^2 - 2r - 1)", static_cast<double>(constants(1.0L, example.r).phi), round_off);
    phi.ours("exact solutions' module", closed.xi.value, round_off);
    ClaimSheet q = sheet.claim(fmt::format("Q of the orbit printed as {}", example.name), "M2");
    q.exact({example.q, 4e-15}, "as listed from the paper by a public test suite");
    q.ours("r^3 (4 - r)", static_cast<double>(constants(1.0L, example.r).q), round_off);
    q.ours("exact solutions' module", closed.eta.value, round_off);
  }
  ClaimSheet phi = sheet.claim("Phi of the sixth orbit, r = 1.0316 M", "M");
  phi.exact({1.99900144, 1e-15}, "-(r^2 - 2r - 1)");
  phi.printed("1.999", "the same list");
  phi.ours("-(r^2 - 2r - 1)", static_cast<double>(constants(1.0L, 1.0316).phi), round_off);
  phi.ours("exact solutions' module", exact::spherical_orbit(1.0, 1.0, 1.0316).xi.value, round_off);
  ClaimSheet q = sheet.claim("Q of the sixth orbit, r = 1.0316 M", "M2");
  q.exact({3.25879036287793, 5e-15}, "r^3 (4 - r)");
  q.ours("r^3 (4 - r)", static_cast<double>(constants(1.0L, 1.0316).q), round_off);
  q.ours("exact solutions' module", exact::spherical_orbit(1.0, 1.0, 1.0316).eta.value, round_off);
  q.ours("as listed, 3.2590", 3.2590, {5e-5 + 8.4 * 5e-5, "half the last digit of Q, and of r times dQ/dr = 8.4"});
}

void draw(PaperSheet& sheet) {
  std::vector<Panel> panels;
  for (const std::size_t k : {std::size_t{2}, std::size_t{4}}) {
    const Orbit& orbit = orbits[k];
    Series path{"traced", Look::line, {}, {}};
    const Charts at = kerr_family::charts(sheet.lab(), orbit.a, "kerr-schild");
    const exact::SphericalOrbit truth = exact::spherical_orbit(1.0, orbit.a, orbit.r);
    const ChartState start = change_chart(
        *at.classical, *at.transport,
        {{0.0, orbit.r, std::numbers::pi / 2.0, 0.0}, {-1.0, 0.0, -std::sqrt(truth.eta.value), truth.xi.value}});
    TraceSettings settings = trace_settings({"dop853", 1e-15});
    // Sigma is at least r^2: two oscillations at most, before the orbit's instability shows.
    settings.lambda_max = 2.0 * orbit.r * orbit.r * truth.mino_period.value;
    const RayEnd end = sheet.lab().trace(*at.transport, start.state, 1, settings, {}, [&](const StepView& step) {
      for (const double part : {0.25, 0.5, 0.75, 1.0}) {
        const PhaseState<double> y = step.at(part);
        path.x.push_back(y[1]), path.y.push_back(y[3]);
      }
    });
    (void)end;
    panels.push_back({.title = orbit.name, .x_label = "x [M]", .y_label = "z [M]", .equal = true, .series = {path}});
  }
  sheet.figure() = {.title = "Teo 2003: spherical photon orbits",
                    .caption = "Traced orbits seen from the equator, the spin up: about two oscillations in latitude.",
                    .panels = std::move(panels)};
}

void run(PaperSheet& sheet) {
  add_examples(sheet);
  add_azimuths(sheet);
  draw(sheet);
}

}  // namespace

Paper teo_2003() {
  return {
      .info = {.id = "teo-2003",
               .reference = "E. Teo, Spherical photon orbits around a Kerr black hole, Gen. Relativ. Gravit. 35, 1909 "
                            "(2003)",
               .reproduced = "The constants of the example orbits, and how far each advances in an oscillation.",
               .cites = "Teo2003",
               .not_checked = {"The paper was not seen: its example orbits are as a public test suite lists them.",
                               "The azimuth jumps by 2 pi where Phi changes sign; for Phi = 0 the passages of the axis "
                               "are counted as no turn."}},
      .run = run,
      .faults = {{drag_fault, "the dragging of the azimuth left out"}}};
}

}  // namespace xpr::papers
