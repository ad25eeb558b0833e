// The two providers of scene geometry: trees, and every triangle in turn.
#include <cmath>

#include "core/geometry/mesh_tree.hpp"
#include "core/geometry/path_envelope.hpp"
#include "core/geometry/point_triangle.hpp"
#include "core/geometry/scene_geometry.hpp"
#include "core/geometry/triangle_contact.hpp"

namespace xpr {
namespace {

[[nodiscard]] StraightRay mapped(const StraightRay& ray, const Affine3& map) {
  return {map.point(ray.origin), map.direction(ray.direction), ray.t_max};
}

[[nodiscard]] double rounding_of(const RayPath& path, double mesh_magnitude) {
  return contact_rounding(control_box(path).magnitude(), mesh_magnitude);
}
[[nodiscard]] double rounding_of(const StraightRay& ray, double mesh_magnitude) {
  return contact_rounding(largest_magnitude(ray.origin), mesh_magnitude);
}

/// The triangle of an instance as it stands in the world.
[[nodiscard]] std::array<Vec3, 3> world_corners(const TriangleMesh& mesh, std::size_t triangle,
                                                const Affine3& to_world) {
  std::array<Vec3, 3> corners = mesh.corners(triangle);
  for (Vec3& p : corners) p = to_world.point(p);
  return corners;
}

class BvhGeometry final : public SceneGeometry {
 public:
  explicit BvhGeometry(GeometryModel model) : SceneGeometry(std::move(model)) {
    for (const auto& mesh : this->model().meshes) trees_.emplace_back(*mesh);
    std::vector<Box3> boxes;
    for (const Placed& one : placed()) {
      if (one.bounds.empty()) continue;
      boxes.push_back(one.bounds);
      instances_.push_back(static_cast<std::uint32_t>(&one - placed().data()));
    }
    over_instances_ = Bvh4(boxes);
  }

  [[nodiscard]] NearestSurface nearest(const Vec3& point) const override;

 protected:
  [[nodiscard]] Found find(const RayPath& path, GeometryCounts& counts) const override {
    const Box3 box = control_box(path);
    const double around = margin(box.magnitude());
    if (!box.grown(around).overlaps(bounds())) {
      ++counts.far;
      return {};
    }
    const RaySegment segment = enclosing_segment(path);
    ThickLine line = over_instances_.line(segment.a, segment.b - segment.a, 1.0, segment.radius + around);
    Found found;
    walk_instances(line, counts, [&](std::uint32_t instance, ThickLine&) {
      const Placed& one = placed()[instance];
      const RayPath there = one.moved ? xpr::mapped(path, one.to_mesh) : path;
      const MeshTree::Nearest first =
          tree_of(instance).first_on(there, rounding_of(there, one.mesh_magnitude), found.theta, counts);
      found.take({first.parameter, instance, first.triangle, first.contact});
    });
    return found;
  }

  [[nodiscard]] Found find(const StraightRay& ray, GeometryCounts& counts) const override {
    ThickLine line = over_instances_.line(ray.origin, ray.direction, ray.t_max, margin(largest_magnitude(ray.origin)));
    Found found;
    walk_instances(line, counts, [&](std::uint32_t instance, ThickLine& walked) {
      const Placed& one = placed()[instance];
      StraightRay there = one.moved ? mapped(ray, one.to_mesh) : ray;
      there.t_max = walked.t_max;
      const MeshTree::Nearest first = tree_of(instance).first_on(there, rounding_of(there, one.mesh_magnitude), counts);
      found.take({first.parameter, instance, first.triangle, first.contact});
      walked.t_max = std::min(walked.t_max, found.theta);
    });
    return found;
  }

 private:
  [[nodiscard]] const MeshTree& tree_of(std::uint32_t instance) const {
    return trees_[model().instances[instance].mesh];
  }

  template <class Visit>
  void walk_instances(ThickLine& line, GeometryCounts& counts, const Visit& visit) const {
    if (instances_.size() == 1) return visit(instances_[0], line);
    counts.nodes += over_instances_.walk(line, [&](std::uint32_t leaf, ThickLine& walked) {
      const Bvh4::Leaf& items = over_instances_.leaves()[leaf];
      for (std::uint32_t k = 0; k < items.count; ++k) visit(instances_[items.items[k]], walked);
    });
  }

  std::vector<MeshTree> trees_;           // one a mesh
  std::vector<std::uint32_t> instances_;  // with triangles
  Bvh4 over_instances_;
};

NearestSurface BvhGeometry::nearest(const Vec3& point) const {
  NearestSurface best;
  for (const std::uint32_t instance : instances_) {
    const Placed& one = placed()[instance];
    const Affine3& to_world = model().instances[instance].to_world;
    // A vector grows by no more than this on its way from the world into the mesh's frame (Frobenius).
    const double growth_squared = dot(one.to_mesh.x_axis, one.to_mesh.x_axis) +
                                  dot(one.to_mesh.y_axis, one.to_mesh.y_axis) +
                                  dot(one.to_mesh.z_axis, one.to_mesh.z_axis);
    const double widened = growth_squared * (1.0 + 0x1p-40);  // for rounding on either side
    const MeshTree& tree = tree_of(instance);
    const auto limit = [&] { return best.distance * best.distance * widened; };
    tree.tree().walk_from(one.to_mesh.point(point), limit(), [&](std::uint32_t leaf) {
      const Bvh4::Leaf& items = tree.tree().leaves()[leaf];
      for (std::uint32_t k = 0; k < items.count; ++k) {
        best = nearer(best, point, world_corners(*one.mesh, items.items[k], to_world), instance, items.items[k]);
      }
      return limit();
    });
  }
  return best;
}

class ReferenceGeometry final : public SceneGeometry {
 public:
  explicit ReferenceGeometry(GeometryModel model) : SceneGeometry(std::move(model)) {}

  [[nodiscard]] NearestSurface nearest(const Vec3& point) const override {
    NearestSurface best;
    for (std::uint32_t i = 0; i < placed().size(); ++i) {
      const TriangleMesh& mesh = *placed()[i].mesh;
      for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        best = nearer(best, point, world_corners(mesh, t, model().instances[i].to_world), i, t);
      }
    }
    return best;
  }

 protected:
  [[nodiscard]] Found find(const RayPath& path, GeometryCounts& counts) const override {
    Found found;
    for (std::uint32_t i = 0; i < placed().size(); ++i) {
      const Placed& one = placed()[i];
      const RayPath there = one.moved ? xpr::mapped(path, one.to_mesh) : path;
      const double rounding = rounding_of(there, one.mesh_magnitude);
      counts.triangles += one.mesh->triangles.size();
      for (std::uint32_t t = 0; t < one.mesh->triangles.size(); ++t) {
        const std::optional<PathContact> contact = first_contact(there, one.mesh->corners(t), rounding);
        if (contact) found.take({contact->theta, i, t, contact->kind});
      }
    }
    return found;
  }

  [[nodiscard]] Found find(const StraightRay& ray, GeometryCounts& counts) const override {
    Found found;
    for (std::uint32_t i = 0; i < placed().size(); ++i) {
      const Placed& one = placed()[i];
      const ShearedRay there(one.moved ? mapped(ray, one.to_mesh) : ray);
      counts.triangles += one.mesh->triangles.size();
      for (std::uint32_t t = 0; t < one.mesh->triangles.size(); ++t) {
        Corners<double> corners;
        for (std::size_t k = 0; k < 3; ++k) {
          const Vec3& p = one.mesh->vertices[one.mesh->triangles[t][k]];
          corners[k] = {p[there.right], p[there.up], p[there.along]};
        }
        const double at = ray_parameter(there, corners);
        if (at <= ray.t_max) found.take({at, i, t, Contact::crossing});
      }
    }
    return found;
  }
};

}  // namespace

std::unique_ptr<SceneGeometry> make_geometry(GeometryModel model, GeometryBackend backend) {
  if (backend == GeometryBackend::reference) return std::make_unique<ReferenceGeometry>(std::move(model));
  return std::make_unique<BvhGeometry>(std::move(model));
}

}  // namespace xpr
