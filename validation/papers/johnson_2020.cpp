// Johnson et al. 2020; Gralla & Lupsasca 2020: how fast light leaves its orbit. [Johnson2020]
// [GrallaLupsasca2020Lensing]
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "metrics/kerr_exact.hpp"
#include "metrics/schwarzschild_exact.hpp"
#include "validation/families/kerr.hpp"
#include "validation/papers/papers.hpp"
#include "validation/papers/quadrature.hpp"
#include "validation/papers/schwarzschild_light.hpp"

namespace xpr::papers {

namespace {

namespace exact = kerr_exact;

constexpr double pi_ = std::numbers::pi;
constexpr const char* whole_orbit_fault = "paper-johnson-whole-orbit";
const double sqrt2 = std::sqrt(2.0), sqrt3 = std::sqrt(3.0);

struct Orbit {
  double a, r, gamma;  ///< gamma: mpmath, 16 digits
};
const std::array<Orbit, 8> orbits{{{1.0, 1.0 + sqrt2, 2.430896053529963},
                                   {1.0, 1.0 + sqrt3, 2.615946335697179},
                                   {1.0, 3.0, 2.750537828629762},
                                   {1.0, 1.0 + 2.0 * sqrt2, 3.08390349040563},
                                   {1.0, 2.0, 2.129489163143327},
                                   {1.0, 1.0316, 0.4294794126335896},
                                   {0.9, 2.5, 2.615160454521323},
                                   {0.5, 3.2, 3.069419871016817}}};

/// sqrt(R''/2) times half the polar period in Mino time: R'' from the constants of the orbit.
double gamma_by_quadrature(const Lab& lab, const Orbit& orbit) {
  const long double a = orbit.a, r = orbit.r, d = r - 1.0L;
  const long double xi =
      a == 1.0L ? -(r * r - 2.0L * r - 1.0L) : -(r * r * r - 3.0L * r * r + a * a * (r + 1.0L)) / (a * d);
  const long double eta = a == 1.0L
                              ? r * r * r * (4.0L - r)
                              : -r * r * r * (r * r * r - 6.0L * r * r + 9.0L * r - 4.0L * a * a) / (a * a * d * d);
  // R = (r^2 + a^2 - a xi)^2 - Delta (eta + (xi - a)^2).
  const long double P = r * r + a * a - a * xi, K = eta + (xi - a) * (xi - a);
  const long double second = 8.0L * r * r + 4.0L * P - 2.0L * K;
  const long double b = xi * xi + eta - a * a, root = std::sqrt(b * b + 4.0L * a * a * eta);
  const long double u_plus = 2.0L * eta / (b + root), minus_u_minus = (b + root) / (2.0L * a * a);
  const Integral quarter = integral(
      [&](long double psi) {
        const long double s = std::sin(psi);
        return 1.0L / std::sqrt(1.0L + u_plus / minus_u_minus * s * s);
      },
      0.0L, std::numbers::pi_v<long double> / 2.0L);
  const long double half = 2.0L * quarter.value / (a * std::sqrt(minus_u_minus));
  return static_cast<double>((lab.planted(whole_orbit_fault) ? 2.0L : 1.0L) * std::sqrt(0.5L * second) * half);
}

/// Growth of a displacement over one half orbit: r after it from r +- delta, the odd part. cosh(gamma).
double gamma_from_rays(const Lab& lab, const Charts& at, const MethodAt& method, const Orbit& orbit, double delta) {
  const exact::SphericalOrbit truth = exact::spherical_orbit(1.0, orbit.a, orbit.r);
  const std::array<Event, 1> passage{{{.name = "equator",
                                       .g = [](const Spacetime&, const PhaseState<double>& y, int) { return y[3]; },
                                       .direction = -1,
                                       .terminal = true}}};
  const auto radius_after = [&](double r) {
    // The orbit's own xi, at a turning point of r: eta follows from R(r) = 0.
    const double xi = truth.xi.value, a = orbit.a;
    const double P = r * r + a * a - a * xi, eta = P * P / (r * r - 2.0 * r + a * a) - (xi - a) * (xi - a);
    const ChartState start =
        change_chart(*at.classical, *at.transport, {{0.0, r, pi_ / 2.0, 0.0}, {-1.0, 0.0, -std::sqrt(eta), xi}});
    return at.transport->radius(lab.trace(*at.transport, start.state, 1, trace_settings(method), passage).y.x());
  };
  return std::acosh((radius_after(orbit.r + delta) - radius_after(orbit.r - delta)) / (2.0 * delta));
}

void run(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  for (const Orbit& orbit : orbits) {
    ClaimSheet claim = sheet.claim(fmt::format("gamma at a = {} M, r = {:.6g} M", orbit.a, orbit.r));
    const double condition = 1.0 + 0.1 / (orbit.r - 1.0);
    claim.exact({orbit.gamma, 1e-15 * condition}, "mpmath, 16 digits");
    const Tolerance round_off{3e-14 * condition, "round-off of r, over r - M"};
    claim.ours("elliptic integrals, 113 bits", exact::spherical_orbit(1.0, orbit.a, orbit.r).lyapunov_half_orbit.value,
               round_off);
    claim.ours("sqrt(R''/2) times half a period by quadrature", gamma_by_quadrature(lab, orbit), round_off);
    if (orbit.r < 1.5) continue;  // at r = 1.03 M the horizon is nearer than the displacement's growth
    const Charts at = kerr_family::charts(lab, orbit.a, "kerr-schild");
    for (const MethodAt& method : {MethodAt{"dop853", 1e-15}, MethodAt{"dopri54", 1e-14}}) {
      constexpr double delta = 1e-4;
      claim.from_rays("growth of a displacement over half an orbit", *at.transport, method,
                      gamma_from_rays(lab, at, method, orbit, delta),
                      {5.0 * delta * delta * std::exp(2.0 * orbit.gamma) + 200.0 * method.setting / delta,
                       "third order in the displacement 1e-4 M, and the tracer's 200 tol over it"});
    }
  }
  ClaimSheet ring = sheet.claim("demagnification of successive rings, Schwarzschild");
  ring.exact({0.04321391826377225, 5e-18}, "exp(-pi)");
  ring.ours("the Schwarzschild module's exponent",
            std::exp(-schwarzschild_exact::lyapunov_exponent_per_half_orbit().value), {1e-16, "round-off"});
  // b - b_c of light deflected by half a turn more falls by that factor: from the orbit equation far down the ladder.
  const auto periapsis = [](double alpha) {
    return zero_of([&](long double P) { return static_cast<long double>(deflection_by_quadrature(P).value - alpha); },
                   3.0L + 1e-9L, 4.0L);
  };
  const auto excess = [](long double P) { return (P - 3.0L) * (P - 3.0L); };
  ring.ours("impact parameters half a turn apart, quadrature",
            static_cast<double>(excess(periapsis(7.0 * pi_)) / excess(periapsis(6.0 * pi_))),
            {1e-5, "asymptotic: the next order is P - 3 = 3e-4 of it"});

  std::vector<Series> curves;
  for (const double a : {0.5, 0.9, 0.998}) {
    const double low = exact::photon_orbit_radius(1.0, a, exact::Sense::prograde).value;
    const double high = exact::photon_orbit_radius(1.0, a, exact::Sense::retrograde).value;
    Series curve{fmt::format("a = {} M", a), Look::line, {}, {}};
    for (const double part : even_steps(1e-4, 1.0 - 1e-4, 90)) {
      const double r = low + part * (high - low);
      curve.x.push_back(r), curve.y.push_back(exact::spherical_orbit(1.0, a, r).lyapunov_half_orbit.value);
    }
    curves.push_back(std::move(curve));
  }
  curves.push_back({"Schwarzschild: pi", Look::printed, {3.0}, {pi_}});
  Series traced{"growth of traced displacements", Look::dots, {}, {}};
  for (const double r : {1.8, 2.3, 2.9, 3.5}) {
    const Charts at = kerr_family::charts(lab, 0.9, "kerr-schild");
    traced.x.push_back(r), traced.y.push_back(gamma_from_rays(lab, at, {"dop853", 1e-14}, {0.9, r, 0.0}, 1e-4));
  }
  curves.push_back(std::move(traced));
  sheet.figure() = {
      .title = "Johnson et al. 2020: the Lyapunov exponent of light's orbits",
      .caption =
          "Exponent per half orbit over the radii of spherical orbits; successive photon rings are "
          "e^gamma thinner.",
      .panels = {
          {.title = "Exponent per half orbit", .x_label = "r [M]", .y_label = "gamma", .series = std::move(curves)}}};
}

}  // namespace

Paper johnson_2020() {
  return {
      .info = {.id = "johnson-2020",
               .reference = "M. D. Johnson et al., Universal interferometric signatures of a black hole's photon ring, "
                            "Sci. Adv. 6, eaaz1310 (2020); S. E. Gralla, A. Lupsasca, Phys. Rev. D 101, 044031 (2020)",
               .reproduced = "The Lyapunov exponent of spherical photon orbits, and the thinning of rings.",
               .cites = "Johnson2020 GrallaLupsasca2020Lensing",
               .not_checked = {"Interferometric visibilities: no image is made here.",
                               "Printed numbers: none is known from a source; sections not verified."}},
      .run = run,
      .faults = {{whole_orbit_fault, "a whole orbit taken for half of one"}}};
}

}  // namespace xpr::papers
