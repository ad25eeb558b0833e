// A scene as a frame sees it: everything resolved and checked, nothing that can change. Made by SceneBuilder from any
// host (scene_host.hpp), published between frames by SnapshotBus.
//
// Meshes, instances, materials and fields stand in the order of their paths, so that two hosts that say the same in
// another order give the same snapshot. World coordinates are those of the scene's chart, which is Cartesian and
// static: triangles are flat in it. Lengths in the scene's unit, angles in radians.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/geometry/affine3.hpp"
#include "core/geometry/scene_geometry.hpp"
#include "core/geometry/vec3.hpp"
#include "core/scene/research.hpp"
#include "integrators/tracer.hpp"
#include "metrics/fields/field_source.hpp"

namespace xpr {

struct SceneHeader {
  std::string name;
  std::string about;  ///< one line for people
  std::string chart;  ///< id of the scene's chart; empty in a description: the metric's first Cartesian one
  std::string units = "scene";
};

enum class CameraModel { pinhole, fisheye, equirectangular, impact_parameter };
inline constexpr std::array<std::string_view, 4> camera_model_names{"pinhole", "fisheye", "equirectangular",
                                                                    "impact-parameter"};

/// In a snapshot right, up and forward are orthonormal, right = forward x up.
struct SceneCamera {
  CameraModel model = CameraModel::pinhole;
  Vec3 position;
  Vec3 forward{0.0, 0.0, -1.0};
  Vec3 up{0.0, 1.0, 0.0};
  Vec3 right{1.0, 0.0, 0.0};
  /// Top to bottom: below pi for a pinhole, up to 2 pi for a fisheye; an equirectangular image shows all of the sky.
  double fov = 0.8726646259971648;  // 50 degrees
  double half_width = 10.0;         ///< of an impact-parameter screen, from its middle to its left and right edge
  double time = 0.0;                ///< coordinate time of the exposure
};

/// Who holds the camera.
enum class ObserverKind { at_rest, zamo, circular_orbit, falling, boosted };
inline constexpr std::array<std::string_view, 5> observer_kind_names{"static", "zamo", "circular-orbit", "falling",
                                                                     "boosted"};

struct SceneObserver {
  ObserverKind kind = ObserverKind::at_rest;
  Vec3 velocity;         ///< of a boosted one, as a static observer at the same place measures it; |velocity| < 1
  bool prograde = true;  ///< of a circular orbit
};

/// How light is carried. In a snapshot every default has been replaced by a value, and Research Mode has been applied.
struct SceneTransport {
  int tier = 1;        ///< 0 kick-drift, 1 error-bounded, 2 invariant-preserving
  std::string method;  ///< a method id; empty in a description: the tier's
  double tol = 0.0;    ///< of adaptive methods; 0 in a description: the tier's
  double step = 0.01;  ///< of fixed-step methods, in lambda for |p_t| = 1
  std::int64_t max_steps = 100'000;
  std::optional<double> r_min, r_max;
  std::optional<Projection> project;         ///< nothing in a description: the tier's
  std::string chart;                         ///< that light is carried in; empty: the regular one
  KickDriftSettings preview;                 ///< of tier 0
  std::int64_t collision_every_n_steps = 1;  ///< of tier 0: steps in a segment that geometry sees
};

/// Gravity by a metric of the catalogue, centred at the origin. `minkowski` where light is straight or bent by fields.
struct SceneSpacetime {
  std::string metric = "minkowski";
  std::vector<std::pair<std::string, double>> parameters;  ///< those that were set, by name
};

/// Channels of a colour are linear, 0 to 1 where nothing shines.
using Colour = std::array<double, 3>;

/// Triangle meshes, by name. Snapshots share them: a frame in which only instances moved has the same meshes.
struct SceneMeshes {
  std::vector<std::string> name;
  std::vector<std::shared_ptr<const TriangleMesh>> mesh;
  std::vector<std::string> source;  ///< the file or the shape that it came from

  [[nodiscard]] std::size_t size() const { return name.size(); }
};

/// How a surface looks. `lit` and `checker` are bright where they face the camera, `flat` is its colour everywhere,
/// light that meets an `absorber` ends there and is black.
enum class MaterialKind { flat, lit, checker, absorber };
inline constexpr std::array<std::string_view, 4> material_kind_names{"flat", "lit", "checker", "absorber"};

struct SceneMaterials {
  std::vector<std::string> name;
  std::vector<MaterialKind> kind;
  std::vector<Colour> colour_a;
  std::vector<Colour> colour_b;                      ///< of a checker's other squares
  std::vector<std::array<std::int64_t, 2>> squares;  ///< of a checker, along u and v from 0 to 1

  [[nodiscard]] std::size_t size() const { return name.size(); }
};

/// Meshes where they stand, by path.
struct SceneInstances {
  std::vector<std::string> path;
  std::vector<std::uint32_t> mesh;  ///< an index into SceneMeshes
  std::vector<Affine3> to_world;    ///< parents applied
  /// An index into SceneMaterials; nothing where the mesh's triangles name their own, as such indices too.
  std::vector<std::optional<std::uint32_t>> material;
  std::vector<std::uint8_t> solid;  ///< 1: its inside is no place for a camera

  [[nodiscard]] std::size_t size() const { return path.size(); }
};

enum class SkyKind { none, checker, graticule, image };
inline constexpr std::array<std::string_view, 4> sky_kind_names{"none", "checker", "graticule", "image"};

struct SkyImage;

/// What stands at infinity. Longitude turns from forward -z, latitude rises to +y.
struct SceneSky {
  SkyKind kind = SkyKind::none;
  Colour colour_a{0.10, 0.12, 0.18};
  Colour colour_b{0.85, 0.86, 0.90};
  std::int64_t squares = 24;  ///< of a checker or graticule around the equator; half as many from pole to pole
  double line_width = 0.008726646259971648;  ///< of a graticule, an angle (half a degree)
  std::string file;                          ///< of an image
  std::shared_ptr<const SkyImage> image;     ///< what is in it
};

/// What is stored for every pixel beside its colour.
enum class Aov {
  depth,
  normal,
  n_dot_v,
  two_sided_n_dot_v,
  pixel_class,
  frequency_shift,
  deflection,
  swept_angle,
  null_drift,
  steps,
  owner
};
inline constexpr std::array<std::string_view, 11> aov_names{
    "depth",      "normal", "n-dot-v", "two-sided-n-dot-v", "class", "frequency-shift", "deflection", "swept-angle",
    "null-drift", "steps",  "owner"};

struct SceneFilm {
  std::int64_t width = 640, height = 360;
  double scale = 1.0;
  std::int64_t samples = 1;  ///< rays a pixel
  std::int64_t tile = 32;    ///< edge of the squares that threads share; no result depends on it
  std::int64_t seed = 1;
  std::vector<Aov> aovs;  ///< each once, in the order of the enum; empty in a description: all

  /// Of the image: max(8, round(width scale)).
  [[nodiscard]] std::int64_t columns() const { return scaled(width); }
  [[nodiscard]] std::int64_t rows() const { return scaled(height); }

 private:
  [[nodiscard]] std::int64_t scaled(std::int64_t size) const {
    const auto pixels = static_cast<std::int64_t>(static_cast<double>(size) * scale + 0.5);
    return pixels < 8 ? 8 : pixels;
  }
};

/// Research Mode as it came out: what was asked for, and what follows.
struct SceneResearch {
  std::string preset = "off";
  ResearchOverrides overrides;  ///< in a snapshot: the preset's with the scene's own over them
  ResearchConfig config;        ///< effective
  ResearchClamps clamps;        ///< of the tier-0 stepping
};

struct SceneSnapshot {
  SceneHeader header;
  SceneCamera camera;
  SceneObserver observer;
  SceneTransport transport;
  SceneSpacetime spacetime;
  FieldSet fields;
  SceneMeshes meshes;
  SceneMaterials materials;
  SceneInstances instances;
  SceneSky sky;
  SceneFilm film;
  SceneResearch research;
  std::vector<std::string> warnings;  ///< what was put right or left out, a line each
};

/// What geometry is built from; owner k is instance k.
[[nodiscard]] GeometryModel geometry_model(const SceneSnapshot& scene);

}  // namespace xpr
