// Light whose radial and polar motion separate: what first-integral tracing needs of a spacetime, and nothing else.
//
// The family is Carter's: Boyer-Lindquist (t, r, theta, phi) with Delta = r^2 - 2 M r + k. Kerr has k = a^2,
// Schwarzschild a = k = 0, charge adds its square to k, M = a = k = 0 is flat. With E = -p_t, lambda = L/E, eta =
// Q/E^2, momenta divided by |E|, u = 1/r and Mino time tau, d(affine) = Sigma d(tau):
//   radius     (du/dtau)^2 = U(u) = P^2 - D kappa u^2 = 1 + c2 u^2 + c3 u^3 + c4 u^4,   u'' = U'(u)/2,
//              P = 1 + (a^2 - a lambda) u^2,   D = 1 - 2 M u + k u^2,   kappa = eta + (lambda - a)^2
//   direction  n on the unit sphere, its azimuth psi turning as dpsi/dtau = e lambda / sin^2 theta, e = sign E:
//              n'^2 = eta + lambda^2 + a^2 n_z^2,   n'' = a^2 n_z e_z - (eta + lambda^2 + 2 a^2 n_z^2) n
//   azimuth    dphi/dtau = dpsi/dtau + e a (P/D - 1)
//   time       dt/dtau = e [(1 + a^2 u^2) P / (u^2 D) + a (lambda - a sin^2 theta)]
// u'' and n'' are polynomials: smooth through turning points and across the axis, where theta and phi are not. From
// Carter's R and Theta by u = 1/r, r^4 U = R, and by differentiating n. On a branch of sign s = sign(u' P) the pole of
// P/D at a horizon is an exact derivative, P^2 - u'^2 = D kappa u^2:
//   P/D = s u'/D + F,   F = kappa u^2 / (P + s u')   (F is what a Kerr-Schild azimuth sees),
// so that only du/D and dr* = (r^2 + a^2) dr/Delta hold logarithms, in closed form:
//   int du/D = artanh(w g)/w = A(r),   r* = r + M ln Delta - (2 M^2 + a^2 - k) A,   g = 1/(r - M),   w^2 = M^2 - k.
// Units: lengths in any one unit, M and a too; tau in its inverse. Cites: [Carter1968] [GrallaLupsasca2020Geodesics]
#pragma once

#include <array>
#include <concepts>

#include "metrics/scalar/elementary.hpp"
#include "metrics/tensor.hpp"

namespace xpr {

/// A spacetime of the family.
struct SeparatedLight {
  double mass = 1.0;
  double spin = 0.0;
  double charge_squared = 0.0;  ///< k - a^2, 0 in vacuum; a horizon needs a^2 + charge^2 <= M^2

  /// w^2 = M^2 - k: half the distance between the horizons, squared.
  [[nodiscard]] constexpr double half_gap_squared() const { return (mass - spin) * (mass + spin) - charge_squared; }
  /// D = Delta/r^2 at u = 1/r, as the difference of squares that keeps its digits where the horizons meet.
  template <class T>
  [[nodiscard]] constexpr T d(const T& u) const {
    return square(1.0 - mass * u) - half_gap_squared() * square(u);
  }
};

/// A metric whose light separates in this way says so by one member, `separated()`.
template <class M>
concept Separable = requires(const M& metric) {
  { metric.separated() } -> std::same_as<SeparatedLight>;
};

/// The potentials of one ray as polynomials.
struct SeparatedPotentials {
  double c2, c3, c4;      ///< U = 1 + c2 u^2 + c3 u^3 + c4 u^4
  double p2;              ///< P = 1 + p2 u^2
  double kappa;           ///< eta + (lambda - a)^2 >= 0
  double polar_constant;  ///< eta + lambda^2
  double spin_squared;

  [[nodiscard]] constexpr double radial(double u) const { return 1.0 + u * u * (c2 + u * (c3 + u * c4)); }
  /// u'' = U'/2.
  [[nodiscard]] constexpr double radial_force(double u) const { return u * (c2 + u * (1.5 * c3 + u * (2.0 * c4))); }
};

/// c2 = a^2 - lambda^2 - eta, c3 = 2 M kappa and c4 = p2^2 - k kappa, that is -a^2 eta - (k - a^2) kappa.
[[nodiscard]] constexpr SeparatedPotentials separated_potentials(const SeparatedLight& light, double lambda,
                                                                 double eta) {
  const double a = light.spin;
  const double across = lambda - a;
  const double kappa = eta + across * across;
  return {.c2 = a * a - (eta + lambda * lambda),
          .c3 = 2.0 * light.mass * kappa,
          .c4 = -a * a * eta - light.charge_squared * kappa,
          .p2 = -a * across,
          .kappa = kappa,
          .polar_constant = eta + lambda * lambda,
          .spin_squared = a * a};
}

/// Where a ray is and where it goes, by its first integrals: momenta divided by |E|, rates in Mino time. The direction
/// n = (sin theta cos phi, sin theta sin phi, cos theta) is that of Boyer-Lindquist theta and phi.
struct SeparatedState {
  double energy_sign = 1.0;  ///< e: of E = -p_t; -1 for rays traced back in time
  double lambda = 0.0;       ///< L/E
  double eta = 0.0;          ///< Q/E^2
  double t = 0.0;            ///< Boyer-Lindquist
  double u = 0.0;            ///< 1/r, 0 at infinity
  double u_rate = 0.0;       ///< du/dtau = -(dr/dtau)/r^2
  std::array<double, 3> n{};
  std::array<double, 3> n_rate{};  ///< with dpsi/dtau for the rate of the azimuth: tangent to the sphere
};

/// The state at (1/r, theta, phi = t = 0) with given constants. `outward` and `theta_grows` choose the branches. On the
/// axis, where lambda must be 0, the ray lies in the plane phi = 0. Throws std::domain_error where the potentials are
/// negative by more than round-off, with their values.
[[nodiscard]] SeparatedState separated_start(const SeparatedLight& light, double lambda, double eta, double energy_sign,
                                             double u, double theta, bool outward, bool theta_grows);

}  // namespace xpr
