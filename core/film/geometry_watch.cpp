#include "core/film/geometry_watch.hpp"

#include <utility>

namespace xpr {

GeometryWatch::GeometryWatch(const SceneGeometry& geometry, std::size_t rays, SceneMap map, double accuracy,
                             GeometryCounts* counts)
    : geometry_(geometry), map_(std::move(map)), accuracy_(accuracy), hits_(rays), counts_(counts) {}

bool GeometryWatch::may_meet(const std::array<double, 3>& begin, const std::array<double, 3>& end,
                             const std::array<double, 3>& bend) {
  // Through a map the chord says nothing of where the path runs in the scene.
  if (map_) return geometry_.triangle_count() > 0;
  const RaySegment segment{.a = {begin[0], begin[1], begin[2]},
                           .b = {end[0], end[1], end[2]},
                           .travelled = 0.0,
                           .radius = length({bend[0], bend[1], bend[2]})};
  return geometry_.may_touch(segment);
}

std::optional<double> GeometryWatch::first_meeting(std::size_t ray, const StepView& step) {
  const std::vector<RayPath> pieces = dense_path(step, map_, accuracy_);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    std::optional<SurfaceHit> hit = geometry_.first_hit(pieces[k], counts_);
    if (!hit) continue;
    const double theta = (static_cast<double>(k) + hit->theta) / static_cast<double>(pieces.size());
    // A ray that starts on a surface leaves it.
    if (theta <= 0.0) continue;
    hits_[ray] = *hit;
    return theta;
  }
  return std::nullopt;
}

}  // namespace xpr
