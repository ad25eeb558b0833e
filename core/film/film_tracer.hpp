// From points of the picture to records: camera rays through the spacetime, in lanes, up to what they meet.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "core/camera/camera.hpp"
#include "core/film/dense_path.hpp"
#include "core/film/ray_record.hpp"
#include "core/geometry/scene_geometry.hpp"
#include "integrators/tracer.hpp"
#include "metrics/spacetime.hpp"

namespace xpr {

/// Where light runs: the chart in which the scene is given and the one that carries its light, the same or another of
/// the same spacetime.
struct FilmSpace {
  std::shared_ptr<const Spacetime> scene;
  std::shared_ptr<const Spacetime> transport;
  /// The metric is a medium's in flat space: clocks tick with t, whatever g_tt says.
  bool medium = false;
};

struct FilmTracerSettings {
  TraceSettings trace;  ///< r_max set
  int lanes = 1;
  bool has_sky = false;
};

/// What finds the records of points of the picture: one interface for every way to carry light. Immutable; trace() may
/// be called from many threads.
class FilmTracer {
 public:
  virtual ~FilmTracer() = default;
  /// The ray that each point sees. Adds to `counts` if given.
  virtual void trace(std::span<const ScreenPoint> points, std::span<RayRecord> records,
                     GeometryCounts* counts) const = 0;
};

/// Null geodesics by any method: media, fields, spacetimes.
class GeodesicTracer final : public FilmTracer {
 public:
  /// Throws std::invalid_argument as CameraView does, and for an observer who moves within a medium.
  GeodesicTracer(FilmSpace space, const SceneGeometry& geometry, const SceneCamera& camera,
                 const SceneObserver& observer, double aspect, FilmTracerSettings settings);

  void trace(std::span<const ScreenPoint> points, std::span<RayRecord> records, GeometryCounts* counts) const override;

  [[nodiscard]] const CameraView& view() const { return view_; }
  [[nodiscard]] const FilmSpace& space() const { return space_; }
  [[nodiscard]] const FilmTracerSettings& settings() const { return settings_; }

 private:
  [[nodiscard]] RayRecord record(const PhaseState<double>& start, const RayEnd& end,
                                 const std::optional<SurfaceHit>& hit) const;
  [[nodiscard]] double emitted(const PhaseState<double>& end, Status status) const;

  FilmSpace space_;
  const SceneGeometry& geometry_;
  CameraView view_;
  FilmTracerSettings settings_;
  SceneMap map_;
  double accuracy_ = 0.0;
};

}  // namespace xpr
