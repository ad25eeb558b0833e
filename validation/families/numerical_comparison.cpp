// Ours against Boost.Odeint's: two implementations of the same methods.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/bundle.hpp"
#include "validation/convergence.hpp"
#include "validation/families/numerical.hpp"
#include "validation/kit.hpp"

namespace xpr::numerical {

namespace {

/// 16 roundings of the largest coordinate, 15 M.
constexpr double step_bound = 16.0 * 15.0 * std::numeric_limits<double>::epsilon();

/// The largest difference over starts and graded components between single steps of two methods.
Row step_row(const Lab& lab, const Bundle& bundle, double h) {
  const Flow flow = bundle.flow();
  double state = 0.0, estimate = 0.0;
  for (const PhaseState<double>& start : bundle.starts) {
    StepperSettings settings;
    settings.error_scale.absolute.fill(1.0);
    const StepOutcome ours = lab.stepper("dopri54", flow, settings)->step(start, h);
    const StepOutcome theirs = make_stepper("odeint:dopri5", flow, settings)->step(start, h);
    for (std::size_t k = 0; k < 8; ++k) state = std::max(state, std::abs(ours.y[k] - theirs.y[k]));
    estimate = std::max(estimate, std::abs(ours.error_norm - theirs.error_norm));
  }
  Row row = make_row(fmt::format("one step of h = {} against Odeint's dopri5", h), *bundle.chart, {"dopri54", h},
                     {{"h", h, "1"}});
  row.note = fmt::format("error estimates differ by {:.2g}", estimate);
  grade_bound(row, std::max(state, estimate),
              {step_bound,
               "the same stages and weights summed in another order: 7 stages, 2 roundings each, of numbers up to 15"});
  return row;
}

struct Ends {
  std::vector<PhaseState<double>> y;
  std::int64_t steps = 0, evaluations = 0;
};

Ends trace_all(const Lab& lab, const Bundle& bundle, const MethodAt& method) {
  Ends out;
  for (std::size_t i = 0; i < bundle.starts.size(); ++i) {
    TraceSettings settings = trace_settings(method, bundle.length_unit);
    settings.lambda_max = bundle.spans[i];
    const RayEnd end = lab.trace(*bundle.chart, bundle.starts[i], 1, settings);
    out.y.push_back(end.y);
    out.steps = std::max(out.steps, end.steps);
    out.evaluations += end.evaluations;
  }
  return out;
}

Row end_row(const Lab& lab, const Bundle& bundle, const MethodAt& ours, std::string_view theirs) {
  const Ends mine = trace_all(lab, bundle, ours);
  const Ends other = trace_all(lab, bundle, {std::string(theirs), ours.setting});
  Row row = make_row(fmt::format("{} against {} at tol {:g}", ours.method, theirs, ours.setting), *bundle.chart, ours,
                     {{"rays", static_cast<double>(bundle.starts.size()), "1"}});
  row.evaluations = mine.evaluations;
  row.note = fmt::format("{} and {} evaluations, at most {} and {} steps a ray", mine.evaluations, other.evaluations,
                         mine.steps, other.steps);
  const double difference = distance(spatial_components(mine.y), spatial_components(other.y));
  // DOP853 and Fehlberg's pair are of one order too, and may take as many steps, but they are two methods.
  const bool one_method = ours.method == "dopri54" && theirs == "odeint:dopri5";
  if (one_method && mine.steps == other.steps) {
    grade_bound(row, difference,
                {step_bound * static_cast<double>(mine.steps),
                 fmt::format("the same {} steps, each to the bound of a single one", mine.steps)});
  } else {
    grade_bound(row, difference,
                {static_cast<double>(mine.steps + other.steps) * ours.setting * 16.0,
                 fmt::format("{} and {} steps, each within tol of |x| up to 15 M", mine.steps, other.steps)});
  }
  return row;
}

std::vector<Row> odeint_rows(const Lab& lab) {
  const Bundle bundle = kerr_rays(lab, lab.full() ? 32 : 16);
  std::vector<Row> rows;
  for (const double h : {0.1, 0.5, 2.0}) rows.push_back(step_row(lab, bundle, h));
  for (const double tol : {1e-6, 1e-9, 1e-12}) {
    rows.push_back(end_row(lab, bundle, {"dopri54", tol}, "odeint:dopri5"));
    rows.push_back(end_row(lab, bundle, {"dop853", tol}, "odeint:rkf78"));
    rows.push_back(end_row(lab, bundle, {"dop853", tol}, "odeint:bulirsch-stoer"));
  }
  return rows;
}

}  // namespace

std::vector<Case> comparison_cases() {
  return {{.info = info("against-odeint",
                        "our Dormand-Prince steps are Boost.Odeint's to round-off, and whole rays agree to tolerance",
                        "Single steps from the starts of Kerr rays, and whole rays past the hole under the same norm "
                        "and controller; DOP853 against Odeint's Fehlberg 7(8) and Bulirsch-Stoer.",
                        "Boost.Odeint on the same flow: an implementation that nobody here wrote",
                        TruthRank::high_precision, "AhnertMulansky2011 DormandPrince1980", "numerical_comparison.cpp"),
           .run = odeint_rows}};
}

}  // namespace xpr::numerical
