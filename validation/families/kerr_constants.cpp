// What light in Kerr keeps: E, L_z and Carter's Q along seeded rays; and one ray in every chart.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "metrics/kerr_exact.hpp"
#include "metrics/scalar/elementary.hpp"
#include "validation/bundle.hpp"
#include "validation/families/kerr.hpp"

namespace xpr::kerr_family {

namespace {

namespace exact = kerr_exact;
using exact::RayConstants;

constexpr double round_off = std::numeric_limits<double>::epsilon();
constexpr std::uint64_t seed = 20260807;
constexpr const char* source_file = "validation/families/kerr_constants.cpp";

constexpr const char* carter_fault = "kerr-carter-sign";
constexpr const char* mino_fault = "kerr-mino-for-affine";

// --- Constants of motion ---

/// Where rays of a bundle begin, and how far they go.
struct Region {
  std::string_view name;
  double r_low, r_high;
  double theta_low, theta_high;
  double greatest_L, greatest_p_theta;
  double r_min;  ///< over the horizon's radius
};

constexpr std::array regions = {
    Region{"off the equator", 6.0, 20.0, 0.4, 2.7, 6.0, 6.0, 1.005},
    Region{"near the axis", 6.0, 20.0, 4e-4, 2e-3, 1e-3, 5.0, 1.005},
    Region{"near the horizon", 1.2, 2.5, 0.4, 2.7, 1.5, 1.5, 1.0 + 1e-6},
};

struct Start {
  ChartState state;
  RayConstants<double> constants;
};

/// A light ray of the region: seeded numbers, drawn again where no light has them.
Start draw(const Charts& at, double spin, const Region& region, SeededNumbers& numbers) {
  for (;;) {
    const double r = numbers.uniform(region.r_low, region.r_high);
    const double theta = numbers.uniform(region.theta_low, region.theta_high);
    const double L = numbers.uniform(-region.greatest_L, region.greatest_L);
    const double p_theta = numbers.uniform(-region.greatest_p_theta, region.greatest_p_theta);
    if (r <= 1.1 * *at.transport->horizon_radius()) continue;
    // Not from 1 - cos^2 theta, which has lost half its digits near the axis.
    const double Q = square(p_theta) + square(std::cos(theta)) * (square(L / std::sin(theta)) - square(spin));
    const RayConstants<double> ray{1.0, L, Q};
    // Well above zero, so that p_r has all its digits.
    if (exact::radial_potential(mass, spin, ray, r) < 0.01 * square(square(r))) continue;
    return {general_light(*at.classical, *at.transport, r, theta, L, p_theta), ray};
  }
}

/// The largest drift of each constant over a bundle, over 1 + its size.
struct Drift {
  double energy = 0.0, angular_momentum = 0.0, carter = 0.0, null_residual = 0.0;
  double carter_scale = 1.0;  ///< largest 2 sqrt(K) + 1 of the bundle
  std::int64_t steps = 0;     ///< of the longest ray
  std::int64_t evaluations = 0;
  std::optional<Status> unexpected;
};

Drift drift_of(const Lab& lab, const Charts& at, double spin, const Region& region, const MethodAt& method, int rays) {
  SeededNumbers numbers(seed);
  TraceSettings settings = trace_settings(method, mass);
  settings.r_max = 25.0 * mass;
  settings.r_min = region.r_min * *at.transport->horizon_radius();
  Drift drift;
  for (int i = 0; i < rays; ++i) {
    const Start start = draw(at, spin, region, numbers);
    const RayEnd end = lab.trace(*at.transport, start.state.state, 1, settings);
    if (end.status != Status::escaped && end.status != Status::captured) drift.unexpected = end.status;
    const RayConstants<double>& ray = start.constants;
    double Q = ray.carter;
    if (lab.planted(carter_fault)) {
      // Q = p_theta^2 + cos^2 theta (L^2/sin^2 theta + a^2 E^2).
      const PhaseState<double> y = change_chart(*at.transport, *at.classical, start.state.state).state;
      Q += 2.0 * square(spin * std::cos(y[2]));
    }
    drift.energy = std::max(drift.energy, std::abs(killing_constant(*at.transport, end.y, "E") - 1.0));
    drift.angular_momentum = std::max(drift.angular_momentum,
                                      std::abs(killing_constant(*at.transport, end.y, "L_z") - ray.angular_momentum));
    drift.carter = std::max(drift.carter, std::abs(*at.transport->carter_constant(end.y) - Q));
    drift.null_residual = std::max(drift.null_residual, end.null_residual_max);
    drift.carter_scale =
        std::max(drift.carter_scale, 1.0 + 2.0 * std::sqrt(ray.carter + square(ray.angular_momentum - spin)));
    drift.steps = std::max(drift.steps, end.steps);
    drift.evaluations += end.evaluations;
  }
  return drift;
}

/// What E, L_z and Q may drift by.
struct DriftTolerance {
  Tolerance energy, angular_momentum, carter;
};

/// x and p are off by tol (M + |x|) and tol after a step; L = x p_y - y p_x by as much as (M + 2 r) tol, r <= 25 M.
constexpr double lever = 60.0;

DriftTolerance adaptive_tolerance(const Drift& drift, const MethodAt& method) {
  const auto steps = static_cast<double>(drift.steps);
  const double local = lever * (method.setting + round_off) * steps;
  const std::string reason =
      fmt::format("{} steps of tol = {:g} and round-off, with a lever of {:g} M", drift.steps, method.setting, lever);
  return {{4.0 * round_off * steps, "p_t is constant term by term: round-off of the start and of every step"},
          {local, reason},
          {local * drift.carter_scale, fmt::format("{}, and 1 + 2 sqrt K = {:.3g}", reason, drift.carter_scale)}};
}

DriftTolerance gauss_tolerance(const Drift& drift, const Drift& twice_the_step) {
  const double rounding = lever * round_off * static_cast<double>(drift.steps) * drift.carter_scale;
  return {{4.0 * round_off * static_cast<double>(drift.steps), "linear in p: kept to round-off"},
          {rounding, "quadratic, which Gauss methods keep: round-off of every step"},
          {twice_the_step.carter / 16.0 + rounding,
           fmt::format("order 6: a 64th of the {:.1e} at twice the step, and a factor 4 for the largest step not being "
                       "small; round-off of every step",
                       twice_the_step.carter)}};
}

void append_drift(const Lab& lab, double spin, const Region& region, const MethodAt& method, std::vector<Row>& rows) {
  const Charts at = charts(lab, spin, "kerr-schild");
  const int rays = lab.full() ? 24 : 6;
  const bool gauss = method.method == "gl6";
  const Drift drift = drift_of(lab, at, spin, region, method, rays);
  const DriftTolerance tolerance =
      gauss ? gauss_tolerance(drift, drift_of(lab, at, spin, region, {method.method, 2.0 * method.setting}, rays))
            : adaptive_tolerance(drift, method);
  const auto append = [&](std::string_view quantity, std::string unit, double value, const Tolerance& bound) {
    Row row = make_row(
        fmt::format("a = {}, {}: {}, {} {:g}", spin, region.name, quantity, method_label(method), method.setting),
        *at.transport, method, {{"a/M", spin, "1"}, {"rays", static_cast<double>(rays), "1"}});
    row.unit = std::move(unit);
    row.evaluations = drift.evaluations;
    if (drift.unexpected) {
      row.note = fmt::format("a ray ended as '{}'", to_string(*drift.unexpected));
    } else {
      grade_bound(row, value, bound);
    }
    rows.push_back(std::move(row));
  };
  append("E", "1", drift.energy, tolerance.energy);
  append("L_z", "M", drift.angular_momentum, tolerance.angular_momentum);
  append("Q", "M2", drift.carter, tolerance.carter);
  if (method.projection == Projection::full) {
    append("null residual", "1", drift.null_residual, {1e-14, "promised: at or below 1e-14 with projection"});
  }
}

std::vector<Row> constants_rows(const Lab& lab) {
  std::vector<Row> rows;
  std::vector<MethodAt> methods = {
      {"dop853", 1e-12}, {"gl6", 0.025}, {"dopri54", 1e-10, Projection::full}, {"dopri54", 1e-9}};
  if (lab.full()) methods.insert(methods.end(), {{"dop853", 1e-14}, {"gl6", 0.0125}, {"odeint:rkf78", 1e-12}});
  const std::vector<double> spins =
      lab.full() ? std::vector<double>{0.0, 0.5, 0.9, 1.0} : std::vector<double>{0.9, 1.0};
  for (const double spin : spins) {
    for (const Region& region : regions) {
      for (const MethodAt& method : methods) {
        // Past an extremal horizon rays turn on the scale r - M, which no one step of lambda fits.
        if (spin == mass && method.method == "gl6") continue;
        append_drift(lab, spin, region, method, rows);
      }
    }
  }
  return rows;
}

// --- One ray in every chart ---

/// A whole ray computed elsewhere at 33 digits: a = 0.6, E = 1, L = 2, p_theta = 6 from r = 50, theta = 1, t = phi = 0
/// inward, to its return to r = 50; every digit that is known.
struct KnownRay {
  static constexpr double spin = 0.6, L = 2.0, p_theta = 6.0, r = 50.0, theta = 1.0;
  static constexpr double carter = 37.5440381403280533;
  static constexpr double end_theta = 1.2812911704019574, end_phi = 3.58737316228051762;
  static constexpr double end_time = 118.228672106212655, affine = 102.455218678658406, mino = 0.627716918138907188;
};

void append_known_ray(const Lab& lab, std::string_view transport, const MethodAt& method, std::vector<Row>& rows) {
  using Known = KnownRay;
  const Charts at = charts(lab, Known::spin, transport);
  TraceSettings settings = trace_settings(method, mass);
  settings.grade_time = true;
  settings.r_max = Known::r;
  const ChartState start =
      general_light(*at.classical, *at.transport, Known::r, Known::theta, Known::L, Known::p_theta);
  const SweptRay ray = trace_swept(lab, *at.classical, *at.transport, start, settings);
  // A Schwarzschild ray with b^2 = Q + L^2 stands in for the conditioning of this one, which passes near the poles.
  const double b = std::sqrt(Known::carter + square(Known::L));
  const double condition = deflection_condition(0.0, b);
  const auto append = [&](std::string_view quantity, std::string unit, double value, double truth, double digits,
                          double amplified) {
    Row row = make_row(fmt::format("{}: {}, {} {:g}", transport, quantity, method_label(method), method.setting),
                       *at.transport, method, {{"a/M", Known::spin, "1"}, {"L", Known::L, "M"}});
    row.unit = std::move(unit);
    if (ended_as(row, ray.end, Status::escaped)) {
      grade(row, value, {truth, digits}, accumulated(ray.end, method.setting, amplified));
    }
    rows.push_back(std::move(row));
  };
  const PhaseState<double>& end = ray.end_classical;
  append("theta", "rad", end[2], Known::end_theta, 3e-16, condition);
  append("phi", "rad", ray.azimuth(), Known::end_phi, 5e-16, condition / std::sin(Known::theta));
  append("t", "M", end[0], Known::end_time, 2e-14, condition * b + 2.0 * Known::r);
  append("affine length", "M", ray.end.lambda, lab.planted(mino_fault) ? Known::mino : Known::affine, 2e-14,
         condition * b + 2.0 * Known::r);
  append("Q", "M2", *at.transport->carter_constant(ray.end.y), Known::carter, 2e-14, 2.0 * b * Known::r);
}

/// The same ray in two charts: seeded rays, one of them over the pole and one that passes it within 1e-6 M.
struct SharedRay {
  std::string_view name;
  double theta, L, p_theta;
};

constexpr std::array shared_rays = {SharedRay{"inclined", 1.1, 4.0, 7.0}, SharedRay{"retrograde", 2.0, -5.0, 7.0},
                                    SharedRay{"over the pole", 0.9, 0.0, 8.0},
                                    SharedRay{"past the pole within 1e-6", 1.3, 1e-6, -8.0}};

void append_shared_ray(const Lab& lab, double spin, const SharedRay& shared, std::vector<Row>& rows) {
  const MethodAt method{"dop853", 1e-13};
  const auto follow = [&](std::string_view transport) {
    const Charts at = charts(lab, spin, transport);
    TraceSettings settings = trace_settings(method, mass);
    settings.grade_time = true;
    settings.r_max = 40.0 * mass;
    const ChartState start =
        general_light(*at.classical, *at.transport, 30.0 * mass, shared.theta, shared.L, shared.p_theta);
    return trace_swept(lab, *at.classical, *at.transport, start, settings);
  };
  const SweptRay reference = follow("kerr-schild");
  const double b = std::hypot(shared.p_theta, shared.L / std::sin(shared.theta));
  // The retrograde equatorial ray of that b, the worst of all with it.
  const double condition = deflection_condition(spin, -b) / std::sin(reference.end_classical[2]);
  for (const std::string_view transport : {"kerr-schild-outgoing", "boyer-lindquist"}) {
    // The polar chart has no way over its own axis.
    if (transport == "boyer-lindquist" && std::abs(shared.L) < 1.0) continue;
    const SweptRay ray = follow(transport);
    const Charts at = charts(lab, spin, transport);
    const auto append = [&](std::string_view quantity, std::string unit, double value, double wanted,
                            double amplified) {
      Row row = make_row(fmt::format("a = {}, {}, {}: {} as in kerr-schild", spin, shared.name, transport, quantity),
                         *at.transport, method, {{"a/M", spin, "1"}, {"L", shared.L, "M"}});
      row.unit = std::move(unit);
      if (ended_as(row, ray.end, Status::escaped) && ended_as(row, reference.end, Status::escaped)) {
        const Tolerance one = accumulated(ray.end, method.setting, amplified);
        const Tolerance other = accumulated(reference.end, method.setting, amplified);
        grade(row, value, {wanted, 0.0}, {one.value + other.value, "both rays: " + one.reason});
      }
      rows.push_back(std::move(row));
    };
    const PhaseState<double>&end = ray.end_classical, &known = reference.end_classical;
    // Over the pole phi is known modulo 2 pi only.
    const double phi = known[3] + std::remainder(end[3] - known[3], 2.0 * std::numbers::pi);
    append("theta", "rad", end[2], known[2], condition);
    append("phi", "rad", phi, known[3], condition);
    append("t", "M", end[0], known[0], condition * b + 70.0);
  }
}

std::vector<Row> chart_rows(const Lab& lab) {
  std::vector<Row> rows;
  const std::vector<MethodAt> methods = lab.full() ? std::vector<MethodAt>{{"dop853", 1e-14},
                                                                           {"dop853", 1e-9},
                                                                           {"dopri54", 1e-12},
                                                                           {"dop853", 1e-12, Projection::full},
                                                                           {"odeint:rkf78", 1e-12}}
                                                   : std::vector<MethodAt>{{"dop853", 1e-13}, {"dopri54", 1e-11}};
  for (const std::string_view transport : {"kerr-schild", "kerr-schild-outgoing", "boyer-lindquist"}) {
    for (const MethodAt& method : methods) append_known_ray(lab, transport, method, rows);
  }
  const std::vector<double> spins =
      lab.full() ? std::vector<double>{0.0, 0.5, 0.9, 1.0} : std::vector<double>{0.9, 1.0};
  for (const double spin : spins) {
    for (const SharedRay& shared : shared_rays) append_shared_ray(lab, spin, shared, rows);
  }
  return rows;
}

}  // namespace

std::vector<Case> constant_cases() {
  return {
      {info("constants", "E, L_z and Carter's Q stay what they were along every ray.",
            fmt::format("Q = p_theta^2 + cos^2 theta (L_z^2/sin^2 theta - a^2 E^2) at the start in Boyer-Lindquist; at "
                        "the end from the Killing tensor in Kerr-Schild components. Rays off the equator, near the "
                        "axis, and from near the horizon down to r+ (1 + 1e-6); SplitMix64 with seed {}.",
                        seed),
            "the constants at the start", TruthRank::closed_form, "Carter1968", source_file),
       true, constants_rows},
      {info("charts", "One ray ends at the same event in every chart, and where an independent computation has it.",
            "a = 0.6, L = 2 M, p_theta = 6 M from r = 50 M, theta = 1 and back to r = 50 M: theta, phi, t, the affine "
            "length and Q; other rays, over the pole too, in pairs of charts.",
            "closed form and Hamiltonian integration at 33 digits, computed apart from this project's code",
            TruthRank::high_precision, "GrallaLupsasca2020Geodesics DexterAgol2009", source_file),
       true, chart_rows},
  };
}

std::vector<Fault> constant_faults() {
  return {{.id = carter_fault, .description = "+ a^2 E^2 for - a^2 E^2 in Carter's Q", .case_id = "kerr/constants"},
          {.id = mino_fault,
           .description = "Mino time, d(lambda)/Sigma, taken for the affine parameter",
           .case_id = "kerr/charts"}};
}

}  // namespace xpr::kerr_family
