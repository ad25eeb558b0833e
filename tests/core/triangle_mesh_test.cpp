#include "core/geometry/triangle_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/geometry/mesh_shapes.hpp"
#include "core/geometry/scene_geometry.hpp"
#include "tests/core/geometry_kit.hpp"
#include "tests/core/temporary_directory.hpp"

namespace xpr {
namespace {

using testing::message_of;
using testing::one_mesh;

TriangleMesh with_defects() {
  TriangleMesh mesh;
  mesh.name = "rock";
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {NAN, 0, 0}, {2, 0, 0}, {0, 0, INFINITY}, {0.5, 1e-17, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {0, 5, 1}, {0, 0, 2}, {2, 1, 4}, {0, 1, 6}};
  mesh.materials = {10, 11, 12, 13, 14, 15, 16};
  return mesh;
}

TEST(TriangleMesh, drops_triangles_that_bound_nothing_and_names_them) {
  TriangleMesh mesh = with_defects();
  const MeshDefects found = drop_defects(mesh);
  EXPECT_EQ(found.not_finite, (std::vector<std::uint32_t>{1, 3}));
  EXPECT_EQ(found.degenerate, (std::vector<std::uint32_t>{2, 4, 6}));
  EXPECT_EQ(mesh.triangles.size(), 2U);
  EXPECT_EQ(mesh.materials, (std::vector<std::uint32_t>{10, 15}));
  EXPECT_EQ(
      found.text("rock"),
      "rock: 5 of 7 triangles dropped: 2 with a corner that is not finite (first: triangle 1, vertex 3), 3 without "
      "area (first: triangle 2)");
  EXPECT_FALSE(drop_defects(mesh).any());
  EXPECT_EQ(drop_defects(mesh).text("rock"), "");
}

TEST(TriangleMesh, keeps_slivers_that_have_a_plane) {
  TriangleMesh mesh = testing::triangle({0, 0, 0}, {1, 0, 0}, {0.5, 1e-13, 0});
  EXPECT_FALSE(drop_defects(mesh).any());
  // Far from the origin the same height is lost in the coordinates.
  for (Vec3& p : mesh.vertices) p = p + Vec3{0, 0, 1000};
  EXPECT_TRUE(drop_defects(mesh).any());
  mesh = testing::triangle({0, 0, 0}, {1e-200, 0, 0}, {0, 1e-200, 0});
  EXPECT_TRUE(drop_defects(mesh).any());  // its area is 0 in double precision
}

TEST(TriangleMesh, that_is_none_is_refused) {
  const auto refused = [](const TriangleMesh& mesh) {
    return message_of<std::invalid_argument>([&] { mesh.validate(); });
  };
  TriangleMesh mesh = testing::triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  EXPECT_EQ(refused(mesh), "no exception");
  mesh.triangles[0][2] = 3;
  EXPECT_EQ(refused(mesh), "triangle: triangle 0 has the corner 3, vertices are 0 to 2");
  mesh.triangles[0][2] = 2;
  mesh.normals.resize(2);
  EXPECT_EQ(refused(mesh), "triangle: 2 normals for 3 vertices");
  mesh.normals.clear();
  mesh.uv.resize(1);
  EXPECT_EQ(refused(mesh), "triangle: 1 uv for 3 vertices");
  mesh.uv.clear();
  mesh.materials.resize(4);
  EXPECT_EQ(refused(mesh), "triangle: 4 materials for 1 triangles");
}

TEST(MeshShapes, are_clean_and_those_that_are_solid_are_closed) {
  for (const MeshShape& shape : mesh_shapes()) {
    TriangleMesh mesh = generate_mesh(shape.key);
    EXPECT_EQ(mesh.name, shape.key);
    EXPECT_FALSE(drop_defects(mesh).any()) << shape.key;
    const bool open = shape.key == "plane" || shape.key == "terrain";
    EXPECT_EQ(open_edges(mesh) > 0, open) << shape.key;
    for (const Vec3& n : mesh.normals) EXPECT_NEAR(length(n), 1.0, 1e-14);
  }
}

TEST(MeshShapes, have_their_outside_outside) {
  for (const MeshShape& shape : mesh_shapes()) {
    const TriangleMesh mesh = generate_mesh(shape.key);
    // The volume inside, by the divergence theorem; 0 or about for sheets.
    double volume = 0.0;
    int against = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto [a, b, c] = mesh.corners(t);
      volume += dot(a, cross(b, c)) / 6.0;
      if (!mesh.normals.empty() && dot(cross(b - a, c - a), mesh.normals[mesh.triangles[t][0]]) < 0.0) ++against;
    }
    EXPECT_EQ(against, 0) << shape.key;
    if (open_edges(mesh) == 0) {
      EXPECT_GT(volume, 0.05) << shape.key;
    }
  }
}

TEST(MeshShapes, have_the_sizes_that_are_asked_for) {
  const TriangleMesh box =
      generate_mesh("box", std::vector<NamedValue>{{"width", 2.0}, {"height", 4.0}, {"depth", 6.0}});
  EXPECT_EQ(box.bounds().lo, (Vec3{-1, -2, -3}));
  EXPECT_EQ(box.bounds().hi, (Vec3{1, 2, 3}));
  EXPECT_EQ(box.triangles.size(), 12U);
  EXPECT_EQ(generate_mesh("ico-sphere", std::vector<NamedValue>{{"level", 2.0}}).triangles.size(), 320U);
  for (const Vec3& p : generate_mesh("ico-sphere", std::vector<NamedValue>{{"radius", 3.0}}).vertices) {
    EXPECT_NEAR(length(p), 3.0, 1e-15 * 4);
  }
  EXPECT_EQ(generate_mesh("torus-knot").triangles.size(), 204'800U);
  EXPECT_EQ(generate_mesh("terrain").triangles.size(), 204'800U);
  EXPECT_EQ(generate_mesh("displaced-sphere").triangles.size(), 327'680U);
}

TEST(MeshShapes, volume_of_a_sphere_is_approached_as_its_triangles_shrink) {
  const auto volume = [](double level) {
    const TriangleMesh mesh = generate_mesh("ico-sphere", std::vector<NamedValue>{{"level", level}});
    double sum = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto [a, b, c] = mesh.corners(t);
      sum += dot(a, cross(b, c)) / 6.0;
    }
    return sum;
  };
  const double exact = 4.0 / 3.0 * 3.141592653589793;
  // Second order in the edge's length.
  EXPECT_NEAR((exact - volume(3)) / (exact - volume(4)), 4.0, 0.1);
}

TEST(MeshShapes, that_are_none_are_refused) {
  const auto refused = [](const char* key, std::vector<NamedValue> values) {
    return message_of<std::invalid_argument>([&] { static_cast<void>(generate_mesh(key, values)); });
  };
  EXPECT_EQ(refused("bxo", {}), "no shape is called 'bxo'; did you mean 'box'?");
  EXPECT_EQ(refused("box", {{"widht", 1.0}}), "box has no parameter 'widht'; did you mean 'width'?");
  EXPECT_EQ(refused("box", {{"width", -1.0}}), "box: width = -1, needs > 0");
  EXPECT_EQ(refused("box", {{"width", NAN}}), "box: width = nan, needs a finite number");
  EXPECT_EQ(refused("ico-sphere", {{"level", 2.5}}), "ico-sphere: level = 2.5, needs a whole number from 0 to 9");
  EXPECT_EQ(refused("uv-sphere", {{"rings", 4096.0}, {"segments", 8192.0}}),
            "uv-sphere: 67108864 triangles, at most 16777216 do");
  EXPECT_EQ(refused("displaced-sphere", {{"amplitude", 1.5}}),
            "displaced-sphere: amplitude = 1.5, needs |amplitude| < 1");
}

}  // namespace
}  // namespace xpr
