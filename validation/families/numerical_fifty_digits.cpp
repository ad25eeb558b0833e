// Steppers against the same metric source at 50 digits, in every chart of the catalogue.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/io/csv.hpp"
#include "metrics/catalogue.hpp"
#include "validation/convergence.hpp"
#include "validation/families/numerical.hpp"
#include "validation/kit.hpp"
#include "validation/truth/stored_tables.hpp"

namespace xpr::numerical {

namespace {

constexpr std::size_t start_column = 3, lambda_column = 11, end_column = 12;

double number(const std::string& text) {
  double value = std::numeric_limits<double>::quiet_NaN();
  (void)parse_number(text, value);
  return value;
}

/// One ray of the table `fifty_digit_rays`, rounded to doubles.
struct StoredRay {
  PhaseState<double> start, end;
  double lambda = 0.0;
};

std::optional<StoredRay> stored_ray(const ReferenceTable& table, const Card& card) {
  for (const std::vector<std::string>& row : table.rows) {
    if (row[0] != card.metric || row[1] != card.chart) continue;
    StoredRay ray;
    for (std::size_t i = 0; i < 8; ++i) {
      ray.start[i] = number(row[start_column + i]);
      ray.end[i] = number(row[end_column + i]);
    }
    ray.lambda = number(row[lambda_column]);
    return ray;
  }
  return std::nullopt;
}

/// The largest |x - y| in units of what each component is measured in.
double largest_distance(const PhaseState<double>& x, const PhaseState<double>& y, const std::array<double, 8>& units) {
  double largest = 0.0;
  for (std::size_t i = 0; i < 8; ++i) largest = std::max(largest, std::abs(x[i] - y[i]) / units[i]);
  return largest;
}

/// How much a relative error in the start's components has grown by the end: the ray displaced in each of them.
double growth(const Lab& lab, const Spacetime& chart, const StoredRay& ray, TraceSettings settings,
              const std::array<double, 8>& units) {
  constexpr double displacement = 1e-6;
  settings.tol = 1e-13;
  settings.method = "dop853";
  const PhaseState<double> straight = lab.trace(chart, ray.start, 1, settings).y;
  double largest = 1.0;
  for (std::size_t i = 0; i < 8; ++i) {
    PhaseState<double> start = ray.start;
    start[i] += displacement * units[i];
    const RayEnd end = lab.trace(chart, start, 1, settings);
    largest = std::max(largest, largest_distance(end.y, straight, units) / displacement);
  }
  return largest;
}

std::vector<Row> fifty_digit_rows(const Lab& lab) {
  const ReferenceTable table = stored_table("fifty_digit_rays");
  std::vector<MethodAt> methods = {{"dop853", 1e-13}, {"dopri54", 1e-11}};
  if (lab.full()) methods.insert(methods.end(), {{"dop853", 1e-9}, {"rkf45", 1e-10}, {"odeint:rkf78", 1e-12}});
  std::vector<Row> rows;
  for (const CatalogueEntry& entry : catalogue()) {
    const std::string name = fmt::format("{} {}", entry.card->metric, entry.card->chart);
    const std::optional<StoredRay> ray = stored_ray(table, *entry.card);
    if (!ray) {
      rows.push_back(skipped_row(name,
                                 "the table fifty_digit_rays has no ray in this chart; xprimeray reference "
                                 "--regenerate fifty_digit_rays makes one"));
      continue;
    }
    const std::unique_ptr<Spacetime> chart = lab.spacetime(entry.card->metric, entry.card->chart);
    const std::array<double, 8> units = component_units(*chart, ray->start, 1.0);
    double amplified = 0.0, size = 1.0;
    for (std::size_t i = 0; i < 8; ++i)
      size = std::max({size, std::abs(ray->start[i]) / units[i], std::abs(ray->end[i]) / units[i]});
    for (const MethodAt& method : methods) {
      TraceSettings settings = trace_settings(method);
      settings.lambda_max = ray->lambda;
      settings.grade_time = true;
      if (amplified == 0.0) amplified = growth(lab, *chart, *ray, settings, units);
      Row row = make_row(fmt::format("{}, {} {:g}", name, method_label(method), method.setting), *chart, method,
                         {{"lambda", ray->lambda, "1"}});
      const RayEnd end = lab.trace(*chart, ray->start, 1, settings);
      if (ended_as(row, end, Status::max_affine)) {
        const double steps = static_cast<double>(end.steps), round_off = std::numeric_limits<double>::epsilon();
        // The reference is rounded to doubles.
        grade(
            row, largest_distance(end.y, ray->end, units), {0.0, 0.5 * round_off * size},
            {steps * (method.setting + round_off) * (1.0 + size) * amplified,
             fmt::format("{} steps, each within tol = {:g} and round-off of 1 + |x|, up to {:.3g}, and an error grows "
                         "to at most {:.3g} of itself along the ray (measured)",
                         end.steps, method.setting, 1.0 + size, amplified)});
      }
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace

std::vector<Case> fifty_digit_cases() {
  return {
      {.info = info("fifty-digits", "in every chart, steppers arrive where the same metric source arrives at 50 digits",
                    "One ray a chart, to a given affine parameter: the largest deviation of a component of x and p, "
                    "time included, in the unit that the error norm measures it in.",
                    "the table fifty_digit_rays: Gragg's rule extrapolated to order 32 over the flow derived from "
                    "inverse_metric, twice; it says nothing about whether the metric is right",
                    TruthRank::same_source, "Gragg1965 BulirschStoer1966", "numerical_fifty_digits.cpp"),
       .run = fifty_digit_rows}};
}

}  // namespace xpr::numerical
