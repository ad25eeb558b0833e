#include "sample_suite.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace xpr {
namespace {

constexpr double pi = 3.141592653589793;

/// Deflection by a mass of 1 with closest approach r0, by the trapezoidal rule, enough for a picture: about 1e-9.
double sample_deflection(double r0) {
  // phi = 2 int_0^1 dw / sqrt(...) with u = (1 - w^2) / r0, which is regular at the turning point.
  constexpr int steps = 20000;
  const double impact_sq = r0 * r0 / (1.0 - 2.0 / r0);
  const auto integrand = [&](double w) {
    const double u = (1.0 - w * w) / r0;
    const double radicand = 1.0 / impact_sq - u * u * (1.0 - 2.0 * u);
    return radicand > 0.0 ? 2.0 * w / r0 / std::sqrt(radicand) : 0.0;
  };
  double sum = 0.5 * integrand(1.0);
  for (int k = 1; k < steps; ++k) sum += integrand((k + 0.0) / steps);
  return 2.0 * (sum + 0.5 * integrand(1e-6)) / steps - pi;
}

class Sampler {
 public:
  Row row(std::string label, const std::string& metric, const std::string& chart, const std::string& method,
          double reference, double tolerance) {
    Row row;
    row.label = std::move(label);
    row.metric = metric;
    row.chart = chart;
    row.method = method;
    row.setting = method.empty() ? 0.0 : 1e-12;
    row.reference = reference;
    row.reference_error = 0.01 * tolerance;
    // The spread of a real suite: errors over three decades below the tolerance.
    row.value = reference + tolerance * std::pow(10.0, uniform_(random_) - 0.1);
    row.tolerance = tolerance;
    row.tolerance_reason = "tol times the condition of the path";
    row.evaluations = 1000 + static_cast<std::int64_t>(random_() % 4000);
    judge(row);
    return row;
  }

 private:
  std::mt19937_64 random_{11};
  std::uniform_real_distribution<double> uniform_{-3.0, 0.0};
};

CaseResult deflection(Sampler& sampler) {
  CaseResult result;
  result.info = {.id = "schwarzschild/deflection",
                 .family = "schwarzschild",
                 .claim = "A ray with impact parameter b > b_c is deflected by Darwin's elliptic integral.",
                 .physics = "alpha = 4 sqrt(r0/Q) [K(k) - F(psi, k)] - pi",
                 .truth = "Darwin's closed form through GeographicLib's elliptic functions",
                 .rank = TruthRank::closed_form,
                 .grades_metric = true,
                 .cites = "Darwin1959",
                 .source = "validation/families/schwarzschild.cpp"};
  for (const char* method : {"dopri54", "dop853"}) {
    for (const double r0 : {3.0003, 3.03, 3.3, 4.0, 6.0, 12.0, 30.0, 100.0, 1000.0, 9999.0}) {
      const double b = r0 / std::sqrt(1.0 - 2.0 / r0);
      Row row = sampler.row("b = " + std::to_string(b) + " M, " + method, "schwarzschild", "kerr-schild", method,
                            sample_deflection(r0), 1e-12);
      row.parameters = {{"b/M", b, "1"}};
      row.unit = "radian";
      result.rows.push_back(std::move(row));
    }
  }
  result.seconds = 0.25;
  return result;
}

CaseResult shadow(Sampler& sampler) {
  CaseResult result;
  result.info = {.id = "kerr/shadow_edge",
                 .family = "kerr",
                 .claim = "The edge of the shadow is Bardeen's parametric curve.",
                 .physics = "alpha = -xi / sin i, beta = sqrt(eta + a^2 cos^2 i - xi^2 cot^2 i)",
                 .truth = "Bardeen's curve in closed form",
                 .rank = TruthRank::closed_form,
                 .grades_metric = true,
                 .cites = "Bardeen1973",
                 .source = "validation/families/kerr.cpp"};
  for (const double degrees : {17.0, 45.0, 60.0, 90.0}) {
    for (int k = 0; k < 12; ++k) {
      const double angle = 2.0 * pi * k / 12.0;
      const double radius = 5.1 + 0.9 * std::sin(degrees * pi / 180.0) * std::cos(angle);
      Row row = sampler.row("i = " + std::to_string(degrees) + " deg, angle " + std::to_string(k), "kerr",
                            "kerr-schild-outgoing", "dop853+full", radius, 1e-10);
      row.parameters = {{"a/M", 0.9, "1"}, {"inclination", degrees * pi / 180.0, "radian"}, {"angle", angle, "radian"}};
      row.unit = "M";
      result.rows.push_back(std::move(row));
    }
  }
  return result;
}

CaseResult critical(Sampler& sampler) {
  CaseResult result;
  result.info = {.id = "kerr/critical",
                 .family = "kerr",
                 .claim = "The critical impact parameters are those of the circular photon orbits.",
                 .physics = "b = L/E at the double root of R(r)",
                 .truth = "closed form in the spin",
                 .rank = TruthRank::closed_form,
                 .grades_metric = true,
                 .cites = "BardeenPressTeukolsky1972",
                 .source = "validation/families/kerr.cpp"};
  for (const double a : {0.0, 0.3, 0.7, 0.9, 0.998, 1.0}) {
    const double prograde_radius = 2.0 * (1.0 + std::cos(2.0 / 3.0 * std::acos(-a)));
    const double retrograde_radius = 2.0 * (1.0 + std::cos(2.0 / 3.0 * std::acos(a)));
    for (const auto& [name, value] :
         {std::pair{"prograde: b_c", 3.0 * std::sqrt(prograde_radius) - a},
          std::pair{"retrograde: b_c", -3.0 * std::sqrt(retrograde_radius) - a},
          std::pair{"prograde: r_ph", prograde_radius}, std::pair{"retrograde: r_ph", retrograde_radius}}) {
      Row row = sampler.row("a = " + std::to_string(a) + ", " + name + " by bisection on rays", "kerr", "kerr-schild",
                            "dop853", value, 1e-10);
      row.parameters = {{"a/M", a, "1"}};
      row.unit = "M";
      result.rows.push_back(std::move(row));
    }
  }
  return result;
}

CaseResult conformance(Sampler& sampler) {
  CaseResult result;
  result.info = {.id = "conformance/kerr",
                 .family = "conformance",
                 .claim = "The metric is symmetric, has the right signature and solves the vacuum equations.",
                 .physics = "Ricci normalised by Riemann",
                 .truth = "zero",
                 .rank = TruthRank::closed_form,
                 .grades_metric = true,
                 .cites = "",
                 .source = "validation/families/conformance.cpp"};
  for (const char* chart : {"kerr-schild", "boyer-lindquist"}) {
    for (const char* what : {"symmetry <g_ab>", "Ricci & Riemann | \"vacuum\"", "Killing fields"}) {
      Row row = sampler.row(std::string(what) + ", " + chart, "kerr", chart, "", 0.0, 1e-13);
      row.reference_error = 0.0;
      judge(row);
      result.rows.push_back(std::move(row));
    }
  }
  result.rows.front().value = 0.0;
  judge(result.rows.front());
  return result;
}

Sweep sample_sweep(const std::string& metric, const std::string& chart) {
  Sweep sweep;
  sweep.quantity = "deflection";
  sweep.unit = "radian";
  struct Shape {
    const char* method;
    bool adaptive;
    double order, scale, evaluations;
  };
  for (const Shape& shape : {Shape{"rk4", false, 4.0, 2e-4, 4.0}, Shape{"gl6", false, 6.0, 4e-6, 18.0},
                             Shape{"dopri54", true, 5.0, 3.0, 6.0}, Shape{"dopri54+full", true, 5.0, 2.0, 6.0},
                             Shape{"dop853", true, 8.0, 0.8, 12.0}}) {
    double previous = std::numeric_limits<double>::quiet_NaN();
    for (int k = 0; k < 6; ++k) {
      SweepPoint point;
      point.metric = metric;
      point.chart = chart;
      point.method = shape.method;
      point.adaptive = shape.adaptive;
      point.setting = shape.adaptive ? std::pow(10.0, -4.0 - 1.5 * k) : std::pow(2.0, -k);
      const double exact =
          shape.adaptive ? shape.scale * point.setting : shape.scale * std::pow(point.setting, shape.order);
      point.error_norm = exact + 3e-15;
      point.error_median = 0.6 * point.error_norm;
      point.error_p99 = 2.5 * point.error_norm;
      point.error_max = 3.0 * point.error_norm;
      point.truth_error = 2e-15;
      const bool projected = std::string(shape.method).find('+') != std::string::npos;
      point.null_drift_max = projected ? 4e-16 : 0.3 * point.error_norm;
      const double steps = shape.adaptive ? 20.0 * std::pow(point.setting, -1.0 / shape.order) : 100.0 / point.setting;
      point.steps_per_ray = steps;
      point.evaluations_per_ray = shape.evaluations * steps;
      point.seconds_per_ray = 2e-7 * point.evaluations_per_ray;
      point.rays = 64;
      const double ratio = shape.adaptive ? std::pow(10.0, 1.5) : 2.0;
      point.observed_order = std::log(previous / point.error_norm) / std::log(ratio);
      point.richardson_error = k < 2 ? std::numeric_limits<double>::quiet_NaN() : point.error_norm / 15.0;
      point.convergence = k == 0 ? "" : point.error_norm < 1e-14 ? "round-off" : "monotone";
      previous = point.error_norm;
      sweep.points.push_back(point);
    }
  }
  return sweep;
}

FaultResult caught_fault(std::string id, std::string description, std::string case_id) {
  return {std::move(id), std::move(description), std::move(case_id), "b = 6 M", 3.2e-3, 1e-12, true, true, ""};
}

}  // namespace

SuiteResult passing_suite() {
  Sampler sampler;
  SuiteResult suite;
  suite.suite = "quick";
  suite.cases = {conformance(sampler), deflection(sampler), shadow(sampler), critical(sampler)};
  suite.sweeps = {sample_sweep("kerr", "kerr-schild"), sample_sweep("schwarzschild", "kerr-schild")};
  suite.faults = {caught_fault("half-mass", "the mass is half of what it says", "schwarzschild/deflection"),
                  caught_fault("kerr-frame-dragging-sign", "g_tphi has the wrong sign", "kerr/critical")};
  return suite;
}

SuiteResult troubled_suite() {
  SuiteResult suite = passing_suite();
  std::vector<Row>& rows = suite.cases[1].rows;
  rows[3].value = rows[3].reference + 7.0 * rows[3].tolerance;
  judge(rows[3]);
  rows[4].value = std::numeric_limits<double>::quiet_NaN();
  judge(rows[4]);
  rows[5].reference_error = 0.5 * rows[5].tolerance;
  judge(rows[5]);
  Row thrown;
  thrown.label = "run";
  thrown.verdict = Verdict::error;
  thrown.note = "no such chart: <boyer & lindquist>\x01";
  rows.push_back(thrown);
  Row left_out;
  left_out.label = "b = 1e4 M in the areal chart";
  left_out.metric = "schwarzschild";
  left_out.chart = "areal";
  left_out.method = "dopri54";
  left_out.verdict = Verdict::skipped;
  left_out.note = "the chart breaks at the horizon";
  rows.push_back(left_out);
  FaultResult missed = caught_fault("sin-for-sin-squared", "sin theta where sin^2 theta belongs", "kerr/shadow_edge");
  missed.error = 1e-13;
  missed.caught = false;
  missed.note = "every ray of the case runs in the equator";
  suite.faults.push_back(missed);
  return suite;
}

ReportInputs sample_inputs(SuiteResult suite) {
  ReportInputs inputs;
  inputs.suite = std::move(suite);
  inputs.command = "xprimeray validate --suite quick";
  inputs.configuration = {{"suite", "quick"}};
  inputs.provenance = {.version = "0.1.0",
                       .commit = "0123456789ab",
                       .dirty = false,
                       .compiler = "GNU 12.2.0",
                       .build_type = "Release",
                       .flags = "-O2",
                       .isa = "x86-64-v3",
                       .hdf5 = "1.10.8",
                       .cpu = "a processor",
                       .date = "2024-06-07T12:00:00Z"};
  inputs.circumstances = {{"threads", "2"}};
  inputs.charts = {{"minkowski", "cartesian"},
                   {"schwarzschild", "kerr-schild"},
                   {"kerr", "kerr-schild"},
                   {"kerr", "boyer-lindquist"}};
  inputs.methods = {"rk4", "dopri54", "dop853", "gl6"};
  inputs.figure_tools = {};
  return inputs;
}

}  // namespace xpr
