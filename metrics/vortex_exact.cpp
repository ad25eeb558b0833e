#include "metrics/vortex_exact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace xpr::vortex_exact {

namespace {

using Long = long double;

/// P(w) = c0 - c1 w + c2 w^2 = c2 (w0 - w)(w1 - w), c2 >= 0.
struct Quadratic {
  Long c0, c1, c2;
  Long w0;        ///< the turning point
  Long far_root;  ///< c2 w1
};

Quadratic quadratic(const Light& light) {
  const Long n = light.n, W = light.W, J = light.J, k = n * n - 1.0L,
             q = 1.0L - static_cast<Long>(light.p_z) * light.p_z;
  Quadratic out{.c0 = q + k,
                .c1 = J * J + q * W * W + 2.0L * k * W * J,
                .c2 = J * J * W * W * (1.0L + k),
                .w0 = 0,
                .far_root = 0};
  const Long discriminant = out.c1 * out.c1 - 4.0L * out.c0 * out.c2;
  if (!(out.c0 > 0.0L && out.c1 > 0.0L && discriminant > 0.0L)) {
    throw std::domain_error(fmt::format("J = {}: light that falls into the vortex, or no light", light.J));
  }
  out.far_root = 0.5L * (out.c1 + std::sqrt(discriminant));
  out.w0 = out.c0 / out.far_root;
  if (!(out.w0 * W * W < 1.0L)) throw std::domain_error(fmt::format("J = {}: it turns within the core", light.J));
  return out;
}

/// The azimuth between r0 and r. With r = r0 + t^2, w0 - w = t^2 (r + r0)/(r r0)^2.
struct Half {
  Long value, error;
};
Half half(const Light& light, const Quadratic& P, Long r) {
  const Long n = light.n, W = light.W, J = light.J, k = n * n - 1.0L, r0 = 1.0L / std::sqrt(P.w0);
  if (!(r >= r0)) {
    throw std::domain_error(fmt::format("r = {}, needs a distance beyond the periapsis {}", static_cast<double>(r),
                                        static_cast<double>(r0)));
  }
  const auto integrand = [&](Long t) {
    const Long radius = r0 + t * t, w = 1.0L / (radius * radius), slow = 1.0L - W * W * w;
    const Long over_t = (radius + r0) * w * P.w0 * (P.far_root - P.c2 * w) / slow;  // p_r^2 / t^2
    return 2.0L * (J * w + k * W * w * (1.0L - W * J * w) / slow) / std::sqrt(over_t);
  };
  using Gauss = boost::math::quadrature::gauss<Long, 30>;
  const Long end = std::sqrt(r - r0);
  Half out{0.0L, 0.0L};
  Long last = Gauss::integrate(integrand, 0.0L, end);
  for (int panels = 2; panels <= 4096; panels *= 2) {
    Long sum = 0.0L;
    for (int i = 0; i < panels; ++i) sum += Gauss::integrate(integrand, end * i / panels, end * (i + 1) / panels);
    out = {sum, std::abs(sum - last)};
    if (out.error < 1e-17L * (1.0L + std::abs(sum))) break;
    last = sum;
  }
  return out;
}

}  // namespace

double radial_momentum_squared(const Light& light, double r) {
  const Long n = light.n, W = light.W, J = light.J, w = 1.0L / (static_cast<Long>(r) * r);
  const Long q = 1.0L - static_cast<Long>(light.p_z) * light.p_z, A = 1.0L - W * J * w;
  return static_cast<double>(q - J * J * w + (n * n - 1.0L) * A * A / (1.0L - W * W * w));
}

double periapsis(const Light& light) { return static_cast<double>(1.0L / std::sqrt(quadratic(light).w0)); }

ExactValue swept(const Light& light, double r1, double r2) {
  const Quadratic P = quadratic(light);
  const Half in = half(light, P, r1), out = half(light, P, r2);
  const double value = static_cast<double>(in.value + out.value);
  return {value,
          std::numeric_limits<double>::epsilon() * (1.0 + std::abs(value)) + static_cast<double>(in.error + out.error)};
}

}  // namespace xpr::vortex_exact
