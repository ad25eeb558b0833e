// Light traced by its first integrals, one ray in each SIMD lane.
//
// For spacetimes whose light separates (metrics/separable.hpp): radius and direction are integrated in Mino time by a
// Taylor method of high order, azimuth and time as quadratures of the same series. A ray from 1000 M past a hole and
// back takes five or six steps. Each ray has its own step, a lane whose ray has ended takes the next one at once, and
// nothing is allocated in between. A ray's result depends neither on the number of lanes nor on its neighbours, to the
// bit. Errors: proportional to the tolerance; E = 0 is outside the method. Cites: [Carter1968] [JorbaZou2005]
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "integrators/status.hpp"
#include "metrics/separable.hpp"

namespace xpr {

struct FirstIntegralSettings {
  double tol = 1e-10;  ///< of direction and azimuth in radians, of 1/r and t in units of the ray's size; 1e-15 or more
  double r_min = 0.0;  ///< going inward -> captured; outside the horizon
  double r_max = std::numeric_limits<double>::infinity();     ///< going outward -> escaped
  double mino_max = std::numeric_limits<double>::infinity();  ///< Mino time that is reached -> max_affine
  std::int64_t max_steps = 100'000;                           ///< more -> max_steps
  bool timed = true;                                          ///< t and affine length too; else NaN
  int lanes = registers::native_lanes;  ///< 1, 2, 4 or 8; the widest register of this build if not said
};

/// How a ray ended.
struct FirstIntegralEnd {
  Status status = Status::max_steps;
  SeparatedState state;        ///< at the end; t is NaN where not timed
  double swept_azimuth = 0.0;  ///< Delta phi with its windings; modulo 2 pi where lambda = 0
  double mino_time = 0.0;
  double affine = 0.0;  ///< affine length for |p_t| = 1; NaN where not timed
  std::int64_t steps = 0;
};

/// Traces every ray to its end: ends[i] belongs to rays[i]. A ray that begins beyond r_max and goes outward has escaped
/// at once; one that begins below r_min and goes inward is captured. Starts off the light cone (u'^2 off U, or n'^2 off
/// its integral, by 1e-9 of the largest term) are `constraint_violated`, starts at or inside the horizon
/// `outside_domain`. Throws std::invalid_argument for settings that make no sense and spans of different lengths.
/// Rays share nothing: blocks may go to as many threads as there are.
void trace_first_integrals(const SeparatedLight& light, std::span<const SeparatedState> rays,
                           std::span<FirstIntegralEnd> ends, const FirstIntegralSettings& settings);

template <Separable Metric>
void trace_first_integrals(const Metric& metric, std::span<const SeparatedState> rays, std::span<FirstIntegralEnd> ends,
                           const FirstIntegralSettings& settings) {
  trace_first_integrals(metric.separated(), rays, ends, settings);
}

}  // namespace xpr
