// A paper and what is reproduced of it: claims, each with the number as printed, the exact number, and ours by at least
// two routes; what was not checked; findings, where the paper and the exact number part; a figure in the paper's
// manner.
//
// A paper is one file under papers/ and one line in papers/registry.cpp. It runs as a case of the suite too (family
// "papers"), so that rows, verdicts and planted faults are those of every other case.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "metrics/exact_value.hpp"
#include "validation/case.hpp"
#include "validation/figure.hpp"
#include "validation/kit.hpp"

namespace xpr {

/// A paper as it is listed, before anything is run.
struct PaperInfo {
  std::string id;                             ///< "darwin-1959"
  std::string reference;                      ///< authors, title, journal
  std::string reproduced;                     ///< one sentence: what is reproduced here
  std::string cites;                          ///< keys of references.bib, separated by spaces
  std::vector<std::string> not_checked = {};  ///< what of the paper was not checked, and why
};

/// A quantity of a paper. Its rows grade each route against `exact`, and the printed number too.
struct Claim {
  std::string quantity;
  std::string unit = "1";
  std::string printed;         ///< as printed; empty where no source of a printed number is known
  std::string printed_source;  ///< where that number was read; without `printed`, numbers known from memory only
  bool misprint = false;       ///< the printed number is wrong, and a finding says so with its proof
  ExactValue exact;
  std::string exact_by;
  std::vector<Row> rows;
};

/// Where a paper, a transcription of it or a code that cites it is wrong: the statement with its proof in numbers.
struct PaperFinding {
  std::string where;
  std::string text;
};

struct PaperResult {
  PaperInfo info;
  std::vector<Claim> claims;
  std::vector<PaperFinding> findings;
  Figure figure;
  std::string transported;  ///< digest of the ends of all rays traced
  double seconds = 0.0;     ///< wall time: volatile
};

/// The worst verdict among a claim's rows: error, fail, inconclusive, pass, and skipped where nothing else is. A claim
/// without rows is an error.
[[nodiscard]] Verdict verdict_of(const Claim& claim);
/// Claims by verdict.
[[nodiscard]] Counts count_claims(const PaperResult& result);

/// A number as printed: its value and half a unit of its last digit. Throws std::invalid_argument for what is no
/// number.
struct PrintedNumber {
  double value = 0.0;
  double half_unit = 0.0;
};
[[nodiscard]] PrintedNumber printed_number(std::string_view text);

/// What a traced ray is graded as.
struct TracedRoute {
  const Spacetime& chart;
  MethodAt method;
  const RayEnd& end;
  Status wanted = Status::escaped;
  std::string where = {};  ///< tells apart routes of the same chart and method
};

/// Fills one claim; every call adds a row. Set exact() first.
class ClaimSheet {
 public:
  ClaimSheet(PaperResult& result, std::size_t index) : result_(&result), index_(index) {}

  /// The exact number and what it comes from.
  ClaimSheet& exact(const ExactValue& value, std::string by);
  /// The number as printed, which must agree to `units` of half its last digit (2 where a source cuts digits off).
  ClaimSheet& printed(std::string text, std::string source, double half_units = 1.0);
  /// A printed number that is wrong: the row passes only where the exact number differs by more than half the last
  /// digit, so that a finding that is itself wrong fails.
  ClaimSheet& misprinted(std::string text, std::string source);
  /// A printed number known from memory only: a skipped row, never an oracle.
  ClaimSheet& not_established(std::string text, std::string why);
  /// Ours, by a route that steps nothing.
  ClaimSheet& ours(std::string route, double value, const Tolerance& tolerance);
  /// Ours, from a traced ray; an error where it did not end as wanted.
  ClaimSheet& traced(const TracedRoute& route, double value, const Tolerance& tolerance);
  /// Ours, from many rays (a bisection).
  ClaimSheet& from_rays(std::string route, const Spacetime& chart, const MethodAt& method, double value,
                        const Tolerance& tolerance);
  /// A formula that a source has wrong: passes only where it misses the exact number by more than `least`.
  ClaimSheet& wrong_formula(std::string route, double value, double least, std::string reason);

 private:
  [[nodiscard]] Claim& claim() { return result_->claims[index_]; }
  ClaimSheet& add(Row row, double value, const Tolerance& tolerance);
  PaperResult* result_;
  std::size_t index_;
};

/// What a paper's file writes on.
class PaperSheet {
 public:
  PaperSheet(const Lab& lab, PaperResult& result) : lab_(&lab), result_(&result) {}
  [[nodiscard]] const Lab& lab() const { return *lab_; }
  ClaimSheet claim(std::string quantity, std::string unit = "1");
  void finding(std::string where, std::string text) {
    result_->findings.push_back({std::move(where), std::move(text)});
  }
  Figure& figure() { return result_->figure; }

 private:
  const Lab* lab_;
  PaperResult* result_;
};

/// A wrong formula that can be planted in a paper's own routes (Lab::planted), and which its claims must catch.
struct PlantedFormula {
  std::string id;
  std::string description;
};

struct Paper {
  PaperInfo info;
  void (*run)(PaperSheet& sheet);
  std::vector<PlantedFormula> faults = {};
};

/// All papers, in the order of the catalogue: an explicit list, a line for each.
[[nodiscard]] const std::vector<Paper>& all_papers();

/// The paper of that id. Throws std::invalid_argument naming the nearest known one.
[[nodiscard]] const Paper& find_paper(std::string_view id);

/// Runs one paper; an exception becomes a claim in error.
[[nodiscard]] PaperResult run_paper(const Paper& paper, const Lab& lab);

/// The same as the suite's case results, one for each paper, in family "papers".
[[nodiscard]] CaseResult as_case(const PaperResult& result);

/// Every paper as a case, and the planted faults that they must catch.
[[nodiscard]] std::vector<Case> paper_cases();
[[nodiscard]] std::vector<Fault> paper_faults();

}  // namespace xpr
