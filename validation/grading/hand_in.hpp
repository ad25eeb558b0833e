// What another code hands in: a table with one row for each ray of a challenge set.
//
//   id, x0..x3                                      needed: the event at which the code ended, in the chart agreed on
//   p0..p3, status, sheet, lambda                   graded where they are there (p covariant)
//   steps, rejected, evaluations, seconds           work, for work against precision
//   null_residual, null_residual_max                read over: the residual is computed from p
//
// It is what `xprimeray trace` writes, and less. Rows come in any order; nan stands for what a code could not do.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/io/table.hpp"
#include "integrators/status.hpp"
#include "validation/grading/challenge.hpp"

namespace xpr {

struct HandedRay {
  Status status = Status::outside_domain;  ///< meaningless without a column of them
  int sheet = 1;
  PhaseState<double> end;
  double lambda = 0.0;
};

struct HandIn {
  std::string file;
  std::string chart;
  std::vector<HandedRay> rays;  ///< ray k of the set at place k
  bool has_status = false;
  bool has_momentum = false;
  bool has_lambda = false;
  /// Mean of the first of these columns that is there: evaluations, steps + rejected, seconds; NaN without any.
  double work = 0.0;
  std::string work_unit;
};

/// The columns that may be handed in.
[[nodiscard]] TableSchema hand_in_schema();

/// Reads a table that has to hold each of the first `count` rays of a set once. Throws InputError for one that is
/// malformed, has a ray twice, lacks some, or holds rays of another set, chart or spacetime.
[[nodiscard]] HandIn read_hand_in(const std::filesystem::path& path, const ChallengeSet& set, std::int64_t count,
                                  const std::string& chart);

}  // namespace xpr
