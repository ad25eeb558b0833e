// Instances of triangle meshes, and what rays ask of them: the first surface on a path, on its curve and not its chord.
//
// Two providers stand behind one interface: `bvh`, trees over triangles and over instances, and `reference`, every
// triangle in turn. Both give the same hits bit for bit, whatever the thread. Nothing is allocated by a query.
//
//   path       A step's polynomial, x(theta). Its signed distance from a triangle's plane is a polynomial in Bernstein
//              form too; its roots are found to rounding, so that the error of a hit is the dense output's own.
//   watertight A path that crosses a mesh crosses one of its triangles: edges are widened by what rounding can do
//              (`rounding` below), so that none slips through between neighbours, whatever the angle.
//   ties       Least parameter, then least instance, then least triangle.
//   tangents   A path that meets a triangle's plane within rounding without crossing it is a hit with
//              Contact::touching, one that runs within the plane with Contact::in_plane where it enters the triangle.
//
// rounding: 2^-45 (3e-14) of the largest coordinate of path and mesh in the mesh's frame. Straight rays follow
// [WoopBenthinWald2013]: no widening at all, edges and corners belong to every triangle that has them, and a triangle
// whose plane holds the ray is passed by (its neighbours have its edges).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "core/geometry/affine3.hpp"
#include "core/geometry/ray_path.hpp"
#include "core/geometry/triangle_mesh.hpp"

namespace xpr {

/// A mesh that stands in the scene.
struct MeshInstance {
  std::uint32_t mesh = 0;  ///< index into GeometryModel::meshes
  Affine3 to_world;
  std::uint32_t owner = 0;                ///< handed through to hits: what the scene calls its owner
  std::optional<std::uint32_t> material;  ///< in place of those of the mesh's triangles
  bool solid = false;                     ///< its inside is no place for a camera
};

/// What geometry is built from. Instances keep their order: it breaks ties.
struct GeometryModel {
  std::vector<std::shared_ptr<const TriangleMesh>> meshes;
  std::vector<MeshInstance> instances;
};

/// o + t d, 0 <= t <= t_max; d need not have length one.
struct StraightRay {
  Vec3 origin;
  Vec3 direction;
  double t_max = std::numeric_limits<double>::infinity();
};

/// How a path meets a surface.
enum class Contact : std::uint8_t { crossing, touching, in_plane };
[[nodiscard]] std::string_view to_string(Contact contact);

struct SurfaceHit {
  double theta = 0.0;  ///< the path's parameter in [0, 1]; for a straight ray t
  Contact contact = Contact::crossing;
  bool from_outside = false;  ///< goes against the geometric normal
  Vec3 position;              ///< on the path
  Vec3 geometric_normal;      ///< unit, on the triangle's outside, mirrored instances too
  Vec3 shading_normal;        ///< unit, from the mesh's normals where it has them
  std::array<double, 3> barycentric{};
  std::array<double, 2> uv{};  ///< of the mesh; 0 where it has none
  std::uint32_t instance = 0;
  std::uint32_t triangle = 0;
  std::uint32_t owner = 0;
  std::uint32_t material = 0;  ///< the instance's, else the triangle's, else 0
};

/// What queries cost, for telemetry: added up by those who pass one.
struct GeometryCounts {
  std::uint64_t paths = 0;      ///< queries
  std::uint64_t far = 0;        ///< queries that ended at the box around everything
  std::uint64_t pieces = 0;     ///< parts of paths that went through a mesh's tree
  std::uint64_t nodes = 0;      ///< nodes of trees looked at
  std::uint64_t triangles = 0;  ///< triangles tested in full; on straight rays by fours
  std::uint64_t hits = 0;
};

/// The surface nearest to a point.
struct NearestSurface {
  double distance = std::numeric_limits<double>::infinity();
  Vec3 position;
  std::uint32_t instance = 0;
  std::uint32_t triangle = 0;
};

enum class GeometryBackend : std::uint8_t { bvh, reference };

class SceneGeometry {
 public:
  virtual ~SceneGeometry() = default;
  SceneGeometry(const SceneGeometry&) = delete;
  SceneGeometry& operator=(const SceneGeometry&) = delete;

  /// The first surface on a path. One with a coordinate that is not finite hits nothing.
  [[nodiscard]] std::optional<SurfaceHit> first_hit(const RayPath& path, GeometryCounts* counts = nullptr) const;
  [[nodiscard]] std::optional<SurfaceHit> first_hit(const StraightRay& ray, GeometryCounts* counts = nullptr) const;

  /// False only where nothing lies within the segment's radius of it: one look at the box around everything.
  [[nodiscard]] bool may_touch(const RaySegment& segment) const;

  [[nodiscard]] virtual NearestSurface nearest(const Vec3& point) const = 0;
  /// The first instance marked solid that the point lies inside of, by the mesh's winding number (over all of its
  /// triangles: for a camera, not for rays). Cites: [JacobsonKavanSorkine2013]
  [[nodiscard]] std::optional<std::uint32_t> solid_around(const Vec3& point) const;

  [[nodiscard]] const GeometryModel& model() const { return model_; }
  /// Around all instances, in the world; empty where there are none.
  [[nodiscard]] const Box3& bounds() const { return bounds_; }
  /// Of all instances.
  [[nodiscard]] std::uint64_t triangle_count() const { return triangle_count_; }

 protected:
  /// A hit as the search leaves it.
  struct Found {
    double theta = std::numeric_limits<double>::infinity();
    std::uint32_t instance = 0;
    std::uint32_t triangle = 0;
    Contact contact = Contact::crossing;

    [[nodiscard]] bool any() const { return theta < std::numeric_limits<double>::infinity(); }
    /// Takes the other where it comes first.
    void take(const Found& other);
  };
  /// An instance, ready for rays.
  struct Placed {
    const TriangleMesh* mesh = nullptr;
    Affine3 to_mesh;
    bool moved = false;         ///< to_mesh is not the identity
    double mesh_magnitude = 0;  ///< the largest |coordinate| of the mesh, in its frame
    double condition = 1.0;     ///< how much larger rounding in the mesh's frame may be in the world
    Box3 bounds;                ///< in the world
  };

  /// Throws std::invalid_argument: a mesh that is none or does not validate, one with a corner that is not finite, a
  /// map without inverse.
  explicit SceneGeometry(GeometryModel model);

  [[nodiscard]] virtual Found find(const RayPath& path, GeometryCounts& counts) const = 0;
  [[nodiscard]] virtual Found find(const StraightRay& ray, GeometryCounts& counts) const = 0;
  [[nodiscard]] const std::vector<Placed>& placed() const { return placed_; }
  /// How far rounding may move anything that a query with coordinates up to `path_magnitude` compares, in the world.
  [[nodiscard]] double margin(double path_magnitude) const;

 private:
  [[nodiscard]] SurfaceHit complete(const Found& found, const Vec3& position, const Vec3& direction) const;

  GeometryModel model_;
  std::vector<Placed> placed_;
  Box3 bounds_;
  double reach_ = 0.0;      ///< the largest |coordinate| of instances and of their shifts
  double condition_ = 1.0;  ///< the largest of the instances
  std::uint64_t triangle_count_ = 0;
};

/// Builds what a backend needs. Throws as the constructor does.
[[nodiscard]] std::unique_ptr<SceneGeometry> make_geometry(GeometryModel model,
                                                           GeometryBackend backend = GeometryBackend::bvh);

}  // namespace xpr
