#include "core/io/png.hpp"

#include <fmt/format.h>
#include <png.h>

#include <cstddef>
#include <stdexcept>

#include "core/io/errors.hpp"

namespace xpr {
namespace {

constexpr std::size_t most_pixels = std::size_t{1} << 28;

/// libpng's simplified interface, which reports errors instead of jumping over frames; freed whatever happens.
class PngImage {
 public:
  explicit PngImage(const std::filesystem::path& path) : path_(path) { image.version = PNG_IMAGE_VERSION; }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
  ~PngImage() { png_image_free(&image); }

  [[nodiscard]] std::string fault(const char* doing) const {
    return fmt::format("{}: cannot be {}: {}", path_.string(), doing, image.message);
  }

  png_image image{};

 private:
  const std::filesystem::path& path_;
};

}  // namespace

void write_png(const std::filesystem::path& path, int columns, int rows, std::span<const std::uint8_t> rgb) {
  const auto bytes = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) * 3;
  if (columns < 1 || rows < 1 || rgb.size() != bytes) {
    throw std::invalid_argument(fmt::format("a picture of {} bytes, needs 3 x {} x {}", rgb.size(), columns, rows));
  }
  PngImage png(path);
  png.image.width = static_cast<png_uint_32>(columns);
  png.image.height = static_cast<png_uint_32>(rows);
  png.image.format = PNG_FORMAT_RGB;
  if (png_image_write_to_file(&png.image, path.c_str(), 0, rgb.data(), 0, nullptr) == 0) {
    throw FaultError(png.fault("written"));
  }
}

Rgb8Image read_png(const std::filesystem::path& path) {
  PngImage png(path);
  if (png_image_begin_read_from_file(&png.image, path.c_str()) == 0) throw InputError(png.fault("read"));
  const std::size_t pixels = std::size_t{png.image.width} * png.image.height;
  if (pixels > most_pixels) {
    throw InputError(fmt::format("{}: {} x {} pixels are too many, at most {}", path.string(), png.image.width,
                                 png.image.height, most_pixels));
  }
  png.image.format = PNG_FORMAT_RGB;
  Rgb8Image out{static_cast<int>(png.image.width), static_cast<int>(png.image.height),
                std::vector<std::uint8_t>(3 * pixels)};
  const png_color black{0, 0, 0};
  if (png_image_finish_read(&png.image, &black, out.rgb.data(), 0, nullptr) == 0) throw InputError(png.fault("read"));
  return out;
}

}  // namespace xpr
