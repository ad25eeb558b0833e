// The rows of one case as a table: value, reference, absolute and relative error, truth's error, tolerance and its
// reason, rank, verdict. What is the same in every row is said once above the table.
#pragma once

#include <string>

#include "reports/page.hpp"
#include "validation/result.hpp"

namespace xpr {

struct CaseTable {
  Facts facts;
  Table table;
};

[[nodiscard]] CaseTable case_table(const CaseResult& result);

/// Numbers of a row with the digits that mean something: those down to its error or its tolerance, whichever is
/// smaller, so that value and reference never print alike where they differ. "na" where nothing was measured.
[[nodiscard]] std::string value_text(const Row& row);
[[nodiscard]] std::string reference_text(const Row& row);
/// An error or a tolerance of a row, to two digits.
[[nodiscard]] std::string error_text(const Row& row, double error);

/// "kerr, kerr-schild, dop853 at 1e-10": where and how a row was measured.
[[nodiscard]] std::string where(const Row& row);
[[nodiscard]] std::string reason_and_note(const Row& row);
/// The verdict, in capitals unless it is a pass.
[[nodiscard]] Cell verdict_cell(const Row& row);
[[nodiscard]] std::string verdict_word(Verdict verdict);

}  // namespace xpr
