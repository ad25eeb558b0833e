// The convention sheet of a challenge set: what its numbers mean and what to hand in, as Markdown.
#pragma once

#include <string>

#include "validation/grading/challenge.hpp"

namespace xpr {

/// For rays in one of the set's charts; `table` is the name of their file.
[[nodiscard]] std::string convention_sheet(const ChallengeSet& set, const std::string& chart, std::int64_t count,
                                           const std::string& table);

/// The command that traces a set with this program.
[[nodiscard]] std::string trace_command(const ChallengeSet& set, const std::string& chart, const std::string& in,
                                        const std::string& out);

}  // namespace xpr
