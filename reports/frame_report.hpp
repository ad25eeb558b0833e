// A frame of the film as files: frame.exr with the colour and every AOV, frame.png to look at, frame.h5 with every
// number, frame.json and frame.md with what became of it.
#pragma once

#include <filesystem>
#include <string>

#include "core/film/film.hpp"
#include "core/io/json.hpp"
#include "core/io/provenance.hpp"

namespace xpr {

struct FrameInputs {
  const FilmFrame& frame;
  std::string title;    ///< of the scene
  std::string banner;   ///< of Research Mode; empty where it is off
  std::string command;  ///< that repeats it
  Json configuration;   ///< resolved, the scene's included
  Provenance provenance;
  double seconds = 0.0;
  int threads = 1;
  int lanes = 1;
};

/// 32 hexadecimal digits over every plane: equal for every number of threads, width of lanes and size of tiles.
[[nodiscard]] std::string frame_hash(const FilmFrame& frame);

/// Throws where no frame can be written there, before any work is done.
void check_frame_directory(const std::filesystem::path& directory);

/// Writes a frame into a directory that is complete or absent.
void write_frame(const FrameInputs& inputs, const std::filesystem::path& directory);

/// One line for people: what became of the pixels, what it cost. What was not measured says na.
[[nodiscard]] std::string health_line(const FrameInputs& inputs);

}  // namespace xpr
