// Who looks: four-velocities of observers and the orthonormal frames in which they hold a camera.
//
// Each frame is that of an observer whom the spacetime's symmetries single out (at rest, or without angular momentum),
// boosted without rotation to the observer's own velocity; its axes there are the scene chart's directions made
// orthonormal, the viewing direction first. Cites: [BardeenPressTeukolsky1972] [MisnerThorneWheeler1973]
#pragma once

#include <optional>

#include "core/geometry/vec3.hpp"
#include "core/scene/snapshot.hpp"
#include "metrics/spacetime.hpp"

namespace xpr {

/// An orthonormal frame: contravariant components in the chart. time . time = -1, the others +1.
struct Tetrad {
  Vec4<double> time, right, up, forward;
};

/// The frame of an observer at x whose camera looks along `forward` with `up` above, both directions in the Cartesian
/// coordinates of `chart`. right, up, forward are those of a picture: seen with `forward` into the page, up upwards,
/// right is forward x up in flat space. Throws std::invalid_argument, saying which observer is possible: one at rest
/// inside an ergosphere, one without angular momentum inside a horizon, a spacetime without the symmetry needed, no
/// timelike orbit, |v| >= 1, forward and up parallel or zero.
[[nodiscard]] Tetrad make_tetrad(const Spacetime& chart, const Vec4<double>& x, const SceneObserver& observer,
                                 const Vec3& forward, const Vec3& up);

/// g_{mu nu} a^mu b^nu.
[[nodiscard]] double inner(const SymTensor4<double>& metric, const Vec4<double>& a, const Vec4<double>& b);

/// The future-directed unit vector along a; nothing where a is not timelike.
[[nodiscard]] std::optional<Vec4<double>> unit_timelike(const SymTensor4<double>& metric, const Vec4<double>& a);

}  // namespace xpr
