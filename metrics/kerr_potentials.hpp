// First integrals of Kerr light: (dr/dtau)^2 = R(r) and (dtheta/dtau)^2 = Theta(theta) in Mino time, d(lambda) = Sigma
// d(tau).
//   R = [E (r^2 + a^2) - a L]^2 - Delta [Q + (L - a E)^2],   Theta = Q + cos^2 theta (a^2 E^2 - L^2/sin^2 theta)
// Boyer-Lindquist r and theta; E = -p_t, L = p_phi, Carter's Q = p_theta^2 + cos^2 theta (L^2/sin^2 theta - a^2 E^2) of
// a null ray. Templates over the scalar: arithmetic alone. Cites: [Carter1968] [GrallaLupsasca2020Geodesics]
#pragma once

#include "metrics/scalar/scalar.hpp"

namespace xpr::kerr_exact {

/// The constants of a null ray: lengths L/E in the unit of M, Q/E^2 in its square.
template <Scalar T>
struct RayConstants {
  T energy;
  T angular_momentum;
  T carter;
};

/// R(r), in the fourth power of the length unit for E = 1.
template <Scalar T>
[[nodiscard]] constexpr T radial_potential(const T& mass, const T& spin, const RayConstants<T>& ray, const T& r) {
  const T delta = r * (r - 2.0 * mass) + spin * spin;
  return square(T(ray.energy * (r * r + spin * spin) - spin * ray.angular_momentum)) -
         delta * (ray.carter + square(T(ray.angular_momentum - spin * ray.energy)));
}

/// Theta against cos^2 theta, off the axis.
template <Scalar T>
[[nodiscard]] constexpr T polar_potential(const T& spin, const RayConstants<T>& ray, const T& cos_theta_squared) {
  return ray.carter +
         cos_theta_squared * (square(T(spin * ray.energy)) - square(ray.angular_momentum) / (1.0 - cos_theta_squared));
}

/// Q from the ray's momenta at a point off the axis.
template <Scalar T>
[[nodiscard]] constexpr T carter_constant(const T& spin, const T& energy, const T& angular_momentum, const T& p_theta,
                                          const T& cos_theta_squared) {
  return square(p_theta) +
         cos_theta_squared * (square(angular_momentum) / (1.0 - cos_theta_squared) - square(T(spin * energy)));
}

}  // namespace xpr::kerr_exact
