// James, von Tunzelmann, Franklin & Thorne 2015: the Kerr camera of the film. [JamesTunzelmannFranklinThorne2015]
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "metrics/kerr_exact.hpp"
#include "metrics/kerr_ray_exact.hpp"
#include "validation/families/kerr.hpp"
#include "validation/papers/papers.hpp"
#include "validation/papers/quadrature.hpp"
#include "validation/papers/schwarzschild_light.hpp"

namespace xpr::papers {

namespace {

using kerr_exact::Sense;

constexpr double pi_ = std::numbers::pi;
constexpr double a = 0.999;
constexpr const char* sigma_fault = "paper-dngr-usual-sigma";

/// b0 and q0 of the spherical orbit at r (their A.5).
long double b0(long double r) { return -(r * r * r - 3.0L * r * r + a * a * (r + 1.0L)) / (a * (r - 1.0L)); }
long double q0(long double r) {
  return -r * r * r * (r * r * r - 6.0L * r * r + 9.0L * r - 4.0L * a * a) / (a * a * (r - 1.0L) * (r - 1.0L));
}
double orbit_radius(double sign) { return 2.0 * (1.0 + std::cos(2.0 / 3.0 * std::acos(sign * a))); }

/// Their metric functions at the equator: lapse alpha, dragging omega, circumference varpi.
struct Frame {
  double alpha, omega, varpi;
};
Frame frame(const Lab& lab, double r) {
  const double delta = r * r - 2.0 * r + a * a, rho = r;
  const double sigma =
      lab.planted(sigma_fault) ? rho * rho : std::sqrt((r * r + a * a) * (r * r + a * a) - a * a * delta);
  return {rho * std::sqrt(delta) / sigma, 2.0 * a * r / (sigma * sigma), sigma / rho};
}

/// Whether the light that reaches the camera comes from the hole (their appendix): b within (b1, b2) and q < q0(b),
/// then by the way p_r points; else by whether the camera stands inside the outer root.
bool from_the_hole(double b, double q, bool outgoing_light) {
  const double r1 = orbit_radius(-1.0), r2 = orbit_radius(1.0);
  const double b1 = static_cast<double>(b0(r2)), b2 = static_cast<double>(b0(r1));
  if (b1 < b && b < b2) {
    const long double r = zero_of([b](long double x) { return b0(x) - b; }, r1, r2);
    if (q < static_cast<double>(q0(r))) return outgoing_light;
  }
  return false;  // outside the photon orbits the outer root lies inside the camera
}

void add_numbers(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  const auto add = [&](const char* name, const char* unit, double value, double first, const char* first_route,
                       double second, const char* second_route) {
    ClaimSheet claim = sheet.claim(fmt::format("{}, a = 0.999 M", name), unit);
    claim.exact({value, 2e-14}, "mpmath, 15 digits");
    const Tolerance digits{2e-12, "a hundred times the digits of the evaluation; r - M = 0.05 in a denominator"};
    claim.ours(first_route, first, digits);
    claim.ours(second_route, second, digits);
  };
  const auto photon = [](Sense sense) { return kerr_exact::photon_orbit_radius(1.0, a, sense).value; };
  const auto critical = [](Sense sense) { return kerr_exact::critical_impact_parameter(1.0, a, sense).value; };
  const double r1 = orbit_radius(-1.0), r2 = orbit_radius(1.0);
  add("r1", "M", 1.05208091592876, r1, "their formula", photon(Sense::prograde), "exact solutions' module");
  add("r2", "M", 3.99911102878707, r2, "their formula", photon(Sense::retrograde), "exact solutions' module");
  add("b1", "M", -6.99833323454229, static_cast<double>(b0(r2)), "b0(r2)", critical(Sense::retrograde),
      "exact solutions' module");
  add("b2", "M", 2.07812987105823, static_cast<double>(b0(r1)), "b0(r1)", critical(Sense::prograde),
      "exact solutions' module");
  const kerr_exact::SphericalOrbit at_two = kerr_exact::spherical_orbit(1.0, a, 2.0);
  add("b0(2 M)", "M", 1.007004004004, static_cast<double>(b0(2.0L)), "their (A.5)", at_two.xi.value,
      "exact solutions' module");
  add("q0(2 M)", "M2", 15.9679519359199, static_cast<double>(q0(2.0L)), "their (A.5)", at_two.eta.value,
      "exact solutions' module");
  const double isco = static_cast<double>(
      zero_of([](long double r) { return r * r - 6.0L * r + 8.0L * a * std::sqrt(r) - 3.0L * a * a; }, 1.05L, 9.0L));
  add("innermost stable orbit", "M", 1.18176461303357, isco, "root of the stability condition",
      kerr_exact::isco_radius(1.0, a, Sense::prograde).value, "exact solutions' module");
  const double r = 6.03;
  const Frame fido = frame(lab, r);
  const auto chart = kerr_family::charts(lab, a, "boyer-lindquist").classical;
  const SymTensor4<double> g = chart->metric({0.0, r, pi_ / 2.0, 0.0}),
                           up = chart->inverse_metric({0.0, r, pi_ / 2.0, 0.0});
  add("alpha at r = 6.03 M", "1", 0.819291144371708, fido.alpha, "their formula", 1.0 / std::sqrt(-up(0, 0)),
      "1/sqrt(-g^tt) of the module");
  add("omega at r = 6.03 M", "M-1", 0.00879129872512423, fido.omega, "their formula", -g(0, 3) / g(3, 3),
      "-g_tphi/g_phiphi of the module");
  add("varpi at r = 6.03 M", "M", 6.13921110080917, fido.varpi, "their formula", std::sqrt(g(3, 3)),
      "sqrt(g_phiphi) of the module");
  const double kepler = 1.0 / (std::pow(r, 1.5) + a);
  add("speed of a circular orbit at 6.03 M", "1", 0.408195646879855, fido.varpi / fido.alpha * (kepler - fido.omega),
      "their formula", std::sqrt(g(3, 3) * -up(0, 0)) * (kepler + g(0, 3) / g(3, 3)), "components of the module");
}

/// Camera rays in all directions: n is the direction in which the light goes, in the frame of a FIDO at r = 6.03 M.
struct CameraRay {
  double b, q, p_r, p_theta;
};
CameraRay camera_ray(const Frame& fido, double r, double n_r, double n_theta, double n_phi) {
  const double energy = 1.0 / (fido.alpha + fido.omega * fido.varpi * n_phi), delta = r * r - 2.0 * r + a * a;
  return {energy * fido.varpi * n_phi, energy * energy * r * r * n_theta * n_theta, energy * r * n_r / std::sqrt(delta),
          energy * r * n_theta};
}

void add_fates(PaperSheet& sheet, Series& captured, Series& escaped) {
  const Lab& lab = sheet.lab();
  constexpr double r = 6.03;
  const Frame fido = frame(lab, r);
  ClaimSheet null = sheet.claim("|2H| of a camera's rays in the module's metric, the largest");
  null.exact({0.0, 0.0}, "their p is null");
  ClaimSheet fates = sheet.claim("camera rays whose fate the paper's test gets wrong");
  fates.exact({0.0, 0.0}, "none");
  const Charts at = kerr_family::charts(lab, a, "kerr-schild-outgoing");
  TraceSettings settings = trace_settings({"dop853", 1e-10});
  settings.r_min = *at.transport->default_r_min();
  settings.r_max = 50.0;
  double worst_null = 0.0, worst_transport = 0.0;
  int against_traced = 0, against_closed = 0;
  RayEnd last;
  for (int i = 0; i < 14; ++i) {
    for (int j = 0; j < 14; ++j) {
      // Directions over the whole sphere, none of them on an axis.
      const double z = -1.0 + (2.0 * i + 1.0) / 14.0, phi = 2.0 * pi_ * (j + 0.37) / 14.0, s = std::sqrt(1.0 - z * z);
      const CameraRay ray = camera_ray(fido, r, s * std::cos(phi), z, s * std::sin(phi));
      const PhaseState<double> light({0.0, r, pi_ / 2.0, 0.0}, {-1.0, ray.p_r, ray.p_theta, ray.b});
      worst_null = std::max(worst_null, std::abs(2.0 * at.classical->hamiltonian(light)));
      ChartState start = change_chart(*at.classical, *at.transport, light);
      start.state = reversed(start.state);
      worst_transport = std::max(worst_transport, std::abs(2.0 * at.transport->hamiltonian(start.state)));
      last = lab.trace(*at.transport, start.state, 1, settings);
      const bool from_hole = from_the_hole(ray.b, ray.q, ray.p_r > 0.0);
      if (from_hole != (last.status == Status::captured)) ++against_traced;
      const kerr_exact::KerrRay closed(
          {1.0, a},
          kerr_exact::RayEvent{
              .r = r, .theta = pi_ / 2.0, .p_t = 1.0, .p_r = -ray.p_r, .p_theta = -ray.p_theta, .p_phi = -ray.b});
      if (from_hole != (closed.fate() == kerr_exact::Fate::captured)) ++against_closed;
      Series& shown = last.status == Status::captured ? captured : escaped;
      shown.x.push_back(ray.b), shown.y.push_back(ray.q);
    }
  }
  const Tolerance round_off{1e-12, "round-off of products of momenta up to 10 E"};
  null.ours("Boyer-Lindquist", worst_null, round_off);
  null.ours("Kerr-Schild, mapped", worst_transport, {1e-11, "as above, through the chart map's Jacobian"});
  const Tolerance none{0.5, "a count"};
  fates.from_rays("196 rays traced back in time", *at.transport, {"dop853", 1e-10}, against_traced, none);
  fates.ours("196 rays in closed form", against_closed, none);
}

void run(PaperSheet& sheet) {
  add_numbers(sheet);
  Series captured{"from the hole, traced", Look::printed, {}, {}}, escaped{"from the sky, traced", Look::dots, {}, {}};
  add_fates(sheet, captured, escaped);
  Series edge{"q0(b0)", Look::line, {}, {}};
  for (const double r : even_steps(orbit_radius(-1.0), orbit_radius(1.0), 160)) {
    edge.x.push_back(static_cast<double>(b0(r))), edge.y.push_back(static_cast<double>(q0(r)));
  }
  sheet.figure() = {.title = "James et al. 2015: which light comes from the hole",
                    .caption =
                        "Camera rays at r = 6.03 M by their constants, a = 0.999 M: under the curve light that goes "
                        "outward comes from the hole, and light that goes inward from the sky behind.",
                    .panels = {{.title = "Fates of camera rays",
                                .x_label = "b [M]",
                                .y_label = "q [M^2]",
                                .series = {edge, escaped, captured}}}};
}

}  // namespace

Paper james_2015_dngr() {
  return {.info = {.id = "james-2015-dngr",
                   .reference =
                       "O. James, E. von Tunzelmann, P. Franklin, K. S. Thorne, Gravitational lensing by spinning "
                       "black holes in astrophysics, and in the movie Interstellar, Class. Quantum Grav. 32, 065001 "
                       "(2015)",
                   .reproduced = "The camera's frame, the spherical orbits of its test, and the fate of its rays.",
                   .cites = "JamesTunzelmannFranklinThorne2015",
                   .not_checked = {"Ray bundles and filtering; images.",
                                   "Equation numbers other than (A.4) and (A.5), which public code names."}},
          .run = run,
          .faults = {{sigma_fault, "the usual Sigma = r^2 + a^2 cos^2 theta taken for theirs"}}};
}

}  // namespace xpr::papers
