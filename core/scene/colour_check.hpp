// What colours of a scene have to be.
#pragma once

#include <fmt/format.h>

#include <cmath>

#include "core/io/source_place.hpp"
#include "core/scene/snapshot.hpp"

namespace xpr {

/// Throws InputError unless every channel is finite and not negative.
inline void check_colour(const Colour& colour, const SourcePlace& place, std::string_view key) {
  for (const double channel : colour) {
    if (std::isfinite(channel) && channel >= 0.0) continue;
    place.fail(key, fmt::format("has a channel {}, needs finite numbers of 0 or more", channel));
  }
}

}  // namespace xpr
