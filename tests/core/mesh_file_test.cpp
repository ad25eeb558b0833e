#include "core/io/mesh_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "core/geometry/scene_geometry.hpp"
#include "core/io/errors.hpp"
#include "tests/core/temporary_directory.hpp"

namespace xpr {
namespace {

using testing::message_of;
using testing::spill;
using testing::TemporaryDirectory;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

MeshFile mesh_of(const std::string& name, const std::string& bytes) {
  const TemporaryDirectory directory;
  spill(directory / name, bytes);
  return read_mesh(directory / name);
}

/// What is said of the file, without its folder.
std::string refused(const std::string& name, const std::string& bytes) {
  const TemporaryDirectory directory;
  spill(directory / name, bytes);
  const std::string line = message_of<InputError>([&] { static_cast<void>(read_mesh(directory / name)); });
  EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  const std::string path = (directory / name).string() + ": ";
  return line.rfind(path, 0) == 0 ? line.substr(path.size()) : line;
}

TEST(ObjFile, gives_triangles_with_normals_uv_and_materials) {
  const MeshFile file = mesh_of("a.obj",
                                "# a comment\r\nmtllib absent.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0.1\nv 0 1e0 0\n"
                                "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\nusemtl red\nf 1/1/1 2/2/1 3/3/1\n"
                                "usemtl blue paint\nf -4/1/1 -2/3/1 -1/2/-1\n");
  const TriangleMesh& mesh = file.mesh;
  EXPECT_FALSE(file.defects.any());
  ASSERT_EQ(mesh.triangles.size(), 2U);
  EXPECT_EQ(mesh.corners(0)[2], (Vec3{1, 1, 0.1}));  // to the bit: the nearest double
  EXPECT_EQ(mesh.corners(1)[0], (Vec3{0, 0, 0}));
  EXPECT_EQ(mesh.corners(1)[2], (Vec3{0, 1, 0}));
  EXPECT_EQ(mesh.vertices.size(), 4U);  // corners 1 and 3 are shared: the same uv
  EXPECT_EQ(mesh.normals.size(), mesh.vertices.size());
  EXPECT_EQ(mesh.uv[mesh.triangles[1][2]], (std::array{1.0, 0.0}));
  EXPECT_EQ(mesh.materials, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(mesh.material_names, (std::vector<std::string>{"red", "blue"}));
}

TEST(ObjFile, parts_polygons_into_triangles) {
  const TriangleMesh mesh =
      mesh_of("a.obj", "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\no pentagon\nf 1 2 3 4 5\n").mesh;
  ASSERT_EQ(mesh.triangles.size(), 3U);
  double area = 0.0;
  for (std::size_t t = 0; t < 3; ++t) {
    const auto [a, b, c] = mesh.corners(t);
    area += 0.5 * cross(b - a, c - a).z;
  }
  EXPECT_NEAR(area, 3.0, 1e-15);
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_TRUE(mesh.materials.empty());
}

TEST(ObjFile, says_in_which_line_it_is_malformed) {
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_EQ(refused("a.obj", three + "f 1 2 4\n"), "line 4: a corner refers to vertex 4, the file has 3");
  EXPECT_EQ(refused("a.obj", three + "f 1 2 0\n"), "line 4: the corner '0' refers to vertex 0, there are 3 so far");
  EXPECT_EQ(refused("a.obj", three + "f 1 2 -4\n"), "line 4: the corner '-4' refers to vertex -4, there are 3 so far");
  EXPECT_EQ(refused("a.obj", three + "f 1/1 2/1 3/1\n"), "line 4: a corner refers to uv 1, the file has 0");
  EXPECT_EQ(refused("a.obj", three + "f 1//1 2//1 3//2\nvn 0 0 1\n"),
            "line 4: a corner refers to normal 2, the file has 1");
  EXPECT_EQ(refused("a.obj", three + "f 1 2\n"), "line 4: a face has 2 corners, needs 3");
  EXPECT_EQ(refused("a.obj", three + "f 1 2 x\n"), "line 4: the corner 'x' has no number for its vertex");
  EXPECT_EQ(refused("a.obj", three + "f 1 2 3/1/1/1\n"), "line 4: the corner '3/1/1/1' has more than three numbers");
  EXPECT_EQ(refused("a.obj", "v 0 0\n"), "line 1: a vertex has 2 numbers, needs 3");
  EXPECT_EQ(refused("a.obj", "v 0 0,5 1\n"), "line 1: '0,5' in a vertex is no number");
  EXPECT_EQ(refused("a.obj", "\nvn 0 0 one\n"), "line 2: 'one' in a normal is no number");
  EXPECT_EQ(refused("a.obj", "vt 0\n"), "line 1: a uv has 1 numbers, needs 2");
  EXPECT_EQ(refused("a.obj", "usemtl\n"), "line 1: usemtl names no material");
  EXPECT_EQ(refused("a.obj", three), "holds no triangle");
  EXPECT_EQ(refused("a.obj", ""), "holds no triangle");
}

TEST(ObjFile, with_vertices_that_are_not_finite_loses_their_triangles_with_a_warning) {
  const MeshFile file = mesh_of("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 1\nv 2 0 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\n");
  EXPECT_EQ(file.mesh.triangles.size(), 1U);
  EXPECT_EQ(
      file.defects.text("a.obj"),
      "a.obj: 2 of 3 triangles dropped: 1 with a corner that is not finite (first: triangle 1, vertex 3), 1 without "
      "area (first: triangle 2)");
  EXPECT_NE(refused("a.obj", "v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n").find("none is left"), std::string::npos);
}

TEST(MeshFile, that_is_not_there_or_of_no_known_format_is_refused) {
  EXPECT_EQ(message_of<InputError>([] { static_cast<void>(read_mesh("/absent/a.obj")); }),
            "/absent/a.obj: cannot be read: No such file or directory");
  EXPECT_EQ(refused("a.stl", "solid"), "a mesh's file ends in .obj, .gltf or .glb, not in '.stl'");
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory / "a.obj");
  EXPECT_NE(message_of<InputError>([&] { static_cast<void>(read_mesh(directory / "a.obj")); }).find("is a directory"),
            std::string::npos);
}

/// A square of two triangles: 4 positions, 4 uv, 6 corners, in one buffer of 48 + 32 + 12 bytes.
std::string square_buffer() {
  const float numbers[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 1};
  const std::uint16_t corners[] = {0, 1, 2, 0, 2, 3};
  std::string bytes(sizeof numbers + sizeof corners, '\0');
  std::memcpy(bytes.data(), numbers, sizeof numbers);
  std::memcpy(bytes.data() + sizeof numbers, corners, sizeof corners);
  return bytes;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// The square twice: as it is, and in a child that is mirrored in x, scaled and moved.
std::string square_json(const std::string& uri) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
         R"("nodes":[{"mesh":0,"children":[1]},{"mesh":0,"scale":[-2,1,1],"translation":[0,0,5]}],)"
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,"material":1}]}],)"
         R"("materials":[{"name":"red"},{}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
         R"({"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},)"
         R"({"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":32},)"
         R"({"buffer":0,"byteOffset":80,"byteLength":12}],)"
         R"("buffers":[{"byteLength":92)" +
         (uri.empty() ? std::string() : R"(,"uri":")" + uri + '"') + "}]}";
}

std::string glb(std::string json, std::string binary) {
  while (json.size() % 4 != 0) json += ' ';
  while (binary.size() % 4 != 0) binary += '\0';
  std::string out = "glTF";
  const auto number = [&](std::size_t n) {
    const auto word = static_cast<std::uint32_t>(n);
    out.append(reinterpret_cast<const char*>(&word), sizeof word);
  };
  number(2);
  number(12 + 8 + json.size() + 8 + binary.size());
  number(json.size());
  out += "JSON" + json;
  number(binary.size());
  out += std::string("BIN\0", 4) + binary;
  return out;
}

void expect_two_squares(const TriangleMesh& mesh) {
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {4, 6, 5}, {4, 7, 6}}));
  EXPECT_EQ(mesh.vertices[2], (Vec3{1, 1, 0}));
  EXPECT_EQ(mesh.vertices[6], (Vec3{-2, 1, 5}));
  for (std::size_t t = 0; t < 4; ++t) {
    const auto [a, b, c] = mesh.corners(t);
    EXPECT_GT(cross(b - a, c - a).z, 0.0) << "mirrored nodes keep the outside";
  }
  EXPECT_EQ(mesh.uv[6], (std::array{1.0, 1.0}));
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_EQ(mesh.materials, (std::vector<std::uint32_t>{1, 1, 1, 1}));
  EXPECT_EQ(mesh.material_names, (std::vector<std::string>{"red", "material 1"}));
}

TEST(GltfFile, gives_the_scene_with_its_nodes_in_place) {
  const TemporaryDirectory directory;
  spill(directory / "a.gltf", square_json("a.bin"));
  spill(directory / "a.bin", square_buffer());
  expect_two_squares(read_mesh(directory / "a.gltf").mesh);
  expect_two_squares(mesh_of("a.glb", glb(square_json(""), square_buffer())).mesh);
}

TEST(GltfFile, turns_nodes_as_their_quaternions_say) {
  const std::string json =
      replaced(square_json(""), R"("scale":[-2,1,1])", R"("rotation":[0,0,0.7071067811865476,0.7071067811865476])");
  const TriangleMesh mesh = mesh_of("a.glb", glb(json, square_buffer())).mesh;
  EXPECT_NEAR(length(mesh.vertices[5] - Vec3{0, 1, 5}), 0.0, 1e-15);  // (1, 0, 0) by a quarter turn about z
  const std::string matrix = replaced(square_json(""), R"("scale":[-2,1,1],"translation":[0,0,5])",
                                      R"("matrix":[0,1,0,0,-1,0,0,0,0,0,1,0,0,0,5,1])");
  EXPECT_EQ(mesh_of("a.glb", glb(matrix, square_buffer())).mesh.vertices[5], (Vec3{0, 1, 5}));
}

TEST(GltfFile, reads_strips_and_fans) {
  for (const auto& [mode, expected] :
       {std::pair{"5", Triangles{{0, 1, 2}, {1, 3, 2}}}, {"6", Triangles{{0, 1, 2}, {0, 2, 3}}}}) {
    std::string json = replaced(square_json(""), R"("indices":2)", std::string(R"("mode":)") + mode);
    json = replaced(json, R"(,"children":[1])", "");
    EXPECT_EQ(mesh_of("a.glb", glb(json, square_buffer())).mesh.triangles, expected) << mode;
  }
}

TEST(GltfFile, says_what_refers_to_nothing) {
  const auto with = [](const std::string& from, const std::string& to) {
    return refused("a.glb", glb(replaced(square_json(""), from, to), square_buffer()));
  };
  EXPECT_EQ(with(R"("children":[1])", R"("children":[7])"), "node 7 is not there (2 of them), but node 0 refers to it");
  EXPECT_EQ(with(R"("children":[1])", R"("children":[0])"),
            "node 0 is reached twice: it stands in a cycle or has two parents");
  EXPECT_EQ(with(R"("indices":2)", R"("indices":5)"),
            "primitive indices accessor out of bounds");  // tinygltf's own words
  EXPECT_EQ(with(R"("count":4,"type":"VEC3")", R"("count":5,"type":"VEC3")"),
            "accessor 0 has 5 items from byte 0 on, 12 bytes apart: more than the 48 bytes of its buffer view");
  EXPECT_EQ(with(R"("count":4,"type":"VEC2")", R"("count":3,"type":"VEC2")"),
            "accessor 1 has 3 items, primitive 0 of mesh 0 has 4 positions");
  EXPECT_EQ(with(R"("byteOffset":80,"byteLength":12)", R"("byteOffset":88,"byteLength":12)"),
            "buffer view 2 has bytes 88 + 12, its buffer 92");
  EXPECT_NE(with(R"("componentType":5123)", R"("componentType":5126)").find("accessor 2 has component type 5126"),
            std::string::npos);
  EXPECT_EQ(with(R"("material":1)", R"("material":2)"),
            "material 2 is not there (2 of them), but primitive 0 of mesh 0 refers to it");
  EXPECT_EQ(with(R"("indices":2)", R"("mode":1)"), "primitive 0 of mesh 0 has the mode 1, which makes no triangles");
  EXPECT_EQ(with(R"("POSITION":0,)", ""), "primitive 0 of mesh 0 has no POSITION");
  EXPECT_NE(with(R"("scale":[-2,1,1])", R"("scale":[0,1,1])").find("node 1 cannot be placed"), std::string::npos);
  EXPECT_EQ(with(R"("scene":0)", R"("extensionsRequired":["KHR_draco_mesh_compression"],"scene":0)"),
            "the extension KHR_draco_mesh_compression is required and not known here");
  std::string buffer = square_buffer();
  buffer[80] = 9;
  EXPECT_EQ(refused("a.glb", glb(square_json(""), buffer)),
            "accessor 2 has the corner 9 at place 0, primitive 0 of mesh 0 has the vertices 0 to 3");
}

TEST(GltfFile, that_lacks_its_buffer_is_refused) {
  EXPECT_NE(refused("a.gltf", square_json("absent.bin")).find("absent.bin"), std::string::npos);
  const TemporaryDirectory directory;
  spill(directory / "a.gltf", square_json("a.bin"));
  spill(directory / "a.bin", square_buffer().substr(0, 50));
  const std::string line = message_of<InputError>([&] { static_cast<void>(read_mesh(directory / "a.gltf")); });
  EXPECT_NE(line.find("a.gltf: "), std::string::npos) << line;
}

TEST(GltfFile, cut_short_anywhere_is_refused_and_never_crashes) {
  const std::string whole = glb(square_json(""), square_buffer());
  for (std::size_t length = 0; length < whole.size(); ++length) {
    EXPECT_NE(refused("a.glb", whole.substr(0, length)), "no exception") << length;
  }
  const std::string text = square_json("a.bin");
  for (std::size_t length = 0; length < text.size(); length += 7) {
    EXPECT_NE(refused("a.gltf", text.substr(0, length)), "no exception") << length;
  }
}

TEST(GltfFile, with_a_vertex_that_is_not_finite_loses_its_triangles_with_a_warning) {
  std::string buffer = square_buffer();
  const float nan = NAN;
  std::memcpy(buffer.data() + 12, &nan, sizeof nan);  // vertex 1
  const MeshFile file = mesh_of("a.glb", glb(replaced(square_json(""), R"(,"children":[1])", ""), buffer));
  EXPECT_EQ(file.mesh.triangles.size(), 1U);
  EXPECT_EQ(file.defects.not_finite, std::vector<std::uint32_t>{0});
  EXPECT_EQ(file.defects.first_bad_vertex, 1U);
}

}  // namespace
}  // namespace xpr
