// Meshes from files: Wavefront OBJ (.obj) and glTF 2.0 (.gltf with its buffers, .glb).
//
// OBJ     polygons are parted into triangles, objects and groups become one mesh, `usemtl` names the materials (the
// .mtl
//         file is not read). Normals and uv are kept where every corner has them.
// glTF    the default scene (else the first), its nodes' transforms applied; triangles, strips and fans of float
//         positions; NORMAL and TEXCOORD_0 where every primitive has them. Images, skins and animations are not looked
//         at. Nodes that mirror turn their triangles round, so that the outside stays outside.
//
// A vertex with a coordinate that is not finite (OBJ: `nan`, `inf`) is data: the triangles that have it are dropped and
// counted, like those without area. Everything else that is malformed is an error.
#pragma once

#include <filesystem>

#include "core/geometry/triangle_mesh.hpp"

namespace xpr {

struct MeshFile {
  TriangleMesh mesh;    ///< clean
  MeshDefects defects;  ///< what was dropped; its text(file) is a warning to print
};

/// Reads a mesh, in the format that the file's ending names. Throws InputError: one line with file, place, what was
/// wrong; FaultError where the disk fails. A file without a triangle is refused.
[[nodiscard]] MeshFile read_mesh(const std::filesystem::path& path);

}  // namespace xpr
