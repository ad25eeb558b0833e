// A frame's planes in HDF5: /frame/<plane>, one number a pixel, row by row from the lower left; `class` as an enum.
#pragma once

#include <filesystem>

#include "core/film/film.hpp"
#include "core/io/hdf5_file.hpp"

namespace xpr {

/// The file in a frame's directory; a directory that holds it is a frame.
inline constexpr const char* frame_file_name = "frame.h5";

/// Writes the group /frame.
void write_planes(Hdf5File& file, const FilmFrame& frame);

/// The planes and the size of a stored frame; its telemetry is not stored there. Throws InputError for what is no
/// frame.
[[nodiscard]] FilmFrame read_frame(const std::filesystem::path& directory);

}  // namespace xpr
