#include "metrics/kerr_exact.hpp"

#include <fmt/core.h>

#include <array>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "metrics/equatorial_light.hpp"
#include "metrics/kerr_quad.hpp"

namespace xpr::kerr_exact {
namespace {

using equatorial_light::Path;
using equatorial_light::Ray;
using std::numbers::pi;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

Ray scattered_ray(double mass, double spin, double impact_parameter) {
  const Ray ray(mass, spin, impact_parameter);
  if (!ray.turns) {
    throw std::domain_error(fmt::format(
        "impact parameter b = {}, needs b < {} or b > {}: between them the ray is captured", impact_parameter,
        critical_impact_parameter(mass, spin, spin < 0 ? Sense::prograde : Sense::retrograde).value,
        critical_impact_parameter(mass, spin, spin < 0 ? Sense::retrograde : Sense::prograde).value));
  }
  return ray;
}

}  // namespace

ExactValue outer_horizon(double mass, double spin) {
  const Hole hole(mass, spin);
  return rounded(hole.mass * hole.outer_horizon());
}

ExactValue inner_horizon(double mass, double spin) {
  const Hole hole(mass, spin);
  return rounded(hole.mass * hole.spin * hole.spin / hole.outer_horizon());
}

ExactValue photon_orbit_radius(double mass, double spin, Sense sense) {
  const Hole hole(mass, spin);
  return rounded(hole.mass * hole.photon_orbit(sense));
}

ExactValue critical_impact_parameter(double mass, double spin, Sense sense) {
  const Hole hole(mass, spin);
  const Quad size = 3 * sqrt(hole.photon_orbit(sense));
  return rounded(hole.mass * hole.sign * (sense == Sense::prograde ? Quad(size - hole.spin) : Quad(-size - hole.spin)));
}

ExactValue isco_radius(double mass, double spin, Sense sense) {
  const Hole hole(mass, spin);
  const Quad& a = hole.spin;
  const Quad z1 = 1 + cbrt((1 - a) * (1 + a)) * (cbrt(1 + a) + cbrt(1 - a));
  const Quad z2 = sqrt(3 * a * a + z1 * z1);
  const Quad root = sqrt((3 - z1) * (3 + z1 + 2 * z2));
  return rounded(hole.mass * (sense == Sense::prograde ? Quad(3 + z2 - root) : Quad(3 + z2 + root)));
}

ExactValue marginally_bound_radius(double mass, double spin, Sense sense) {
  const Hole hole(mass, spin);
  const Quad a = sense == Sense::prograde ? hole.spin : Quad(-hole.spin);
  return rounded(hole.mass * (2 - a + 2 * sqrt(1 - a)));
}

ExactValue polar_photon_orbit_radius(double mass, double spin) {
  const Hole hole(mass, spin);
  return rounded(hole.mass * hole.polar_photon_orbit());
}

ExactValue equatorial_periapsis(double mass, double spin, double impact_parameter) {
  const Ray ray = scattered_ray(mass, spin, impact_parameter);
  return rounded(ray.mass * ray.periapsis());
}

ExactValue equatorial_deflection(double mass, double spin, double impact_parameter) {
  const Bounded swept = equatorial_light::whole_swept_angle(scattered_ray(mass, spin, impact_parameter));
  return rounded(Bounded{abs(swept.value) - boost::math::constants::pi<Quad>(), swept.error});
}

ExactValue equatorial_weak_field_series(double mass, double spin, double impact_parameter, int order) {
  [[maybe_unused]] const Hole checked(mass, spin);
  if (!(std::abs(impact_parameter) > 14 * mass) || !std::isfinite(impact_parameter)) {
    throw std::domain_error(fmt::format("impact parameter b = {}, needs a finite |b| > 14 M", impact_parameter));
  }
  if (order < 1 || order > 5) throw std::domain_error(fmt::format("order = {}, needs 1 <= order <= 5", order));
  const auto coefficients = [](double a) {
    return std::array<double, 5>{4.0, 15 * pi / 4 - 4 * a, 128.0 / 3 - 10 * pi * a + 4 * a * a,
                                 15 * pi / 64 * (76 * a * a + 231) - 4 * a * (a * a + 48),
                                 3584.0 / 5 + 4 * a * a * (a * a + 128) - 4.5 * pi * a * (6 * a * a + 77)};
  };
  const double a = impact_parameter < 0 ? -spin / mass : spin / mass;
  const double x = mass / std::abs(impact_parameter);
  const auto c = coefficients(a), retrograde = coefficients(-std::abs(a));
  double sum = 0;
  for (int n = order; n >= 1; --n) sum = x * (c[static_cast<std::size_t>(n - 1)] + sum);
  // Against the rotation all coefficients are positive and bound the others' size; their ratio stays below the
  // retrograde critical b/M <= 7.
  double rest = 0;
  for (int n = order + 1; n <= 5; ++n) rest += retrograde[static_cast<std::size_t>(n - 1)] * std::pow(x, n);
  rest += 7 * retrograde[4] * std::pow(x, 6) / (1 - 7 * x);
  return {sum, rest * (1 + 64 * epsilon) + 32 * epsilon * sum};
}

ExactValue equatorial_swept_angle(double mass, double spin, double impact_parameter, double r1, double r2,
                                  bool via_periapsis) {
  return rounded(equatorial_light::swept_angle(Ray(mass, spin, impact_parameter), Path{r1, r2, via_periapsis}));
}

ExactValue equatorial_coordinate_time(double mass, double spin, double impact_parameter, double r1, double r2,
                                      bool via_periapsis) {
  return rounded(equatorial_light::coordinate_time(Ray(mass, spin, impact_parameter), Path{r1, r2, via_periapsis}));
}

RayConstants<double> principal_null_constants(double spin, double theta) {
  const double sine = std::sin(theta), cosine = std::cos(theta);
  return {1.0, spin * sine * sine, -spin * spin * cosine * cosine * cosine * cosine};
}

// b = a is the equatorial member of the congruence; t and phi do not depend on theta0.
ExactValue principal_null_time(double mass, double spin, double r1, double r2) {
  return equatorial_coordinate_time(mass, spin, spin, r1, r2, false);
}

ExactValue principal_null_angle(double mass, double spin, double r1, double r2) {
  ExactValue angle = equatorial_swept_angle(mass, spin, spin, r1, r2, false);
  angle.value = std::abs(angle.value);
  return angle;
}

}  // namespace xpr::kerr_exact
