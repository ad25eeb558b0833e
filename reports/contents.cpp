#include "reports/contents.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "reports/case_table.hpp"
#include "reports/meaningful.hpp"
#include "reports/text.hpp"

namespace xpr {
namespace {

Tone tone_of(const Counts& counts) {
  if (counts.fail + counts.error > 0) return Tone::bad;
  if (counts.inconclusive + counts.skipped > 0) return Tone::warning;
  return counts.pass > 0 ? Tone::good : Tone::muted;
}

Tone tone_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::passed:
      return Tone::good;
    case Outcome::failed:
    case Outcome::error:
      return Tone::bad;
    case Outcome::swept:
      return Tone::plain;
    case Outcome::inconclusive:
    case Outcome::nothing_graded:
      break;
  }
  return Tone::warning;
}

/// "2.1 (label)" of a worst row; "na" where there is none.
Cell worst_cell(const RowOfCase& worst) {
  if (worst.row == nullptr) return {"na", Tone::muted, ""};
  return {fmt::format("{}: {}", worst.result->info.id, worst.row->label), Tone::plain, case_anchor(*worst.result)};
}

Cell count_cell(std::int64_t count, Tone tone) { return {grouped(count), count > 0 ? tone : Tone::muted, ""}; }

class Composer {
 public:
  Composer(const Contents& contents, Page& page) : in_(contents), page_(page) {}

  void compose() {
    page_.title("xPRIMEray validation report: suite " + in_.suite.suite);
    verdict();
    reproduce();
    failures();
    skipped();
    overview();
    coverage();
    families();
    tails();
    sweeps();
    faults();
    figures();
    provenance();
  }

 private:
  void chapter(const std::string& title, Tone tone = Tone::plain, const std::string& aside = "") {
    page_.begin({2, title, slug(title), tone, aside});
  }

  void verdict() {
    page_.paragraph(in_.digest.sentence, tone_of(in_.digest.outcome));
    const Counts& counts = in_.digest.counts;
    page_.table({{{"rows", true},
                  {"pass", true},
                  {"FAIL", true},
                  {"ERROR", true},
                  {"INCONCLUSIVE", true},
                  {"SKIPPED", true},
                  {"faults planted", true},
                  {"faults MISSED", true}},
                 {{count_cell(counts.total(), Tone::plain), count_cell(counts.pass, Tone::good),
                   count_cell(counts.fail, Tone::bad), count_cell(counts.error, Tone::bad),
                   count_cell(counts.inconclusive, Tone::warning), count_cell(counts.skipped, Tone::warning),
                   count_cell(static_cast<std::int64_t>(in_.suite.faults.size()), Tone::plain),
                   count_cell(static_cast<std::int64_t>(in_.digest.missed_faults.size()), Tone::bad)}}});
    for (const std::string& problem : in_.figures.problems) page_.paragraph(problem, Tone::warning);
  }

  void reproduce() {
    chapter("How to reproduce");
    page_.listing(in_.command);
    page_.facts({{"rays_hash", in_.hashes.rays}, {"report_hash", in_.hashes.report}});
    page_.paragraph(
        "The same build on the same CPU gives the same two hashes; rays_hash is the same on every machine.");
    page_.end();
  }

  void failures() {
    const auto rows = static_cast<std::int64_t>(in_.digest.failures.size());
    const auto missed = static_cast<std::int64_t>(in_.digest.missed_faults.size());
    if (rows + missed == 0) return;
    chapter("Failures", Tone::bad,
            counted(rows, "row") + (missed > 0 ? ", " + counted(missed, "planted fault") + " not caught" : ""));
    if (rows > 0) page_.table(failure_table());
    for (const FaultResult* fault : in_.digest.missed_faults) {
      page_.paragraph(fmt::format("Planted fault {} was NOT CAUGHT by {}: {}. {}", fault->id, fault->case_id,
                                  fault->description, fault->note),
                      Tone::bad);
    }
    page_.end();
  }

  Table failure_table() const {
    Table table{{{"case"},
                 {"row"},
                 {"metric, chart, method"},
                 {"value", true},
                 {"reference", true},
                 {"error", true},
                 {"tolerance", true},
                 {"error / tolerance", true},
                 {"unit"},
                 {"verdict"},
                 {"why this tolerance; note"}},
                {}};
    for (const RowOfCase& at : in_.digest.failures) {
      const Row& row = *at.row;
      table.rows.push_back({{at.result->info.id, Tone::plain, case_anchor(*at.result)},
                            {row.label},
                            {where(row)},
                            {value_text(row)},
                            {reference_text(row)},
                            {error_text(row, row.error)},
                            {error_text(row, row.tolerance)},
                            {two_digits_or_na(error_over_tolerance(row))},
                            {row.unit},
                            verdict_cell(row),
                            {reason_and_note(row)}});
    }
    return table;
  }

  void skipped() {
    if (in_.digest.skipped.empty()) return;
    chapter("Skipped", Tone::warning,
            counted(static_cast<std::int64_t>(in_.digest.skipped.size()), "row") + ", NOT graded");
    Table table{{{"case"}, {"row"}, {"metric, chart, method"}, {"verdict"}, {"why"}}, {}};
    for (const RowOfCase& at : in_.digest.skipped) {
      table.rows.push_back({{at.result->info.id, Tone::plain, case_anchor(*at.result)},
                            {at.row->label},
                            {where(*at.row)},
                            verdict_cell(*at.row),
                            {at.row->note.empty() ? "no reason given" : at.row->note}});
    }
    page_.table(table);
    page_.end();
  }

  void overview() {
    chapter("Families");
    Table table{{{"family"},
                 {"cases", true},
                 {"rows", true},
                 {"pass", true},
                 {"FAIL", true},
                 {"ERROR", true},
                 {"INCONCLUSIVE", true},
                 {"SKIPPED", true},
                 {"worst error / tolerance", true},
                 {"in"}},
                {}};
    for (const FamilyDigest& family : in_.digest.families) {
      table.rows.push_back({{family.name, Tone::plain, "family-" + slug(family.name)},
                            {grouped(static_cast<std::int64_t>(family.cases.size()))},
                            count_cell(family.counts.total(), Tone::plain),
                            count_cell(family.counts.pass, Tone::good),
                            count_cell(family.counts.fail, Tone::bad),
                            count_cell(family.counts.error, Tone::bad),
                            count_cell(family.counts.inconclusive, Tone::warning),
                            count_cell(family.counts.skipped, Tone::warning),
                            {two_digits_or_na(family.tail.max)},
                            worst_cell(family.worst)});
    }
    page_.table(table);
    page_.end();
  }

  void coverage() {
    const Coverage& matrix = in_.coverage;
    chapter("Coverage");
    page_.paragraph(
        "Rows that pass, of rows graded, for each metric in each chart and each method. \"Sweep only\": errors "
        "were measured in a sweep, and no row judges them. Projected variants count under their method.");
    Table table{{{"metric"}, {"chart"}}, {}};
    for (const std::string& method : matrix.methods) table.columns.push_back({method.empty() ? "no stepping" : method});
    for (std::size_t i = 0; i < matrix.charts.size(); ++i) {
      std::vector<Cell> row{{matrix.charts[i].metric},
                            {matrix.charts[i].chart.empty() ? "any" : matrix.charts[i].chart}};
      for (const CoverageCell& cell : matrix.cells[i]) row.push_back(coverage_cell(cell));
      table.rows.push_back(std::move(row));
    }
    page_.table(table);
    page_.end();
  }

  static Cell coverage_cell(const CoverageCell& cell) {
    const std::int64_t graded = cell.counts.total() - cell.counts.skipped;
    if (graded > 0) {
      const bool all = cell.counts.pass == graded;
      return {fmt::format("{}/{}{}", cell.counts.pass, graded, all ? "" : " FAIL"), all ? Tone::good : Tone::bad, ""};
    }
    if (cell.counts.skipped > 0) return {fmt::format("{} SKIPPED", cell.counts.skipped), Tone::warning, ""};
    return {cell.sweep_points > 0 ? "sweep only" : "not graded", Tone::muted, ""};
  }

  void families() {
    chapter("Every row, by family");
    for (const FamilyDigest& family : in_.digest.families) {
      const bool bad = family.counts.pass != family.counts.total();
      page_.begin({3, family.name, "family-" + slug(family.name), tone_of(family.counts),
                   counts_in_words(family.counts), true, bad});
      for (const CaseDigest& one : family.cases) {
        const CaseInfo& info = one.result->info;
        page_.begin({4, info.id, case_anchor(*one.result), tone_of(one.counts), counts_in_words(one.counts)});
        page_.paragraph(info.claim);
        const CaseTable laid_out = case_table(*one.result);
        page_.facts(laid_out.facts);
        if (!one.result->rows.empty()) page_.table(laid_out.table);
        page_.end();
      }
      page_.end();
    }
    page_.end();
  }

  void tails() {
    chapter("Tails of error over tolerance");
    page_.paragraph("A number at or below 1 is within tolerance. Rows without an error or a tolerance are left out.");
    Table table{{{"case"}, {"rows", true}, {"median", true}, {"p99", true}, {"max", true}, {"worst row"}}, {}};
    for (const FamilyDigest& family : in_.digest.families) {
      for (const CaseDigest& one : family.cases) {
        const Tone tone = one.tail.max > 1.0 ? Tone::bad : Tone::plain;
        table.rows.push_back({{one.result->info.id, Tone::plain, case_anchor(*one.result)},
                              {grouped(one.tail.rows)},
                              {two_digits_or_na(one.tail.median)},
                              {two_digits_or_na(one.tail.p99)},
                              {two_digits_or_na(one.tail.max), tone, ""},
                              {one.worst == nullptr ? "na" : one.worst->label}});
      }
    }
    page_.table(table);
    page_.end();
  }

  void sweeps() {
    if (in_.suite.sweeps.empty()) return;
    chapter("Sweeps");
    page_.paragraph(
        "Errors are norms over a bundle of rays; observed order is the slope between a point and the one before; "
        "GCI is the error that Richardson extrapolation estimates. na: not defined there.");
    for (std::size_t i = 0; i < in_.suite.sweeps.size(); ++i) {
      const Sweep& sweep = in_.suite.sweeps[i];
      page_.begin({3, sweep.quantity, fmt::format("sweep-{}", i + 1), Tone::plain,
                   fmt::format("unit {}, truth: {}", sweep.unit, to_string(sweep.rank)), true, false});
      page_.table(sweep_table(sweep));
      page_.end();
    }
    page_.end();
  }

  static Table sweep_table(const Sweep& sweep) {
    Table table{{{"metric"},
                 {"chart"},
                 {"method"},
                 {"tol or step", true},
                 {"rays", true},
                 {"error (rms)", true},
                 {"median", true},
                 {"p99", true},
                 {"max", true},
                 {"truth error", true},
                 {"null drift", true},
                 {"evaluations / ray", true},
                 {"seconds / ray", true},
                 {"observed order", true},
                 {"GCI", true},
                 {"class"}},
                {}};
    for (const SweepPoint& point : sweep.points) {
      const bool diverges = point.convergence == "divergent";
      table.rows.push_back({{point.metric},
                            {point.chart},
                            {point.method},
                            {fmt::format("{} {}", point.adaptive ? "tol" : "step", two_digits(point.setting))},
                            {grouped(point.rays)},
                            {two_digits_or_na(point.error_norm)},
                            {two_digits_or_na(point.error_median)},
                            {two_digits_or_na(point.error_p99)},
                            {two_digits_or_na(point.error_max)},
                            {two_digits_or_na(point.truth_error)},
                            {two_digits_or_na(point.null_drift_max)},
                            {std::isnan(point.evaluations_per_ray) ? "na" : meaningful(point.evaluations_per_ray, 0.5)},
                            {two_digits_or_na(point.seconds_per_ray)},
                            {std::isnan(point.observed_order) ? "na" : meaningful(point.observed_order, 0.02)},
                            {two_digits_or_na(point.richardson_error)},
                            {point.convergence, diverges ? Tone::warning : Tone::plain, ""}});
    }
    return table;
  }

  void faults() {
    if (in_.suite.faults.empty()) return;
    const auto caught = in_.suite.faults.size() - in_.digest.missed_faults.size();
    chapter("Planted faults", in_.digest.missed_faults.empty() ? Tone::plain : Tone::bad,
            fmt::format("{} of {} caught", caught, in_.suite.faults.size()));
    page_.paragraph(
        "A fault is caught when a row fails with a finite error above ten tolerances while the unbroken twin "
        "passes in the same run; an exception or a NaN is no catch.");
    Table table{{{"fault"},
                 {"what is wrong"},
                 {"case"},
                 {"row"},
                 {"error", true},
                 {"tolerance", true},
                 {"error / tolerance", true},
                 {"twin"},
                 {"verdict"},
                 {"note"}},
                {}};
    for (const FaultResult& fault : in_.suite.faults) {
      const bool graded = fault.tolerance > 0.0;
      table.rows.push_back(
          {{fault.id},
           {fault.description},
           {fault.case_id},
           {fault.row.empty() ? "na" : fault.row},
           {graded ? two_digits(fault.error) : "na"},
           {graded ? two_digits(fault.tolerance) : "na"},
           {graded ? two_digits(fault.error / fault.tolerance) : "na"},
           {fault.twin_passed ? "passes" : "DOES NOT PASS", fault.twin_passed ? Tone::plain : Tone::bad, ""},
           {fault.caught ? "caught" : "NOT CAUGHT", fault.caught ? Tone::good : Tone::bad, ""},
           {fault.note}});
    }
    page_.table(table);
    page_.end();
  }

  void figures() {
    chapter("Figures");
    for (const std::string& problem : in_.figures.problems) page_.paragraph(problem, Tone::warning);
    if (in_.figures.drawn.empty()) page_.paragraph("No figure was drawn.");
    for (const Picture& picture : in_.figures.drawn) page_.picture(picture);
    page_.end();
  }

  void provenance() {
    chapter("Provenance");
    Facts facts = in_.provenance;
    facts.emplace_back("rays_hash", in_.hashes.rays);
    facts.emplace_back("report_hash", in_.hashes.report);
    page_.facts(facts);
    if (!in_.configuration.empty()) page_.listing(in_.configuration);
    page_.end();
  }

  const Contents& in_;
  Page& page_;
};

}  // namespace

void compose(const Contents& contents, Page& page) { Composer(contents, page).compose(); }

std::string case_anchor(const CaseResult& result) { return "case-" + slug(result.info.id); }

}  // namespace xpr
