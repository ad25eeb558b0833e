// JSON as this project writes it: keys in the order in which they were set, numbers that are not finite as the strings
// "nan", "inf" and "-inf", which plain JSON has no way to spell.
#pragma once

#include <nlohmann/json.hpp>

#include "core/io/csv.hpp"

namespace xpr {

using Json = nlohmann::ordered_json;

/// A number, or the string that stands for it.
[[nodiscard]] inline Json json_number(double value) {
  if (value - value == 0.0) return value;
  return number_text(value);
}

}  // namespace xpr
