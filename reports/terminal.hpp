// The verdict of a run on one screen, in plain text: what `validate` prints last.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "validation/result.hpp"

namespace xpr {

/// The largest number of lines of terminal_verdict.
inline constexpr std::size_t screen_lines = 24;

/// A table of families with counts and worst error / tolerance; failures and skipped rows by name, as many as fit, with
/// the number of those that do not; the verdict in a sentence; where the report is (left out where `report` is empty).
/// At most `screen_lines` lines; ends with a newline.
[[nodiscard]] std::string terminal_verdict(const SuiteResult& suite, const std::filesystem::path& report);

}  // namespace xpr
