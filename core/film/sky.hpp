// What stands at infinity: colours by direction.
#pragma once

#include "core/geometry/vec3.hpp"
#include "core/scene/snapshot.hpp"

namespace xpr {

/// Longitude in [-pi, pi), zero towards -z and growing towards +x; latitude in [-pi / 2, pi / 2], rising to +y.
struct SkyDirection {
  double longitude = 0.0;
  double latitude = 0.0;
};
[[nodiscard]] SkyDirection sky_direction(const Vec3& direction);

/// The colour in a direction; black where there is no sky.
[[nodiscard]] Colour sky_colour(const SceneSky& sky, const Vec3& direction);

}  // namespace xpr
