// Exact rays of the parabolic fibre (shaped_media.hpp), no stepping. With E = 1, w = n0 g:
//   x = x0 cos(w lambda) + p0 sin(w lambda) / w across the fibre, z = z0 + p_z lambda, t = int n^2 dlambda
// Exact for any p, null or not. Cites: [BornWolf1999]
#pragma once

#include <array>

#include "metrics/tensor.hpp"

namespace xpr::shaped_media_exact {

struct FibreRay {
  PhaseState<double> y;
  double error = 0.0;  ///< of each component
};
/// Where the ray through `start` (t, x, y, z; p with p_t = -1) is at lambda. Throws std::domain_error for other p_t,
/// and for n0 or g that are not positive.
[[nodiscard]] FibreRay fibre_ray(double n0, double g, const PhaseState<double>& start, double lambda);

}  // namespace xpr::shaped_media_exact
