// What a reader wants to know of a suite before its numbers: one verdict, counts, what failed, tails, coverage.
// Everything here points into the SuiteResult it was made from, which must outlive it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "validation/result.hpp"

namespace xpr {

/// A row and the case it belongs to.
struct RowOfCase {
  const CaseResult* result = nullptr;
  const Row* row = nullptr;
};

/// Distribution of error / tolerance over the rows that have both; NaN where there are none.
struct RatioTail {
  std::int64_t rows = 0;
  double median = 0.0;
  double p99 = 0.0;  ///< nearest rank
  double max = 0.0;
};

/// A case with its counts, its tail and its worst row (null where no row has an error and a tolerance).
struct CaseDigest {
  const CaseResult* result = nullptr;
  Counts counts;
  RatioTail tail;
  const Row* worst = nullptr;
};

struct FamilyDigest {
  std::string name;
  Counts counts;
  RatioTail tail;
  RowOfCase worst;
  std::vector<CaseDigest> cases;
};

/// A metric in a chart: a line of the coverage matrix.
struct ChartName {
  std::string metric;
  std::string chart;
  friend bool operator==(const ChartName&, const ChartName&) = default;
};

struct CoverageCell {
  Counts counts;
  std::int64_t sweep_points = 0;
};

/// Charts x methods, with every combination present whether or not something graded it. Projections ("+full") count
/// under their method; the method "" stands for rows in which nothing is stepped.
struct Coverage {
  std::vector<ChartName> charts;
  std::vector<std::string> methods;
  std::vector<std::vector<CoverageCell>> cells;  ///< [chart][method]
};

/// `swept`: a convergence sweep by itself, which measures and grades nothing.
enum class Outcome { passed, failed, error, inconclusive, nothing_graded, swept };
[[nodiscard]] const char* to_string(Outcome outcome);  ///< "PASSED", "FAILED", ...

struct Digest {
  Outcome outcome = Outcome::nothing_graded;
  std::string sentence;  ///< the verdict in one sentence, with counts
  Counts counts;
  std::vector<FamilyDigest> families;  ///< in the order in which they first appear
  std::vector<RowOfCase> failures;     ///< fail, then error, then inconclusive; worst error / tolerance first in each
  std::vector<RowOfCase> skipped;
  std::vector<RowOfCase> worst;                   ///< the ten largest error / tolerance of all
  std::vector<const FaultResult*> missed_faults;  ///< planted and not caught
};

[[nodiscard]] Digest digest(const SuiteResult& suite);

/// `charts` and `methods` are those that exist, in the order to print; what the rows add to them is appended.
[[nodiscard]] Coverage coverage(const SuiteResult& suite, std::vector<ChartName> charts,
                                std::vector<std::string> methods);

/// Whether a row holds a measurement at all: a skipped row, or one that ended in an exception, holds none, and its
/// zeros must not be printed or stored as numbers.
[[nodiscard]] bool measured(const Row& row);

/// error / tolerance; NaN where the row has no such number, infinity where the error itself is not finite.
[[nodiscard]] double error_over_tolerance(const Row& row);

/// error / |reference|; NaN where the reference is zero or nothing was measured.
[[nodiscard]] double relative_error(const Row& row);

/// "dopri54+full" -> "dopri54".
[[nodiscard]] std::string base_method(const std::string& method);

/// "3 passed, 1 FAILED, 2 skipped": all five verdicts, those without rows left out.
[[nodiscard]] std::string counts_in_words(const Counts& counts);

}  // namespace xpr
