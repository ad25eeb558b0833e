#include "validation/result.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace xpr {

std::string_view to_string(TruthRank rank) {
  constexpr std::array<std::string_view, 6> names = {"closed form",     "independent high precision",
                                                     "published table", "digitised plot",
                                                     "same source",     "self-convergence"};
  return names[static_cast<std::size_t>(rank)];
}

std::string_view to_string(Verdict verdict) {
  constexpr std::array<std::string_view, 5> names = {"pass", "fail", "inconclusive", "error", "skipped"};
  return names[static_cast<std::size_t>(verdict)];
}

Counts count(const CaseResult& result) {
  Counts counts;
  for (const Row& row : result.rows) {
    switch (row.verdict) {
      case Verdict::pass:
        ++counts.pass;
        break;
      case Verdict::fail:
        ++counts.fail;
        break;
      case Verdict::inconclusive:
        ++counts.inconclusive;
        break;
      case Verdict::error:
        ++counts.error;
        break;
      case Verdict::skipped:
        ++counts.skipped;
        break;
    }
  }
  return counts;
}

Counts count(const SuiteResult& result) {
  Counts total;
  for (const CaseResult& one : result.cases) {
    const Counts counts = count(one);
    total.pass += counts.pass;
    total.fail += counts.fail;
    total.inconclusive += counts.inconclusive;
    total.error += counts.error;
    total.skipped += counts.skipped;
  }
  return total;
}

int exit_code(const SuiteResult& result) {
  const Counts counts = count(result);
  bool fault_missed = false;
  for (const FaultResult& fault : result.faults) fault_missed = fault_missed || !fault.caught;
  if (counts.error > 0) return 3;
  if (counts.fail > 0 || fault_missed) return 1;
  if (counts.inconclusive > 0) return 4;
  return 0;
}

void judge(Row& row) {
  row.error = std::abs(row.value - row.reference);
  if (!std::isfinite(row.error) || !std::isfinite(row.reference_error) || !(row.tolerance > 0.0)) {
    row.verdict = Verdict::error;
    if (row.note.empty()) row.note = "a value, its reference or its tolerance is not a usable number";
  } else if (row.error - std::abs(row.reference_error) > row.tolerance) {
    row.verdict = Verdict::fail;
  } else if (std::abs(row.reference_error) > 0.1 * row.tolerance) {
    row.verdict = Verdict::inconclusive;
  } else {
    row.verdict = row.error + std::abs(row.reference_error) <= row.tolerance ? Verdict::pass : Verdict::fail;
  }
}

}  // namespace xpr
