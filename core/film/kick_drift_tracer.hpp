// Tier 0 of the film: rays of the kick-drift stepper through fields, chord by chord, as older renderers drew them.
#pragma once

#include <memory>

#include "core/fields/kick_drift.hpp"
#include "core/film/film_tracer.hpp"

namespace xpr {

/// Previews only: first order, hits on chords. What the stepper does not know (time, null residual) is not measured.
class KickDriftTracer final : public FilmTracer {
 public:
  /// `space` is the same fields' spacetime, in which the camera stands; rays escape at a distance of `r_max` from the
  /// origin, whence they go on straight.
  KickDriftTracer(std::shared_ptr<const FieldModel> fields, FilmSpace space, const SceneGeometry& geometry,
                  const SceneCamera& camera, double aspect, KickDriftSettings settings, bool has_sky);

  void trace(std::span<const ScreenPoint> points, std::span<RayRecord> records, GeometryCounts* counts) const override;

 private:
  [[nodiscard]] RayRecord trace_one(const PhaseState<double>& start, GeometryCounts* counts) const;

  std::shared_ptr<const FieldModel> fields_;
  FilmSpace space_;
  const SceneGeometry& geometry_;
  CameraView view_;
  KickDriftSettings settings_;
  bool has_sky_;
};

}  // namespace xpr
