// Tolerances: adaptive methods err in proportion to what they are told, and their estimates are honest.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "validation/bundle.hpp"
#include "validation/convergence.hpp"
#include "validation/families/numerical.hpp"
#include "validation/kit.hpp"

namespace xpr::numerical {

namespace {

/// One tolerance over a bundle.
struct Measured {
  double error = 0.0;       ///< root mean square over rays and components
  double null_drift = 0.0;  ///< root mean square of the largest null residuals
  std::int64_t evaluations = 0;
  std::int64_t steps = 0;  ///< the most that any ray took
};

Measured measure(const Lab& lab, const Bundle& bundle, const MethodAt& method) {
  Measured out;
  std::vector<PhaseState<double>> ends;
  std::vector<double> drifts;
  for (std::size_t i = 0; i < bundle.starts.size(); ++i) {
    TraceSettings settings = trace_settings(method, bundle.length_unit);
    settings.lambda_max = bundle.spans[i];
    const RayEnd end = lab.trace(*bundle.chart, bundle.starts[i], 1, settings);
    ends.push_back(end.y);
    drifts.push_back(end.null_residual_max);
    out.evaluations += end.evaluations;
    out.steps = std::max(out.steps, end.steps);
  }
  out.error = distance(spatial_components(ends), spatial_components(bundle.ends));
  out.null_drift = root_mean_square(drifts);
  return out;
}

constexpr double decades = 6.0;  // from 1e-5, where steps are short enough, to 1e-11, above round-off

Tolerance slope_tolerance(int order) {
  return {
      1.0 / order + 0.30 / decades,
      fmt::format("where the leading error term is small the next one shows, h^(p+1): slope up to 1 + 1/{}; and the "
                  "error constant may change by 2 over {:g} decades as the steps fall differently",
                  order, decades)};
}

/// Proportionality alone would pass a method that errs a million tolerances.
Row error_row(const Bundle& bundle, const MethodCard& card, double tol, double error, std::int64_t steps) {
  Row row = make_row(fmt::format("error at the tightest tolerance, {}", card.id), *bundle.chart,
                     {std::string(card.id), tol}, {{"rays", static_cast<double>(bundle.starts.size()), "1"}});
  row.note = fmt::format("{:.2g} tolerances", error / tol);
  const double size = root_mean_square(spatial_components(bundle.starts));
  grade_bound(
      row, error,
      {static_cast<double>(steps) * tol * (1.0 + size) * 2.0,
       fmt::format("{} steps, each within tol = {:g} of 1 + |x|, {:.2g} in the mean, amplified by about 2 along "
                   "the ray",
                   steps, tol, size)});
  return row;
}

std::vector<Row> proportionality_rows(const Lab& lab, const Bundle& bundle) {
  std::vector<Row> rows;
  for (const MethodCard& card : methods()) {
    if (!card.adaptive) continue;
    std::vector<double> tolerances, errors, drifts;
    std::int64_t evaluations = 0, steps = 0;
    for (double tol = 1e-5; tol > 0.5e-11; tol *= 0.1) {
      const Measured measured = measure(lab, bundle, {std::string(card.id), tol, Projection::none});
      tolerances.push_back(tol);
      errors.push_back(measured.error);
      drifts.push_back(measured.null_drift);
      evaluations += measured.evaluations;
      steps = measured.steps;
    }
    const auto row = [&](std::string_view what, const std::vector<double>& values) {
      Row out = make_row(fmt::format("slope of {} against tolerance, {}", what, card.id), *bundle.chart,
                         {std::string(card.id), tolerances.back(), Projection::none},
                         {{"rays", static_cast<double>(bundle.starts.size()), "1"}, {"decades", decades, "1"}});
      out.evaluations = evaluations;
      out.note = fmt::format("{} over tolerance: {:.2g} at {:.0e}, {:.2g} at {:.0e}", what,
                             values.front() / tolerances.front(), tolerances.front(), values.back() / tolerances.back(),
                             tolerances.back());
      grade(out, fitted_slope(tolerances, values), {1.0, 0.0}, slope_tolerance(card.order));
      return out;
    };
    rows.push_back(row("error", errors));
    rows.push_back(row("null drift", drifts));
    rows.push_back(error_row(bundle, card, tolerances.back(), errors.back(), steps));
  }
  return rows;
}

/// The largest ratio, over rays and step sizes, of the local error that was made to the estimate of it.
Row estimate_row(const Lab& lab, const Bundle& bundle, const MethodCard& card) {
  const Flow flow = bundle.flow();
  double worst = 0.0;
  std::int64_t evaluations = 0;
  for (std::size_t i = 0; i < bundle.starts.size(); ++i) {
    for (const double fraction : card.order < 8 ? std::array{0.02, 0.03, 0.05} : std::array{0.08, 0.12, 0.16}) {
      const double h = fraction * bundle.spans[i];
      StepperSettings settings;
      settings.error_scale.absolute.fill(1.0);
      settings.error_scale.absolute[0] = std::numeric_limits<double>::infinity();
      const std::unique_ptr<Stepper> stepper = lab.stepper(card.id, flow, settings);
      const StepOutcome outcome = stepper->step(bundle.starts[i], h);
      const PhaseState<double> truth = walk(*make_stepper("dop853", flow, {}), bundle.starts[i], h, 16).y;
      double error = 0.0;
      for (std::size_t k = 1; k < 8; ++k) error = std::max(error, std::abs(outcome.y[k] - truth[k]));
      // Below this the error is that of rounding, which no estimate covers.
      constexpr double round_off = 1e-14;
      if (error > 100.0 * round_off) worst = std::max(worst, error / outcome.error_norm);
      evaluations += stepper->evaluations();
    }
  }
  Row row = make_row(fmt::format("local error over its estimate, {}", card.id), *bundle.chart,
                     {std::string(card.id), 0.0, Projection::none},
                     {{"rays", static_cast<double>(bundle.starts.size()), "1"}});
  row.evaluations = evaluations;
  grade_bound(row, worst,
              {1.0, "the estimate is the error of a companion of lower order; what is propagated errs less"});
  return row;
}

}  // namespace

std::vector<Case> tolerance_cases() {
  const auto fisheye = [](const Lab& lab) {
    return proportionality_rows(lab, fisheye_orbits(lab, lab.full() ? 32 : 16, FisheyePath::arc));
  };
  const auto kerr = [](const Lab& lab) {
    return proportionality_rows(lab, kerr_scattering(lab, lab.full() ? 32 : 16));
  };
  const auto estimates = [](const Lab& lab) {
    std::vector<Row> rows;
    const Bundle bundle = kerr_rays(lab, 16);
    for (const MethodCard& card : methods()) {
      if (card.adaptive && !card.id.starts_with("odeint:")) rows.push_back(estimate_row(lab, bundle, card));
    }
    return rows;
  };
  const std::string measured =
      "The same rays at seven tolerances; slopes of log(error) and of log(null residual) against log(tolerance) by "
      "least squares. With local extrapolation both are 1: the error per step is held at the tolerance by an estimate "
      "that shrinks with the power of the step that the global error has.";
  return {
      {.info =
           info("tolerance-fisheye", "adaptive methods err, and leave the light cone, in proportion to their tolerance",
                measured, "great circles in stereographic projection: closed form", TruthRank::closed_form,
                "Maxwell1854 HairerNorsettWanner1993", "numerical_tolerance.cpp"),
       .run = fisheye},
      {.info =
           info("tolerance-kerr", "the same proportionality holds for light that passes a Kerr hole off the equator",
                measured, "DOP853 with far finer steps, checked by Gauss-Legendre's order 6",
                TruthRank::self_convergence, "HairerNorsettWanner1993", "numerical_tolerance.cpp"),
       .run = kerr},
      {.info = info("error-estimate",
                    "the error estimate of an adaptive method is no smaller than the local error that it makes",
                    "Single steps from the start of Kerr rays, of three lengths; the error is the largest of any "
                    "graded component, in the norm of the estimate.",
                    "the same step in sixteen parts by DOP853", TruthRank::self_convergence, "HairerNorsettWanner1993",
                    "numerical_tolerance.cpp"),
       .run = estimates},
  };
}

}  // namespace xpr::numerical
