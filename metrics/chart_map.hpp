// Carrying a ray from one chart of a spacetime to another.
#pragma once

#include "metrics/spacetime.hpp"

namespace xpr {

/// A point of phase space with the sheet on which it lies (+1 where there is only one).
struct ChartState {
  PhaseState<double> state;
  int sheet = 1;
};

/// (x, p) of chart `from` in chart `to`, through the hub in which all charts of a spacetime meet; bit for bit the same
/// where both are the same chart. Both must have the same parameters. Throws std::invalid_argument where the charts
/// belong to different metrics.
///
/// There and back again costs a few units of round-off in x and p, but where a chart is singular: a spherical chart at
/// angle s from its axis keeps angles to 2e-16 (so x to 2e-16 r, and directions about the axis to 2e-16 / s where s is
/// measured from theta = pi), and on the axis itself it keeps only the momentum in the plane phi = 0; a chart singular
/// on a horizon divides by r - r+.
[[nodiscard]] ChartState change_chart(const Spacetime& from, const Spacetime& to, const PhaseState<double>& y,
                                      int sheet = 1);

}  // namespace xpr
