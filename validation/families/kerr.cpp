// Light in Kerr's equatorial plane against its closed forms, and what the parts of this family share.
#include "validation/families/kerr.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <vector>

#include "metrics/kerr_exact.hpp"
#include "metrics/scalar/elementary.hpp"
#include "validation/families.hpp"
#include "validation/truth/enclosure.hpp"

namespace xpr {

namespace kerr_family {

namespace exact = kerr_exact;
using exact::Sense;

Charts charts(const Lab& lab, double spin, std::string_view transport) {
  const std::array<NamedValue, 2> values{{{"M", mass}, {"a", spin}}};
  return charts(lab, "kerr", "boyer-lindquist", transport, values);
}

ChartState inward_light(const Charts& at, double r, double theta, double L, double p_theta) {
  const bool backward = at.transport->card().chart == "kerr-schild-outgoing";
  ChartState start = general_light(*at.classical, *at.transport, r, theta, L, p_theta, !backward);
  if (backward) start.state = reversed(start.state);
  return start;
}

double deflection_condition(double spin, double b) {
  const Sense sense = b > 0.0 ? Sense::prograde : Sense::retrograde;
  const double h = 1e-3 * std::abs(b - exact::critical_impact_parameter(mass, spin, sense).value);
  const double slope =
      (exact::equatorial_deflection(mass, spin, b + h).value - exact::equatorial_deflection(mass, spin, b - h).value) /
      (2.0 * h);
  return 1.0 + std::abs(b * slope);
}

CaseInfo info(std::string_view name, std::string claim, std::string physics, std::string truth, TruthRank rank,
              std::string cites, std::string source) {
  return {.id = fmt::format("kerr/{}", name),
          .family = "kerr",
          .claim = std::move(claim),
          .physics = std::move(physics),
          .truth = std::move(truth),
          .rank = rank,
          .grades_metric = true,
          .cites = std::move(cites),
          .source = std::move(source)};
}

namespace {

constexpr double far = std::numeric_limits<double>::infinity();
constexpr double equator = std::numbers::pi / 2.0;
constexpr const char* source_file = "validation/families/kerr.cpp";

constexpr std::array spins = {0.0, 0.3, 0.7, 0.9, 0.998, 1.0};
constexpr std::array senses = {Sense::prograde, Sense::retrograde};

constexpr const char* swapped_fault = "kerr-senses-swapped";
constexpr const char* delta_sign_fault = "kerr-xi-delta-sign";
constexpr const char* transcription_fault = "kerr-iyer-hansen-plus";

std::string_view name(Sense sense) { return sense == Sense::prograde ? "prograde" : "retrograde"; }
double sign(Sense sense) { return sense == Sense::prograde ? 1.0 : -1.0; }
Sense opposite(Sense sense) { return sense == Sense::prograde ? Sense::retrograde : Sense::prograde; }

// --- Photon orbits and critical impact parameters ---

/// Equatorial light that moves tangentially at r: p_r = 0, E = 1, L from g^{phi phi} L^2 - 2 g^{t phi} L + g^{tt} = 0.
PhaseState<double> tangential(const Spacetime& classical, double r, Sense sense) {
  const Vec4<double> x = {0.0, r, equator, 0.0};
  const SymTensor4<double> g = classical.inverse_metric(x);
  const double root = std::sqrt(square(g(0, 3)) - g(3, 3) * g(0, 0));
  // Each in the form that does not cancel; the prograde one is regular at the static limit, where g^{phi phi} = 0.
  const double L = sense == Sense::prograde ? -g(0, 0) / (root - g(0, 3)) : (g(0, 3) - root) / g(3, 3);
  return {x, {-1.0, 0.0, 0.0, L}};
}

/// Where tangential light stays: the radial force on it changes sign. `low` where it falls in, 4.5 M where it leaves.
double orbit_from_flow(const Spacetime& classical, double low, Sense sense) {
  return bisect_fate(low, 4.5 * mass, 0.0,
                     [&](double r) { return classical.flow(tangential(classical, r, sense))[5] > 0.0; });
}

/// Inside every prograde orbit of the spins here, or outside the static limit, where retrograde light needs to be.
double tangential_floor(const Spacetime& classical, Sense sense) {
  return sense == Sense::prograde ? *classical.default_r_min() : 2.5 * mass;
}

double orbit_from_rays(const Lab& lab, const Charts& at, Sense sense, const MethodAt& method, Row& row) {
  TraceSettings settings = trace_settings(method, mass);
  settings.r_max = 10.0 * mass;
  return bisect_fate(tangential_floor(*at.classical, sense), 4.5 * mass, 1e-13 * mass, [&](double r) {
    const ChartState start = change_chart(*at.classical, *at.transport, tangential(*at.classical, r, sense));
    settings.r_min = std::min(*at.classical->default_r_min(), r);
    const RayEnd end = lab.trace(*at.transport, start.state, 1, settings);
    row.evaluations += end.evaluations;
    return end.status == Status::escaped;
  });
}

/// The least |b| that comes back rather than reach r_min.
double critical_from_rays(const Lab& lab, const Charts& at, Sense sense, const MethodAt& method, double r_min,
                          Row& row) {
  TraceSettings settings = trace_settings(method, mass);
  settings.r_min = r_min;
  settings.r_max = 15.0 * mass;
  const double least = bisect_fate(1.5 * mass, 8.0 * mass, 1e-13 * mass, [&](double b) {
    const ChartState start = inward_light(at, 10.0 * mass, equator, sign(sense) * b, 0.0);
    const RayEnd end = lab.trace(*at.transport, start.state, 1, settings);
    row.evaluations += end.evaluations;
    return end.status == Status::escaped;
  });
  return sign(sense) * least;
}

Truth orbit_truth(const Lab& lab, double spin, Sense sense) {
  const enclosure::CriticalParameters critical = enclosure::kerr_critical_parameters(mass, spin);
  const Sense wanted = lab.planted(swapped_fault) ? opposite(sense) : sense;
  const ExactValue r = proven(wanted == Sense::prograde ? critical.prograde_radius : critical.retrograde_radius);
  return {r.value, r.error};
}

Truth critical_truth(const Lab& lab, double spin, Sense sense) {
  const Sense wanted = lab.planted(swapped_fault) ? opposite(sense) : sense;
  const enclosure::CriticalParameters critical = enclosure::kerr_critical_parameters(mass, spin);
  const ExactValue b = proven(wanted == Sense::prograde ? critical.prograde_b : critical.retrograde_b);
  if (!lab.planted(delta_sign_fault) || spin == 0.0) return {b.value, b.error};
  // xi = [(r^2 + a^2) - 2 r Delta/(r - M)]/a with r^2 - 2 M r - a^2 for Delta.
  const double r = exact::photon_orbit_radius(mass, spin, sense).value;
  const double delta = r * (r - 2.0 * mass) - square(spin);
  return {((square(r) + square(spin)) - 2.0 * r * delta / (r - mass)) / spin, 1e-14};
}

const Tolerance promised_critical{1e-10, "promised: critical parameters below 1e-10"};

/// At a = M the prograde orbit lies on the horizon: tangential light at r > M has b = r + M and always leaves, a ray
/// turns at r = b - M after some M/(r - M) radians, and no ray shows b_c = 2 M itself. What can be measured: the b that
/// just reaches r = M + gap, less the gap; and that the force points outward down to where doubles still tell its sign.
void append_extremal_prograde(const Lab& lab, const Charts& at, std::vector<Row>& rows) {
  constexpr double floor = mass + 1e-6;
  Row flow = make_row("a = 1, prograde: r_ph from the flow of the metric", *at.classical, {}, {{"a/M", 1.0, "1"}});
  flow.unit = "M";
  flow.note = "the orbit is on the horizon; light that moves tangentially at M + 1e-6 M still leaves";
  const Truth r_ph = orbit_truth(lab, 1.0, Sense::prograde);
  grade(flow, orbit_from_flow(*at.classical, floor, Sense::prograde), r_ph,
        {2e-6, "twice the distance from the horizon at which the search begins"});
  rows.push_back(std::move(flow));
  for (const double gap : {1e-1, 1e-2}) {
    const MethodAt method{"dop853", 1e-14};
    Row row = make_row(fmt::format("a = 1, prograde: b of the ray that turns at M + {:g} M, less {:g} M", gap, gap),
                       *at.transport, method, {{"a/M", 1.0, "1"}, {"gap", gap, "M"}});
    row.unit = "M";
    row.note = "the orbit is on the horizon, reached after infinitely many turns: measured outside it";
    const double b = critical_from_rays(lab, at, Sense::prograde, method, mass + gap, row);
    grade(row, b - gap, critical_truth(lab, 1.0, Sense::prograde), promised_critical);
    rows.push_back(std::move(row));
  }
}

std::vector<Row> critical_rows(const Lab& lab) {
  std::vector<Row> rows;
  const std::vector<MethodAt> methods = lab.full() ? std::vector<MethodAt>{{"dop853", 1e-14}, {"dopri54", 1e-13}}
                                                   : std::vector<MethodAt>{{"dop853", 1e-14}};
  for (const double spin : spins) {
    const Charts at = charts(lab, spin, "kerr-schild");
    for (const Sense sense : senses) {
      if (spin == mass && sense == Sense::prograde) {
        append_extremal_prograde(lab, at, rows);
        continue;
      }
      const std::string which = fmt::format("a = {}, {}", spin, name(sense));
      Row flow = make_row(which + ": r_ph from the flow of the metric", *at.classical, {}, {{"a/M", spin, "1"}});
      flow.unit = "M";
      grade(flow, orbit_from_flow(*at.classical, tangential_floor(*at.classical, sense), sense),
            orbit_truth(lab, spin, sense), promised_critical);
      rows.push_back(std::move(flow));
      for (const MethodAt& method : methods) {
        Row orbit =
            make_row(fmt::format("{}: r_ph by bisection on rays, {} {:g}", which, method_label(method), method.setting),
                     *at.transport, method, {{"a/M", spin, "1"}});
        orbit.unit = "M";
        const double r_ph = orbit_from_rays(lab, at, sense, method, orbit);
        grade(orbit, r_ph, orbit_truth(lab, spin, sense), promised_critical);
        rows.push_back(std::move(orbit));
        Row row =
            make_row(fmt::format("{}: b_c by bisection on rays, {} {:g}", which, method_label(method), method.setting),
                     *at.transport, method, {{"a/M", spin, "1"}});
        row.unit = "M";
        const double b = critical_from_rays(lab, at, sense, method, *at.transport->default_r_min(), row);
        grade(row, b, critical_truth(lab, spin, sense), promised_critical);
        rows.push_back(std::move(row));
      }
    }
  }
  return rows;
}

// --- Deflection ---

/// Iyer and Hansen's formula as one public transcription has it: + (a/b)^2/2 for - in Omega_-. 0 < |a| < M.
double deflection_with_wrong_sign(double spin, double impact_parameter) {
  const double s = impact_parameter > 0.0 ? 1.0 : -1.0;
  const double b = std::abs(impact_parameter), w = s * spin / b, w0 = square(spin);
  const double r0 =
      2.0 * b / std::sqrt(3.0) * std::sqrt(1.0 - w * w) *
      std::cos(std::acos(-3.0 * std::sqrt(3.0) * square(1.0 - w) / (b * std::pow(1.0 - w * w, 1.5))) / 3.0);
  const double h = 1.0 / r0, hs = (1.0 + w) / (1.0 - w), R = std::sqrt(1.0 - w0);
  const double S = std::sqrt((1.0 - 2.0 * h / hs) * (1.0 + 6.0 * h / hs));
  const double k = std::sqrt((S + 6.0 * h / hs - 1.0) / (2.0 * S));
  const double psi = std::asin(std::sqrt((1.0 - 2.0 * h / hs - S) / (1.0 - 6.0 * h / hs - S)));
  const auto term = [&](double sense, double omega_sign, double w_sign) {
    const double outer = 1.0 + sense * R;
    const double omega =
        omega_sign * (outer * (1.0 - w) + w_sign * w0 / 2.0) / (R * (outer - w0 * hs / 4.0 * (1.0 - 2.0 * h / hs - S)));
    const double n = (1.0 - 6.0 * h / hs - S) / (1.0 - 2.0 * h / hs - S - 4.0 / (w0 * hs) * outer);
    return omega * (std::comp_ellint_3(k, n) - std::ellint_3(k, n, psi));
  };
  return -std::numbers::pi + 4.0 / (1.0 - w) / std::sqrt(hs * S) * (term(1.0, 1.0, -1.0) + term(-1.0, -1.0, +1.0));
}

Truth deflection_truth(const Lab& lab, double spin, double b) {
  // Where the horizons meet, the proven quadrature gives up next to the prograde orbit; the closed form does not.
  const bool extremal = std::abs(spin) == mass;
  const ExactValue truth =
      extremal ? exact::equatorial_deflection(mass, spin, b) : proven(enclosure::kerr_deflection(mass, spin, b));
  const bool wrong = lab.planted(transcription_fault) && spin > 0.0 && spin < mass;
  return {wrong ? deflection_with_wrong_sign(spin, b) : truth.value, truth.error};
}

/// The angle swept between the ray's own ends, the closed-form tails beyond them, less pi.
double deflection_of(const SweptRay& ray, double spin, double b) {
  const auto tail = [&](double r) {
    return std::abs(exact::equatorial_swept_angle(mass, spin, b, r, far, false).value);
  };
  return std::abs(ray.azimuth()) + tail(ray.start_classical[1]) + tail(ray.end_classical[1]) - std::numbers::pi;
}

std::vector<MethodAt> deflection_methods(const Lab& lab) {
  if (!lab.full()) return {{"dop853", 1e-9}, {"dop853", 1e-15}, {"dopri54", 1e-10}};
  return {{"dop853", 1e-8},
          {"dop853", 1e-11},
          {"dop853", 1e-15},
          {"dopri54", 1e-7},
          {"dopri54", 1e-10},
          {"dopri54", 1e-13},
          {"rkf45", 1e-9},
          {"odeint:dopri5", 1e-10},
          {"odeint:rkf78", 1e-12},
          {"dop853", 1e-11, Projection::full},
          {"dopri54", 1e-9, Projection::energy}};
}

/// Whether round-off alone is more than `tol` allows, so that a million steps are not enough. A ray past an extremal
/// hole turns at a gap b - 2 M from it, with p_r = M/gap and steps as long as the gap. In Boyer-Lindquist dp_r/dlambda
/// is a difference of terms (M/gap)^2, of whose round-off half a unit stays; in Kerr-Schild p_r itself has round-off,
/// which the fifth-order method meets because its steps are shortest.
bool below_round_off(const Charts& at, double spin, double b, const MethodAt& method) {
  if (spin != mass || b < 0.0) return false;
  const double one_unit = std::numeric_limits<double>::epsilon() * mass / (b - 2.0 * mass);
  if (at.transport->card().chart == "boyer-lindquist") return method.setting < 0.5 * one_unit;
  return method.method == "dopri54" && method.setting < one_unit;
}

void append_deflection(const Lab& lab, const Charts& at, double spin, double b, double ratio, std::vector<Row>& rows) {
  const double condition = deflection_condition(spin, b);
  const double r0 = std::max(50.0, 2.0 * std::abs(b));
  for (const MethodAt& method : deflection_methods(lab)) {
    // Fehlberg's 7(8) estimates its error from k1 + k11 - k12 - k13, of which two stand at the start and two at the end
    // of the step: nothing in a pure quadrature, which a nearly straight ray is. Its tol says nothing there.
    if (method.method == "odeint:rkf78" && ratio > 10.0) continue;
    const std::string label = fmt::format("a = {}, b = {:.7g} M ({} b_c), {}, {} {:g}", spin, b, ratio,
                                          at.transport->card().chart, method_label(method), method.setting);
    if (below_round_off(at, spin, b, method)) {
      rows.push_back(
          skipped_row(label, "so near to the extremal horizon round-off exceeds this tol in this chart", "rad"));
      continue;
    }
    Row row = make_row(label, *at.transport, method, {{"a/M", spin, "1"}, {"b", b, "M"}, {"b/b_c", ratio, "1"}});
    row.unit = "rad";
    TraceSettings settings = trace_settings(method, mass);
    settings.r_max = r0;
    const SweptRay ray =
        trace_swept(lab, *at.classical, *at.transport, inward_light(at, r0, equator, b, 0.0), settings);
    if (ended_as(row, ray.end, Status::escaped)) {
      const double stored_b = impact_parameter(*at.classical, ray.start_classical);
      const Truth truth = deflection_truth(lab, spin, stored_b);
      grade(row, deflection_of(ray, spin, stored_b), truth,
            deflection_tolerance(ray.end, method, ratio, condition, truth.value));
    }
    rows.push_back(std::move(row));
  }
}

std::vector<Row> deflection_rows(const Lab& lab) {
  std::vector<Row> rows;
  const std::vector<double> some_spins =
      lab.full() ? std::vector<double>(spins.begin(), spins.end()) : std::vector<double>{0.0, 0.9, 1.0};
  const std::vector<double> ratios =
      lab.full() ? std::vector<double>{1.0001, 1.01, 1.1, 1.5, 4.0, 100.0} : std::vector<double>{1.001, 1.1, 4.0};
  for (const std::string_view transport : {"kerr-schild", "kerr-schild-outgoing", "boyer-lindquist"}) {
    for (const double spin : some_spins) {
      const Charts at = charts(lab, spin, transport);
      for (const Sense sense : senses) {
        const double critical = exact::critical_impact_parameter(mass, spin, sense).value;
        for (const double nominal : ratios) {
          // Past an extremal hole a prograde ray turns at r = b - M, after M/(sqrt3 (b - 2 M)) radians and more: at b =
          // 1.001 b_c it is as near to critical as the others are at 1.0001 b_c, and winds 46 times.
          const double ratio = spin == mass && sense == Sense::prograde ? std::max(nominal, 1.001) : nominal;
          append_deflection(lab, at, spin, ratio * critical, ratio, rows);
        }
      }
    }
  }
  return rows;
}

}  // namespace
}  // namespace kerr_family

std::vector<Case> kerr_cases() {
  using namespace kerr_family;
  std::vector<Case> list = {
      {info("critical", "Equatorial light circles the hole at Bardeen's radii, and falls in below the critical b.",
            "r_ph = 2 M {1 + cos[(2/3) arccos(-+a/M)]}, b_c = +-3 sqrt(M r_ph) - a. r_ph from the metric: where the "
            "radial force on tangential light changes sign; from rays: bisection on whether light that starts "
            "tangentially falls or leaves; b_c by bisection on the fate of rays from 10 M. At a = M, prograde, the "
            "orbit is on the horizon: the b that turns at M + gap is M + r = 2 M + gap.",
            "the closed forms in ball arithmetic, their error proven, a/M in {0, 0.3, 0.7, 0.9, 0.998, 1}",
            TruthRank::closed_form, "BardeenPressTeukolsky1972", source_file),
       true, critical_rows},
      {info("deflection", "Equatorial light is deflected by Iyer and Hansen's elliptic integrals, on either side.",
            "alpha = |Delta phi| - pi. Rays are traced from r0 = max(50 M, 2 |b|) and back to r0, forward in time or, "
            "in the outgoing chart, backward; the angles beyond both ends are added in closed form, at the radii where "
            "the ray really is.",
            "elliptic integrals of the third kind at the stored b = L/E in ball arithmetic, their error proven; at a = "
            "M "
            "Gauss-Legendre quadrature",
            TruthRank::closed_form, "IyerHansen2009", source_file),
       true, deflection_rows},
  };
  for (std::vector<Case>& part : std::array{orbit_cases(), shadow_cases(), constant_cases()}) {
    std::move(part.begin(), part.end(), std::back_inserter(list));
  }
  return list;
}

std::vector<Fault> kerr_faults() {
  using namespace kerr_family;
  std::vector<Fault> list = {
      {.id = swapped_fault,
       .description = "the prograde photon orbit taken for the retrograde one (the upper sign of +- for the lower)",
       .case_id = "kerr/critical"},
      {.id = delta_sign_fault,
       .description = "Delta = r^2 - 2 M r - a^2 in xi of the photon orbit",
       .case_id = "kerr/critical"},
      {.id = transcription_fault,
       .description = "+ (a/b)^2/2 for - (a/b)^2/2 in Iyer and Hansen's Omega_-, as one public transcription has it",
       .case_id = "kerr/deflection"}};
  for (std::vector<Fault>& part : std::array{orbit_faults(), shadow_faults(), constant_faults()}) {
    std::move(part.begin(), part.end(), std::back_inserter(list));
  }
  return list;
}

}  // namespace xpr
