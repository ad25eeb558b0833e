#include "metrics/null_cone.hpp"

#include <cmath>

namespace xpr {

std::optional<Vec4<double>> null_momentum(const Spacetime& spacetime, const Vec4<double>& x, const Vec4<double>& p,
                                          double sign) {
  const SymTensor4<double> g = spacetime.inverse_metric(x);
  const Vec4<double> spatial{0.0, p[1], p[2], p[3]};
  const Vec4<double> raised = raise_index(g, spatial);
  // g^{tt} p_0^2 + 2 b p_0 + c = 0 and p^t = g^{tt} p_0 + b = root, of the wanted sign.
  const double b = raised[0];
  const double c = contract(spatial, raised);
  const double root = std::copysign(std::sqrt(b * b - g(0, 0) * c), sign);
  const double p_0 = root * b <= 0.0 ? (root - b) / g(0, 0) : -c / (root + b);
  if (!std::isfinite(p_0)) return std::nullopt;
  return Vec4<double>{p_0, p[1], p[2], p[3]};
}

}  // namespace xpr
