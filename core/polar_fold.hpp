// Polar angles back into [0, pi].
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>

#include "metrics/tensor.hpp"

namespace xpr {

/// theta outside [0, pi] means that the axis was crossed, once for each multiple of pi, which adds pi to the azimuth
/// each time. `polar` and `azimuth` are the indices of the two coordinates.
inline void fold_polar_angle(PhaseState<double>& y, std::size_t polar, std::size_t azimuth) {
  constexpr double half_turn = std::numbers::pi;
  const double crossings = std::floor(y[polar] / half_turn);
  if (crossings == 0.0 || !std::isfinite(crossings) || y[polar] == half_turn) return;
  const bool odd = std::fmod(crossings, 2.0) != 0.0;
  y[polar] = odd ? (crossings + 1.0) * half_turn - y[polar] : y[polar] - crossings * half_turn;
  if (odd) y[4 + polar] = -y[4 + polar];
  y[azimuth] += std::abs(crossings) * half_turn;
}

}  // namespace xpr
