// Angles as users write them: with their unit.
#pragma once

#include <optional>
#include <string_view>

namespace xpr {

/// "60deg" or "1.05rad" in radians; nothing for anything else.
[[nodiscard]] std::optional<double> parse_angle(std::string_view text);

}  // namespace xpr
