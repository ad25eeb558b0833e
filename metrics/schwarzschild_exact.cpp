#include "metrics/schwarzschild_exact.hpp"

#include <fmt/core.h>

#include <GeographicLib/EllipticFunction.hpp>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "metrics/equatorial_light.hpp"

namespace xpr::schwarzschild_exact {
namespace {

using equatorial_light::Path;
using equatorial_light::Ray;
using std::numbers::pi;
using std::numbers::sqrt3;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

void require_mass(double mass) {
  if (!(mass > 0) || !std::isfinite(mass)) {
    throw std::invalid_argument(fmt::format("mass M = {}, needs a finite M > 0", mass));
  }
}

void require(bool good, const char* name, double value, const char* range) {
  if (!good) throw std::domain_error(fmt::format("{} = {}, needs {}", name, value, range));
}

/// A value whose evaluation took `roundings` operations, none of which cancels.
ExactValue with_roundings(double value, int roundings) { return {value, roundings * epsilon * std::abs(value)}; }

Ray ray_of(double mass, double impact_parameter) {
  require_mass(mass);
  require(impact_parameter >= 0, "impact parameter b", impact_parameter, "b >= 0");
  return {mass, 0.0, impact_parameter};
}

Ray scattered_ray(double mass, double impact_parameter) {
  const Ray ray = ray_of(mass, impact_parameter);
  require(ray.turns, "impact parameter b", impact_parameter, "b > b_c = 3 sqrt(3) M, below it the ray is captured");
  return ray;
}

// The deflection 2 integral_0^u2 du/sqrt(2 (u - u1)(u2 - u)(u3 - u)) - pi from the root u2, the gap u3 - u2 and -u1,
// all positive: R_F takes products and sums of them alone, so its relative error is that of a handful of roundings.
ExactValue deflection_from_roots(double minus_u1, double u2, double gap) {
  const double swept = 2 * std::numbers::sqrt2 *
                       GeographicLib::EllipticFunction::RF(minus_u1 * gap / u2, (u2 + minus_u1) * gap / u2,
                                                           (u2 + minus_u1) * (u2 + gap) / u2);
  return {swept - pi, 8 * epsilon * swept};
}

// The first ten coefficients of (M/b)^n.
constexpr std::array<double, 10> weak_coefficients = {4.0,
                                                      15 * pi / 4,
                                                      128.0 / 3,
                                                      3465 * pi / 64,
                                                      3584.0 / 5,
                                                      255255 * pi / 256,
                                                      98304.0 / 7,
                                                      334639305 * pi / 16384,
                                                      18743296.0 / 63,
                                                      29113619535 * pi / 65536};

}  // namespace

ExactValue photon_sphere_radius(double mass) {
  require_mass(mass);
  return with_roundings(3 * mass, 1);
}

ExactValue critical_impact_parameter(double mass) {
  require_mass(mass);
  return with_roundings(3 * sqrt3 * mass, 2);
}

ExactValue lyapunov_exponent_per_time(double mass) {
  require_mass(mass);
  return with_roundings(1 / (3 * sqrt3 * mass), 2);
}

ExactValue lyapunov_exponent_per_half_orbit() { return with_roundings(pi, 1); }

ExactValue periapsis(double mass, double impact_parameter) {
  const Ray ray = scattered_ray(mass, impact_parameter);
  return rounded(ray.periapsis() * ray.mass);
}

ExactValue deflection(double mass, double impact_parameter) {
  const Ray ray = scattered_ray(mass, impact_parameter);
  return deflection_from_roots(static_cast<double>(-ray.u1), static_cast<double>(ray.u2), static_cast<double>(ray.gap));
}

ExactValue deflection_from_periapsis(double mass, double periapsis) {
  require_mass(mass);
  require(periapsis > 3 * mass && std::isfinite(periapsis), "periapsis P", periapsis, "a finite P > 3 M");
  // Darwin's Q; u1 and u3 solve 2 u^2 - (1 - 2 u2) u - u2 (1 - 2 u2) = 0, and u3 - u2 = (P - 6 + Q)/(4P).
  const Quad p = Quad(periapsis) / Quad(mass);
  const Quad q = sqrt((p - 2) * (p + 6));
  return deflection_from_roots(static_cast<double>((q - p + 2) / (4 * p)), static_cast<double>(1 / p),
                               static_cast<double>(4 * (p - 3) / (p * (q + 6 - p))));
}

ExactValue swept_angle(double mass, double impact_parameter, double r1, double r2, bool via_periapsis) {
  return rounded(equatorial_light::swept_angle(ray_of(mass, impact_parameter), Path{r1, r2, via_periapsis}));
}

ExactValue coordinate_time(double mass, double impact_parameter, double r1, double r2, bool via_periapsis) {
  return rounded(equatorial_light::coordinate_time(ray_of(mass, impact_parameter), Path{r1, r2, via_periapsis}));
}

ExactValue weak_field_series(double mass, double impact_parameter, int order) {
  require_mass(mass);
  require(impact_parameter > 6 * sqrt3 * mass && std::isfinite(impact_parameter), "impact parameter b",
          impact_parameter, "a finite b > 2 b_c = 6 sqrt(3) M");
  require(order >= 1 && order <= 10, "order", order, "1 <= order <= 10");
  const double x = mass / impact_parameter;
  double sum = 0;
  for (int n = order; n >= 1; --n) sum = x * (weak_coefficients[static_cast<std::size_t>(n - 1)] + sum);
  // The ratio of successive coefficients grows towards b_c/M, so a geometric series with that ratio bounds the rest.
  const double next =
      order < 10 ? weak_coefficients[static_cast<std::size_t>(order)] : weak_coefficients.back() * 3 * sqrt3;
  const double rest = next * std::pow(x, order + 1) / (1 - 3 * sqrt3 * x);
  return {sum, rest * (1 + 64 * epsilon) + 8 * epsilon * sum};
}

ExactValue strong_field_logarithm(double mass, double impact_parameter) {
  const Ray ray = scattered_ray(mass, impact_parameter);
  require(impact_parameter < 1.1 * 3 * sqrt3 * mass, "impact parameter b", impact_parameter, "b_c < b < 1.1 b_c");
  const Quad ratio = ray.d / (3 * sqrt(Quad(3)));
  const auto excess = static_cast<double>(ratio - 1);
  const double constant = std::log(216 * (7 - 4 * sqrt3));
  const double value = -std::log(excess) + constant - pi;
  // What is left out is b' (5 Lambda - 35 + 4 sqrt3)/18 + ..., b' = 1 - b_c/b, Lambda = constant - ln b': below a third
  // of b' (Lambda + 1) in this range.
  const auto b_prime = static_cast<double>((ratio - 1) / ratio);
  const double rest = b_prime * (constant - std::log(b_prime) + 1) / 3;
  // 7 - 4 sqrt3 = 0.0718 loses a factor of 100.
  return {value, rest + 128 * epsilon + 4 * epsilon * (std::abs(value) + pi)};
}

ExactValue strong_field_series(double mass, double impact_parameter, int order) {
  const Ray ray = scattered_ray(mass, impact_parameter);
  require(impact_parameter < 6 * sqrt3 * mass, "impact parameter b", impact_parameter, "b_c < b < 2 b_c");
  require(order >= 0 && order <= 3, "order", order, "0 <= order <= 3");
  const Quad ratio = ray.d / (3 * sqrt(Quad(3)));
  const auto x = static_cast<double>((ratio - 1) / ratio);
  const double lambda = std::log(216 * (7 - 4 * sqrt3)) - std::log(x);
  const std::array<double, 4> terms = {-pi + lambda, (-17 + 4 * sqrt3 + 5 * lambda) * x / 18,
                                       (-879 + 236 * sqrt3 + 205 * lambda) * x * x / 1296,
                                       (-321590 + 90588 * sqrt3 + 68145 * lambda) * x * x * x / 629856};
  double sum = 0, size = pi;
  for (int n = order; n >= 0; --n) {
    sum += terms[static_cast<std::size_t>(n)];
    size += std::abs(terms[static_cast<std::size_t>(n)]);
  }
  // The rest is below the logarithm's coefficient in the next term times (Lambda + 1); the fourth one, which the paper
  // does not print, lies below 0.09 by comparison with the exact deflection.
  constexpr std::array<double, 4> next_logarithm = {5.0 / 18, 205.0 / 1296, 68145.0 / 629856, 0.09};
  const double rest = next_logarithm[static_cast<std::size_t>(order)] * std::pow(x, order + 1) * (lambda + 1);
  return {sum, rest + 128 * epsilon + 16 * epsilon * size};
}

ExactValue escape_cone_angle(double mass, double r) {
  require_mass(mass);
  require(r > 2 * mass && std::isfinite(r), "radius r", r, "a finite r > 2 M");
  // sin^2 = 27 M^2 (1 - 2M/r)/r^2 and cos^2 = (1 - 3M/r)^2 (1 + 6M/r): the arctangent is well conditioned throughout.
  const double sine = 3 * sqrt3 * (mass / r) * std::sqrt((r - 2 * mass) / r);
  const double cosine = (r - 3 * mass) / r * std::sqrt(1 + 6 * mass / r);
  // r - 2M is exact near the horizon and r - 3M (one rounding of 3M) near the photon sphere.
  return {std::atan2(sine, cosine), 8 * epsilon};
}

ExactValue areal_from_isotropic(double mass, double rho) {
  require_mass(mass);
  require(rho >= mass / 2 && std::isfinite(rho), "isotropic radius rho", rho, "a finite rho >= M/2");
  const double stretch = 1 + mass / (2 * rho);
  return with_roundings(rho * stretch * stretch, 4);
}

ExactValue isotropic_from_areal(double mass, double r) {
  require_mass(mass);
  require(r >= 2 * mass && std::isfinite(r), "areal radius r", r, "a finite r >= 2 M");
  return with_roundings((r - mass + std::sqrt(r * (r - 2 * mass))) / 2, 4);
}

ExactValue refractive_index(double mass, double rho) {
  require_mass(mass);
  require(rho > mass / 2 && std::isfinite(rho), "isotropic radius rho", rho, "a finite rho > M/2");
  const double stretch = 1 + mass / (2 * rho);
  return with_roundings(stretch * stretch * stretch * rho / (rho - mass / 2), 6);
}

}  // namespace xpr::schwarzschild_exact
