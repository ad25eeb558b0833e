// What is said of a name that nobody knows.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace xpr {

/// "unknown WHAT 'x'; did you mean 'y'?", or the known ones where none is near.
[[nodiscard]] std::string unknown_name(std::string_view what, std::string_view name,
                                       const std::vector<std::string_view>& known);

}  // namespace xpr
