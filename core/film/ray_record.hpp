// What is known of one ray of the film when it has ended: the single source of colours, AOVs and every diagnostic.
#pragma once

#include <cstdint>
#include <limits>

#include "core/film/film_class.hpp"
#include "core/geometry/scene_geometry.hpp"
#include "integrators/status.hpp"

namespace xpr {

inline constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

/// Positions and directions in the scene's chart. What a ray has not is NaN, never 0.
struct RayRecord {
  FilmClass film_class = FilmClass::unclassified;
  Status status = Status::outside_domain;
  Vec3 position;                          ///< of the end
  Vec3 direction;                         ///< unit, of travel at the end: away from the camera
  SurfaceHit hit;                         ///< where film_class is geom_hit
  double depth = not_measured;            ///< straight-line distance from the camera to the hit
  double optical_path = not_measured;     ///< coordinate time that the light took
  double frequency_shift = not_measured;  ///< nu at the camera / nu of an emitter at rest where the ray ends
  double deflection = not_measured;       ///< angle between the ray's first and last direction
  double swept_angle = not_measured;      ///< about the z axis, with its turns
  double null_drift = not_measured;       ///< largest null residual on the way
  std::int64_t steps = 0;
};

}  // namespace xpr
