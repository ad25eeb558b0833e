// Bardeen, Press & Teukolsky 1972: the characteristic radii of Kerr. [BardeenPressTeukolsky1972]
#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "metrics/kerr_exact.hpp"
#include "validation/families/kerr.hpp"
#include "validation/papers/papers.hpp"
#include "validation/papers/quadrature.hpp"
#include "validation/papers/schwarzschild_light.hpp"

namespace xpr::papers {

namespace {

namespace exact = kerr_exact;
using exact::Sense;

constexpr const char* sense_fault = "paper-bpt-senses-swapped";

/// mpmath, 15 digits; b signed as L.
struct Line {
  double a, photon[2], b[2], isco[2], polar;
};
constexpr Line lines[] = {{0.5,
                           {2.34729635533386, 3.53208888623796},
                           {4.09626665871387, -6.13815572471545},
                           {4.23300252953083, 7.55458471451236},
                           2.88321774192635},
                          {0.9,
                           {1.55785462742338, 3.91026793910304},
                           {2.84442140347617, -6.83231923044667},
                           {2.32088304176189, 8.71735227960649},
                           2.55999686936568},
                          {0.99,
                           {1.16764185185753, 3.99110286108940},
                           {2.25172433539895, -6.98332343110269},
                           {1.45449793805967, 8.97186134254697},
                           2.43098324380603}};

long double sign_of(Sense sense) { return sense == Sense::prograde ? 1.0L : -1.0L; }

/// r^(3/2) - 3 r^(1/2) + 2 s a = 0 outside the horizon.
double photon_root(double a, Sense sense) {
  return static_cast<double>(zero_of(
      [=](long double r) { return r * std::sqrt(r) - 3.0L * std::sqrt(r) + 2.0L * sign_of(sense) * a; }, 1.0L, 4.1L));
}
/// r^2 - 6 r + 8 s a sqrt r - 3 a^2 = 0.
double isco_root(double a, Sense sense) {
  return static_cast<double>(
      zero_of([=](long double r) { return r * r - 6.0L * r + 8.0L * sign_of(sense) * a * std::sqrt(r) - 3.0L * a * a; },
              sense == Sense::prograde ? 1.05L : 5.9L, 9.1L));
}
/// Energy 1 on a circular orbit.
double bound_root(double a, Sense sense) {
  return static_cast<double>(zero_of(
      [=](long double r) {
        const long double q = std::sqrt(r), s = sign_of(sense);
        const long double energy = r * q - 2.0L * q + s * a;
        return energy * energy - r * q * (r * q - 3.0L * q + 2.0L * s * a);
      },
      static_cast<long double>(photon_root(a, sense)) + 0.02L, 6.0L));
}
/// Numerator of xi: r^3 - 3 r^2 + a^2 r + a^2 = 0.
double polar_root(double a) {
  return static_cast<double>(
      zero_of([=](long double r) { return r * r * r - 3.0L * r * r + a * a * (r + 1.0L); }, 2.0L, 3.0L));
}

double critical_from_rays(const Lab& lab, const Charts& at, const MethodAt& method, Sense sense, double guess) {
  TraceSettings settings = trace_settings(method);
  settings.r_min = *at.transport->default_r_min();
  settings.r_max = 15.0;
  const double sign = static_cast<double>(sign_of(sense));
  return sign * bisect_fate(std::abs(guess) - 0.2, std::abs(guess) + 0.2, 1e-13, [&](double b) {
           const ChartState start = kerr_family::inward_light(at, 10.0, 0.5 * std::acos(-1.0), sign * b, 0.0);
           return lab.trace(*at.transport, start.state, 1, settings).status == Status::escaped;
         });
}

void add_line(PaperSheet& sheet, const Line& line) {
  const Tolerance digits{1e-13, "ten times the digits of the evaluation"};
  const double a = line.a;
  for (const int k : {0, 1}) {
    const Sense sense = k == 0 ? Sense::prograde : Sense::retrograde;
    const Sense formula_sense = sheet.lab().planted(sense_fault) == (k == 0) ? Sense::retrograde : Sense::prograde;
    const char* name = k == 0 ? "prograde" : "retrograde";
    ClaimSheet photon = sheet.claim(fmt::format("{} photon orbit, a = {} M", name, a), "M");
    photon.exact({line.photon[k], 5e-15}, "mpmath, 15 digits");
    photon.ours("the paper's formula", exact::photon_orbit_radius(1.0, a, formula_sense).value, digits);
    photon.ours("root of the circular orbit's equation", photon_root(a, sense), digits);
    ClaimSheet isco = sheet.claim(fmt::format("{} innermost stable orbit, a = {} M", name, a), "M");
    isco.exact({line.isco[k], 5e-15}, "mpmath, 15 digits");
    isco.ours("the paper's formula", exact::isco_radius(1.0, a, formula_sense).value, digits);
    isco.ours("root of the stability condition", isco_root(a, sense), digits);
    ClaimSheet b = sheet.claim(fmt::format("{} critical b, a = {} M", name, a), "M");
    b.exact({line.b[k], 5e-15}, "mpmath, 15 digits");
    const double sign = static_cast<double>(sign_of(sense));
    b.ours("s 3 sqrt(r_ph) - a", sign * 3.0 * std::sqrt(photon_root(a, sense)) - a, digits);
    b.ours("-a + 6 s cos(arccos(-s a)/3)", -a + 6.0 * sign * std::cos(std::acos(-sign * a) / 3.0), digits);
    for (const Route& route : {Route{"kerr-schild", {"dop853", 1e-13}}, Route{"boyer-lindquist", {"dopri54", 1e-13}}}) {
      if (route.chart != "kerr-schild" && (!sheet.lab().full() || a > 0.95)) continue;
      const Charts at = kerr_family::charts(sheet.lab(), a, route.chart);
      b.from_rays("fate of rays", *at.transport, route.method,
                  critical_from_rays(sheet.lab(), at, route.method, sense, line.b[k]),
                  {1e-10, "promised: critical parameters below 1e-10"});
    }
  }
  ClaimSheet polar = sheet.claim(fmt::format("polar photon orbit, a = {} M", a), "M");
  polar.exact({line.polar, 5e-15}, "mpmath, 15 digits");
  polar.ours("closed form", exact::polar_photon_orbit_radius(1.0, a).value, digits);
  polar.ours("root of xi", polar_root(a), digits);
}

void run(PaperSheet& sheet) {
  for (const Line& line : lines) add_line(sheet, line);
  for (const auto& [sense, value] :
       {std::pair{Sense::prograde, 1.73245553203368}, {Sense::retrograde, 5.65680975041804}}) {
    ClaimSheet bound = sheet.claim(
        fmt::format("{} marginally bound orbit, a = 0.9 M", sense == Sense::prograde ? "prograde" : "retrograde"), "M");
    bound.exact({value, 5e-15}, "mpmath, 15 digits");
    const Tolerance digits{1e-13, "ten times the digits of the evaluation"};
    bound.ours("the paper's formula", exact::marginally_bound_radius(1.0, 0.9, sense).value, digits);
    bound.ours("root of E = 1", bound_root(0.9, sense), digits);
  }
  std::vector<Series> all;
  const auto add = [&all](const std::string& name, Look look, const std::function<double(double)>& radius) {
    Series series{name, look, {}, {}};
    for (const double a : even_steps(0.0, 1.0, 120)) series.x.push_back(a), series.y.push_back(radius(a));
    all.push_back(std::move(series));
  };
  add("horizon", Look::dotted, [](double a) { return exact::outer_horizon(1.0, a).value; });
  add("photon orbit, prograde", Look::line,
      [](double a) { return exact::photon_orbit_radius(1.0, a, Sense::prograde).value; });
  add("photon orbit, retrograde", Look::line,
      [](double a) { return exact::photon_orbit_radius(1.0, a, Sense::retrograde).value; });
  add("marginally bound, prograde", Look::dashed,
      [](double a) { return exact::marginally_bound_radius(1.0, a, Sense::prograde).value; });
  add("marginally bound, retrograde", Look::dashed,
      [](double a) { return exact::marginally_bound_radius(1.0, a, Sense::retrograde).value; });
  add("innermost stable, prograde", Look::line,
      [](double a) { return exact::isco_radius(1.0, a, Sense::prograde).value; });
  add("innermost stable, retrograde", Look::line,
      [](double a) { return exact::isco_radius(1.0, a, Sense::retrograde).value; });
  sheet.figure() = {
      .title = "Bardeen, Press & Teukolsky 1972: radii of circular equatorial orbits",
      .caption =
          "Radii of circular orbits around a Kerr hole against its spin, as in the paper's first "
          "figure.",
      .panels = {
          {.title = "Circular equatorial orbits", .x_label = "a/M", .y_label = "r [M]", .series = std::move(all)}}};
}

}  // namespace

Paper bardeen_press_teukolsky_1972() {
  return {.info = {.id = "bardeen-press-teukolsky-1972",
                   .reference = "J. M. Bardeen, W. H. Press, S. A. Teukolsky, Rotating black holes, Astrophys. J. 178, "
                                "347 (1972)",
                   .reproduced = "Photon orbits, innermost stable and marginally bound orbits, critical impact "
                                 "parameters.",
                   .cites = "BardeenPressTeukolsky1972",
                   .not_checked = {"Energy extraction and synchrotron radiation: outside what rays can tell.",
                                   "Printed numbers: none is known from a source."}},
          .run = run,
          .faults = {{sense_fault, "prograde and retrograde exchanged"}}};
}

}  // namespace xpr::papers
