#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/io/errors.hpp"
#include "core/io/png.hpp"
#include "core/scene/describe_scene.hpp"
#include "core/scene/scene_file.hpp"
#include "core/scene/sky_image.hpp"
#include "tests/core/temporary_directory.hpp"

namespace xpr {
namespace {

using testing::message_of;
using testing::spill;
using testing::TemporaryDirectory;

std::shared_ptr<const SceneSnapshot> scene_of(const std::string& text, const std::filesystem::path& directory = ".") {
  return make_snapshot(SceneFile(text, "a.toml", directory));
}
std::string refusal(const std::string& text, const std::filesystem::path& directory = ".") {
  return message_of<InputError>([&] { (void)scene_of(text, directory); });
}

const std::string cube = "[[mesh]]\nname = \"cube\"\nshape = \"box\"\n";

TEST(SceneThings, stand_in_the_order_of_their_paths) {
  const auto scene = scene_of(cube +
                              "[[mesh]]\nname = \"ball\"\nshape = \"ico-sphere\"\nset = { radius = 2, level = 0 }\n"
                              "[[material]]\nname = \"red\"\nkind = \"flat\"\ncolour_a = [1, 0, 0]\n"
                              "[[instance]]\npath = \"/z\"\nmesh = \"cube\"\nmaterial = \"red\"\nsolid = true\n"
                              "[[instance]]\npath = \"/a\"\nmesh = \"ball\"\n");
  EXPECT_EQ(scene->meshes.name, (std::vector<std::string>{"ball", "cube"}));
  EXPECT_EQ(scene->meshes.mesh[0]->triangles.size(), 20U);
  EXPECT_EQ(scene->materials.name, (std::vector<std::string>{"default", "red"}));
  EXPECT_EQ(scene->instances.path, (std::vector<std::string>{"/a", "/z"}));
  EXPECT_EQ(scene->instances.mesh, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(scene->instances.material[0], 0U);
  EXPECT_EQ(scene->instances.material[1], 1U);
  EXPECT_EQ(scene->instances.solid, (std::vector<std::uint8_t>{0, 1}));

  const GeometryModel model = geometry_model(*scene);
  ASSERT_EQ(model.instances.size(), 2U);
  EXPECT_EQ(model.meshes[model.instances[1].mesh]->triangles.size(), 12U);
  EXPECT_EQ(model.instances[1].owner, 1U);
  EXPECT_TRUE(model.instances[1].solid);
}

// x is scaled, then turned, then shifted; the parent's transform comes after the child's.
TEST(SceneThings, transforms_apply_to_points_in_order_and_parents_last) {
  const auto scene = scene_of(cube +
                              "[[instance]]\npath = \"/a/b\"\nparent = \"/a\"\nmesh = \"cube\"\nscale = [2, 1, 1]\n"
                              "rotate = { axis = [0, 0, 3], angle = \"90deg\" }\ntranslate = [5, 0, 0]\n"
                              "[[instance]]\npath = \"/a\"\ntranslate = [0, 0, 7]\nscale = 10\n");
  ASSERT_EQ(scene->instances.size(), 1U);  // the parent is a group
  // (1, 0, 0) -> (2, 0, 0) -> (0, 2, 0) -> (5, 2, 0); the parent makes (50, 20, 0) and (50, 20, 7) of it.
  const Vec3 p = scene->instances.to_world[0].point({1.0, 0.0, 0.0});
  EXPECT_NEAR(p.x, 50.0, 1e-13);  // a rounding of sin and cos, times 20
  EXPECT_NEAR(p.y, 20.0, 1e-13);
  EXPECT_EQ(p.z, 7.0);
}

TEST(SceneThings, a_matrix_is_three_rows_of_four) {
  const auto scene =
      scene_of(cube + "[[instance]]\npath = \"/a\"\nmesh = \"cube\"\nmatrix = [1, 2, 3, 4, 0, 5, 6, 7, 0, 0, 8, 9]\n");
  EXPECT_EQ(scene->instances.to_world[0].point({1.0, 10.0, 100.0}), (Vec3{325.0, 657.0, 809.0}));
}

TEST(SceneThings, faces_of_a_mesh_keep_the_materials_that_they_name) {
  const TemporaryDirectory directory;
  spill(directory / "two.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nusemtl b\nf 1 2 3\nusemtl a\nf 2 4 3\n");
  const std::string mesh = "[[mesh]]\nname = \"two\"\nfile = \"two.obj\"\n";
  const std::string a = "[[material]]\nname = \"a\"\n", b = "[[material]]\nname = \"b\"\n";
  const std::string instance = "[[instance]]\npath = \"/two\"\nmesh = \"two\"\n";
  const auto scene = scene_of(mesh + a + b + instance, directory.path());
  EXPECT_EQ(scene->materials.name, (std::vector<std::string>{"a", "b", "default"}));
  EXPECT_FALSE(scene->instances.material[0]);
  EXPECT_EQ(scene->meshes.mesh[0]->materials, (std::vector<std::uint32_t>{1, 0}));
  EXPECT_EQ(
      refusal(mesh + a + instance, directory.path()),
      "a.toml: line 2: [[mesh]] name 'two' has triangles of material 'b', but there is no [[material]] of that name; "
      "write one, or give its instances a material");
  // An instance that names its own material asks for none of them.
  EXPECT_EQ(scene_of(mesh + a + instance + "material = \"a\"\n", directory.path())->instances.material[0], 0U);
}

TEST(SceneThings, triangles_that_were_dropped_are_a_warning) {
  const TemporaryDirectory directory;
  spill(directory / "bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nf 1 2 3\nf 1 2 4\n");
  const auto scene = scene_of("[[mesh]]\nname = \"bad\"\nfile = \"bad.obj\"\n", directory.path());
  EXPECT_EQ(scene->meshes.mesh[0]->triangles.size(), 1U);
  ASSERT_EQ(scene->warnings.size(), 1U);
  EXPECT_TRUE(scene->warnings[0].starts_with("a.toml: bad.obj")) << scene->warnings[0];
}

TEST(SceneThings, a_sky_can_be_an_image) {
  const TemporaryDirectory directory;
  write_png(directory / "sky.png", 2, 1, std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0});
  const auto scene = scene_of("[sky]\nkind = \"image\"\nfile = \"sky.png\"\n", directory.path());
  ASSERT_NE(scene->sky.image, nullptr);
  EXPECT_EQ(scene->sky.image->columns, 2);
}

TEST(SceneThings, say_in_one_line_what_is_wrong_where) {
  const std::string at = "[[instance]]\npath = \"/a\"\nmesh = \"cube\"\n";
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"[[mesh]]\nname = \"m\"\nfile = \"none.obj\"",
       "a.toml: line 3: [[mesh]] file does not do: ./none.obj: cannot be read"},
      {"[[mesh]]\nname = \"m\"", "a.toml: line 1: [[mesh]] file or shape is needed"},
      {"[[mesh]]\nname = \"m\"\nshape = \"boxx\"",
       "a.toml: line 3: [[mesh]] shape does not do: no shape is called 'boxx'; did you mean 'box'?"},
      {cube + "set = { width = -1 }", "a.toml: line 4: [[mesh]] set does not do: box: width = -1, needs > 0"},
      {cube + cube, "a.toml: line 5: [[mesh]] name 'cube' is taken by another one"},
      {cube + at + at, "a.toml: line 8: [[instance]] path '/a' is taken by another one"},
      {cube + "[[instance]]\npath = \"/a\"\nmesh = \"cub\"",
       "a.toml: line 6: [[instance]] mesh is an unknown mesh 'cub'; did you mean 'cube'?"},
      {cube + at + "material = \"defualt\"",
       "a.toml: line 7: [[instance]] material is an unknown material 'defualt'; did you mean 'default'?"},
      {cube + at + "parent = \"/b\"", "a.toml: line 7: [[instance]] parent is an unknown instance '/b'"},
      {cube + at +
           "parent = \"/b\"\n[[instance]]\npath = \"/b\"\nparent = \"/c\"\n[[instance]]\npath = \"/c\"\nparent = "
           "\"/a\"",
       "a.toml: line 7: [[instance]] parent goes round in a cycle: /a -> /b -> /c -> /a"},
      {cube + at + "parent = \"/b\"\n[[instance]]\npath = \"/b\"\nparent = \"/b\"",
       "a.toml: line 7: [[instance]] parent goes round in a cycle: /a -> /b -> /b"},
      {cube + at + "scale = [1, 0, 1]", "a.toml: line 7: [[instance]] scale flattens space: it cannot be undone"},
      {cube + at + "scale = 2\nmatrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]",
       "a.toml: line 7: [[instance]] scale and matrix exclude each other; keep one"},
      {cube + at + "solid = 1", "a.toml: line 7: [[instance]] solid needs true or false"},
      {"[[material]]\nname = \"m\"\ncolour_a = [1, -1, 0]",
       "a.toml: line 3: [[material]] colour_a has a channel -1, needs finite numbers of 0 or more"},
      {"[[material]]\nname = \"m\"\nkind = \"chequer\"",
       "a.toml: line 3: [[material]] kind is an unknown name 'chequer'; did you mean 'checker'?"},
      {"[[material]]\nname = \"m\"\nsquares = [3, 0.5]",
       "a.toml: line 3: [[material]] squares has 0, needs 1 to 1000000"},
      {"[sky]\nkind = \"image\"\nfile = \"none.png\"",
       "a.toml: line 3: [sky] file does not do: ./none.png: cannot be read"},
      {"[sky]\nkind = \"image\"\nfile = \"sky.jpg\"",
       "a.toml: line 3: [sky] file does not do: ./sky.jpg: a sky is an .exr or a .png file"},
  };
  for (const auto& [text, says] : wrong) {
    const std::string said = refusal(text);
    EXPECT_TRUE(said.starts_with(says)) << text << "\n  says " << said << "\n  not  " << says;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
}

std::filesystem::path scenes() { return std::filesystem::path(XPR_SOURCE_DIR) / "scenes"; }

TEST(Scenes, that_ship_can_all_be_read) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(scenes())) {
    if (entry.path().extension() != ".toml") continue;
    ++count;
    SCOPED_TRACE(entry.path().string());
    std::shared_ptr<const SceneSnapshot> scene;
    ASSERT_NO_THROW(scene = read_scene(entry.path()));
    EXPECT_EQ(scene->header.name, entry.path().stem().string());
    EXPECT_FALSE(scene->header.about.empty());
    EXPECT_TRUE(scene->warnings.empty());
    EXPECT_GT(scene->instances.size(), 0U);
    // Research Mode and every tier that is not 0 leave it readable.
    for (const char* preset : {"validate", "paper-match", "stress-test"}) {
      SceneFlags flags;
      flags.preset = preset;
      EXPECT_TRUE(read_scene(entry.path(), flags)->research.config.research_enabled);
    }
  }
  EXPECT_GE(count, 10);
}

// The numbers of the fixtures' definition.
TEST(Scenes, fixture_001_is_the_radial_baseline) {
  const auto scene = read_scene(scenes() / "fixture_001.toml");
  EXPECT_EQ(scene->camera.position, (Vec3{0.0, 0.0, 7.0}));
  EXPECT_DOUBLE_EQ(scene->camera.fov, 42.0 * std::acos(-1.0) / 180.0);
  EXPECT_EQ(scene->film.columns(), 480);
  EXPECT_EQ(scene->film.rows(), 270);
  ASSERT_EQ(scene->fields.sources.size(), 1U);
  const FieldSource& field = scene->fields.sources[0];
  EXPECT_EQ(field.curve, FieldCurve::power);
  EXPECT_EQ(field.a, 1.8);
  EXPECT_EQ(field.r_inner, 0.0);
  EXPECT_EQ(field.r_outer, 5.0);
  EXPECT_EQ(bending_of(field, scene->fields.gains), 0.9);  // attractive, every gain 1
  EXPECT_EQ(field.world_from_local.origin, (std::array{0.0, 0.0, 0.0}));
  const KickDriftSettings& steps = scene->transport.preview;
  EXPECT_EQ(steps.max_steps, 350);
  EXPECT_EQ(steps.step_length, 0.05);
  EXPECT_EQ(steps.max_step, 0.2);
  EXPECT_EQ(steps.gain, 0.7);
  EXPECT_EQ(steps.low_curvature, 0.3);

  std::vector<std::array<double, 3>> balls, expected;
  for (std::size_t k = 0; k < scene->instances.size(); ++k) {
    const Vec3& p = scene->instances.to_world[k].shift;
    if (scene->meshes.name[scene->instances.mesh[k]] == "ball") balls.push_back({p.x, p.y, p.z});
  }
  for (const double x : {-6.0, -3.0, 0.0, 3.0, 6.0}) {
    for (const double y : {-3.5, 0.0, 3.5}) expected.push_back({x, y, -18.0});
  }
  std::sort(balls.begin(), balls.end());
  EXPECT_EQ(balls, expected);
  for (std::size_t k = 0; k < scene->meshes.size(); ++k) {
    const Box3 box = scene->meshes.mesh[k]->bounds();
    if (scene->meshes.name[k] == "ball") {
      for (const Vec3& v : scene->meshes.mesh[k]->vertices) EXPECT_NEAR(length(v), 0.77, 1e-15);
    } else {
      EXPECT_EQ(box.hi - box.lo, (Vec3{28.0, 18.0, 0.25}));
    }
  }
}

TEST(Scenes, fixtures_002_to_004_differ_from_001_as_they_are_defined_to) {
  const auto two = read_scene(scenes() / "fixture_002.toml"), three = read_scene(scenes() / "fixture_003.toml"),
             four = read_scene(scenes() / "fixture_004.toml");
  EXPECT_EQ(two->instances.size(), 1U + 5U);
  ASSERT_EQ(three->fields.sources.size(), 1U);
  EXPECT_EQ(three->fields.sources[0].world_from_local.origin, (std::array{2.0, 0.0, 0.0}));
  ASSERT_EQ(four->fields.sources.size(), 2U);
  EXPECT_EQ(four->fields.sources[0].world_from_local.origin, (std::array{-2.0, 0.0, 0.0}));
  EXPECT_EQ(four->fields.sources[1].world_from_local.origin, (std::array{2.0, 0.0, 0.0}));
  EXPECT_EQ(four->fields.sources[0].a, 1.8);
}

TEST(Scenes, the_hermetic_room_is_closed_and_its_camera_is_off_the_centre_of_its_field) {
  const auto scene = read_scene(scenes() / "hermetic_room.toml");
  const auto& origin = scene->fields.sources.at(0).world_from_local.origin;
  EXPECT_GT(length(scene->camera.position - Vec3{origin[0], origin[1], origin[2]}), 1.0);
  const auto room = std::find(scene->meshes.name.begin(), scene->meshes.name.end(), "room");
  ASSERT_NE(room, scene->meshes.name.end());
  EXPECT_EQ(open_edges(*scene->meshes.mesh[static_cast<std::size_t>(room - scene->meshes.name.begin())]), 0U);
}

TEST(Scenes, the_heavy_one_has_two_hundred_thousand_triangles) {
  const auto scene = read_scene(scenes() / "mesh_heavy.toml");
  EXPECT_GE(scene->meshes.mesh.at(0)->triangles.size(), 200'000U);
}

}  // namespace
}  // namespace xpr
