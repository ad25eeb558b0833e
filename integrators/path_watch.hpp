// Things in space that rays may meet: what a film's geometry is to the tracer.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "integrators/tracer.hpp"
#include "metrics/scalar/elementary.hpp"

namespace xpr {

/// Looks for the first thing on each step that a ray takes. The tracer ends the ray there as `hit`. From one thread.
class PathWatch {
 public:
  virtual ~PathWatch() = default;

  /// Whether a step from `begin` to `end` (x1, x2, x3 of the chart) may meet something: false only where nothing is
  /// within sqrt(sum bend_i^2) of the chord. The cubic through both ends and both slopes stays within 4/27 of that.
  [[nodiscard]] virtual bool may_meet(const std::array<double, 3>& begin, const std::array<double, 3>& end,
                                      const std::array<double, 3>& bend) = 0;

  /// The first meeting on the dense output of a step of ray number `ray`, as a fraction in (0, 1] of the step.
  [[nodiscard]] virtual std::optional<double> first_meeting(std::size_t ray, const StepView& step) = 0;
};

/// How far a path can be from its chord: the cubic through both ends and both slopes deviates by at most 4/27 of this,
/// and is monotone where this is less than the chord.
template <class T>
[[nodiscard]] T bend_of(const T& h, const T& g0, const T& rate0, const T& g1, const T& rate1) {
  const T chord = g1 - g0;
  return abs(h * rate0 - chord) + abs(h * rate1 - chord);
}

/// No smaller than the length in x1, x2, x3 of the cubic through both ends and both slopes: its velocity is that of the
/// chord but for as much as it bends.
template <class T>
[[nodiscard]] T path_length_bound(const T& h, const PhaseState<T>& y0, const PhaseState<T>& rate0,
                                  const PhaseState<T>& y1, const PhaseState<T>& rate1) {
  T chord = T(0.0), bend = T(0.0);
  for (std::size_t k = 1; k < 4; ++k) {
    chord = chord + square(y1[k] - y0[k]);
    bend = bend + square(bend_of(h, y0[k], rate0[k], y1[k], rate1[k]));
  }
  return sqrt(chord) + sqrt(bend);
}

/// Whether a path of at most this length, with these distances from a surface at its ends, both on the same side,
/// cannot have met it.
template <class T>
[[nodiscard]] MaskOf<T> out_of_reach(const T& distance0, const T& distance1, const T& path_length) {
  return (distance0 > 0.0) & (distance1 > 0.0) & (distance0 + distance1 > path_length);
}

}  // namespace xpr
