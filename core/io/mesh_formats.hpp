// The formats behind read_mesh: each turns a file's bytes into a mesh, defects and all.
#pragma once

#include <filesystem>
#include <string>

#include "core/geometry/triangle_mesh.hpp"

namespace xpr {

/// Throw InputError as read_mesh does.
[[nodiscard]] TriangleMesh mesh_from_obj(const std::filesystem::path& path, const std::string& bytes);
[[nodiscard]] TriangleMesh mesh_from_gltf(const std::filesystem::path& path, const std::string& bytes, bool binary);

}  // namespace xpr
