// The numerical family's parts, one file each, put together in numerical.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "validation/case.hpp"

namespace xpr::numerical {

[[nodiscard]] std::vector<Case> order_cases();
[[nodiscard]] std::vector<Case> tolerance_cases();
[[nodiscard]] std::vector<Case> structure_cases();
[[nodiscard]] std::vector<Case> long_run_cases();
[[nodiscard]] std::vector<Case> projection_cases();
[[nodiscard]] std::vector<Case> event_cases();
[[nodiscard]] std::vector<Case> comparison_cases();
[[nodiscard]] std::vector<Case> fifty_digit_cases();

/// A CaseInfo of this family: "numerical/" + name, grading steppers and not metrics.
[[nodiscard]] CaseInfo info(std::string_view name, std::string claim, std::string physics, std::string truth,
                            TruthRank rank, std::string cites, std::string source);

}  // namespace xpr::numerical
