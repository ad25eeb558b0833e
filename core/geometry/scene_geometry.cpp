#include "core/geometry/scene_geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/geometry/path_envelope.hpp"
#include "core/geometry/triangle_contact.hpp"
#include "metrics/scalar/elementary.hpp"

namespace xpr {
namespace {

[[nodiscard]] bool is_finite(const RayPath& path) {
  for (std::size_t k = 0; k <= static_cast<std::size_t>(path.degree); ++k) {
    if (!is_finite(path.control[k])) return false;
  }
  return true;
}

/// The angle under which p sees the triangle, over 4 pi; positive from inside. Cites: [VanOosteromStrackee1983]
[[nodiscard]] double winding(const std::array<Vec3, 3>& corners, const Vec3& p) {
  const Vec3 a = corners[0] - p, b = corners[1] - p, c = corners[2] - p;
  const double la = length(a), lb = length(b), lc = length(c);
  const double volume = dot(a, cross(b, c));
  const double rest = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  constexpr double two_pi = 6.283185307179586;
  return atan2(volume, rest) / two_pi;
}

}  // namespace

std::string_view to_string(Contact contact) {
  switch (contact) {
    case Contact::crossing:
      return "crossing";
    case Contact::touching:
      return "touching";
    case Contact::in_plane:
      break;
  }
  return "in_plane";
}

void SceneGeometry::Found::take(const Found& other) {
  if (other.theta > theta) return;
  if (other.theta == theta && std::pair(other.instance, other.triangle) >= std::pair(instance, triangle)) return;
  *this = other;
}

SceneGeometry::SceneGeometry(GeometryModel model) : model_(std::move(model)) {
  // Products of four lengths must stay far from overflow.
  constexpr double most = 1e60;
  std::vector<Box3> boxes;
  for (std::size_t m = 0; m < model_.meshes.size(); ++m) {
    if (!model_.meshes[m]) throw std::invalid_argument(fmt::format("mesh {} is none", m));
    const TriangleMesh& mesh = *model_.meshes[m];
    mesh.validate();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (const Vec3& p : mesh.corners(t)) {
        if (is_finite(p) && largest_magnitude(p) <= most) continue;
        throw std::invalid_argument(
            fmt::format("{}: triangle {} has the corner ({}, {}, {}), coordinates must be finite and at most {}",
                        mesh.name, t, p.x, p.y, p.z, most));
      }
    }
    boxes.push_back(mesh.bounds());
  }
  for (std::size_t i = 0; i < model_.instances.size(); ++i) {
    const MeshInstance& instance = model_.instances[i];
    if (instance.mesh >= model_.meshes.size()) {
      throw std::invalid_argument(
          fmt::format("instance {} is of mesh {}, of {}", i, instance.mesh, model_.meshes.size()));
    }
    const Box3& box = boxes[instance.mesh];
    Placed placed;
    placed.mesh = model_.meshes[instance.mesh].get();
    placed.to_mesh = instance.to_world.inverse();
    placed.moved = !instance.to_world.is_identity();
    placed.mesh_magnitude = box.magnitude();
    placed.condition = std::max(1.0, instance.to_world.norm() * placed.to_mesh.norm());
    for (int corner = 0; corner < 8 && !box.empty(); ++corner) {
      placed.bounds.add(
          instance.to_world.point({(corner & 1) != 0 ? box.hi.x : box.lo.x, (corner & 2) != 0 ? box.hi.y : box.lo.y,
                                   (corner & 4) != 0 ? box.hi.z : box.lo.z}));
    }
    if (placed.bounds.magnitude() > most) {
      throw std::invalid_argument(
          fmt::format("instance {} reaches to {}, at most {} does", i, placed.bounds.magnitude(), most));
    }
    bounds_.add(placed.bounds);
    reach_ = std::max(reach_, placed.bounds.magnitude() + largest_magnitude(instance.to_world.shift));
    condition_ = std::max(condition_, placed.condition);
    triangle_count_ += placed.mesh->triangles.size();
    placed_.push_back(placed);
  }
}

double SceneGeometry::margin(double path_magnitude) const {
  return 8.0 * condition_ * contact_rounding(path_magnitude, reach_);
}

std::optional<SurfaceHit> SceneGeometry::first_hit(const RayPath& path, GeometryCounts* counts) const {
  GeometryCounts ignored;
  GeometryCounts& into = counts != nullptr ? *counts : ignored;
  ++into.paths;
  if (!is_finite(path)) return std::nullopt;
  const Found found = find(path, into);
  if (!found.any()) return std::nullopt;
  ++into.hits;
  return complete(found, point(path, found.theta), velocity(path, found.theta));
}

std::optional<SurfaceHit> SceneGeometry::first_hit(const StraightRay& ray, GeometryCounts* counts) const {
  GeometryCounts ignored;
  GeometryCounts& into = counts != nullptr ? *counts : ignored;
  ++into.paths;
  if (!is_finite(ray.origin) || !is_finite(ray.direction) || ray.direction == Vec3{}) return std::nullopt;
  const Found found = find(ray, into);
  if (!found.any()) return std::nullopt;
  ++into.hits;
  return complete(found, ray.origin + found.theta * ray.direction, ray.direction);
}

SurfaceHit SceneGeometry::complete(const Found& found, const Vec3& position, const Vec3& direction) const {
  const Placed& placed = placed_[found.instance];
  const TriangleMesh& mesh = *placed.mesh;
  const MeshInstance& instance = model_.instances[found.instance];
  const std::array<Vec3, 3> corners = mesh.corners(found.triangle);
  const auto& vertex = mesh.triangles[found.triangle];

  SurfaceHit hit;
  hit.theta = found.theta;
  hit.contact = found.contact;
  hit.position = position;
  hit.instance = found.instance;
  hit.triangle = found.triangle;
  hit.owner = instance.owner;
  hit.material = instance.material.value_or(mesh.materials.empty() ? 0 : mesh.materials[found.triangle]);
  hit.barycentric = barycentric_at(corners, placed.to_mesh.point(position));
  const Vec3 normal = normalized(cross(corners[1] - corners[0], corners[2] - corners[0]));
  hit.geometric_normal = normalized(placed.to_mesh.transposed(normal));
  hit.from_outside = dot(direction, hit.geometric_normal) < 0.0;
  hit.shading_normal = hit.geometric_normal;
  if (!mesh.normals.empty()) {
    Vec3 mean{};
    for (std::size_t k = 0; k < 3; ++k) mean = mean + hit.barycentric[k] * mesh.normals[vertex[k]];
    const Vec3 shading = normalized(placed.to_mesh.transposed(mean));
    if (is_finite(shading)) hit.shading_normal = shading;
  }
  if (!mesh.uv.empty()) {
    for (std::size_t k = 0; k < 3; ++k) {
      hit.uv[0] += hit.barycentric[k] * mesh.uv[vertex[k]][0];
      hit.uv[1] += hit.barycentric[k] * mesh.uv[vertex[k]][1];
    }
  }
  return hit;
}

bool SceneGeometry::may_touch(const RaySegment& segment) const {
  Box3 box;
  box.add(segment.a);
  box.add(segment.b);
  const double reach = segment.radius + margin(box.magnitude());
  return box.grown(reach).overlaps(bounds_);
}

std::optional<std::uint32_t> SceneGeometry::solid_around(const Vec3& p) const {
  for (std::size_t i = 0; i < placed_.size(); ++i) {
    if (!model_.instances[i].solid || !placed_[i].bounds.contains(p)) continue;
    const Vec3 there = placed_[i].to_mesh.point(p);
    double turns = 0.0;
    for (std::size_t t = 0; t < placed_[i].mesh->triangles.size(); ++t) {
      turns += winding(placed_[i].mesh->corners(t), there);
    }
    // Closed meshes give whole numbers; half of one parts them, holes and rounding notwithstanding.
    if (std::fabs(turns) > 0.5) return static_cast<std::uint32_t>(i);
  }
  return std::nullopt;
}

}  // namespace xpr
