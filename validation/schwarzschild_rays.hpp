// Light in Schwarzschild as families and papers trace it: in from a radius and out again, and its deflection. M = 1.
#pragma once

#include <string_view>

#include "validation/kit.hpp"

namespace xpr {

/// The areal chart and a transport chart of M = 1.
[[nodiscard]] Charts schwarzschild_charts(const Lab& lab, std::string_view transport);

/// A ray from r0 inward and back out to r0.
[[nodiscard]] SweptRay there_and_back(const Lab& lab, const Charts& at, double b, double r0, const MethodAt& method,
                                      bool grade_time = false);

/// The deflection of a ray traced so: the swept angle between its own ends, and the closed-form tails beyond them, less
/// pi.
[[nodiscard]] double traced_deflection(const SweptRay& ray, double b);

/// |b d alpha / d b| + 1, by a central difference of the closed form: how much a relative error of b is amplified.
[[nodiscard]] double deflection_condition(double b);

}  // namespace xpr
