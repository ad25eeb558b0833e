// What modules ask of their parameters.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <string_view>

namespace xpr {

/// Throws std::invalid_argument unless 0 < value < infinity; `what` reads like "mass M".
inline void require_positive(std::string_view what, double value) {
  if (!(value > 0.0 && std::isfinite(value))) {
    throw std::invalid_argument(
        fmt::format("{} = {}, needs 0 < {} < infinity", what, value, what.substr(what.find_last_of(' ') + 1)));
  }
}

}  // namespace xpr
