#include "validation/suite.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>

#include <fmt/core.h>

#include "metrics/catalogue.hpp"

namespace xpr {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// Calls work(i) for every i below `count` from a few threads, and reports progress under a lock.
void for_each_index(std::size_t count, const SuiteOptions& options, const std::function<void(std::size_t)>& work,
                    const std::function<std::string_view(std::size_t)>& name) {
  std::atomic<std::size_t> next{0};
  std::mutex reporting;
  std::size_t done = 0;
  const Clock::time_point begin = Clock::now();
  const auto worker = [&] {
    for (std::size_t i = next++; i < count && !options.stop.stop_requested(); i = next++) {
      work(i);
      const std::scoped_lock lock(reporting);
      ++done;
      if (!options.progress) continue;
      const double elapsed = seconds_since(begin);
      const double each = elapsed / static_cast<double>(done);
      options.progress({done, count, name(i), elapsed, each * static_cast<double>(count - done)});
    }
  };
  const unsigned wanted =
      options.threads > 0 ? static_cast<unsigned>(options.threads) : std::max(1U, std::thread::hardware_concurrency());
  std::vector<std::jthread> pool;
  for (std::size_t i = 1; i < std::min<std::size_t>(wanted, count); ++i) pool.emplace_back(worker);
  worker();
}

/// The rows of one case under a lab; what was thrown becomes a row.
CaseResult run_one(const Case& one, const Lab& lab) {
  CaseResult result{.info = one.info, .rows = {}, .transported = {}, .seconds = 0.0};
  CanonicalHash transported;
  const Clock::time_point begin = Clock::now();
  Row broken;
  broken.label = "run";
  try {
    result.rows = one.run(lab.recording(transported.dataset("rays")));
    broken.note = "the case made no rows";
  } catch (const std::exception& problem) {
    result.rows.clear();
    broken.note = fmt::format("exception: {}", problem.what());
  }
  result.transported = transported.hex();
  if (result.rows.empty()) result.rows.push_back(std::move(broken));
  result.seconds = seconds_since(begin);
  return result;
}

bool known(std::span<const std::string> names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

[[noreturn]] void refuse(std::string_view what, std::string_view given, std::span<const std::string> names) {
  const std::vector<std::string_view> views(names.begin(), names.end());
  const std::string near = nearest_name(given, views);
  throw std::invalid_argument(near.empty() ? fmt::format("unknown {} '{}'", what, given)
                                           : fmt::format("unknown {} '{}'; did you mean '{}'?", what, given, near));
}

bool in_suite(const Case& one, std::string_view suite) {
  if (suite == "full") return true;
  if (suite == "quick") return one.quick;
  if (suite == "metrics") return one.info.grades_metric;
  return one.info.family == suite;
}

bool mentions(const CaseInfo& info, std::string_view word) {
  return info.id.find(word) != std::string::npos || info.claim.find(word) != std::string::npos ||
         info.cites.find(word) != std::string::npos;
}

/// Error over tolerance: how far above what is allowed; not finite where the row is no number.
double excess(const Row& row) {
  return row.tolerance > 0.0 ? row.error / row.tolerance : std::numeric_limits<double>::quiet_NaN();
}

/// Compares a broken run with its twin, row by row, and keeps the row that speaks loudest.
void look_for_catch(FaultResult& result, const CaseResult& broken, const CaseResult& twin) {
  std::map<std::string_view, Verdict> verdict_of_twin;
  for (const Row& row : twin.rows) verdict_of_twin[row.label] = row.verdict;
  double largest = -1.0;
  for (const Row& row : broken.rows) {
    const auto unbroken = verdict_of_twin.find(row.label);
    const bool twin_passed = unbroken != verdict_of_twin.end() && unbroken->second == Verdict::pass;
    const double ratio = excess(row);
    const bool caught = row.verdict == Verdict::fail && std::isfinite(row.error) && ratio > 10.0 && twin_passed;
    if (!std::isfinite(ratio) || (result.caught && !caught)) continue;
    if (caught == result.caught && ratio <= largest) continue;
    largest = ratio;
    result.row = row.label;
    result.error = row.error;
    result.tolerance = row.tolerance;
    result.twin_passed = twin_passed;
    result.caught = caught;
    result.note = row.note;
  }
  if (result.caught) return;
  const bool threw = broken.rows.size() == 1 && broken.rows[0].verdict == Verdict::error;
  if (threw) {
    result.note = fmt::format("not caught: {}, and an exception is no catch", broken.rows[0].note);
  } else if (largest < 0.0) {
    result.note = "not caught: no row has a finite error";
  } else if (!result.twin_passed) {
    result.note = "not caught: the unbroken twin of the loudest row does not pass either";
  } else {
    result.note = "not caught: no row fails by more than 10 times its tolerance";
  }
}

}  // namespace

bool matches_glob(std::string_view pattern, std::string_view text) {
  std::size_t p = 0;
  std::size_t t = 0;
  std::size_t star = std::string_view::npos;
  std::size_t resume = 0;
  while (t < text.size()) {
    if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t]) && pattern[p] != '*') {
      ++p;
      ++t;
    } else if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++resume;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

std::vector<std::string> suite_names(std::span<const Case> all) {
  std::vector<std::string> names = {"quick", "full", "metrics"};
  for (const Case& one : all) {
    if (!known(names, one.info.family)) names.push_back(one.info.family);
  }
  return names;
}

SuiteSize suite_size(const Selection& selection) {
  return selection.suite == "quick" ? SuiteSize::quick : SuiteSize::full;
}

std::vector<const Case*> select_cases(std::span<const Case> all, const Selection& selection) {
  const std::vector<std::string> suites = suite_names(all);
  if (!known(suites, selection.suite)) refuse("suite", selection.suite, suites);
  std::vector<std::string> ids;
  for (const Case& one : all) ids.push_back(one.info.id);
  for (const std::string& glob : selection.globs) {
    if (std::none_of(ids.begin(), ids.end(), [&](const std::string& id) { return matches_glob(glob, id); })) {
      refuse("case", glob, ids);
    }
  }
  std::vector<const Case*> selected;
  for (const Case& one : all) {
    const auto& globs = selection.globs;
    const bool named = globs.empty() || std::any_of(globs.begin(), globs.end(), [&](const std::string& glob) {
                         return matches_glob(glob, one.info.id);
                       });
    const bool mentioned = std::all_of(selection.contains.begin(), selection.contains.end(),
                                       [&](const std::string& word) { return mentions(one.info, word); });
    // A case that is asked for by name runs whether or not it belongs to the quick suite.
    const bool belongs = in_suite(one, selection.suite) || (!globs.empty() && selection.suite == "quick");
    if (named && mentioned && belongs) selected.push_back(&one);
  }
  return selected;
}

std::vector<CaseResult> run_cases(std::span<const Case* const> selected, SuiteSize size, const SuiteOptions& options) {
  std::vector<CaseResult> results(selected.size());
  const Lab lab(size);
  for_each_index(
      selected.size(), options, [&](std::size_t i) { results[i] = run_one(*selected[i], lab); },
      [&](std::size_t i) { return std::string_view(selected[i]->info.id); });
  std::erase_if(results, [](const CaseResult& result) { return result.info.id.empty(); });
  return results;
}

SuiteResult run_suite(const Selection& selection, const SuiteOptions& options) {
  const std::vector<const Case*> selected = select_cases(cases(), selection);
  return {.suite = selection.suite,
          .cases = run_cases(selected, suite_size(selection), options),
          .sweeps = {},
          .faults = {}};
}

std::vector<FaultResult> run_self_test(std::span<const Fault> planted, std::span<const Case> all, SuiteSize size,
                                       const SuiteOptions& options, std::span<const CaseResult> twins) {
  std::map<std::string_view, const Case*> case_of;
  for (const Case& one : all) case_of[one.info.id] = &one;
  // Each twin runs once, before the faults that share it; all are pieces of the same run.
  std::map<std::string_view, const CaseResult*> twin_of;
  for (const CaseResult& result : twins) twin_of[result.info.id] = &result;
  std::vector<const Case*> missing;
  std::set<std::string_view> wanted;
  for (const Fault& fault : planted) {
    const auto found = case_of.find(fault.case_id);
    if (found == case_of.end() || twin_of.contains(fault.case_id)) continue;
    if (wanted.insert(fault.case_id).second) missing.push_back(found->second);
  }
  const std::vector<CaseResult> unbroken = run_cases(missing, size, options);
  for (const CaseResult& result : unbroken) twin_of[result.info.id] = &result;

  std::vector<FaultResult> results(planted.size());
  for_each_index(
      planted.size(), options,
      [&](std::size_t i) {
        const Fault& fault = planted[i];
        FaultResult& result = results[i];
        result.description = fault.description;
        result.case_id = fault.case_id;
        const auto twin = twin_of.find(fault.case_id);
        if (twin == twin_of.end()) {
          result.note = fmt::format("not caught: there is no case '{}'", fault.case_id);
        } else {
          look_for_catch(result, run_one(*case_of.at(fault.case_id), Lab(size, &fault)), *twin->second);
        }
        result.id = fault.id;
      },
      [&](std::size_t i) { return std::string_view(planted[i].id); });
  std::erase_if(results, [](const FaultResult& result) { return result.id.empty(); });
  return results;
}

}  // namespace xpr
