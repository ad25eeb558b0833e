#include "core/film/frame_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/film/film_class.hpp"
#include "core/io/errors.hpp"

namespace xpr {
namespace {

constexpr const char* class_plane = "class";

std::vector<double> class_codes(const std::vector<std::string>& names, const std::string& where) {
  std::vector<double> codes;
  codes.reserve(names.size());
  for (const std::string& name : names) {
    const auto* found = std::find(film_class_names.begin(), film_class_names.end(), name);
    if (found == film_class_names.end()) throw InputError(fmt::format("{}: unknown class '{}'", where, name));
    codes.push_back(static_cast<double>(found - film_class_names.begin()));
  }
  return codes;
}

}  // namespace

void write_planes(Hdf5File& file, const FilmFrame& frame) {
  for (const FilmPlane& plane : frame.planes) {
    const std::string name = "/frame/" + plane.name;
    if (plane.name == class_plane) {
      std::vector<std::int64_t> codes(plane.values.size());
      std::transform(plane.values.begin(), plane.values.end(), codes.begin(),
                     [](double code) { return static_cast<std::int64_t>(code); });
      file.write_enum(name, codes, film_class_names, {"1", plane.long_name});
    } else {
      file.write(name, plane.values, {plane.units, plane.long_name});
    }
  }
  file.set_attribute("/frame", "columns", std::int64_t{frame.columns});
  file.set_attribute("/frame", "rows", std::int64_t{frame.rows});
  file.set_attribute("/frame", "order", "row by row from the lower left");
}

FilmFrame read_frame(const std::filesystem::path& directory) {
  const std::filesystem::path path = directory / frame_file_name;
  const Hdf5File file = Hdf5File::open(path);
  if (!file.exists("/frame")) throw InputError(path.string() + ": no group /frame; a frame's file has one");
  FilmFrame frame;
  frame.columns = static_cast<int>(file.number_attribute("/frame", "columns"));
  frame.rows = static_cast<int>(file.number_attribute("/frame", "rows"));
  const auto pixels = static_cast<std::size_t>(frame.columns) * static_cast<std::size_t>(frame.rows);
  for (const std::string& name : file.members("/frame")) {
    const std::string dataset = "/frame/" + name;
    FilmPlane plane{.name = name, .units = {}, .long_name = {}, .values = {}};
    plane.values = name == class_plane ? class_codes(file.read_enum(dataset), path.string() + " " + dataset)
                                       : file.read_doubles(dataset);
    if (plane.values.size() != pixels) {
      throw InputError(fmt::format("{} {}: {} values, needs {} x {}", path.string(), dataset, plane.values.size(),
                                   frame.columns, frame.rows));
    }
    frame.planes.push_back(std::move(plane));
  }
  return frame;
}

}  // namespace xpr
