#include "metrics/shaped_media_exact.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace xpr::shaped_media_exact {

FibreRay fibre_ray(double n0, double g, const PhaseState<double>& start, double lambda) {
  if (!(n0 > 0.0 && g > 0.0)) throw std::domain_error(fmt::format("n0 = {}, g = {}, needs both positive", n0, g));
  if (start[4] != -1.0) throw std::domain_error(fmt::format("p_t = {}, needs -1", start[4]));
  using Long = long double;
  const Long w = static_cast<Long>(n0) * g, angle = w * lambda;
  const Long c = std::cos(angle), s = std::sin(angle);
  FibreRay out{.y = start};
  Long squares = 0.0L, size = 1.0L;  // int (x^2 + y^2) dlambda
  for (std::size_t i = 1; i < 3; ++i) {
    const Long x = start[i], p = start[i + 4];
    out.y[i] = static_cast<double>(x * c + p * s / w);
    out.y[i + 4] = static_cast<double>(p * c - x * w * s);
    const Long half = 0.5L * lambda, beat = s * c / (2.0L * w);
    squares += x * x * (half + beat) + p * p / (w * w) * (half - beat) + x * p * s * s / (w * w);
    size += std::abs(x) + std::abs(p) / w;
  }
  out.y[3] = static_cast<double>(start[3] + static_cast<Long>(start[7]) * lambda);
  const Long n_squared = static_cast<Long>(n0) * n0;
  out.y[0] = static_cast<double>(start[0] + n_squared * (lambda - static_cast<Long>(g) * g * squares));
  out.error =
      std::numeric_limits<double>::epsilon() * static_cast<double>(size * (1.0L + w) + n_squared * std::abs(lambda));
  return out;
}

}  // namespace xpr::shaped_media_exact
