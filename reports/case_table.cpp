#include "reports/case_table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "reports/digest.hpp"
#include "reports/meaningful.hpp"

namespace xpr {
namespace {

/// The place down to which value and reference are printed.
double resolution(const Row& row) {
  if (!std::isfinite(row.error) || row.error <= 0.0) return row.tolerance;
  return row.tolerance > 0.0 ? std::min(row.error, row.tolerance) : row.error;
}

Tone tone_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass:
      return Tone::good;
    case Verdict::fail:
    case Verdict::error:
      return Tone::bad;
    case Verdict::inconclusive:
    case Verdict::skipped:
      break;
  }
  return Tone::warning;
}

/// A column that is lifted above the table where all rows agree.
struct TextColumn {
  std::string title;
  std::function<std::string(const Row&)> text;
};

bool all_agree(const std::vector<Row>& rows, const TextColumn& column) {
  return std::all_of(rows.begin(), rows.end(),
                     [&](const Row& row) { return column.text(row) == column.text(rows.front()); });
}

}  // namespace

std::string value_text(const Row& row) { return measured(row) ? meaningful(row.value, resolution(row)) : "na"; }

std::string reference_text(const Row& row) { return measured(row) ? meaningful(row.reference, resolution(row)) : "na"; }

std::string error_text(const Row& row, double error) { return measured(row) ? two_digits(error) : "na"; }

std::string where(const Row& row) {
  std::string text;
  for (const std::string* part : {&row.metric, &row.chart, &row.method}) {
    if (!part->empty()) text += (text.empty() ? "" : ", ") + *part;
  }
  if (row.setting > 0.0) text += " at " + shortest(row.setting);
  return text;
}

std::string reason_and_note(const Row& row) {
  if (row.note.empty() || row.tolerance_reason.empty()) return row.tolerance_reason + row.note;
  return row.tolerance_reason + "; " + row.note;
}

std::string verdict_word(Verdict verdict) {
  std::string word(to_string(verdict));
  if (verdict == Verdict::pass) return word;
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return word;
}

Cell verdict_cell(const Row& row) { return {verdict_word(row.verdict), tone_of(row.verdict), ""}; }

CaseTable case_table(const CaseResult& result) {
  const CaseInfo& info = result.info;
  const std::vector<Row>& rows = result.rows;
  CaseTable out;
  out.facts = {{"truth", info.truth}, {"rank", std::string(to_string(info.rank))}};
  if (!info.grades_metric) out.facts.emplace_back("grades", "a stepper or the harness, no metric");
  if (!info.cites.empty()) out.facts.emplace_back("cites", info.cites);
  if (!info.source.empty()) out.facts.emplace_back("defined in", info.source);

  const std::vector<TextColumn> before = {
      {"metric", [](const Row& row) { return row.metric; }},
      {"chart", [](const Row& row) { return row.chart; }},
      {"method", [](const Row& row) { return row.method; }},
      {"tol or step", [](const Row& row) { return row.setting > 0.0 ? shortest(row.setting) : std::string(); }},
      {"unit", [](const Row& row) { return row.unit; }}};
  const std::vector<TextColumn> after = {{"why this tolerance", [](const Row& row) { return row.tolerance_reason; }},
                                         {"note", [](const Row& row) { return row.note; }}};
  std::vector<TextColumn> shown_before;
  std::vector<TextColumn> shown_after;
  for (const auto& [columns, shown] : {std::pair{&before, &shown_before}, std::pair{&after, &shown_after}}) {
    for (const TextColumn& column : *columns) {
      if (rows.empty()) continue;
      if (rows.size() == 1 || !all_agree(rows, column)) {
        shown->push_back(column);
      } else if (!column.text(rows.front()).empty()) {
        out.facts.emplace_back(column.title, column.text(rows.front()));
      }
    }
  }

  out.table.columns = {{"row"}};
  for (const TextColumn& column : shown_before) out.table.columns.push_back({column.title});
  for (const char* title : {"value", "reference", "abs. error", "rel. error", "truth error", "tolerance"}) {
    out.table.columns.push_back({title, true});
  }
  out.table.columns.push_back({"rank"});
  out.table.columns.push_back({"verdict"});
  for (const TextColumn& column : shown_after) out.table.columns.push_back({column.title});
  for (const Row& row : rows) {
    std::vector<Cell> cells{{row.label}};
    for (const TextColumn& column : shown_before) cells.push_back({column.text(row)});
    cells.push_back({value_text(row)});
    cells.push_back({reference_text(row)});
    cells.push_back({error_text(row, row.error)});
    cells.push_back({two_digits_or_na(relative_error(row))});
    cells.push_back({error_text(row, row.reference_error)});
    cells.push_back({error_text(row, row.tolerance)});
    cells.push_back({std::string(to_string(info.rank))});
    cells.push_back(verdict_cell(row));
    for (const TextColumn& column : shown_after) cells.push_back({column.text(row)});
    out.table.rows.push_back(std::move(cells));
  }
  return out;
}

}  // namespace xpr
