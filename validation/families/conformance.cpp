// What must hold of every metric module, whatever it describes, as cases: one row for each chart and check, the worst
// over the parameters at which metrics go wrong (no spin, the extremal one, lengths other than 1).
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

#include "metrics/catalogue.hpp"
#include "metrics/conformance.hpp"
#include "validation/families.hpp"
#include "validation/kit.hpp"

namespace xpr {

namespace {

using Values = std::vector<NamedValue>;

std::vector<Values> variations(std::string_view metric) {
  if (metric == "kerr") {
    return {{{"a", 0.0}}, {{"a", 0.6}}, {{"a", 0.998}}, {{"a", 1.0}}, {{"a", -0.7}}, {{"M", 3.0}, {"a", 2.9}}};
  }
  if (metric == "schwarzschild") return {{}, {{"M", 2.5}}};
  if (metric == "ellis") return {{}, {{"b0", 0.3}}};
  if (metric == "luneburg" || metric == "maxwell-fisheye") return {{}, {{"R", 2.5}}};
  if (metric == "medium-uniform") return {{}, {{"n", 0.7}}};
  if (metric == "ellipsoid") return {{}, {{"f", 1.0 / 3.0}}, {{"f", -0.2}}, {{"a_axis", 2.5}, {"f", 0.1}}};
  return {{}};
}

double excess(const Row& row) { return row.tolerance > 0.0 ? row.error / row.tolerance : -1.0; }

Row row_of(const Finding& finding, const Spacetime& chart) {
  std::vector<RowParameter> parameters;
  for (const NamedValue& value : chart.parameters()) {
    parameters.push_back({.name = std::string(value.name), .value = value.value, .unit = "1"});
  }
  Row row = make_row(fmt::format("{}: {}", chart.card().chart, finding.check), chart, {}, std::move(parameters));
  if (finding.state == FindingState::not_checked) {
    row.verdict = Verdict::skipped;
    row.note = finding.message;
    return row;
  }
  grade_bound(row, finding.error, {finding.tolerance, finding.tolerance_reason});
  if (row.verdict != Verdict::pass) row.note = finding.message;
  return row;
}

/// Keeps the worse of two rows of one label: a number before none, more of its tolerance before less.
void keep_worse(Row& kept, Row&& row) {
  const bool worse = row.verdict != Verdict::skipped && !(excess(row) <= excess(kept));
  if (kept.verdict == Verdict::skipped || worse) kept = std::move(row);
}

/// What a module has not declared is a row all the same; what does not apply (no spin, no horizon) is none.
bool belongs_in_report(const Row& row) { return row.verdict != Verdict::skipped || row.label.ends_with(": ricci"); }

std::vector<Row> conformance_rows(const Lab& lab, std::string_view metric) {
  std::vector<std::string_view> chart_ids;
  for (const CatalogueEntry& entry : catalogue()) {
    if (entry.card->metric == metric) chart_ids.push_back(entry.card->chart);
  }
  std::vector<Row> rows;
  std::map<std::string, std::size_t> place;
  const ConformanceOptions options{.points = lab.full() ? 96 : 24};
  for (const Values& values : variations(metric)) {
    std::vector<std::unique_ptr<Spacetime>> owned;
    std::vector<const Spacetime*> charts;
    for (const std::string_view id : chart_ids) {
      owned.push_back(lab.spacetime(metric, id, values));
      charts.push_back(owned.back().get());
    }
    for (const Spacetime* chart : charts) {
      for (const Finding& finding : check_conformance(*chart, charts, options)) {
        Row row = row_of(finding, *chart);
        const auto [at, is_new] = place.emplace(row.label, rows.size());
        if (is_new) {
          rows.push_back(std::move(row));
        } else {
          keep_worse(rows[at->second], std::move(row));
        }
      }
    }
  }
  std::erase_if(rows, [](const Row& row) { return !belongs_in_report(row); });
  // Charts side by side, in catalogue order, whatever order their checks first applied in.
  std::stable_sort(rows.begin(), rows.end(), [&](const Row& a, const Row& b) {
    const auto order = [&](const Row& row) { return std::find(chart_ids.begin(), chart_ids.end(), row.chart); };
    return order(a) < order(b);
  });
  return rows;
}

}  // namespace

std::vector<Case> conformance_cases() {
  std::vector<Case> list;
  for (const CatalogueEntry& entry : catalogue()) {
    const std::string metric(entry.card->metric);
    const std::string id = "conformance/" + metric;
    if (std::any_of(list.begin(), list.end(), [&](const Case& one) { return one.info.id == id; })) continue;
    list.push_back(
        {{.id = id,
          .family = "conformance",
          .claim = fmt::format("Every chart of '{}' is a Lorentzian metric with the symmetries, the curvature and the "
                               "sense of rotation that it claims, and all charts carry the same one.",
                               metric),
          .physics =
              "Identities at seeded events off the equator, near the axis, on both sides of horizon and throat: "
              "g g^-1 = 1, signature (-+++), derivatives by duals against differences, Hamilton's equations, "
              "{K.p, H} = 0, R_mn = 0 or as declared, flatness far out, far-field mass, frame dragging, the axis "
              "without a cone, chart maps inverse to each other and canonical. Errors are measured in an "
              "orthonormal frame.",
          .truth = "identities of geometry: what should vanish is 0",
          .rank = TruthRank::closed_form,
          .grades_metric = true,
          .cites = std::string(entry.card->cites),
          .source = "validation/families/conformance.cpp"},
         true,
         [metric](const Lab& lab) { return conformance_rows(lab, metric); }});
  }
  return list;
}

}  // namespace xpr
