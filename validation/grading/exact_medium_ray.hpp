// Exact rays of the two media with closed ones, at any distance from the centre.
#pragma once

#include <memory>

#include "validation/grading/exact_ray.hpp"

namespace xpr {

/// Luneburg's lens of radius R in vacuum: straight, an arc of an ellipse, straight.
[[nodiscard]] std::unique_ptr<ExactRay> luneburg_course(double R, const PhaseState<double>& start);

/// Maxwell's fish-eye: a great circle of the 3-sphere.
[[nodiscard]] std::unique_ptr<ExactRay> fisheye_course(double R, const PhaseState<double>& start);

}  // namespace xpr
