// A report card: the scores of one table of rays, their percentiles, and a grade.
//
// Every quantity that was handed in gets a letter from the 99th percentile of its scaled errors (error plus the closed
// form's own, over the ray's condition where that is more than 1):
//   A+ <= 1e-10,  A <= 1e-8,  B <= 1e-6,  C <= 1e-4,  D <= 1e-2,  F otherwise;
// so does the share of rays that failed (nan, wrong status, unfinished, off the ray):
//   A+ and A: none,  B <= 0.1 %,  C <= 1 %,  D <= 10 %,  F otherwise;
// and so does phi's count of turns, by the share of rays with a wrong one, in the same way. The grade is the worst of
// them all. With mistakes of convention undone the same rule gives a second grade; the first stands.
#pragma once

#include <string>
#include <vector>

#include "validation/grading/conventions.hpp"

namespace xpr {

enum class Letter { a_plus, a, b, c, d, f };
inline constexpr std::array<std::string_view, 6> letter_names = {"A+", "A", "B", "C", "D", "F"};
/// What an error may be at most, and a share of failed rays.
inline constexpr std::array<double, 5> letter_errors = {1e-10, 1e-8, 1e-6, 1e-4, 1e-2};
inline constexpr std::array<double, 5> letter_shares = {0.0, 0.0, 1e-3, 1e-2, 1e-1};

[[nodiscard]] Letter letter_of_error(double error);
[[nodiscard]] Letter letter_of_share(double share);
[[nodiscard]] std::string_view to_string(Letter letter);

/// Errors of one quantity over some rays; NaN without any.
struct Tail {
  std::int64_t rays = 0;
  double median = 0.0, p90 = 0.0, p99 = 0.0, most = 0.0;
  double scaled_median = 0.0, scaled_p99 = 0.0, scaled_most = 0.0;
  std::int64_t worst = -1;  ///< id of the ray with the largest scaled error
  Letter letter = Letter::f;
};

/// What a table gives, as it stands or with mistakes undone.
struct Marks {
  std::array<Tail, quantity_count> tail;
  std::array<std::int64_t, outcome_names.size()> outcomes{};
  std::int64_t rays = 0;
  std::int64_t failed = 0;
  std::int64_t counted_turns = 0;  ///< rays whose turns of phi are known
  std::int64_t wrong_turns = 0;
  Letter status_letter = Letter::f;
  Letter turns_letter = Letter::f;
  Letter grade = Letter::f;
};

/// The same for one family of the set.
struct FamilyMarks {
  std::string_view name;
  std::string_view what;
  std::int64_t rays = 0;
  std::int64_t failed = 0;
  std::array<Tail, quantity_count> tail;
};

struct ReportCard {
  HandIn hand_in;
  std::string label;       ///< of this table among several: a tolerance, or a file
  double tolerance = 0.0;  ///< NaN where none was named
  std::vector<ConventionFound> mistakes;
  std::vector<RayScore> scores;  ///< with mistakes undone
  Marks as_handed_in;
  Marks undone;                       ///< the same where there are no mistakes
  std::vector<FamilyMarks> families;  ///< with mistakes undone
};

/// Grades one table.
[[nodiscard]] ReportCard grade(const Examiner& examiner, HandIn hand_in);

}  // namespace xpr
