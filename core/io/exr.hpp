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

}  // namespace xpr
