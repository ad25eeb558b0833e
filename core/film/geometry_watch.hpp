// The scene's geometry as the tracer meets it: a quick look at every step, and the hit on the curve of those that come
// near.
#pragma once

#include <optional>
#include <vector>

#include "core/film/dense_path.hpp"
#include "core/geometry/scene_geometry.hpp"
#include "integrators/path_watch.hpp"

namespace xpr {

class GeometryWatch final : public PathWatch {
 public:
  /// For `rays` rays of one batch. `map` is empty where transport runs in the scene's chart; else hits are found on the
  /// mapped path, followed to `accuracy`. Adds to `counts` if given. The geometry must outlive this.
  GeometryWatch(const SceneGeometry& geometry, std::size_t rays, SceneMap map, double accuracy,
                GeometryCounts* counts = nullptr);

  [[nodiscard]] bool may_meet(const std::array<double, 3>& begin, const std::array<double, 3>& end,
                              const std::array<double, 3>& bend) override;
  [[nodiscard]] std::optional<double> first_meeting(std::size_t ray, const StepView& step) override;

  /// What ray `ray` met, if anything.
  [[nodiscard]] const std::optional<SurfaceHit>& hit(std::size_t ray) const { return hits_[ray]; }

 private:
  const SceneGeometry& geometry_;
  SceneMap map_;
  double accuracy_;
  std::vector<std::optional<SurfaceHit>> hits_;
  GeometryCounts* counts_;
};

}  // namespace xpr
