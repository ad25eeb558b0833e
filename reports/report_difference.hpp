// Two reports of the suite, row by row: what is new, what is gone, whose verdict or number moved.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace xpr {

/// A row that both reports have and that they tell differently.
struct RowChange {
  std::string row;  ///< "kerr/deflection: b = 6 M, ..."
  std::string verdict_before, verdict_after;
  double value_before = 0.0, value_after = 0.0;
  double error_before = 0.0, error_after = 0.0;  ///< over the row's tolerance
};

struct ReportDifference {
  std::string hash_before, hash_after;  ///< report_hash
  std::string rays_before, rays_after;  ///< rays_hash
  std::int64_t rows = 0;                ///< that both have
  std::vector<std::string> gone, added;
  std::vector<RowChange> verdicts;  ///< other verdict
  std::vector<RowChange> values;    ///< same verdict, other bits of the value; the largest change over tolerance first

  /// No row is gone or new, no verdict moved.
  [[nodiscard]] bool same_verdicts() const { return gone.empty() && added.empty() && verdicts.empty(); }
};

/// Compares report.h5, or paper.h5, of two report directories. Throws InputError for what is no report.
[[nodiscard]] ReportDifference compare_reports(const std::filesystem::path& before, const std::filesystem::path& after);

/// Whether there is a report in that directory.
[[nodiscard]] bool has_report(const std::filesystem::path& directory);

/// For people: a few lines, the first `most` changes of each kind by name.
[[nodiscard]] std::string difference_text(const ReportDifference& difference, std::size_t most);

}  // namespace xpr
