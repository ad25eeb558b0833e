// Long runs: symplectic methods keep the energy for ever, the others lose it at the rate that their order says.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <span>

#include "metrics/chart_map.hpp"
#include "metrics/scalar/elementary.hpp"
#include "validation/bundle.hpp"
#include "validation/convergence.hpp"
#include "validation/families/numerical.hpp"
#include "validation/kit.hpp"

namespace xpr::numerical {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// A bound orbit, its period and the size of the terms that cancel in H.
struct Orbit {
  std::unique_ptr<Spacetime> chart;
  PhaseState<double> start;
  double period;
  double energy_scale;
  std::string where;
};

/// One of the fish-eye's circles, passing x = 0.8 at an angle of tan = 1/5 against the tangent: L = 0.957.
Orbit fisheye_orbit(const Lab& lab) {
  const NamedValue radius{"R", 1.0};
  const double r = 0.8, n = 2.0 / (1.0 + r * r);
  const double sine = 5.0 / std::sqrt(26.0), cosine = 1.0 / std::sqrt(26.0);
  const double L = r * n * sine;
  return {lab.spacetime("maxwell-fisheye", "cartesian", {&radius, 1}),
          {{0.0, r, 0.0, 0.0}, {-1.0, n * cosine, n * sine, 0.0}},
          2.0 * pi<double>() / (L * L * L),
          0.5 * n * n,
          "the fish-eye"};
}

/// A mass that circles a Kerr hole of spin 0.9 M between about 8 M and 12 M, off the equator: light has no stable
/// orbits there, and Hamilton's equations are the same. H = -1/2.
Orbit kerr_orbit(const Lab& lab) {
  const NamedValue spin{"a", 0.9};
  Orbit orbit{lab.spacetime("kerr", "kerr-schild", {&spin, 1}), {}, 210.0, 1.0, "Kerr"};
  const std::unique_ptr<Spacetime> classical = lab.spacetime("kerr", "boyer-lindquist", {&spin, 1});
  const Vec4<double> x = {0.0, 12.0, 0.5 * pi<double>(), 0.0};
  const SymTensor4<double> g = classical->inverse_metric(x);
  const double L = 3.2, p_theta = 1.8;
  // g^{tt} E^2 - 2 g^{t phi} E L + g^{phi phi} L^2 + g^{theta theta} p_theta^2 = -1, at an apsis.
  const double half_b = -g(0, 3) * L;
  const double c = g(3, 3) * L * L + g(2, 2) * p_theta * p_theta + 1.0;
  const double E = (-half_b - std::sqrt(half_b * half_b - g(0, 0) * c)) / g(0, 0);
  orbit.start = change_chart(*classical, *orbit.chart, {x, {-E, 0.0, p_theta, L}}).state;
  return orbit;
}

/// The mean of a quasi-periodic signal by a smooth window: its oscillations average out faster than any power of the
/// length of the window. Cites: [DasSaikiSanderYorke2017]
double smooth_mean(std::span<const double> samples) {
  double sum = 0.0, weights = 0.0;
  const double n = static_cast<double>(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double u = (static_cast<double>(i) + 0.5) / n;
    const double weight = exp(-1.0 / (u * (1.0 - u)));
    sum += weight * (samples[i] - samples[0]);
    weights += weight;
  }
  return samples[0] + sum / weights;
}

struct Drift {
  double change = 0.0;  ///< of the smooth mean of H, second half against first
  double early = 0.0;   ///< largest |H - H_0| in the first half
  double late = 0.0;    ///< and in the second
  std::int64_t evaluations = 0;
  bool converged = true;
};

struct LongRun {
  std::string_view method;
  std::int64_t steps_per_orbit;
  double tao_omega = 1.0;
};

Drift energy_drift(const Lab& lab, const Orbit& orbit, const LongRun& run, std::int64_t orbits) {
  const Flow flow = [&orbit](const PhaseState<double>& y) { return orbit.chart->flow(y); };
  StepperSettings settings;
  settings.tao_omega = run.tao_omega;
  const std::unique_ptr<Stepper> stepper = lab.stepper(run.method, flow, settings);
  const std::int64_t steps = run.steps_per_orbit * orbits;
  const double h = orbit.period / static_cast<double>(run.steps_per_orbit);
  std::vector<double> H;
  H.reserve(static_cast<std::size_t>(steps));
  Drift out;
  PhaseState<double> y = orbit.start;
  const double H0 = orbit.chart->hamiltonian(y);
  for (std::int64_t i = 0; i < steps; ++i) {
    const StepOutcome outcome = stepper->step(y, h);
    y = outcome.y;
    out.converged = out.converged && outcome.converged;
    H.push_back(orbit.chart->hamiltonian(y));
    double& largest = 2 * i < steps ? out.early : out.late;
    largest = std::max(largest, std::abs(H.back() - H0));
  }
  const std::size_t half = H.size() / 2;
  out.change = smooth_mean(std::span(H).subspan(half)) - smooth_mean(std::span(H).first(half));
  out.evaluations = stepper->evaluations();
  return out;
}

Row long_row(const Orbit& orbit, const LongRun& run, std::int64_t orbits, std::string_view what) {
  return make_row(fmt::format("{} with {} in {}", what, run.method, orbit.where), *orbit.chart,
                  {std::string(run.method), orbit.period / static_cast<double>(run.steps_per_orbit)},
                  {{"orbits", static_cast<double>(orbits), "1"},
                   {"steps per orbit", static_cast<double>(run.steps_per_orbit), "1"}});
}

/// Symplectic methods: no trend in the mean of H, and an oscillation that does not grow.
std::vector<Row> bounded_rows(const Lab& lab, const Orbit& orbit, const LongRun& run, std::int64_t orbits) {
  const Drift drift = energy_drift(lab, orbit, run, orbits);
  Row trend = long_row(orbit, run, orbits, "trend of H");
  trend.evaluations = drift.evaluations;
  trend.note = fmt::format("H oscillates by {:.2g}; its mean moved by {:.2g}{}", drift.late, std::abs(drift.change),
                           drift.converged ? "" : "; an iteration did not settle");
  const double steps = static_cast<double>(run.steps_per_orbit * orbits);
  grade_bound(trend, drift.change,
              {4.0 * epsilon * orbit.energy_scale * std::sqrt(steps),
               fmt::format("no trend above round-off's random walk: 4 eps of the terms of H ({:.2g}) a step, over the "
                           "root of {:g} steps",
                           orbit.energy_scale, steps)});
  Row bounded = long_row(orbit, run, orbits, "oscillation of H, late over early,");
  bounded.evaluations = drift.evaluations;
  grade(bounded, drift.late / drift.early, {1.0, 0.0},
        {0.1, "both halves of the run sample the same oscillation at many phases"});
  return {trend, bounded};
}

/// Methods that are not symplectic: H drifts in proportion to time, as h to the power p + 1 for even p, p for odd p.
Row drifting_row(const Lab& lab, const Orbit& orbit, const LongRun& run, std::int64_t orbits) {
  const MethodCard& card = method_card(run.method);
  LongRun halved = run;
  halved.steps_per_orbit *= 2;
  const Drift coarse = energy_drift(lab, orbit, run, orbits);
  const Drift fine = energy_drift(lab, orbit, halved, orbits);
  Row row = long_row(orbit, run, orbits, "order of the drift of H");
  row.evaluations = coarse.evaluations + fine.evaluations;
  row.note = fmt::format("the mean of H moved by {:.2g}, with half the step by {:.2g}", coarse.change, fine.change);
  const double order = card.order + (card.order % 2 == 0 ? 1.0 : 0.0);
  grade(row, order_between(2.0, std::abs(coarse.change), 1.0, std::abs(fine.change)), {order, 0.0},
        {0.25, "the next term of the drift's series makes up to 19 % at these steps (2^0.25 = 1.19)"});
  return row;
}

// Tao's omega must bind the two copies of phase space against the flow's own spreading, here near 1, for ever.
constexpr LongRun bounded_fisheye[] = {{"verlet", 128}, {"implicit-midpoint", 128}, {"gl4", 64},
                                       {"gl6", 64},     {"tao2", 512, 8.0},         {"tao4", 512, 8.0}};
constexpr LongRun bounded_kerr[] = {{"implicit-midpoint", 128}, {"gl4", 64}, {"gl6", 64}, {"tao2", 256}, {"tao4", 512}};
constexpr LongRun drifting_fisheye[] = {{"euler", 16384}, {"midpoint", 512}, {"heun2", 512}, {"rk4", 128},
                                        {"rkf45", 256},   {"dopri54", 256},  {"dop853", 48}};

std::vector<Row> all_bounded(const Lab& lab, const Orbit& orbit, std::span<const LongRun> runs, std::int64_t orbits) {
  std::vector<Row> rows;
  for (const LongRun& run : runs) {
    for (Row& row : bounded_rows(lab, orbit, run, orbits)) rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<Row> fisheye_rows(const Lab& lab) {
  const Orbit orbit = fisheye_orbit(lab);
  std::vector<Row> rows = all_bounded(lab, orbit, bounded_fisheye, lab.full() ? 10000 : 500);
  for (const LongRun& run : drifting_fisheye) {
    rows.push_back(drifting_row(lab, orbit, run, run.method == "euler" ? 4 : lab.full() ? 200 : 40));
  }
  return rows;
}

std::vector<Row> kerr_rows(const Lab& lab) {
  return all_bounded(lab, kerr_orbit(lab), bounded_kerr, lab.full() ? 3000 : 100);
}

}  // namespace

std::vector<Case> long_run_cases() {
  return {
      {.info = info("long-run-fisheye",
                    "over ten thousand closed orbits (500 in the quick suite) symplectic methods keep H with no trend "
                    "above round-off, and the others drift at their order",
                    "H after every step, averaged with a smooth window over the first and the second half of the run, "
                    "so that its oscillation drops out and the trend remains. On reversible closed orbits the drift of "
                    "a method of order p goes as h^(p+1) for even p, h^p for odd p.",
                    "H = 0 is kept by the exact flow", TruthRank::closed_form,
                    "HairerLubichWanner2006 DasSaikiSanderYorke2017 Maxwell1854", "numerical_long_run.cpp"),
       .run = fisheye_rows},
      {.info = info("long-run-kerr",
                    "where H does not separate, implicit and doubled symplectic methods keep it over thousands of "
                    "orbits about a Kerr hole (100 in the quick suite)",
                    "The same, for a mass on an inclined eccentric orbit between about 8 M and 12 M: light has no "
                    "stable bound orbits there, and the integrators do not know H = 0 from H = -1/2.",
                    "H = -1/2 is kept by the exact flow", TruthRank::closed_form,
                    "HairerLubichWanner2006 Tao2016 DasSaikiSanderYorke2017", "numerical_long_run.cpp"),
       .run = kerr_rows},
  };
}

}  // namespace xpr::numerical
