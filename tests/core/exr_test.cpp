#include "core/io/exr.hpp"

#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "core/io/errors.hpp"
#include "tests/core/temporary_directory.hpp"

namespace xpr {
namespace {

using testing::TemporaryDirectory;

TEST(Exr, keeps_every_channel_with_its_first_row_at_the_bottom) {
  const TemporaryDirectory directory;
  const std::vector<double> depth{1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
  const std::vector<double> angle{-1.0, -2.0, -3.0, -4.0, -5.0, -6.0};
  const std::vector<ImageChannel> channels{{"depth", depth}, {"angle", angle}};
  write_exr(directory / "image.exr", 3, 2, channels);

  Imf::InputFile file((directory / "image.exr").c_str());
  EXPECT_EQ(file.header().dataWindow().max.x, 2);
  EXPECT_EQ(file.header().dataWindow().max.y, 1);
  for (const ImageChannel& channel : channels) {
    Imf::Array2D<float> pixels(2, 3);
    Imf::FrameBuffer frame;
    frame.insert(channel.name,
                 Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(&pixels[0][0]), sizeof(float), 3 * sizeof(float)));
    file.setFrameBuffer(frame);
    file.readPixels(0, 1);
    for (std::size_t row = 0; row < 2; ++row) {
      for (std::size_t column = 0; column < 3; ++column) {
        // OpenEXR counts rows from the top.
        EXPECT_EQ(pixels[static_cast<long>(1 - row)][static_cast<long>(column)],
                  static_cast<float>(channel.values[3 * row + column]))
            << channel.name;
      }
    }
  }
}

TEST(Exr, refuses_a_channel_of_another_size_and_a_place_that_is_not_there) {
  const TemporaryDirectory directory;
  const std::vector<double> five(5);
  const std::vector<ImageChannel> channels{{"five", five}};
  EXPECT_THROW(write_exr(directory / "image.exr", 3, 2, channels), std::invalid_argument);
  EXPECT_THROW(write_exr(directory / "none" / "image.exr", 5, 1, channels), FaultError);
}

}  // namespace
}  // namespace xpr
