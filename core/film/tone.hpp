// From linear colours to what a screen shows: for pictures to look at only, never for numbers.
#pragma once

#include <cstdint>
#include <vector>

#include "core/film/film.hpp"

namespace xpr {

/// 8-bit R, G, B, row by row from the upper left: clamped to [0, 1] and put on sRGB's curve. Not-a-number is black. The
/// frame has the planes R, G and B.
[[nodiscard]] std::vector<std::uint8_t> displayed(const FilmFrame& frame);

}  // namespace xpr
