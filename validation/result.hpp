// What the suite finds, as plain data: rows, verdicts, sweeps, planted faults. Reports lay it out; nothing here knows
// how.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace xpr {

/// Where a reference value comes from, best first (DESIGN section 5). The last two alone never turn a case that grades
/// a metric green.
enum class TruthRank {
  closed_form,
  high_precision,  ///< independent computation, separately written
  published_table,
  digitised_plot,
  same_source,  ///< our own metric at 50 digits: grades steppers only
  self_convergence,
};

enum class Verdict { pass, fail, inconclusive, error, skipped };

[[nodiscard]] std::string_view to_string(TruthRank rank);
[[nodiscard]] std::string_view to_string(Verdict verdict);

/// A named input of a row, such as b/M.
struct RowParameter {
  std::string name;
  double value = 0.0;
  std::string unit = "1";  ///< UDUNITS spelling
};

/// One graded number.
struct Row {
  std::string label;  ///< unique within its case; what a person reads
  std::vector<RowParameter> parameters;
  std::string metric;
  std::string chart;
  std::string method;    ///< method id, with "+full" etc. where projected; empty where nothing is stepped
  double setting = 0.0;  ///< tol or step; 0 where there is none
  std::string unit = "1";
  double value = 0.0;
  double reference = 0.0;
  double reference_error = 0.0;  ///< absolute error of the truth itself
  double error = 0.0;            ///< |value - reference|, in `unit` (a one-sided claim states its own)
  double tolerance = 0.0;
  std::string tolerance_reason;
  Verdict verdict = Verdict::error;
  std::string note;  ///< why skipped or in error; what a reader should know
  std::int64_t evaluations = 0;
};

/// A case as it is listed and explained, before it is run.
struct CaseInfo {
  std::string id;  ///< "family/name", as in `--case schwarzschild/deflection`
  std::string family;
  std::string claim;    ///< one sentence that the rows make true or false
  std::string physics;  ///< the formula and how it is measured, for `explain`
  std::string truth;    ///< where the reference values come from
  TruthRank rank = TruthRank::closed_form;
  bool grades_metric = true;  ///< false: grades a stepper or the harness
  std::string cites;          ///< keys of references.bib, separated by spaces
  std::string source;         ///< the file that defines it, from the repository root
};

struct CaseResult {
  CaseInfo info;
  std::vector<Row> rows;
  std::string
      transported{};     ///< digest of the ends of all rays that the case traced, in order: the same on every machine
  double seconds = 0.0;  ///< wall time: volatile, never hashed
};

/// One point of a convergence or work-precision sweep: statistics over a bundle of rays.
struct SweepPoint {
  std::string metric;
  std::string chart;
  std::string method;
  bool adaptive = false;
  double setting = 0.0;  ///< tol (adaptive) or step
  std::int64_t rays = 0;
  double error_median = 0.0;
  double error_p99 = 0.0;
  double error_max = 0.0;
  double error_norm = 0.0;  ///< root mean square over the rays: what orders are read from
  double truth_error = 0.0;
  double null_drift_max = 0.0;
  double evaluations_per_ray = 0.0;
  double steps_per_ray = 0.0;
  double seconds_per_ray = 0.0;   ///< volatile, never hashed
  double observed_order = 0.0;    ///< between this point and the previous one; NaN at the first
  double richardson_error = 0.0;  ///< error estimate from the last two or three points (GCI); NaN where not defined
  std::string convergence;        ///< "monotone", "oscillatory", "divergent", "round-off", "" at the first points
};

struct Sweep {
  std::string quantity;  ///< what the error is of
  std::string unit = "1";
  TruthRank rank = TruthRank::closed_form;
  std::vector<SweepPoint> points;
};

/// A fault planted on purpose, and what became of it.
struct FaultResult {
  std::string id;
  std::string description;
  std::string case_id;  ///< that was asked to catch it
  std::string row;      ///< the row with the largest error/tolerance
  double error = 0.0;
  double tolerance = 0.0;
  bool twin_passed = false;  ///< the unbroken case, same rows, same run
  bool caught = false;       ///< verdict fail with finite error > 10 x tolerance while the twin passes
  std::string note;
};

struct SuiteResult {
  std::string suite;  ///< "quick", "full", ...
  std::vector<CaseResult> cases;
  std::vector<Sweep> sweeps;
  std::vector<FaultResult> faults;
};

struct Counts {
  std::int64_t pass = 0, fail = 0, inconclusive = 0, error = 0, skipped = 0;
  [[nodiscard]] std::int64_t total() const { return pass + fail + inconclusive + error + skipped; }
};
[[nodiscard]] Counts count(const CaseResult& result);
[[nodiscard]] Counts count(const SuiteResult& result);

/// The exit code of a graded run (DESIGN section 8): 3 for errors, 1 for failures, 4 for inconclusive truth, else 0.
[[nodiscard]] int exit_code(const SuiteResult& result);

/// Fills error and verdict: pass only where |value - reference| + |reference_error| <= tolerance; inconclusive where
/// the truth's own error exceeds a tenth of the tolerance; error where value or reference is not finite.
void judge(Row& row);

}  // namespace xpr
