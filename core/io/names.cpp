#include "core/io/names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "metrics/catalogue.hpp"

namespace xpr {

std::string unknown_name(std::string_view what, std::string_view name, const std::vector<std::string_view>& known) {
  const std::string near = nearest_name(name, known);
  if (!near.empty()) return fmt::format("unknown {} '{}'; did you mean '{}'?", what, name, near);
  return fmt::format("unknown {} '{}'; there are {}", what, name, fmt::join(known, ", "));
}

}  // namespace xpr
