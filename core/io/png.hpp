// Pictures as PNG, 8 bits of red, green and blue: for screens, never for numbers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace xpr {

/// Red, green, blue of each pixel on sRGB's curve, row by row from the upper left.
struct Rgb8Image {
  int columns = 0;
  int rows = 0;
  std::vector<std::uint8_t> rgb;
};

/// Writes columns x rows pixels, laid out as in Rgb8Image. Throws std::invalid_argument where the number of bytes is
/// another and FaultError where writing fails.
void write_png(const std::filesystem::path& path, int columns, int rows, std::span<const std::uint8_t> rgb);

/// Any PNG as 8-bit colour: greys, palettes and 16 bits are converted, transparency shows black. Throws InputError for
/// a file that cannot be read, is no PNG or ends too early.
[[nodiscard]] Rgb8Image read_png(const std::filesystem::path& path);

}  // namespace xpr
