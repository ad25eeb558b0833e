#include "core/io/mesh_file.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cerrno>
#include <fstream>
#include <iterator>

#include "core/io/errors.hpp"
#include "core/io/mesh_formats.hpp"

namespace xpr {
namespace {

[[nodiscard]] std::string bytes_of(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) throw InputError(path.string() + ": is a directory, not a mesh");
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) throw_system_error(path, "cannot be read", errno);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (in.bad()) throw_system_error(path, "cannot be read", EIO);
  return bytes;
}

}  // namespace

MeshFile read_mesh(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (ending != ".obj" && ending != ".gltf" && ending != ".glb") {
    throw InputError(fmt::format("{}: a mesh's file ends in .obj, .gltf or .glb, not in '{}'", path.string(), ending));
  }
  const std::string bytes = bytes_of(path);
  MeshFile out;
  out.mesh = ending == ".obj" ? mesh_from_obj(path, bytes) : mesh_from_gltf(path, bytes, ending == ".glb");
  out.mesh.name = path.string();
  if (out.mesh.triangles.empty()) throw InputError(path.string() + ": holds no triangle");
  out.defects = drop_defects(out.mesh);
  if (out.mesh.triangles.empty()) {
    throw InputError(out.defects.text(path.string()) + ": none is left");
  }
  return out;
}

}  // namespace xpr
