// A step's dense output as a polynomial path in the scene: what geometry looks for hits on.
#pragma once

#include <functional>
#include <vector>

#include "core/geometry/ray_path.hpp"
#include "integrators/tracer.hpp"

namespace xpr {

/// A point of the transport chart in the scene: the spatial coordinates themselves where both charts are one.
using SceneMap = std::function<Vec3(const Vec4<double>& x, int sheet)>;

/// The path of a step, in one piece of the dense output's own degree (7 at most) where `map` is empty: the same
/// polynomial in another basis, its ends those of the step. Through a map, in as many pieces as it takes polynomials of
/// degree 7 to follow it to `accuracy` (a length): pieces[k] covers theta in [k, k + 1] / size.
[[nodiscard]] std::vector<RayPath> dense_path(const StepView& step, const SceneMap& map, double accuracy);

}  // namespace xpr
