// Virbhadra & Ellis 2000: relativistic images and rings of a Schwarzschild lens. [VirbhadraEllis2000]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "metrics/schwarzschild_exact.hpp"
#include "validation/papers/papers.hpp"
#include "validation/papers/quadrature.hpp"
#include "validation/papers/schwarzschild_light.hpp"

namespace xpr::papers {

namespace {

namespace exact = schwarzschild_exact;

constexpr double pi_ = std::numbers::pi;
const double critical_b = 3.0 * std::sqrt(3.0);
constexpr const char* newtonian_fault = "paper-virbhadra-ellis-newtonian";
/// M/D_d of Sgr A* as the paper takes it (2.8e6 solar masses at 8.5 kpc), with G M_sun/c^2 = 1.476625038 km.
constexpr double mass_over_distance = 1.57637227718e-11;
constexpr double microarcsecond = pi_ / (180.0 * 3600.0 * 1e6);

/// The periapsis at which the deflection is `alpha`, by the closed form and by quadrature.
long double periapsis_by_closed_form(const Lab& lab, double alpha) {
  const double factor = lab.planted(newtonian_fault) ? 0.5 : 1.0;
  return zero_of(
      [&](long double P) {
        return static_cast<long double>(factor * exact::deflection_from_periapsis(1.0, static_cast<double>(P)).value -
                                        alpha);
      },
      3.0L + 1e-12L, 10.0L);
}
long double periapsis_by_quadrature(double alpha) {
  return zero_of([&](long double P) { return static_cast<long double>(deflection_by_quadrature(P).value - alpha); },
                 3.0L + 1e-7L, 10.0L);
}

double impact_parameter_of(long double P) { return static_cast<double>(std::sqrt(P * P * P / (P - 2.0L))); }

/// b/b_c - 1 without cancellation: P^3 - 27 (P - 2) = (P - 3)^2 (P + 6).
double excess_of(long double P) {
  const long double d = (P - 3.0L) * (P - 3.0L) * (P + 6.0L) / (27.0L * (P - 2.0L));
  return static_cast<double>(d / (1.0L + std::sqrt(1.0L + d)));
}

/// b at which traced rays are deflected by alpha: false position on the logarithm, a few rays.
double ring_from_rays(const Lab& lab, const Charts& at, const MethodAt& method, double alpha, double from) {
  const auto deflection = [&](double b) { return traced_deflection(there_and_back(lab, at, b, 50.0, method), b); };
  // Near b_c the deflection is -ln(b - b_c) up to a slowly changing rest: Newton in ln(b - b_c) converges at once.
  double distance = from - critical_b;
  for (int k = 0; k < 8; ++k) {
    const double off = deflection(critical_b + distance) - alpha;
    distance *= std::exp(off);
    if (std::abs(off) < 1e-13) break;
  }
  return critical_b + distance;
}

struct Ring {
  int turns;
  double b, r_o, excess;  ///< mpmath, 50 digits; excess = b/b_c - 1
};
constexpr Ring rings[] = {{1, 5.20268040281045576, 3.090230513201116, 0.00125631035674},
                          {2, 5.19616456675937591, 3.003750932592082, 2.33712404027e-6},
                          {3, 5.19615244538470095, 3.000161833697114, 4.36439642746e-9}};

void add_rings(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  for (const Ring& ring : rings) {
    const double alpha = 2.0 * pi_ * ring.turns;
    const long double closed = periapsis_by_closed_form(lab, alpha), quadrature = periapsis_by_quadrature(alpha);
    ClaimSheet b = sheet.claim(
        fmt::format("impact parameter of the ring of {} turn{}", ring.turns, ring.turns > 1 ? "s" : ""), "M");
    b.exact({ring.b, 5e-16}, "mpmath, 50 digits");
    const Tolerance tight{1e-14, "round-off: b stands still to second order in P"};
    b.ours("closed form solved for alpha = 2 pi n", impact_parameter_of(closed), tight);
    b.ours("quadrature solved for it", impact_parameter_of(quadrature), tight);
    for (const Route& route : schwarzschild_routes()) {
      if (ring.turns == 3) continue;  // b - b_c = 2e-8: the doubles of a ray's start hold it to 1e-8 of itself
      const Charts at = schwarzschild_charts(lab, route.chart);
      b.from_rays("rays deflected by 2 pi n", *at.transport, route.method,
                  ring_from_rays(lab, at, route.method, alpha, ring.b + 0.1 * (ring.b - critical_b)),
                  {1e-11,
                   "100 local errors of 1e-12 over the slope d alpha/d b, which is 1/(b - b_c) > 100; and the "
                   "start's round-off"});
    }
    ClaimSheet r_o =
        sheet.claim(fmt::format("closest approach of the same, {} turn{}", ring.turns, ring.turns > 1 ? "s" : ""), "M");
    r_o.exact({ring.r_o, 1e-15}, "mpmath, 50 digits");
    const Tolerance root{1e-12, "round-off of the deflection, 1e-15, over its slope 2/(P - 3) and the roots of both"};
    r_o.ours("closed form solved for alpha = 2 pi n", static_cast<double>(closed), root);
    r_o.ours("quadrature solved for it", static_cast<double>(quadrature), root);
    ClaimSheet excess =
        sheet.claim(fmt::format("b/b_c - 1 of the same, {} turn{}", ring.turns, ring.turns > 1 ? "s" : ""));
    excess.exact({ring.excess, 1e-11 * ring.excess}, "mpmath, 12 digits");
    const Tolerance relative{1e-9 * ring.excess, "round-off of alpha up to 19 rad: 1e-14 in the logarithm, with room"};
    excess.ours("closed form solved for alpha = 2 pi n", excess_of(closed), relative);
    excess.ours("quadrature solved for it", excess_of(quadrature), relative);
  }
}

void add_abstract(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  ClaimSheet bound = sheet.claim("closest approach for a deflection of 3 pi/2", "M");
  bound.exact({3.208531727235278, 1e-15}, "mpmath, 50 digits");
  bound.printed("3.21", "abstract: \"r_o = 3.21 M\"");
  const Tolerance root{1e-13, "round-off of the deflection over its slope, 10 per M"};
  bound.ours("closed form solved for it", static_cast<double>(periapsis_by_closed_form(lab, 1.5 * pi_)), root);
  bound.ours("quadrature solved for it", static_cast<double>(periapsis_by_quadrature(1.5 * pi_)), root);
  for (const Route& route : schwarzschild_routes()) {
    const Charts at = schwarzschild_charts(lab, route.chart);
    const double b = ring_from_rays(lab, at, route.method, 1.5 * pi_, 5.23);
    bound.from_rays("rays deflected by 3 pi/2", *at.transport, route.method, static_cast<double>(periapsis_of(b)),
                    {1e-10, "100 local errors of 1e-12 over the slope d alpha/d P of 10"});
  }

  ClaimSheet image = sheet.claim("angle of the first relativistic ring of Sgr A*", "microarcsecond");
  const double first = rings[0].b * mass_over_distance / microarcsecond;
  image.exact({first, 1e-3 * first}, "b_1 M/D_d with today's constants, which differ from the paper's by 1e-3");
  image.printed("17", "abstract: \"about 17 microarcseconds\"");
  // The whole lens equation for a source behind the lens, D_ds = D_s/2: tan(theta) = (1/2) [tan(theta) +
  // tan(alpha - theta)]; alpha exceeds 2 pi by some 2 theta/(D_ds/D_s) = 3e-10.
  const Tolerance constants{0.2, "M/D_d as the paper had it is not known to better than 1e-3: 0.02, with room"};
  image.ours(
      "lens equation, closed form",
      [&] {
        const double theta = rings[0].b * mass_over_distance;
        const double alpha = 2.0 * pi_ + 2.0 * theta;
        return std::asin(impact_parameter_of(periapsis_by_closed_form(lab, alpha)) * mass_over_distance) /
               microarcsecond;
      }(),
      constants);
  image.ours("ring of one turn, quadrature",
             impact_parameter_of(periapsis_by_quadrature(2.0 * pi_)) * mass_over_distance / microarcsecond, constants);
  image.not_established("16.898 and 16.877 muas for the first two rings",
                        "the table is from memory, and implies an M/D_d 0.1 per cent smaller than today's constants; "
                        "only ratios are compared");

  ClaimSheet ratio = sheet.claim("first ring over second");
  ratio.exact({rings[0].b / rings[1].b, 3e-16}, "mpmath, 50 digits");
  const Tolerance round_off{1e-14, "round-off"};
  ratio.ours("closed form",
             impact_parameter_of(periapsis_by_closed_form(lab, 2.0 * pi_)) /
                 impact_parameter_of(periapsis_by_closed_form(lab, 4.0 * pi_)),
             round_off);
  ratio.ours(
      "quadrature",
      impact_parameter_of(periapsis_by_quadrature(2.0 * pi_)) / impact_parameter_of(periapsis_by_quadrature(4.0 * pi_)),
      round_off);
}

void draw(PaperSheet& sheet) {
  Series curve{"exact", Look::line, {}, {}};
  for (const double above : log_steps(2e-5, 5.0, 160)) {
    curve.x.push_back(3.0 + above);
    curve.y.push_back(exact::deflection_from_periapsis(1.0, 3.0 + above).value / pi_);
  }
  Series traced{"traced", Look::dots, {}, {}};
  const Charts at = schwarzschild_charts(sheet.lab(), "kerr-schild");
  for (const double above : log_steps(1e-3, 4.0, 14)) {
    const double P = 3.0 + above, b = impact_parameter_of(P);
    traced.x.push_back(P);
    traced.y.push_back(traced_deflection(there_and_back(sheet.lab(), at, b, 50.0, {"dop853", 1e-12}), b) / pi_);
  }
  Series bound{"r_o = 3.21 M, as printed", Look::printed, {3.21}, {1.5}};
  Series ladder{"rings, exact", Look::line, {}, {}};
  Series from_rays{"rings from rays", Look::dots, {}, {}};
  for (const Ring& ring : rings) {
    ladder.x.push_back(ring.turns);
    ladder.y.push_back(ring.excess);
    if (ring.turns == 3) continue;
    const double b = ring_from_rays(sheet.lab(), at, {"dop853", 1e-14}, 2.0 * pi_ * ring.turns, ring.b);
    from_rays.x.push_back(ring.turns);
    from_rays.y.push_back(b / critical_b - 1.0);
  }
  std::vector<Series> left{curve, traced, bound};
  for (const double turns : {1.0, 2.0}) left.push_back({"", Look::dotted, {3.0, 8.0}, {2.0 * turns, 2.0 * turns}});
  sheet.figure() = {
      .title = "Virbhadra & Ellis 2000: relativistic images of a Schwarzschild lens",
      .caption =
          "Left: deflection against the closest approach; dotted: one and two whole turns, where the "
          "rings are. Right: how close each ring lies to the shadow's edge.",
      .panels = {
          {.title = "Deflection", .x_label = "closest approach r_o [M]", .y_label = "deflection [pi]", .series = left},
          {.title = "Relativistic rings",
           .x_label = "turns",
           .y_label = "b/b_c - 1",
           .y_log = true,
           .series = {ladder, from_rays}}}};
}

void run(PaperSheet& sheet) {
  add_abstract(sheet);
  add_rings(sheet);
  draw(sheet);
}

}  // namespace

Paper virbhadra_ellis_2000() {
  return {.info = {.id = "virbhadra-ellis-2000",
                   .reference = "K. S. Virbhadra, G. F. R. Ellis, Schwarzschild black hole lensing, Phys. Rev. D 62, "
                                "084003 (2000)",
                   .reproduced = "Relativistic rings of a Schwarzschild lens: where light turns by 2 pi n, and the two "
                                 "numbers of the abstract.",
                   .cites = "VirbhadraEllis2000",
                   .not_checked = {"The tables of images and magnifications: known from memory only, so no oracle.",
                                   "Absolute microarcseconds beyond two digits: the paper's M/D_d was not read off the "
                                   "original.",
                                   "The text of the lens equation (sections not verified)."}},
          .run = run,
          .faults = {{newtonian_fault, "half the deflection, as Newton's light has it"}}};
}

}  // namespace xpr::papers
