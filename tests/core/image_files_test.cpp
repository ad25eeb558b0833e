#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/io/errors.hpp"
#include "core/io/exr.hpp"
#include "core/io/png.hpp"
#include "core/scene/sky_image.hpp"
#include "tests/core/temporary_directory.hpp"

namespace xpr {
namespace {

using testing::message_of;
using testing::slurp;
using testing::spill;
using testing::TemporaryDirectory;

/// Columns x rows pixels, no two channels alike.
std::vector<std::uint8_t> colours(int columns, int rows) {
  std::vector<std::uint8_t> rgb;
  for (int k = 0; k < 3 * columns * rows; ++k) rgb.push_back(static_cast<std::uint8_t>((k * 37 + k / 3) % 256));
  return rgb;
}

/// Every prefix of a file, some bytes longer each time, is refused in one line that names the file; but for one that
/// only lacks the `end_mark` bytes after the last pixel.
template <class Read>
void refuses_every_part_of(const std::filesystem::path& whole, const std::filesystem::path& part, std::size_t end_mark,
                           const Read& read) {
  const std::string bytes = slurp(whole);
  for (std::size_t size = 0; size < bytes.size() - end_mark; size += 1 + bytes.size() / 40) {
    spill(part, bytes.substr(0, size));
    const std::string says = message_of<InputError>([&] { read(part); });
    EXPECT_TRUE(says.starts_with(part.string() + ": cannot be read")) << size << " of " << bytes.size() << ": " << says;
    EXPECT_EQ(says.find('\n'), std::string::npos);
  }
}

TEST(Png, gives_back_what_was_written) {
  const TemporaryDirectory directory;
  const std::vector<std::uint8_t> rgb = colours(7, 5);
  write_png(directory / "a.png", 7, 5, rgb);
  const Rgb8Image read = read_png(directory / "a.png");
  EXPECT_EQ(read.columns, 7);
  EXPECT_EQ(read.rows, 5);
  EXPECT_EQ(read.rgb, rgb);
}

TEST(Png, refuses_what_it_cannot_write) {
  const TemporaryDirectory directory;
  EXPECT_THROW(write_png(directory / "a.png", 7, 5, colours(7, 4)), std::invalid_argument);
  EXPECT_THROW(write_png(directory / "none" / "a.png", 7, 5, colours(7, 5)), FaultError);
}

TEST(Png, refuses_a_file_that_ends_too_early_or_is_none) {
  const TemporaryDirectory directory;
  write_png(directory / "a.png", 60, 50, colours(60, 50));
  refuses_every_part_of(directory / "a.png", directory / "part.png", 12,
                        [](const auto& path) { (void)read_png(path); });
  EXPECT_THROW((void)read_png(directory / "none.png"), InputError);
}

TEST(Exr, reads_back_what_it_wrote) {
  const TemporaryDirectory directory;
  const std::vector<double> depth{1.0, 2.0, 3.0, 4.0, 5.0, 6.0}, red{-1.0, 0.5, 1e6, 0.0, 0.25, 2.0};
  write_exr(directory / "a.exr", 3, 2, std::vector<ImageChannel>{{"depth", depth}, {"R", red}});
  const ExrImage image = read_exr(directory / "a.exr");
  EXPECT_EQ(image.columns, 3);
  EXPECT_EQ(image.rows, 2);
  for (const auto& [name, values] : {std::pair{"depth", depth}, {"R", red}}) {
    const std::vector<float>* plane = image.channel(name);
    ASSERT_NE(plane, nullptr) << name;
    for (std::size_t k = 0; k < values.size(); ++k) EXPECT_EQ((*plane)[k], static_cast<float>(values[k])) << name;
  }
  EXPECT_EQ(image.channel("G"), nullptr);
}

TEST(Exr, refuses_a_file_that_ends_too_early_or_is_none) {
  const TemporaryDirectory directory;
  std::vector<double> noise(64 * 64);
  for (std::size_t k = 0; k < noise.size(); ++k) noise[k] = static_cast<double>(k * 2654435761U % 1000003U);
  write_exr(directory / "a.exr", 64, 64, std::vector<ImageChannel>{{"Y", noise}});
  refuses_every_part_of(directory / "a.exr", directory / "part.exr", 0, [](const auto& path) { (void)read_exr(path); });
  spill(directory / "text.exr", "no picture at all, but long enough to be one");
  EXPECT_THROW((void)read_exr(directory / "text.exr"), InputError);
}

constexpr double pi = std::numbers::pi;

TEST(SkyImage, has_its_columns_from_longitude_minus_pi_and_its_rows_from_the_south) {
  SkyImage sky{4, 2, {}};
  for (int k = 0; k < 8; ++k) sky.pixels.push_back({static_cast<double>(k), 0.0, 0.0});
  // Centres of pixels lie at odd multiples of pi / 4.
  EXPECT_DOUBLE_EQ(sky.at(-0.75 * pi, -0.25 * pi)[0], 0.0);
  EXPECT_DOUBLE_EQ(sky.at(0.25 * pi, -0.25 * pi)[0], 2.0);
  EXPECT_DOUBLE_EQ(sky.at(0.75 * pi, 0.25 * pi)[0], 7.0);
  EXPECT_DOUBLE_EQ(sky.at(0.0, -0.25 * pi)[0], 1.5);  // half-way between two
  EXPECT_DOUBLE_EQ(sky.at(0.25 * pi, 0.0)[0], 4.0);
  // Round the back, from both sides, and beyond the last row.
  EXPECT_DOUBLE_EQ(sky.at(pi, -0.25 * pi)[0], 1.5);
  EXPECT_DOUBLE_EQ(sky.at(-pi, -0.25 * pi)[0], 1.5);
  EXPECT_DOUBLE_EQ(sky.at(0.25 * pi, 0.5 * pi)[0], 6.0);
}

TEST(SkyImage, is_read_from_exr_and_png_in_linear_colours) {
  const TemporaryDirectory directory;
  write_png(directory / "sky.png", 2, 1, std::vector<std::uint8_t>{0, 255, 188, 10, 128, 1});
  const SkyImage png = read_sky_image(directory / "sky.png");
  EXPECT_EQ(png.pixels[0][0], 0.0);
  EXPECT_EQ(png.pixels[0][1], 1.0);
  // IEC 61966-2-1, written out with std::pow; a unit or two in the last place of pow apart.
  EXPECT_NEAR(png.pixels[0][2], std::pow((188.0 / 255.0 + 0.055) / 1.055, 2.4), 1e-15);
  EXPECT_NEAR(png.pixels[1][0], 10.0 / 255.0 / 12.92, 1e-17);

  const std::vector<double> r{0.5, 2.0}, g{0.25, 0.0}, b{8.0, 1.0};
  write_exr(directory / "sky.exr", 2, 1, std::vector<ImageChannel>{{"R", r}, {"G", g}, {"B", b}});
  EXPECT_EQ(read_sky_image(directory / "sky.exr").pixels[0], (Colour{0.5, 0.25, 8.0}));
  write_exr(directory / "grey.exr", 2, 1, std::vector<ImageChannel>{{"Y", r}});
  EXPECT_EQ(read_sky_image(directory / "grey.exr").pixels[1], (Colour{2.0, 2.0, 2.0}));
  write_exr(directory / "depth.exr", 2, 1, std::vector<ImageChannel>{{"depth", r}});
  EXPECT_THROW((void)read_sky_image(directory / "depth.exr"), InputError);
  EXPECT_THROW((void)read_sky_image(directory / "sky.jpg"), InputError);
}

}  // namespace
}  // namespace xpr
