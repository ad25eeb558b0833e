#include "core/io/exr.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <fmt/format.h>

#include <algorithm>
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

const std::vector<float>* ExrImage::channel(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? nullptr : &planes[static_cast<std::size_t>(found - names.begin())];
}

namespace {

/// More pixels than this are a broken header.
constexpr long most_pixels = 1L << 28;

ExrImage read_channels(Imf::InputFile& file) {
  const auto window = file.header().dataWindow();
  const long columns = long{window.max.x} - window.min.x + 1, rows = long{window.max.y} - window.min.y + 1;
  if (columns < 1 || rows < 1 || columns * rows > most_pixels) {
    throw std::runtime_error(fmt::format("{} x {} pixels, needs 1 to {}", columns, rows, most_pixels));
  }
  if (!file.isComplete()) throw std::runtime_error("it ends too early");
  ExrImage out{static_cast<int>(columns), static_cast<int>(rows), {}, {}};
  const Imf::ChannelList& channels = file.header().channels();
  for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
    if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1) {
      throw std::runtime_error(fmt::format("channel {} has another resolution", channel.name()));
    }
    out.names.emplace_back(channel.name());
    out.planes.emplace_back(static_cast<std::size_t>(columns * rows));
  }
  Imf::FrameBuffer frame;
  for (std::size_t k = 0; k < out.names.size(); ++k) {
    frame.insert(out.names[k], Imf::Slice::Make(Imf::FLOAT, out.planes[k].data(), window));
  }
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  // The file's first row is the upper one.
  for (std::vector<float>& plane : out.planes) {
    for (long row = 0; row < rows / 2; ++row) {
      std::swap_ranges(plane.begin() + row * columns, plane.begin() + (row + 1) * columns,
                       plane.end() - (row + 1) * columns);
    }
  }
  return out;
}

}  // namespace

ExrImage read_exr(const std::filesystem::path& path) {
  try {
    Imf::InputFile file(path.string().c_str(), 0);
    return read_channels(file);
  } catch (const std::exception& error) {
    // OpenEXR says what and why on several lines.
    std::string why = error.what();
    std::replace(why.begin(), why.end(), '\n', ' ');
    throw InputError(fmt::format("{}: cannot be read as EXR: {}", path.string(), why));
  }
}

}  // namespace xpr
