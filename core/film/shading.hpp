// The colour of a ray's end: materials lit from the camera, the sky, and plain colours for what is neither.
#pragma once

#include "core/film/ray_record.hpp"
#include "core/scene/snapshot.hpp"

namespace xpr {

/// Linear. Captured light and light that got away without a sky are black; a ray that ran out of its budget is magenta,
/// one that is not understood orange, so that neither looks like a part of the scene.
[[nodiscard]] Colour colour_of(const SceneSnapshot& scene, const RayRecord& ray);

}  // namespace xpr
