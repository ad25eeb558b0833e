#include "core/io/exr.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <fmt/format.h>

#include <cstddef>
#include <stdexcept>

#include "core/io/errors.hpp"

namespace xpr {

void write_exr(const std::filesystem::path& path, int columns, int rows, std::span<const ImageChannel> channels) {
  const auto width = static_cast<std::size_t>(columns);
  const auto height = static_cast<std::size_t>(rows);
  Imf::Header header(columns, rows);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::FrameBuffer frame;
  std::vector<std::vector<float>> planes;
  planes.reserve(channels.size());
  for (const ImageChannel& channel : channels) {
    if (channel.values.size() != width * height) {
      throw std::invalid_argument(
          fmt::format("channel {} has {} values, needs {} x {}", channel.name, channel.values.size(), columns, rows));
    }
    // The file's first row is the upper one.
    std::vector<float>& plane = planes.emplace_back(width * height);
    for (std::size_t row = 0; row < height; ++row) {
      for (std::size_t column = 0; column < width; ++column) {
        plane[(height - 1 - row) * width + column] = static_cast<float>(channel.values[row * width + column]);
      }
    }
    header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
    frame.insert(channel.name,
                 Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(plane.data()), sizeof(float), sizeof(float) * width));
  }
  try {
    // Threads would change nothing but the time.
    Imf::OutputFile file(path.string().c_str(), header, 0);
    file.setFrameBuffer(frame);
    file.writePixels(rows);
  } catch (const std::exception& error) {
    throw FaultError(fmt::format("{}: cannot be written: {}", path.string(), error.what()));
  }
}

}  // namespace xpr
