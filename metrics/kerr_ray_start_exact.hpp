// The start of a Kerr ray, checked and in units of the mass. Included by the closed form's sources only.
#pragma once

#include "metrics/kerr_ray_exact.hpp"

namespace xpr::kerr_exact {

struct PreparedStart {
  double mass;
  double orientation;  ///< sign of a
  double time_sense;   ///< -1 where the ray is followed back in time
  Wide r0;
  int radial_sign;
  UnitConstants constants;
  PolarStart polar;
};

[[nodiscard]] PreparedStart prepared(const RayHole& hole, const RayStart& start);
[[nodiscard]] PreparedStart prepared(const RayHole& hole, const RayMomentum& start);
[[nodiscard]] PreparedStart prepared(const RayHole& hole, const RayEvent& start);

}  // namespace xpr::kerr_exact
