// Kerr light whose shape is known in closed form off the equator: spherical orbits, principal null rays, and camera
// rays that end on the past horizon.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/ray_angles.hpp"
#include "metrics/kerr_exact.hpp"
#include "metrics/scalar/elementary.hpp"
#include "validation/families/kerr.hpp"
#include "validation/truth/enclosure.hpp"

namespace xpr::kerr_family {

namespace {

namespace exact = kerr_exact;
using exact::RayConstants;
using exact::SphericalOrbit;

constexpr double round_off = std::numeric_limits<double>::epsilon();
constexpr double equator = std::numbers::pi / 2.0;
constexpr const char* source_file = "validation/families/kerr_orbits.cpp";

constexpr const char* frame_fault = "kerr-azimuth-without-frame";
constexpr const char* spinless_fault = "kerr-principal-null-spinless";
constexpr const char* ingoing_fault = "kerr-past-horizon-in-ingoing-chart";

// --- Spherical photon orbits ---

struct Orbit {
  double spin;
  double r;
  std::string_view what;
};

std::vector<Orbit> spherical_orbits(const Lab& lab) {
  std::vector<Orbit> orbits = {{1.0, 1.0 + std::numbers::sqrt2, "over the poles"},
                               {1.0, 3.0, "Teo's xi = -2"},
                               {0.9, exact::polar_photon_orbit_radius(mass, 0.9).value, "over the poles"},
                               {0.5, 3.2, "retrograde"}};
  if (lab.full()) {
    orbits.insert(orbits.end(), {{1.0, 1.0 + std::numbers::sqrt3, "Teo's xi = -1"},
                                 {1.0, 1.0 + 2.0 * std::numbers::sqrt2, "Teo's xi = -6"},
                                 {1.0, 2.0, "Teo's xi = 1"},
                                 {1.0, 1.0316, "Teo's xi = 1.999"},
                                 {0.9, 1.6, "near the prograde equatorial one"},
                                 {0.9, 2.5, "prograde"},
                                 {0.9, 3.9, "near the retrograde equatorial one"},
                                 {0.5, exact::polar_photon_orbit_radius(mass, 0.5).value, "over the poles"}});
  }
  return orbits;
}

/// Passages of the equator: southward (-1), northward (+1), or both (0).
std::array<Event, 1> equator_passage(int direction) {
  return {{{.name = "equator",
            .g = [](const Spacetime&, const PhaseState<double>& y, int) { return y[3]; },
            .direction = direction,
            .terminal = direction != 0}}};
}

/// On the orbit at the equator, going north.
ChartState on_orbit(const Charts& at, const Orbit& orbit, const SphericalOrbit& truth) {
  const PhaseState<double> y({0.0, orbit.r, equator, 0.0}, {-1.0, 0.0, -std::sqrt(truth.eta.value), truth.xi.value});
  return change_chart(*at.classical, *at.transport, y);
}

/// The radii at the first `n` passages of the equator; fewer where the ray has left.
std::vector<double> radii_at_equator(const Lab& lab, const Charts& at, const ChartState& start, const Orbit& orbit,
                                     const SphericalOrbit& truth, int n, const TraceSettings& settings, RayEnd& end) {
  TraceSettings limited = settings;
  // d(lambda) = Sigma d(tau) <= (r^2 + a^2) d(tau), half a period of tau for each passage.
  limited.lambda_max = 1.001 * (square(orbit.r) + square(orbit.spin)) * 0.5 * n * truth.mino_period.value;
  limited.r_max = 20.0 * mass;
  limited.r_min = *at.transport->default_r_min();
  end = lab.trace(*at.transport, start.state, 1, limited, equator_passage(0));
  std::vector<double> radii;
  for (const EventHit& hit : end.hits) {
    if (hit.lambda < 1e-3 * mass) continue;  // the start itself, which a projection moves by round-off
    if (radii.size() < static_cast<std::size_t>(n)) radii.push_back(hit.chart->radius(hit.y.x()));
  }
  return radii;
}

/// epsilon_0 of the claim: what one half orbit's steps put onto the unstable mode, summed over all later ones; the
/// start's own rounding counts as one step.
double seed_deviation(const Orbit& orbit, const MethodAt& method, double steps_per_half_orbit, double gamma) {
  const double local = (method.setting + round_off) * (mass + orbit.r);
  return (steps_per_half_orbit + 1.0) * local / (1.0 - std::exp(-gamma));
}

/// Constants and one oscillation, proven.
SphericalOrbit orbit_truth(const Orbit& orbit) {
  const enclosure::SphericalOrbit truth = enclosure::kerr_spherical_orbit(mass, orbit.spin, orbit.r);
  return {.xi = proven(truth.xi),
          .eta = proven(truth.eta),
          .cos_squared_least = proven(truth.cos_squared_least),
          .minus_u_minus = proven(truth.minus_u_minus),
          .mino_period = proven(truth.mino_period),
          .azimuth = proven(truth.azimuth),
          .time = proven(truth.time),
          .lyapunov_half_orbit = proven(truth.lyapunov_half_orbit)};
}

void append_hold(const Lab& lab, const Charts& at, const Orbit& orbit, const MethodAt& method, std::vector<Row>& rows) {
  const SphericalOrbit truth = orbit_truth(orbit);
  const double gamma = truth.lyapunov_half_orbit.value;
  constexpr int longest = 8;
  RayEnd end;
  const std::vector<double> radii =
      radii_at_equator(lab, at, on_orbit(at, orbit, truth), orbit, truth, longest, trace_settings(method, mass), end);
  const double epsilon = seed_deviation(orbit, method, static_cast<double>(end.steps) / longest, gamma);
  for (const int n : {1, 4, longest}) {
    const double bound = epsilon * std::exp(gamma * n);
    if (bound > 1e-2 * mass) continue;  // beyond the linear regime there is nothing to hold
    Row row = make_row(fmt::format("a = {}, r = {:.6g} M ({}), radius after {} half orbits, {} {:g}", orbit.spin,
                                   orbit.r, orbit.what, n, method_label(method), method.setting),
                       *at.transport, method,
                       {{"a/M", orbit.spin, "1"}, {"r", orbit.r, "M"}, {"half orbits", static_cast<double>(n), "1"}});
    row.unit = "M";
    row.evaluations = end.evaluations;
    if (radii.size() < static_cast<std::size_t>(n)) {
      row.note = fmt::format("ended as '{}' after {} half orbits", to_string(end.status), radii.size());
    } else {
      grade(row, radii[static_cast<std::size_t>(n) - 1], {orbit.r, 0.0},
            {bound, fmt::format("epsilon_0 e^(gamma n) with gamma = {:.4f} and epsilon_0 = {:.1e} M from the steps of "
                                "half an orbit, each within tol",
                                gamma, epsilon)});
    }
    rows.push_back(std::move(row));
  }
}

/// One full oscillation in latitude, as its two halves: the start lies on the equator to round-off only.
struct Oscillation {
  RayEnd end;  ///< of the second half, with the steps and evaluations of both
  double azimuth = 0.0;
  double time = 0.0;
};

Oscillation oscillate(const Lab& lab, const Charts& at, const Orbit& orbit, const SphericalOrbit& truth,
                      const MethodAt& method) {
  TraceSettings settings = trace_settings(method, mass);
  settings.grade_time = true;
  settings.lambda_max = (square(orbit.r) + square(orbit.spin)) * truth.mino_period.value;
  Oscillation whole;
  ChartState from = on_orbit(at, orbit, truth);
  std::int64_t steps = 0, evaluations = 0;
  for (const int direction : {-1, 1}) {
    const SweptRay half = trace_swept(lab, *at.classical, *at.transport, from, settings, equator_passage(direction));
    whole.azimuth += half.azimuth();
    whole.time += half.end_classical[0] - half.start_classical[0];
    steps += half.end.steps;
    evaluations += half.end.evaluations;
    whole.end = half.end;
    if (half.end.status != Status::crossed) break;
    from = {half.end.y, half.end.sheet};
  }
  whole.end.steps = steps;
  whole.end.evaluations = evaluations;
  return whole;
}

void append_turn(const Lab& lab, const Charts& at, const Orbit& orbit, const MethodAt& method, std::vector<Row>& rows) {
  const SphericalOrbit truth = orbit_truth(orbit);
  const Oscillation whole = oscillate(lab, at, orbit, truth, method);
  const bool polar = std::abs(truth.xi.value) < 1e-12;
  // A deviation in r grows by e^{2 gamma} meanwhile, and goes into phi and t with what is left of the orbit.
  const double growth = std::exp(2.0 * truth.lyapunov_half_orbit.value);
  const auto row_of = [&](std::string_view quantity, std::string unit) {
    Row row = make_row(fmt::format("a = {}, r = {:.6g} M ({}), {} in a full oscillation, {} {:g}", orbit.spin, orbit.r,
                                   orbit.what, quantity, method_label(method), method.setting),
                       *at.transport, method, {{"a/M", orbit.spin, "1"}, {"r", orbit.r, "M"}});
    row.unit = std::move(unit);
    return row;
  };
  Row azimuth = row_of("Delta phi", "rad");
  if (polar) azimuth.note = "L_z is below round-off: compared modulo 2 pi";
  if (ended_as(azimuth, whole.end, Status::crossed)) {
    double wanted = truth.azimuth.value;
    if (lab.planted(frame_fault)) wanted += orbit.spin * truth.mino_period.value;
    double swept = whole.azimuth;
    if (polar) swept = wanted + std::remainder(swept - wanted, 2.0 * std::numbers::pi);
    grade(azimuth, swept, {wanted, truth.azimuth.error},
          accumulated(whole.end, method.setting, growth * (1.0 + std::abs(wanted))));
  }
  rows.push_back(std::move(azimuth));
  Row time = row_of("Delta t", "M");
  if (ended_as(time, whole.end, Status::crossed)) {
    grade(time, whole.time, {truth.time.value, truth.time.error},
          accumulated(whole.end, method.setting, growth * (1.0 + truth.time.value)));
  }
  rows.push_back(std::move(time));
}

void append_growth(const Lab& lab, const Charts& at, const Orbit& orbit, std::vector<Row>& rows) {
  const SphericalOrbit truth = orbit_truth(orbit);
  const MethodAt method{"dop853", 1e-14};
  const double gamma = truth.lyapunov_half_orbit.value;
  constexpr double delta = 1e-4 * mass;
  Row row = make_row(fmt::format("a = {}, r = {:.6g} M ({}), gamma from rays {:g} M beside it", orbit.spin, orbit.r,
                                 orbit.what, delta),
                     *at.transport, method, {{"a/M", orbit.spin, "1"}, {"r", orbit.r, "M"}});
  const auto leaving = [&](double displacement) {
    RayEnd end;
    const ChartState start = general_light(*at.classical, *at.transport, orbit.r + displacement, equator,
                                           truth.xi.value, -std::sqrt(truth.eta.value), displacement < 0.0);
    const std::vector<double> radii =
        radii_at_equator(lab, at, start, orbit, truth, 1, trace_settings(method, mass), end);
    row.evaluations += end.evaluations;
    return radii.empty() ? std::numeric_limits<double>::quiet_NaN() : radii.front();
  };
  // The mean over both sides is free of the second order.
  const double grown = (leaving(delta) - leaving(-delta)) / (2.0 * delta);
  const double scale = std::min(orbit.r, 2.0 * (orbit.r - mass));
  const double third_order = square(delta / scale * std::exp(gamma));
  // The rays leave with p_r^2 = R/Delta^2, R ~ delta^2 being the rest of terms of order r^4 that cancel.
  const double cancelled = 100.0 * round_off * square(orbit.r / delta);
  grade(row, std::log(grown), {gamma, truth.lyapunov_half_orbit.error},
        {third_order + cancelled + 100.0 * method.setting * std::exp(gamma) / delta,
         fmt::format("third order in the displacement, {:.1e}; cancellation in R at the start, {:.1e}; a hundred steps "
                     "of tol on the displacement",
                     third_order, cancelled)});
  rows.push_back(std::move(row));
}

std::vector<Row> spherical_rows(const Lab& lab) {
  std::vector<Row> rows;
  const std::vector<MethodAt> methods = lab.full() ? std::vector<MethodAt>{{"dop853", 1e-14},
                                                                           {"dop853", 1e-10},
                                                                           {"dopri54", 1e-12},
                                                                           {"odeint:rkf78", 1e-12},
                                                                           {"dop853", 1e-12, Projection::full}}
                                                   : std::vector<MethodAt>{{"dop853", 1e-14}, {"dopri54", 1e-11}};
  for (const Orbit& orbit : spherical_orbits(lab)) {
    const Charts at = charts(lab, orbit.spin, "kerr-schild");
    for (const MethodAt& method : methods) {
      append_hold(lab, at, orbit, method, rows);
      append_turn(lab, at, orbit, method, rows);
    }
    append_growth(lab, at, orbit, rows);
  }
  return rows;
}

// --- Principal null rays ---

void append_principal(const Lab& lab, double spin, std::string_view transport, double theta, bool inward,
                      const MethodAt& method, std::vector<Row>& rows) {
  const Charts at = charts(lab, spin, transport);
  const double L = exact::principal_null_constants(spin, theta).angular_momentum;
  TraceSettings settings = trace_settings(method, mass);
  settings.grade_time = true;
  (inward ? settings.r_min : settings.r_max) = inward ? 3.0 : 100.0;
  const ChartState start = general_light(*at.classical, *at.transport, inward ? 100.0 : 3.0, theta, L, 0.0, inward);
  const SweptRay ray = trace_swept(lab, *at.classical, *at.transport, start, settings);
  const double r1 = ray.start_classical[1], r2 = ray.end_classical[1];
  const auto append = [&](std::string_view quantity, std::string unit, double value, const ExactValue& truth,
                          double condition) {
    Row row =
        make_row(fmt::format("a = {}, theta = {:.6g}, {}, {}: {}, {} {:g}", spin, theta, inward ? "inward" : "outward",
                             transport, quantity, method_label(method), method.setting),
                 *at.transport, method, {{"a/M", spin, "1"}, {"theta", theta, "rad"}});
    row.unit = std::move(unit);
    if (ended_as(row, ray.end, inward ? Status::captured : Status::escaped)) {
      grade(row, value, {truth.value, truth.error}, accumulated(ray.end, method.setting, condition));
    }
    rows.push_back(std::move(row));
  };
  ExactValue time = exact::principal_null_time(mass, spin, r1, r2);
  if (lab.planted(spinless_fault)) time = exact::principal_null_time(mass, 0.0, r1, r2);
  append("Delta t", "M", std::abs(ray.end_classical[0] - ray.start_classical[0]), time, 2.0 * 100.0);
  const double across = 2.0 / std::sin(theta);  // an error across the ray turns phi by 1/sin theta of it
  append("Delta phi", "rad", std::abs(ray.azimuth()), exact::principal_null_angle(mass, spin, r1, r2), across * 10.0);
  append("theta stays", "rad", ray.end_classical[2], {theta, 0.0}, 10.0);
  append("affine length", "M", ray.end.lambda, {std::abs(r1 - r2), 0.0}, 2.0 * 100.0);
}

std::vector<Row> principal_rows(const Lab& lab) {
  std::vector<Row> rows;
  const std::vector<MethodAt> methods =
      lab.full() ? std::vector<MethodAt>{{"dop853", 1e-14}, {"dopri54", 1e-11}, {"rkf45", 1e-9}}
                 : std::vector<MethodAt>{{"dop853", 1e-13}};
  const std::vector<double> angles =
      lab.full() ? std::vector<double>{1e-3, 0.3, 1.0, equator, 2.5} : std::vector<double>{1e-3, 1.0};
  const std::vector<double> some_spins =
      lab.full() ? std::vector<double>{0.3, 0.9, 1.0} : std::vector<double>{0.9, 1.0};
  for (const double spin : some_spins) {
    for (const double theta : angles) {
      for (const MethodAt& method : methods) {
        append_principal(lab, spin, "kerr-schild", theta, false, method, rows);
        append_principal(lab, spin, "kerr-schild-outgoing", theta, true, method, rows);
        append_principal(lab, spin, "boyer-lindquist", theta, true, method, rows);
      }
    }
  }
  return rows;
}

// --- Camera rays down to the past horizon ---

/// Errors of x and p are bounded by tol (M + |x|) and tol each, with |x| <= 10 M: what E, L and angles make of them.
constexpr double ray_condition = 30.0;

struct Plunge {
  double spin;
  double b;
  double theta;
  double p_theta;
};

std::vector<Plunge> plunges(const Lab& lab) {
  std::vector<Plunge> list;
  const std::vector<double> spins =
      lab.full() ? std::vector<double>{0.0, 0.5, 0.9, 0.998} : std::vector<double>{0.0, 0.9, 0.998};
  for (const double spin : spins) {
    const double prograde = exact::critical_impact_parameter(mass, spin, exact::Sense::prograde).value;
    const double retrograde = exact::critical_impact_parameter(mass, spin, exact::Sense::retrograde).value;
    list.insert(list.end(), {{spin, 0.0, equator, 0.0},
                             {spin, 0.6 * prograde, equator, 0.0},
                             {spin, 0.9 * retrograde, equator, 0.0},
                             {spin, 0.8, 0.7, 1.5},
                             {spin, 0.0, 0.4, -1.0}});
  }
  return list;
}

/// |p| in the outgoing chart. The congruence l of that chart has l.p = -K/(P + sqrt R) on these rays (E = 1, P = r^2 +
/// a^2 - a L, K = Q + (L - a)^2), and H = 0 is |p|^2 = E^2 + (2 M r/Sigma) (l.p)^2.
double momentum_in_closed_form(double spin, const RayConstants<double>& ray, double r, double cos_theta) {
  const double P = square(r) + square(spin) - spin * ray.angular_momentum;
  const double K = ray.carter + square(ray.angular_momentum - spin);
  const double R = exact::radial_potential(mass, spin, ray, r);
  const double sigma = square(r) + square(spin * cos_theta);
  return std::sqrt(1.0 + 2.0 * mass * r / sigma * square(K / (P + std::sqrt(std::max(R, 0.0)))));
}

double momentum_norm(const PhaseState<double>& y) { return std::hypot(y[5], y[6], y[7]); }

/// A camera ray and where it ended.
struct Plunged {
  RayEnd end;
  PhaseState<double> start_classical;
  PhaseState<double> end_classical;
  double largest_momentum = 0.0;
};

Plunged follow(const Lab& lab, const Charts& at, const Plunge& plunge, const MethodAt& method, double r_min) {
  const Charts camera = charts(lab, plunge.spin, "kerr-schild-outgoing");
  const ChartState outgoing = inward_light(camera, 10.0 * mass, plunge.theta, plunge.b, plunge.p_theta);
  const ChartState start = change_chart(*camera.transport, *at.transport, outgoing.state);
  TraceSettings settings = trace_settings(method, mass);
  settings.r_min = r_min;
  settings.r_max = 20.0 * mass;
  Plunged ray;
  ray.start_classical = change_chart(*at.transport, *at.classical, start.state).state;
  ray.largest_momentum = momentum_norm(start.state);
  const RayAngles angles(*at.classical, *at.transport, ray.start_classical, start);
  ray.end = lab.trace(*at.transport, start.state, 1, settings, {}, [&](const StepView& step) {
    ray.largest_momentum = std::max(ray.largest_momentum, momentum_norm(step.end));
  });
  ray.end_classical = angles.continued(ray.end, change_chart(*at.transport, *at.classical, ray.end.y).state);
  return ray;
}

void append_plunge(const Lab& lab, const Plunge& plunge, const MethodAt& method, std::vector<Row>& rows) {
  const Charts at = charts(lab, plunge.spin, lab.planted(ingoing_fault) ? "kerr-schild" : "kerr-schild-outgoing");
  const double horizon = *at.transport->horizon_radius();
  const Plunged ray = follow(lab, at, plunge, method, horizon * (1.0 + 1e-6));
  const double b = impact_parameter(*at.classical, ray.start_classical);
  const RayConstants<double> constants{
      1.0, b, exact::carter_constant(plunge.spin, 1.0, b, plunge.p_theta, square(std::cos(plunge.theta)))};
  const auto append = [&](std::string_view quantity, std::string unit, double value, const Truth& truth,
                          const Tolerance& tolerance) {
    Row row = make_row(
        fmt::format("a = {}, L = {:.4g} M, theta = {:.4g}, p_theta = {:g} M: {}, {} {:g}", plunge.spin, plunge.b,
                    plunge.theta, plunge.p_theta, quantity, method_label(method), method.setting),
        *at.transport, method, {{"a/M", plunge.spin, "1"}, {"L", plunge.b, "M"}, {"theta", plunge.theta, "rad"}});
    row.unit = std::move(unit);
    if (ended_as(row, ray.end, Status::captured)) grade(row, value, truth, tolerance);
    rows.push_back(std::move(row));
  };
  const Tolerance carried = accumulated(ray.end, method.setting, ray_condition);
  const double r = at.transport->radius(ray.end.y.x());
  append("r where it ends", "M", r, {horizon * (1.0 + 1e-6), round_off},
         method.projection == Projection::none
             ? Tolerance{16.0 * round_off * mass, "the stop is met to round-off: a few units in the last place of r"}
             : Tolerance{method.setting * mass, "the stop is met to round-off, and projected by up to tol after that"});
  const double p_end = momentum_in_closed_form(plunge.spin, constants, r, ray.end.y[3] / r);
  append("|p| at the end", "1", momentum_norm(ray.end.y), {p_end, 4.0 * round_off * p_end},
         {carried.value * square(p_end), carried.reason + ", and |p|^2"});
  // P grows and 2 M r/Sigma <= 2 M/r falls with r, so that the bound is the one at the horizon.
  const double P = 2.0 * mass * horizon - plunge.spin * b;
  const double K = constants.carter + square(b - plunge.spin);
  const double bound = std::sqrt(1.0 + 2.0 * mass / horizon * square(K / P));
  append("largest |p| above its bound", "1", std::max(0.0, ray.largest_momentum - bound), {0.0, 0.0},
         {1e-9 * bound,
          "|p|^2 = 1 + (2 M r/Sigma) [K/(P + sqrt R)]^2 <= 1 + (2 M/r+) (K/P+)^2 on the whole ray; 1e-9 "
          "for the ray's own error"});
  append("L_z at the end", "M", impact_parameter(*at.transport, ray.end.y), {b, 4.0 * round_off * (1.0 + std::abs(b))},
         carried);
  append("Q at the end", "M2", *at.transport->carter_constant(ray.end.y),
         {constants.carter, 8.0 * round_off * (1.0 + std::abs(constants.carter))},
         {carried.value * (1.0 + 2.0 * std::sqrt(K)), carried.reason + ", and 1 + 2 sqrt K"});
  if (plunge.p_theta != 0.0) return;
  // phi of Boyer-Lindquist diverges as a/(r+ - r-) ln(r - r+), and r - r+ is known to round-off of r.
  const double spread = horizon - (2.0 * mass - horizon);
  const double logarithm = std::abs(plunge.spin) / spread * 16.0 * round_off / 1e-6;
  const ExactValue swept =
      exact::equatorial_swept_angle(mass, plunge.spin, b, ray.start_classical[1], ray.end_classical[1], false);
  append("Delta phi, future-directed", "rad", ray.start_classical[3] - ray.end_classical[3], {swept.value, swept.error},
         {carried.value * (1.0 + std::abs(swept.value)) + logarithm,
          fmt::format("{}; and {:.1e} for a/(r+ - r-) ln(r - r+) at 1e-6 r+ from the horizon", carried.reason,
                      logarithm)});
}

std::vector<Row> horizon_rows(const Lab& lab) {
  std::vector<Row> rows;
  const std::vector<MethodAt> methods =
      lab.full() ? std::vector<MethodAt>{{"dop853", 1e-14}, {"dopri54", 1e-11}, {"dop853", 1e-12, Projection::full}}
                 : std::vector<MethodAt>{{"dop853", 1e-13}};
  for (const Plunge& plunge : plunges(lab)) {
    for (const MethodAt& method : methods) append_plunge(lab, plunge, method, rows);
  }
  return rows;
}

}  // namespace

std::vector<Case> orbit_cases() {
  return {
      {info("spherical-orbits", "Light with Teo's constants stays on its sphere as long as its instability allows.",
            "xi = -(r^3 - 3 M r^2 + a^2 r + a^2 M)/[a (r - M)], eta = -r^3 (r^3 - 6 M r^2 + 9 M^2 r - 4 a^2 M)/[a^2 "
            "(r - M)^2], E = 1, from the equator. |delta r| stays below epsilon_0 e^{gamma n} after n half orbits; "
            "Delta phi and Delta t of a full oscillation in latitude; gamma itself from rays that leave the sphere.",
            "complete elliptic integrals, gamma = (4 r sqrt chi/(a sqrt(-u-))) K(u+/u-)", TruthRank::closed_form,
            "Teo2003 Johnson2020 GrallaLupsasca2020Lensing", source_file),
       true, spherical_rows},
      {info("principal-null", "Light with L = a sin^2 theta, Q = -a^2 cos^4 theta keeps theta, with r affine.",
            "dt/dr = +-(r^2 + a^2)/Delta, dphi/dr = +-a/Delta, dr/dlambda = +-1 between 3 M and 100 M.", "logarithms",
            TruthRank::closed_form, "Kerr1963 Carter1968", source_file),
       true, principal_rows},
      {info("backward-horizon", "Camera rays reach r+ (1 + 1e-6) backward in time with bounded momentum.",
            "Past-directed rays from 10 M in the outgoing chart, whose congruence l has l.p = -K/(P + sqrt R) on them: "
            "|p|^2 = 1 + (2 M r/Sigma) [K/(P + sqrt R)]^2 <= 1 + (2 M/r+) (K/P+)^2 with P = r^2 + a^2 - a L, K = Q + "
            "(L - a)^2, E = 1. L_z and Q at the end; Delta phi of the equatorial ones.",
            "the first integrals, and quadrature for Delta phi", TruthRank::closed_form, "Carter1968 Kerr1963",
            source_file),
       true, horizon_rows},
  };
}

std::vector<Fault> orbit_faults() {
  return {{.id = frame_fault,
           .description = "dphi/dtau of a spherical orbit without its term -a",
           .case_id = "kerr/spherical-orbits"},
          {.id = spinless_fault,
           .description = "Schwarzschild's ln(r - 2 M) for the time of a principal null ray",
           .case_id = "kerr/principal-null"},
          {.id = ingoing_fault,
           .description = "camera rays traced back in the ingoing chart, which is singular where they end",
           .case_id = "kerr/backward-horizon"}};
}

}  // namespace xpr::kerr_family
