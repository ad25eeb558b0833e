#include "core/geometry/scene_geometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "core/geometry/path_envelope.hpp"
#include "tests/core/geometry_kit.hpp"
#include "tests/core/temporary_directory.hpp"

namespace xpr {
namespace {

using testing::Draw;
using testing::four_knots;
using testing::knot_of_500;
using testing::message_of;
using testing::one_mesh;
using testing::straight_path;
using testing::triangle;

struct Both {
  explicit Both(const GeometryModel& model)
      : bvh(make_geometry(model)), reference(make_geometry(model, GeometryBackend::reference)) {}

  /// Asks both, demands the same bits, and returns whether something was hit.
  template <class Query>
  bool agree(const Query& query) const {
    const auto a = bvh->first_hit(query), b = reference->first_hit(query);
    EXPECT_EQ(a.has_value(), b.has_value());
    if (!a || !b) return false;
    EXPECT_EQ(a->theta, b->theta);
    EXPECT_EQ(a->instance, b->instance);
    EXPECT_EQ(a->triangle, b->triangle);
    EXPECT_EQ(a->contact, b->contact);
    EXPECT_EQ(a->position, b->position);
    EXPECT_EQ(a->shading_normal, b->shading_normal);
    return true;
  }

  std::unique_ptr<SceneGeometry> bvh, reference;
};

int hits_of_paths(const Both& both, int paths, double where, double longest, std::uint64_t seed) {
  Draw draw(seed);
  int hits = 0;
  for (int k = 0; k < paths && !::testing::Test::HasFailure(); ++k)
    hits += both.agree(draw.path(where, longest)) ? 1 : 0;
  return hits;
}

// With a million paths, 0 disagree: `bench_geometry --benchmark_filter=agreement` (docs/performance.md).
TEST(SceneGeometry, finds_by_trees_what_every_triangle_in_turn_gives_on_curved_paths) {
  EXPECT_GT(hits_of_paths(Both(one_mesh(knot_of_500())), 10'000, 2.0, 3.0, 31), 1'000);
}

TEST(SceneGeometry, finds_the_same_in_instances_turned_scaled_and_mirrored) {
  EXPECT_GT(hits_of_paths(Both(four_knots()), 3'000, 2.0, 3.0, 32), 500);
}

TEST(SceneGeometry, finds_the_same_at_huge_and_tiny_coordinates) {
  for (const double size : {1e-30, 1e8, 1e40}) {
    TriangleMesh mesh = knot_of_500();
    for (Vec3& p : mesh.vertices) p = size * p;
    EXPECT_GT(hits_of_paths(Both(one_mesh(mesh)), 1'000, 2.0 * size, 3.0 * size, 33), 100) << size;
  }
  // Far from the origin, where coordinates have lost eight digits.
  TriangleMesh mesh = knot_of_500();
  const Vec3 far{1e8, -2e8, 5e7};
  for (Vec3& p : mesh.vertices) p = p + far;
  const Both both(one_mesh(mesh));
  Draw draw(34);
  int hits = 0;
  for (int k = 0; k < 1'000; ++k) {
    RayPath path = draw.path(2.0, 3.0);
    for (Vec3& c : path.control) c = c + far;
    hits += both.agree(path) ? 1 : 0;
  }
  EXPECT_GT(hits, 100);
}

TEST(SceneGeometry, finds_the_same_among_slivers) {
  Draw draw(35);
  TriangleMesh mesh;
  for (std::uint32_t t = 0; t < 300; ++t) {
    const Vec3 a = draw.in_cube(1.0), b = draw.in_cube(1.0);
    // Heights from a millionth of the length down to 1e-12 of it.
    const double height = std::exp(draw.uniform(std::log(1e-12), std::log(1e-6)));
    mesh.vertices.insert(mesh.vertices.end(), {a, b, a + draw.uniform(0.0, 1.0) * (b - a) + draw.in_cube(height)});
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  ASSERT_FALSE(drop_defects(mesh).any());
  const Both both(one_mesh(mesh));
  int hits = 0;
  for (int k = 0; k < 3'000; ++k) {
    // Aimed at a sliver's middle.
    const auto corners = mesh.corners(static_cast<std::size_t>(draw.whole(0, 299)));
    const Vec3 aim = (1.0 / 3.0) * (corners[0] + corners[1] + corners[2]);
    RayPath path = draw.path(1.0, 2.0);
    const Vec3 shift = aim - point(path, 0.5);
    for (Vec3& c : path.control) c = c + shift;
    hits += both.agree(path) ? 1 : 0;
    both.agree(StraightRay{path.control[0], aim - path.control[0]});
  }
  EXPECT_GT(hits, 2'900);
}

TEST(SceneGeometry, finds_the_same_on_straight_rays) {
  for (const GeometryModel& model : {one_mesh(knot_of_500()), four_knots()}) {
    const Both both(model);
    Draw draw(36);
    int hits = 0;
    for (int k = 0; k < 10'000; ++k) {
      StraightRay ray{draw.in_cube(2.0), draw.uniform(0.1, 10.0) * draw.direction()};
      if (k % 3 == 0) ray.t_max = draw.uniform(0.0, 1.0);
      if (k % 5 == 0) ray.direction.y = 0.0;
      if (k % 10 == 0) ray.direction.x = -0.0;
      hits += both.agree(ray) ? 1 : 0;
    }
    EXPECT_GT(hits, 1'000);
  }
}

TEST(SceneGeometry, finds_on_a_straight_path_what_a_straight_ray_finds) {
  const auto geometry = make_geometry(four_knots());
  Draw draw(37);
  int hits = 0;
  for (int k = 0; k < 5'000; ++k) {
    const Vec3 a = draw.in_cube(2.0), b = draw.in_cube(2.0);
    const auto along_path = geometry->first_hit(straight_path(a, b));
    const auto along_ray = geometry->first_hit(StraightRay{a, b - a, 1.0});
    ASSERT_EQ(along_path.has_value(), along_ray.has_value()) << k;
    if (!along_path) continue;
    ++hits;
    EXPECT_EQ(along_path->triangle, along_ray->triangle);
    // A cosine of 1e-3 at the least met here, over 1e-15.
    EXPECT_NEAR(along_path->theta, along_ray->theta, 1e-12);
  }
  EXPECT_GT(hits, 1'000);
}

/// Curved paths from outside of a sphere of radius one into it, through a given point at theta = 1/2.
RayPath path_inward_through(Draw& draw, const Vec3& aim) {
  for (;;) {
    RayPath path;
    path.degree = draw.whole(1, RayPath::max_degree);
    const Vec3 out = 1.5 * normalized(normalized(aim) + draw.in_cube(0.8)), in = draw.in_cube(0.2);
    for (int k = 0; k <= path.degree; ++k) {
      const double s = static_cast<double>(k) / path.degree;
      path.control[static_cast<std::size_t>(k)] = (1.0 - s) * out + s * in + draw.in_cube(0.2);
    }
    const Vec3 shift = aim - point(path, 0.5);
    for (Vec3& c : path.control) c = c + shift;
    const Vec3& end = path.control[static_cast<std::size_t>(path.degree)];
    if (length(path.control[0]) > 1.05 && length(end) < 0.7) return path;
  }
}

TEST(SceneGeometry, lets_no_path_slip_through_edges_and_corners_of_a_closed_mesh) {
  const TriangleMesh sphere = generate_mesh("ico-sphere", std::vector<NamedValue>{{"level", 2.0}});
  const Both both(one_mesh(sphere));
  Draw draw(38);
  for (int k = 0; k < 10'000 && !HasFailure(); ++k) {
    const auto corners =
        sphere.corners(static_cast<std::size_t>(draw.whole(0, static_cast<int>(sphere.triangles.size()) - 1)));
    const double s = k % 2 == 0 ? 0.0 : draw.uniform(0.0, 1.0);
    const Vec3 aim = corners[0] + s * (corners[1] - corners[0]);
    const RayPath path = path_inward_through(draw, aim);
    if (k % 20 == 0) {
      EXPECT_TRUE(both.agree(path));
    }
    const auto hit = both.bvh->first_hit(path);
    ASSERT_TRUE(hit) << k;
    EXPECT_TRUE(hit->from_outside || hit->contact == Contact::touching || std::fabs(hit->theta - 0.5) < 1e-9);
    EXPECT_TRUE(both.bvh->first_hit(StraightRay{path.control[0], aim - path.control[0], 1.0 + 1e-9})) << k;
    // From inside a straight ray has to leave, through an edge or a corner as well.
    EXPECT_TRUE(both.bvh->first_hit(StraightRay{{0.01, 0.02, 0.03}, aim - Vec3{0.01, 0.02, 0.03}})) << k;
  }
}

TEST(SceneGeometry, lets_no_path_slip_through_where_it_grazes_a_flat_wall) {
  // A wall of 2 x 50 x 50 triangles in z = 0, all coplanar; paths cross it at angles down to 1e-10 through its edges.
  TriangleMesh wall =
      generate_mesh("terrain", std::vector<NamedValue>{{"height", 0.0}, {"cells", 50.0}, {"size", 10.0}});
  const auto geometry = make_geometry(one_mesh(wall));
  Draw draw(39);
  for (int k = 0; k < 20'000; ++k) {
    const auto corners = wall.corners(static_cast<std::size_t>(draw.whole(0, 4'999)));
    const Vec3 aim = corners[0] + draw.uniform(0.0, 1.0) * (corners[1] - corners[0]);
    const double rise = std::exp(draw.uniform(std::log(1e-10), 0.0));
    const Vec3 along{draw.uniform(-0.1, 0.1), draw.uniform(-0.1, 0.1), rise};
    RayPath path = straight_path(aim - along, aim + along);
    if (k % 2 == 0) {
      path.degree = 3;  // flat where it crosses: a triple root
      const Vec3 flat{along.x / 3, along.y / 3, 0.0};
      path.control = {aim - along, aim - flat, aim + flat, aim + along};
    }
    ASSERT_TRUE(geometry->first_hit(path)) << k << " rise " << rise;
  }
}

TEST(SceneGeometry, gives_ties_to_the_lesser_instance_and_triangle) {
  TriangleMesh mesh = triangle({-1, -1, 0}, {1, -1, 0}, {0, 1, 0});
  mesh.triangles.push_back({0, 1, 2});
  mesh.triangles.push_back({0, 2, 1});
  GeometryModel model = one_mesh(mesh);
  model.instances.push_back(model.instances[0]);
  for (const GeometryBackend backend : {GeometryBackend::bvh, GeometryBackend::reference}) {
    const auto geometry = make_geometry(model, backend);
    for (int k = 0; k < 2; ++k) {
      const auto hit = k == 0 ? geometry->first_hit(straight_path({0, 0, 1}, {0, 0, -1}))
                              : geometry->first_hit(StraightRay{{0, 0, 1}, {0, 0, -1}});
      ASSERT_TRUE(hit);
      EXPECT_EQ(hit->instance, 0U);
      EXPECT_EQ(hit->triangle, 0U);
    }
  }
}

TEST(SceneGeometry, hit_tells_what_was_hit_and_where) {
  TriangleMesh mesh = triangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0});
  mesh.uv = {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}};
  mesh.normals = {normalized(Vec3{0, 0, 1}), normalized(Vec3{1, 0, 1}), normalized(Vec3{0, 1, 1})};
  mesh.materials = {3};
  GeometryModel model = one_mesh(mesh, {{0, 1, 0}, {-1, 0, 0}, {0, 0, 2}, {5, 0, 1}});  // a quarter turn about z
  model.instances[0].owner = 42;
  model.instances.push_back({.mesh = 0,
                             .to_world = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -3}},
                             .owner = 43,
                             .material = 8,
                             .solid = false});
  const auto geometry = make_geometry(model);
  // The mesh's point (0.5, 0.25, 0) stands at (5 - 0.25, 0.5, 1).
  const auto hit = geometry->first_hit(straight_path({4.75, 0.5, 5.0}, {4.75, 0.5, 0.0}));
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->theta, 0.8, 1e-15);
  EXPECT_NEAR(length(hit->position - Vec3{4.75, 0.5, 1.0}), 0.0, 4e-15);
  EXPECT_EQ(hit->geometric_normal, (Vec3{0, 0, 1}));
  EXPECT_TRUE(hit->from_outside);
  EXPECT_EQ(hit->owner, 42U);
  EXPECT_EQ(hit->material, 3U);
  EXPECT_NEAR(hit->barycentric[0], 0.625, 1e-15);
  EXPECT_NEAR(hit->barycentric[1], 0.25, 1e-15);
  EXPECT_NEAR(hit->barycentric[2], 0.125, 1e-15);
  EXPECT_NEAR(hit->uv[0], 0.25, 1e-15);
  EXPECT_NEAR(hit->uv[1], 0.125, 1e-15);
  const Vec3 mean = 0.625 * mesh.normals[0] + 0.25 * mesh.normals[1] + 0.125 * mesh.normals[2];
  EXPECT_NEAR(length(hit->shading_normal - normalized(Vec3{-mean.y, mean.x, mean.z / 2})), 0.0, 4e-15);
  const auto other = geometry->first_hit(StraightRay{{0.5, 0.5, -9.0}, {0, 0, 1}});
  ASSERT_TRUE(other);
  EXPECT_EQ(other->owner, 43U);
  EXPECT_EQ(other->material, 8U);
  EXPECT_FALSE(other->from_outside);
}

TEST(SceneGeometry, has_normals_across_the_triangles_of_stretched_and_sheared_instances) {
  const auto geometry = make_geometry(four_knots());
  Draw draw(44);
  std::vector<int> hits(5);
  for (int k = 0; k < 5'000; ++k) {
    const auto hit = geometry->first_hit(StraightRay{draw.in_cube(2.0), draw.direction()});
    if (!hit) continue;
    ++hits[hit->instance];
    const auto corners = geometry->model().meshes[0]->corners(hit->triangle);
    const Affine3& map = geometry->model().instances[hit->instance].to_world;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 side = normalized(map.direction(corners[(i + 1) % 3] - corners[i]));
      // The knot's triangles are up to ten times as long as high: their normals keep 14 digits.
      EXPECT_NEAR(dot(hit->geometric_normal, side), 0.0, 1e-14);
    }
  }
  for (std::size_t i = 0; i < 4; ++i) EXPECT_GT(hits[i], 20) << i;
}

TEST(SceneGeometry, keeps_the_outside_outside_when_an_instance_is_mirrored) {
  const TriangleMesh sphere = generate_mesh("uv-sphere");
  const auto geometry = make_geometry(one_mesh(sphere, {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {}}));
  Draw draw(40);
  for (int k = 0; k < 200; ++k) {
    const Vec3 d = draw.direction();
    const auto hit = geometry->first_hit(StraightRay{3.0 * d, -d});
    ASSERT_TRUE(hit);
    EXPECT_TRUE(hit->from_outside);
    EXPECT_GT(dot(hit->geometric_normal, d), 0.9);
    EXPECT_GT(dot(hit->shading_normal, d), 0.999);
  }
}

TEST(SceneGeometry, looks_once_at_paths_that_are_far_from_everything) {
  const auto geometry = make_geometry(four_knots());
  GeometryCounts counts;
  EXPECT_FALSE(geometry->first_hit(straight_path({100, 0, 0}, {90, 1, 0}), &counts));
  EXPECT_EQ(counts.paths, 1U);
  EXPECT_EQ(counts.far, 1U);
  EXPECT_EQ(counts.nodes, 0U);
  EXPECT_FALSE(geometry->may_touch({.a = {100, 0, 0}, .b = {90, 1, 0}, .travelled = 0.0, .radius = 1.0}));
  EXPECT_TRUE(geometry->may_touch({.a = {100, 0, 0}, .b = {90, 1, 0}, .travelled = 0.0, .radius = 90.0}));
}

TEST(SceneGeometry, may_touch_never_denies_a_hit) {
  const auto geometry = make_geometry(four_knots());
  Draw draw(41);
  int hits = 0, denied = 0;
  for (int k = 0; k < 10'000; ++k) {
    const RayPath path = draw.path(4.0, 3.0);
    const bool may = geometry->may_touch(enclosing_segment(path));
    denied += may ? 0 : 1;
    if (!geometry->first_hit(path)) continue;
    ++hits;
    EXPECT_TRUE(may);
  }
  EXPECT_GT(hits, 100);
  EXPECT_GT(denied, 1'000);
}

TEST(SceneGeometry, of_nothing_and_of_numbers_that_are_none_hits_nothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto empty = make_geometry({});
  EXPECT_FALSE(empty->first_hit(straight_path({0, 0, 0}, {1, 0, 0})));
  EXPECT_FALSE(empty->first_hit(StraightRay{{0, 0, 0}, {1, 0, 0}}));
  EXPECT_EQ(empty->nearest({}).distance, std::numeric_limits<double>::infinity());
  const auto geometry = make_geometry(one_mesh(knot_of_500()));
  EXPECT_FALSE(geometry->first_hit(straight_path({0, 0, 0}, {nan, 0, 0})));
  EXPECT_FALSE(geometry->first_hit(straight_path({0, 0, 0}, {INFINITY, 0, 0})));
  EXPECT_FALSE(geometry->first_hit(StraightRay{{0, nan, 0}, {1, 0, 0}}));
  EXPECT_FALSE(geometry->first_hit(StraightRay{{5, 0, 0}, {0, 0, 0}}));
  // A step of no length on the surface is a hit, one beside it none.
  const Vec3 on = geometry->model().meshes[0]->vertices[7];
  EXPECT_TRUE(geometry->first_hit(straight_path(on, on)));
  EXPECT_FALSE(geometry->first_hit(straight_path(2.0 * on, 2.0 * on)));
}

TEST(SceneGeometry, refuses_models_that_are_none) {
  const auto refused = [](GeometryModel model) {
    return message_of<std::invalid_argument>([&] { static_cast<void>(make_geometry(std::move(model))); });
  };
  GeometryModel model = one_mesh(triangle({0, 0, 0}, {1, 0, 0}, {0, NAN, 0}));
  EXPECT_NE(refused(model).find("triangle: triangle 0 has the corner (0, nan, 0)"), std::string::npos)
      << refused(model);
  model = one_mesh(triangle({0, 0, 0}, {1, 0, 0}, {0, 1e70, 0}));
  EXPECT_NE(refused(model).find("at most 1e+60"), std::string::npos);
  model = one_mesh(triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  model.instances[0].mesh = 1;
  EXPECT_NE(refused(model).find("instance 0 is of mesh 1, of 1"), std::string::npos);
  model = one_mesh(triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), {{1, 0, 0}, {2, 0, 0}, {0, 0, 1}, {}});
  EXPECT_NE(refused(model).find("no inverse"), std::string::npos);
  model = {};
  model.meshes.push_back(nullptr);
  EXPECT_NE(refused(model).find("mesh 0 is none"), std::string::npos);
}

TEST(SceneGeometry, knows_the_nearest_surface) {
  const auto box = make_geometry(one_mesh(generate_mesh("box"), {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {}}));
  EXPECT_NEAR(box->nearest({3, 0.2, 0.1}).distance, 2.0, 1e-15);
  EXPECT_NEAR(box->nearest({2, 2, 2}).distance, std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(box->nearest({0.2, 0.1, 0.99999999}).distance, 1e-8, 1e-15);
  const Both both(four_knots());
  Draw draw(42);
  for (int k = 0; k < 300; ++k) {
    const Vec3 p = draw.in_cube(2.0);
    const NearestSurface a = both.bvh->nearest(p), b = both.reference->nearest(p);
    EXPECT_EQ(a.distance, b.distance);
    EXPECT_NEAR(length(a.position - p), a.distance, 1e-15);
  }
}

TEST(SceneGeometry, knows_the_inside_of_solids) {
  GeometryModel model = four_knots();
  for (MeshInstance& instance : model.instances) instance.solid = true;
  model.instances[0].solid = false;
  model.meshes.push_back(std::make_shared<TriangleMesh>(generate_mesh("uv-sphere")));
  model.instances.push_back({.mesh = 1,
                             .to_world = {{-2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {9, 0, 0}},
                             .owner = 0,
                             .material = {},
                             .solid = true});
  const auto geometry = make_geometry(model);
  EXPECT_EQ(geometry->solid_around({9, 0, 0}), std::optional<std::uint32_t>(5));
  EXPECT_EQ(geometry->solid_around({9, 0, 1.99}), std::optional<std::uint32_t>(5));
  EXPECT_FALSE(geometry->solid_around({9, 0, 2.01}));
  EXPECT_FALSE(geometry->solid_around({9, 1.9, 1.9}));
  // Against the parity of crossings on a straight ray, over the turned knot alone.
  GeometryModel turned = model;
  turned.instances = {model.instances[1]};
  const auto one = make_geometry(turned);
  Draw draw(43);
  int inside = 0;
  for (int k = 0; k < 500; ++k) {
    const Vec3 p = draw.in_cube(1.5);
    int crossings = 0;
    StraightRay ray{p, draw.direction()};
    for (auto hit = one->first_hit(ray); hit; hit = one->first_hit(ray)) {
      ++crossings;
      ray.origin = hit->position + 1e-9 * ray.direction;
    }
    EXPECT_EQ(one->solid_around(p).has_value(), crossings % 2 == 1) << k;
    inside += crossings % 2;
  }
  EXPECT_GT(inside, 20);
}

}  // namespace
}  // namespace xpr
