#include "core/io/angle.hpp"

#include <numbers>
#include <utility>

#include "core/io/csv.hpp"

namespace xpr {

std::optional<double> parse_angle(std::string_view text) {
  for (const auto& [unit, size] : {std::pair{std::string_view("deg"), std::numbers::pi / 180.0}, {"rad", 1.0}}) {
    if (!text.ends_with(unit)) continue;
    double value = 0.0;
    if (parse_number(text.substr(0, text.size() - unit.size()), value) == NumberFault::none) return value * size;
  }
  return std::nullopt;
}

}  // namespace xpr
