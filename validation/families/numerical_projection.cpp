// Projection onto the light cone and the Killing constants: drift goes to round-off, the order stays.
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

constexpr std::array projections = {Projection::energy, Projection::momentum, Projection::full};

struct Traced {
  std::vector<PhaseState<double>> ends;
  double null_residual = 0.0;  ///< the largest on any ray
  double b_change = 0.0;       ///< the largest relative change of the impact parameter
  std::int64_t evaluations = 0;
};

Traced trace_all(const Lab& lab, const Bundle& bundle, const MethodAt& method) {
  Traced out;
  for (std::size_t i = 0; i < bundle.starts.size(); ++i) {
    TraceSettings settings = trace_settings(method, bundle.length_unit);
    settings.lambda_max = bundle.spans[i];
    const RayEnd end = lab.trace(*bundle.chart, bundle.starts[i], 1, settings);
    const double b = impact_parameter(*bundle.chart, bundle.starts[i]);
    out.ends.push_back(end.y);
    out.null_residual = std::max(out.null_residual, end.null_residual_max);
    out.b_change = std::max(out.b_change, std::abs(impact_parameter(*bundle.chart, end.y) - b) / std::abs(b));
    out.evaluations += end.evaluations;
  }
  return out;
}

std::vector<Row> residual_rows(const Lab& lab) {
  const Bundle bundle = kerr_rays(lab, lab.full() ? 32 : 16);
  std::vector<Row> rows;
  for (const MethodAt& plain : {MethodAt{"rk4", 0.25}, MethodAt{"dopri54", 1e-6}, MethodAt{"dop853", 1e-8}}) {
    const double unprojected = trace_all(lab, bundle, plain).null_residual;
    for (const Projection projection : projections) {
      MethodAt method = plain;
      method.projection = projection;
      const Traced traced = trace_all(lab, bundle, method);
      Row row = make_row(fmt::format("null residual with {}", method_label(method)), *bundle.chart, method,
                         {{"rays", static_cast<double>(bundle.starts.size()), "1"},
                          {"residual_without_projection", unprojected, "1"}});
      row.note = fmt::format("{:.2g} without projection", unprojected);
      row.evaluations = traced.evaluations;
      grade_bound(row, traced.null_residual, {1e-14, "the figure that the project promises"});
      rows.push_back(row);
      if (projection != Projection::full) continue;
      Row moved = make_row(fmt::format("impact parameter moved by {}", method_label(method)), *bundle.chart, method,
                           {{"rays", static_cast<double>(bundle.starts.size()), "1"}});
      moved.evaluations = traced.evaluations;
      grade_bound(moved, traced.b_change,
                  {64.0 * std::numeric_limits<double>::epsilon(),
                   "L_z = x p_y - y p_x, components up to 15 M that cancel to a few M: 32 eps at either end"});
      rows.push_back(moved);
    }
  }
  return rows;
}

/// Order of a fixed-step method with a projection, between the two finest of three step sizes.
Row order_row(const Lab& lab, const Bundle& bundle, std::string_view name, std::int64_t steps, Projection projection) {
  std::vector<double> settings, errors;
  const std::vector<double> truth = spatial_components(bundle.ends);
  MethodAt method{std::string(name), 0.0, projection};
  std::int64_t evaluations = 0;
  for (const std::int64_t n : {steps, 2 * steps}) {
    method.setting = bundle.spans[0] / static_cast<double>(n);  // all rays of the bundle are as long
    const Traced traced = trace_all(lab, bundle, method);
    settings.push_back(method.setting);
    errors.push_back(distance(spatial_components(traced.ends), truth));
    evaluations += traced.evaluations;
  }
  Row row = make_row(fmt::format("observed order of {}", method_label(method)), *bundle.chart, method,
                     {{"rays", static_cast<double>(bundle.starts.size()), "1"}});
  row.evaluations = evaluations;
  row.note = fmt::format("errors {:.2g} and {:.2g}", errors[0], errors[1]);
  grade(row, order_between(settings[0], errors[0], settings[1], errors[1]),
        {static_cast<double>(method_card(name).order), 0.0},
        {0.1, "to 0.1, as without projection: each moves the state by no more than the error of the step"});
  return row;
}

std::vector<Row> order_rows(const Lab& lab) {
  const Bundle bundle = kerr_scattering(lab, lab.full() ? 32 : 16);
  std::vector<Row> rows;
  for (const Projection projection : projections) {
    rows.push_back(order_row(lab, bundle, "heun2", 1024, projection));
    rows.push_back(order_row(lab, bundle, "rk4", 512, projection));
    rows.push_back(order_row(lab, bundle, "gl4", 256, projection));
  }
  return rows;
}

}  // namespace

std::vector<Case> projection_cases() {
  return {
      {.info =
           info("projection-residual",
                "with projection light stays on its cone to 1e-14, and `full` leaves the impact parameter alone",
                "The largest null residual |g^{mu nu} p_mu p_nu| / (n.p)^2 on rays past a Kerr hole, and the change "
                "of b = L_z/E, at step sizes and tolerances that leave far more without projection.",
                "0, exact", TruthRank::closed_form, "HairerLubichWanner2006", "numerical_projection.cpp"),
       .run = residual_rows},
      {.info = info("projection-order", "projection after every step keeps the order of the method",
                    "As for the observed orders, through the tracer with each projection.",
                    "DOP853 with far finer steps, checked by Gauss-Legendre's order 6", TruthRank::self_convergence,
                    "HairerLubichWanner2006", "numerical_projection.cpp"),
       .run = order_rows},
  };
}

}  // namespace xpr::numerical
