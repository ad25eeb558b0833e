#include "core/film/tone.hpp"

#include <array>

#include "metrics/scalar/elementary.hpp"

namespace xpr {
namespace {

/// IEC 61966-2-1.
std::uint8_t srgb(double linear) {
  if (!(linear > 0.0)) return 0;
  if (linear >= 1.0) return 255;
  const double shown = linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(255.0 * shown + 0.5);
}

}  // namespace

std::vector<std::uint8_t> displayed(const FilmFrame& frame) {
  const auto columns = static_cast<std::size_t>(frame.columns), rows = static_cast<std::size_t>(frame.rows);
  std::vector<std::uint8_t> bytes(3 * columns * rows);
  const std::array<const FilmPlane*, 3> colour{frame.plane("R"), frame.plane("G"), frame.plane("B")};
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      const std::size_t from = (rows - 1 - row) * columns + column, to = 3 * (row * columns + column);
      for (std::size_t c = 0; c < 3; ++c) bytes[to + c] = srgb(colour[c]->values[from]);
    }
  }
  return bytes;
}

}  // namespace xpr
