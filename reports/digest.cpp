#include "reports/digest.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "reports/meaningful.hpp"

namespace xpr {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t worst_rows_kept = 10;

RatioTail tail_of(std::vector<double> ratios) {
  RatioTail tail{static_cast<std::int64_t>(ratios.size()), not_a_number, not_a_number, not_a_number};
  if (ratios.empty()) return tail;
  std::sort(ratios.begin(), ratios.end());
  const std::size_t n = ratios.size();
  tail.median = n % 2 == 1 ? ratios[n / 2] : 0.5 * (ratios[n / 2 - 1] + ratios[n / 2]);
  tail.p99 = ratios[static_cast<std::size_t>(std::ceil(0.99 * static_cast<double>(n))) - 1];
  tail.max = ratios.back();
  return tail;
}

void add(Counts& total, const Counts& more) {
  total.pass += more.pass;
  total.fail += more.fail;
  total.inconclusive += more.inconclusive;
  total.error += more.error;
  total.skipped += more.skipped;
}

void add(Counts& total, Verdict verdict) {
  CaseResult one;
  one.rows.emplace_back().verdict = verdict;
  add(total, count(one));
}

bool worse(const Row& a, const Row& b) { return error_over_tolerance(a) > error_over_tolerance(b); }

/// The rows with a ratio, worst first; ties stay in suite order.
std::vector<RowOfCase> by_ratio(std::vector<RowOfCase> rows) {
  std::erase_if(rows, [](const RowOfCase& at) { return std::isnan(error_over_tolerance(*at.row)); });
  std::stable_sort(rows.begin(), rows.end(),
                   [](const RowOfCase& a, const RowOfCase& b) { return worse(*a.row, *b.row); });
  return rows;
}

std::vector<RowOfCase> rows_of(const CaseResult& result) {
  std::vector<RowOfCase> rows;
  for (const Row& row : result.rows) rows.push_back({&result, &row});
  return rows;
}

RatioTail tail_of_rows(const std::vector<RowOfCase>& ranked) {
  std::vector<double> ratios;
  for (const RowOfCase& at : ranked) ratios.push_back(error_over_tolerance(*at.row));
  return tail_of(std::move(ratios));
}

std::vector<FamilyDigest> families_of(const SuiteResult& suite) {
  std::vector<FamilyDigest> families;
  for (const CaseResult& result : suite.cases) {
    auto family = std::find_if(families.begin(), families.end(),
                               [&](const FamilyDigest& known) { return known.name == result.info.family; });
    if (family == families.end())
      family = families.insert(families.end(), FamilyDigest{result.info.family, {}, {}, {}, {}});
    const std::vector<RowOfCase> ranked = by_ratio(rows_of(result));
    family->cases.push_back(
        {&result, count(result), tail_of_rows(ranked), ranked.empty() ? nullptr : ranked.front().row});
    add(family->counts, count(result));
  }
  for (FamilyDigest& family : families) {
    std::vector<RowOfCase> rows;
    for (const CaseDigest& one : family.cases) {
      const std::vector<RowOfCase> more = rows_of(*one.result);
      rows.insert(rows.end(), more.begin(), more.end());
    }
    rows = by_ratio(std::move(rows));
    family.tail = tail_of_rows(rows);
    if (!rows.empty()) family.worst = rows.front();
  }
  return families;
}

Outcome outcome_of(const SuiteResult& suite, const Counts& counts) {
  switch (exit_code(suite)) {
    case 3:
      return Outcome::error;
    case 1:
      return Outcome::failed;
    case 4:
      return Outcome::inconclusive;
    default:
      break;
  }
  if (counts.pass > 0) return Outcome::passed;
  const bool only_sweeps = suite.cases.empty() && suite.faults.empty() && !suite.sweeps.empty();
  return only_sweeps ? Outcome::swept : Outcome::nothing_graded;
}

/// "2 quantities, 8 series, 64 points; nothing is graded": a series is one method's errors over its settings.
std::string swept_in_words(const std::vector<Sweep>& sweeps) {
  std::set<std::tuple<std::string, std::string, std::string, std::string>> series;
  std::size_t points = 0;
  for (const Sweep& sweep : sweeps) {
    points += sweep.points.size();
    for (const SweepPoint& point : sweep.points) {
      series.emplace(sweep.quantity, point.metric, point.chart, point.method);
    }
  }
  const auto number = [](std::size_t n) { return static_cast<std::int64_t>(n); };
  const std::string quantities = sweeps.size() == 1 ? "1 quantity" : grouped(number(sweeps.size())) + " quantities";
  return fmt::format("{}, {} series, {}; nothing is graded", quantities, grouped(number(series.size())),
                     counted(number(points), "point"));
}

std::string sentence_of(const SuiteResult& suite, const Digest& digest) {
  const Counts& counts = digest.counts;
  const std::int64_t graded = counts.total() - counts.skipped;
  std::vector<std::string> parts;
  const auto say = [&parts](std::int64_t number, std::string text) {
    if (number > 0) parts.push_back(std::move(text));
  };
  const auto of_graded = [graded](std::int64_t number) {
    return fmt::format("{} of {}", grouped(number), counted(graded, "graded row"));
  };
  if (counts.pass == graded) {
    say(graded, graded == 1
                    ? "the one graded row lies within tolerance of its reference"
                    : fmt::format("all {} lie within tolerance of their references", counted(graded, "graded row")));
  } else {
    say(counts.fail, of_graded(counts.fail) + " out of tolerance");
    say(counts.error, of_graded(counts.error) + " not measured, in error");
    say(counts.inconclusive, of_graded(counts.inconclusive) + " undecided, the truth too uncertain");
  }
  const auto faults = static_cast<std::int64_t>(suite.faults.size());
  const auto missed = static_cast<std::int64_t>(digest.missed_faults.size());
  if (missed == 0) {
    say(faults, fmt::format("all {} caught", counted(faults, "planted fault")));
  } else {
    say(missed, fmt::format("{} of {} UNNOTICED", missed, counted(faults, "planted fault")));
  }
  say(counts.skipped, counted(counts.skipped, "row") + " SKIPPED");
  std::string sentence = to_string(digest.outcome);
  if (digest.outcome == Outcome::swept) parts.push_back(swept_in_words(suite.sweeps));
  if (parts.empty()) parts.emplace_back("no row was graded");
  for (std::size_t i = 0; i < parts.size(); ++i) sentence += (i == 0 ? ": " : "; ") + parts[i];
  return sentence + ".";
}

}  // namespace

const char* to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::passed:
      return "PASSED";
    case Outcome::failed:
      return "FAILED";
    case Outcome::error:
      return "ERROR";
    case Outcome::inconclusive:
      return "INCONCLUSIVE";
    case Outcome::swept:
      return "CONVERGENCE SWEEP";
    case Outcome::nothing_graded:
      break;
  }
  return "NOTHING GRADED";
}

bool measured(const Row& row) {
  if (row.verdict != Verdict::error) return row.verdict != Verdict::skipped;
  // judge() calls a row an error only for a number that is not finite or a tolerance that is no tolerance; with usable
  // numbers, or none, the measurement itself broke off.
  const bool finite = std::isfinite(row.value) && std::isfinite(row.reference) && std::isfinite(row.reference_error);
  return !finite || (!(row.tolerance > 0.0) && (row.value != 0.0 || row.reference != 0.0));
}

double error_over_tolerance(const Row& row) {
  if (!measured(row) || !(row.tolerance > 0.0)) return not_a_number;
  return std::isfinite(row.error) ? row.error / row.tolerance : std::numeric_limits<double>::infinity();
}

double relative_error(const Row& row) {
  if (!measured(row) || row.reference == 0.0) return not_a_number;
  return row.error / std::abs(row.reference);
}

std::string base_method(const std::string& method) { return method.substr(0, method.find('+')); }

std::string counts_in_words(const Counts& counts) {
  std::string words;
  const auto say = [&words](std::int64_t number, const char* what) {
    if (number > 0) words += fmt::format("{}{} {}", words.empty() ? "" : ", ", grouped(number), what);
  };
  say(counts.pass, "passed");
  say(counts.fail, "FAILED");
  say(counts.error, "in ERROR");
  say(counts.inconclusive, "INCONCLUSIVE");
  say(counts.skipped, "SKIPPED");
  return words.empty() ? "no rows" : words;
}

Digest digest(const SuiteResult& suite) {
  Digest result;
  result.counts = count(suite);
  result.families = families_of(suite);
  std::vector<RowOfCase> all;
  for (const CaseResult& one : suite.cases) {
    const std::vector<RowOfCase> rows = rows_of(one);
    all.insert(all.end(), rows.begin(), rows.end());
  }
  for (const Verdict verdict : {Verdict::fail, Verdict::error, Verdict::inconclusive}) {
    const auto first = static_cast<std::ptrdiff_t>(result.failures.size());
    for (const RowOfCase& at : all) {
      if (at.row->verdict == verdict) result.failures.push_back(at);
    }
    // A row without a ratio (an exception) sorts with the worst.
    const auto badness = [](const RowOfCase& at) {
      const double ratio = error_over_tolerance(*at.row);
      return std::isnan(ratio) ? std::numeric_limits<double>::infinity() : ratio;
    };
    std::stable_sort(result.failures.begin() + first, result.failures.end(),
                     [&](const RowOfCase& a, const RowOfCase& b) { return badness(a) > badness(b); });
  }
  for (const RowOfCase& at : all) {
    if (at.row->verdict == Verdict::skipped) result.skipped.push_back(at);
  }
  result.worst = by_ratio(all);
  if (result.worst.size() > worst_rows_kept) result.worst.resize(worst_rows_kept);
  for (const FaultResult& fault : suite.faults) {
    if (!fault.caught) result.missed_faults.push_back(&fault);
  }
  result.outcome = outcome_of(suite, result.counts);
  result.sentence = sentence_of(suite, result);
  return result;
}

Coverage coverage(const SuiteResult& suite, std::vector<ChartName> charts, std::vector<std::string> methods) {
  Coverage matrix{std::move(charts), std::move(methods), {}};
  const auto index = [](auto& known, const auto& wanted) {
    const auto at = std::find(known.begin(), known.end(), wanted);
    const auto position = static_cast<std::size_t>(at - known.begin());
    if (at == known.end()) known.push_back(wanted);
    return position;
  };
  const auto visit = [&](const auto& each) {
    for (const CaseResult& result : suite.cases) {
      for (const Row& row : result.rows) {
        each(ChartName{row.metric, row.chart}, base_method(row.method),
             [&row](CoverageCell& cell) { add(cell.counts, row.verdict); });
      }
    }
    for (const Sweep& sweep : suite.sweeps) {
      for (const SweepPoint& point : sweep.points) {
        each(ChartName{point.metric, point.chart}, base_method(point.method),
             [](CoverageCell& cell) { ++cell.sweep_points; });
      }
    }
  };
  visit([&](const ChartName& chart, const std::string& method, const auto&) {
    if (chart.metric.empty()) return;  // grades no spacetime
    index(matrix.charts, chart);
    index(matrix.methods, method);
  });
  matrix.cells.assign(matrix.charts.size(), std::vector<CoverageCell>(matrix.methods.size()));
  visit([&](const ChartName& chart, const std::string& method, const auto& count_it) {
    if (chart.metric.empty()) return;
    count_it(matrix.cells[index(matrix.charts, chart)][index(matrix.methods, method)]);
  });
  return matrix;
}

}  // namespace xpr
