// Paths, rays and models that the tests of geometry share.
#pragma once

#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "core/geometry/mesh_shapes.hpp"
#include "core/geometry/scene_geometry.hpp"

namespace xpr::testing {

/// Random numbers that are the same everywhere: of the standard library only the generator is.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  double uniform(double lo, double hi) { return lo + (hi - lo) * 0x1p-53 * static_cast<double>(random_() >> 11); }
  Vec3 in_cube(double half) { return {uniform(-half, half), uniform(-half, half), uniform(-half, half)}; }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = in_cube(1.0);
      const double squared = dot(v, v);
      if (squared > 0.01 && squared <= 1.0) return normalized(v);
    }
  }
  int whole(int lo, int hi) { return lo + static_cast<int>(uniform(0.0, 1.0) * (hi - lo + 1)); }
  /// A path of random degree and length, its control points off a straight line by 0 to 100 % of the length.
  RayPath path(double where, double longest) {
    RayPath out;
    out.degree = whole(1, RayPath::max_degree);
    const double size = longest * uniform(0.05, 1.0);
    const double bend = size * (whole(0, 3) == 0 ? 1.0 : uniform(0.0, 0.2));
    const Vec3 start = in_cube(where), along = size * direction();
    for (int k = 0; k <= out.degree; ++k) {
      out.control[static_cast<std::size_t>(k)] = start + (static_cast<double>(k) / out.degree) * along + in_cube(bend);
    }
    return out;
  }

 private:
  std::mt19937_64 random_;
};

inline RayPath straight_path(const Vec3& a, const Vec3& b) {
  RayPath path;
  path.control[0] = a;
  path.control[1] = b;
  return path;
}

inline GeometryModel one_mesh(TriangleMesh mesh, const Affine3& to_world = {}) {
  GeometryModel model;
  model.meshes.push_back(std::make_shared<TriangleMesh>(std::move(mesh)));
  model.instances.push_back({.mesh = 0, .to_world = to_world, .owner = 0, .material = {}, .solid = false});
  return model;
}

/// A mesh of one triangle.
inline TriangleMesh triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  TriangleMesh mesh;
  mesh.name = "triangle";
  mesh.vertices = {a, b, c};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

/// A knotted tube of 500 triangles.
inline TriangleMesh knot_of_500() {
  return generate_mesh("torus-knot", std::vector<NamedValue>{{"segments", 50.0}, {"sides", 5.0}, {"tube", 0.2}});
}

/// The knot four times: turned, scaled unevenly, mirrored, and small and far away.
inline GeometryModel four_knots() {
  GeometryModel model = one_mesh(knot_of_500());
  const auto add = [&](const Affine3& map) {
    model.instances.push_back({.mesh = 0,
                               .to_world = map,
                               .owner = static_cast<std::uint32_t>(model.instances.size()),
                               .material = {},
                               .solid = false});
  };
  add({{0.6, 0.8, 0.0}, {-0.8, 0.6, 0.0}, {0.0, 0.0, 1.0}, {0.5, 0.3, 0.2}});
  add({{0.3, 0.0, 0.1}, {0.0, 2.0, 0.0}, {0.0, -0.2, 0.7}, {-0.4, 0.1, -0.3}});
  add({{-0.9, 0.0, 0.0}, {0.0, 0.9, 0.1}, {0.0, 0.0, 1.1}, {0.1, -0.7, 0.4}});
  add({{0.01, 0.0, 0.0}, {0.0, 0.01, 0.0}, {0.0, 0.0, 0.01}, {1.0, 1.0, 1.0}});
  return model;
}

}  // namespace xpr::testing
