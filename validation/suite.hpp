// Running cases: which ones, on how many threads, and the self-test that plants faults under them.
//
// Results are ordered as the cases are and do not depend on the number of threads. Wall times are recorded beside the
// rows and are no part of them.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "validation/case.hpp"
#include "validation/result.hpp"

namespace xpr {

/// Which cases to run.
struct Selection {
  std::string suite = "quick";             ///< see suite_names()
  std::vector<std::string> globs = {};     ///< case ids, with * and ?; empty: all
  std::vector<std::string> contains = {};  ///< words that id, claim or citations must contain, every one of them
};

/// quick, full, metrics (every case that grades a metric) and the families: what --suite takes.
[[nodiscard]] std::vector<std::string> suite_names(std::span<const Case> all);

/// How large the bundles are: the full size in every suite but `quick`.
[[nodiscard]] SuiteSize suite_size(const Selection& selection);

/// The selected cases in their order. A glob that matches no case of `all` throws std::invalid_argument, as an unknown
/// suite does, naming the nearest known one.
[[nodiscard]] std::vector<const Case*> select_cases(std::span<const Case> all, const Selection& selection);

/// Whether `text` matches `pattern`, in which * stands for any run of characters and ? for any one.
[[nodiscard]] bool matches_glob(std::string_view pattern, std::string_view text);

/// Where a run stands, told after each piece of work.
struct Progress {
  std::size_t done = 0;
  std::size_t total = 0;
  std::string_view last;  ///< what was finished last
  double elapsed_seconds = 0.0;
  double remaining_seconds = 0.0;  ///< extrapolated from what is done
};

struct SuiteOptions {
  int threads = 0;                                     ///< 0: as many as the machine has
  std::function<void(const Progress&)> progress = {};  ///< called under a lock, from whichever thread finished
  std::stop_token stop = {};                           ///< when requested, cases not yet begun are left out
};

/// Runs cases; an exception in one becomes an `error` row of it.
[[nodiscard]] std::vector<CaseResult> run_cases(std::span<const Case* const> selected, SuiteSize size,
                                                const SuiteOptions& options = {});

/// run_cases under the name of its suite.
[[nodiscard]] SuiteResult run_suite(const Selection& selection, const SuiteOptions& options = {});

/// Plants each fault under its case and says whether it was caught: a row with verdict `fail` and finite error > 10 x
/// tolerance whose unbroken twin passes in the same run (DESIGN section 5). `all` is where cases are looked up; a fault
/// that names no case of it is not caught, and its note says so. `twins` are unbroken results of the same run and size,
/// where there are some already; cases that are missing from them are run.
[[nodiscard]] std::vector<FaultResult> run_self_test(std::span<const Fault> planted, std::span<const Case> all,
                                                     SuiteSize size, const SuiteOptions& options = {},
                                                     std::span<const CaseResult> twins = {});

}  // namespace xpr
