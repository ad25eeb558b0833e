// Images of named channels as OpenEXR: what any viewer and compositor of high dynamic range opens.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace xpr {

/// One channel, row by row from the lower left, one value a pixel; kept as 32-bit floats.
struct ImageChannel {
  std::string name;
  std::span<const double> values;
};

/// Writes channels of columns x rows values, losslessly compressed, to a file that does not exist yet. Equal channels
/// give equal bytes. Throws std::invalid_argument for a channel of another size and FaultError where writing fails.
void write_exr(const std::filesystem::path& path, int columns, int rows, std::span<const ImageChannel> channels);

/// An image as it was read, channels by name.
struct ExrImage {
  int columns = 0;
  int rows = 0;
  std::vector<std::string> names;
  std::vector<std::vector<float>> planes;  ///< one for each name, row by row from the lower left

  /// The channel of that name, null where there is none.
  [[nodiscard]] const std::vector<float>* channel(const std::string& name) const;
};

/// Reads every channel, whatever its numbers, as 32-bit floats. Throws InputError for a file that cannot be read, is no
/// EXR, ends too early, or has channels of another resolution.
[[nodiscard]] ExrImage read_exr(const std::filesystem::path& path);

}  // namespace xpr
