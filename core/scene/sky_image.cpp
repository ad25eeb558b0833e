#include "core/scene/sky_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/io/errors.hpp"
#include "core/io/exr.hpp"
#include "core/io/png.hpp"
#include "metrics/scalar/elementary.hpp"

namespace xpr {
namespace {

/// sRGB's curve (IEC 61966-2-1) for every 8-bit value.
std::array<double, 256> srgb_curve() {
  std::array<double, 256> linear{};
  for (std::size_t k = 0; k < linear.size(); ++k) {
    const double v = static_cast<double>(k) / 255.0;
    linear[k] = v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
  }
  return linear;
}

SkyImage from_png(const std::filesystem::path& path) {
  const Rgb8Image png = read_png(path);
  const std::array<double, 256> linear = srgb_curve();
  SkyImage sky{png.columns, png.rows, std::vector<Colour>(png.rgb.size() / 3)};
  const auto columns = static_cast<std::size_t>(png.columns), rows = static_cast<std::size_t>(png.rows);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      const std::size_t from = 3 * ((rows - 1 - row) * columns + column);
      for (std::size_t c = 0; c < 3; ++c) sky.pixels[row * columns + column][c] = linear[png.rgb[from + c]];
    }
  }
  return sky;
}

SkyImage from_exr(const std::filesystem::path& path) {
  const ExrImage exr = read_exr(path);
  std::array<const std::vector<float>*, 3> planes{exr.channel("R"), exr.channel("G"), exr.channel("B")};
  if (const auto* grey = exr.channel("Y")) planes = {grey, grey, grey};
  if (std::find(planes.begin(), planes.end(), nullptr) != planes.end()) {
    throw InputError(fmt::format("{}: has no channels R, G, B and no channel Y", path.string()));
  }
  SkyImage sky{exr.columns, exr.rows, std::vector<Colour>(planes[0]->size())};
  for (std::size_t k = 0; k < sky.pixels.size(); ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = static_cast<double>((*planes[c])[k]);
      if (!std::isfinite(value)) throw InputError(fmt::format("{}: has a pixel that is not finite", path.string()));
      sky.pixels[k][c] = value;
    }
  }
  return sky;
}

}  // namespace

Colour SkyImage::at(double longitude, double latitude) const {
  const auto n = static_cast<double>(columns), m = static_cast<double>(rows);
  const double x = (longitude / (2.0 * pi<double>()) + 0.5) * n - 0.5;
  const double y = std::clamp((latitude / pi<double>() + 0.5) * m - 0.5, 0.0, m - 1.0);
  const double left = std::floor(x), below = std::floor(y);
  const auto column = static_cast<long>(left);
  const auto row = static_cast<long>(below), above = std::min<long>(row + 1, rows - 1);
  const auto pixel = [&](long i, long j) -> const Colour& {
    return pixels[static_cast<std::size_t>(j * columns + ((i % columns) + columns) % columns)];
  };
  const double u = x - left, v = y - below;
  Colour out{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double low = (1.0 - u) * pixel(column, row)[c] + u * pixel(column + 1, row)[c];
    const double high = (1.0 - u) * pixel(column, above)[c] + u * pixel(column + 1, above)[c];
    out[c] = (1.0 - v) * low + v * high;
  }
  return out;
}

SkyImage read_sky_image(const std::filesystem::path& path) {
  if (path.extension() == ".exr") return from_exr(path);
  if (path.extension() == ".png") return from_png(path);
  throw InputError(fmt::format("{}: a sky is an .exr or a .png file", path.string()));
}

}  // namespace xpr
