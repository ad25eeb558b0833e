// A picture of the whole sky: equirectangular, linear colours.
#pragma once

#include <filesystem>
#include <vector>

#include "core/scene/snapshot.hpp"

namespace xpr {

struct SkyImage {
  int columns = 0;
  int rows = 0;
  std::vector<Colour> pixels;  ///< row by row from the south pole up, longitude from -pi to pi

  /// The colour in a direction, linear between the centres of pixels; longitude goes round, the poles' rows go on
  /// beyond their centres. Longitude in [-pi, pi], latitude in [-pi / 2, pi / 2].
  [[nodiscard]] Colour at(double longitude, double latitude) const;
};

/// Reads an .exr (channels R, G, B or Y, linear) or a .png (on sRGB's curve), by the file's ending. Throws InputError:
/// one line with the file and what is wrong with it.
[[nodiscard]] SkyImage read_sky_image(const std::filesystem::path& path);

}  // namespace xpr
