#include "metrics/medium_exact.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace xpr::medium_exact {
namespace {

// long double inside: over 10^4 orbits the angle lambda/R must not round to a double.
using Long = long double;
using LongVector = std::array<Long, 3>;

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr Long long_epsilon = std::numeric_limits<Long>::epsilon();

void require_radius(double R) {
  if (!(R > 0) || !std::isfinite(R)) {
    throw std::invalid_argument(fmt::format("radius R = {}, needs a finite R > 0", R));
  }
}

void require_finite(const char* name, const Vector& v) {
  if (!std::isfinite(v[0]) || !std::isfinite(v[1]) || !std::isfinite(v[2])) {
    throw std::domain_error(fmt::format("{} = ({}, {}, {}), needs finite components", name, v[0], v[1], v[2]));
  }
}

void require_finite(const char* name, double x) {
  if (!std::isfinite(x)) throw std::domain_error(fmt::format("{} = {}, needs a finite number", name, x));
}

LongVector widened(const Vector& v) { return {v[0], v[1], v[2]}; }
Vector narrowed(const LongVector& v) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}
Long dot(const LongVector& a, const LongVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
LongVector cross(const LongVector& a, const LongVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
LongVector combined(Long a, const LongVector& x, Long b, const LongVector& y) {
  return {a * x[0] + b * y[0], a * x[1] + b * y[1], a * x[2] + b * y[2]};
}
Long length(const LongVector& a) { return std::sqrt(dot(a, a)); }

/// Rounding of a component of at most `size` to a double, and what the long arithmetic did: sixteen roundings of
/// `amplification`, one of the angle.
double bound(Long size, Long amplification, Long angle = 0) {
  return static_cast<double>(size * (epsilon + long_epsilon * amplification * (16 + std::abs(angle))));
}

/// A fish-eye ray on the unit 3-sphere (X, W), x = R X/(1 + W): start and unit tangent per angle t/R.
struct GreatCircle {
  LongVector x, tangent;
  Long w, tangent_w;
};

GreatCircle great_circle(double R, const Vector& x0, const Vector& p0) {
  require_radius(R);
  require_finite("x0", x0);
  require_finite("p0", p0);
  const LongVector x = widened(x0);
  const Long p_length = length(widened(p0));
  if (!(p_length > 0)) throw std::domain_error("p0 = 0, needs a direction");
  const LongVector direction = combined(1 / p_length, widened(p0), 0, x);
  const Long index = 2 / (1 + dot(x, x) / (Long(R) * R)), along = index * dot(x, direction) / R;
  return {combined(index / R, x, 0, x), combined(1, direction, -along / R, x), index - 1, -along};
}

}  // namespace

double luneburg_index_squared(double R, const Vector& x) {
  require_radius(R);
  const LongVector wide = widened(x);
  return static_cast<double>(2 - dot(wide, wide) / (Long(R) * R));
}

RayPoint luneburg_ray(double R, const Vector& x0, const Vector& p0, double lambda) {
  require_radius(R);
  require_finite("x0", x0);
  require_finite("p0", p0);
  require_finite("lambda", lambda);
  const Long angle = Long(lambda) / R, c = std::cos(angle), s = std::sin(angle);
  const LongVector x = widened(x0), p = widened(p0);
  const Long size = std::max(length(x) + R * length(p), length(x) / R + length(p));
  return {narrowed(combined(c, x, R * s, p)), narrowed(combined(c, p, -s / R, x)), bound(size, 1, angle)};
}

ExactValue luneburg_optical_path(double R, const Vector& x0, const Vector& p0, double lambda) {
  require_radius(R);
  require_finite("x0", x0);
  require_finite("p0", p0);
  require_finite("lambda", lambda);
  const LongVector x = widened(x0), p = widened(p0);
  const Long angle = Long(lambda) / R, s = std::sin(angle), half_sine = std::sin(2 * angle) / 4;
  const Long x_squared = dot(x, x) / (Long(R) * R), p_squared = dot(p, p), mixed = dot(x, p) / R;
  // integral of n^2 = 2 - |x(lambda)|^2/R^2
  const Long path =
      R * (2 * angle - x_squared * (angle / 2 + half_sine) - p_squared * (angle / 2 - half_sine) - mixed * s * s);
  const Long size = R * (2 + x_squared + p_squared) * (1 + std::abs(angle));
  return {static_cast<double>(path), static_cast<double>(epsilon * std::abs(path) + 16 * long_epsilon * size)};
}

ExactPoint luneburg_focus(double R) {
  require_radius(R);
  return {{R, 0.0, 0.0}, 0.0};
}

ExactValue luneburg_path_to_focus(double R, double y) {
  require_radius(R);
  if (!(std::abs(y) <= R)) throw std::domain_error(fmt::format("height y = {}, needs |y| <= R = {}", y, R));
  const double path = std::numbers::pi / 2 * R + std::sqrt((R - y) * (R + y));
  return {path, 4 * epsilon * path};
}

double fisheye_index(double R, const Vector& x) {
  require_radius(R);
  const LongVector wide = widened(x);
  return static_cast<double>(2 / (1 + dot(wide, wide) / (Long(R) * R)));
}

RayPoint fisheye_ray(double R, const Vector& x0, const Vector& p0, double optical_path) {
  const GreatCircle circle = great_circle(R, x0, p0);
  require_finite("optical path t", optical_path);
  const Long angle = Long(optical_path) / R, c = std::cos(angle), s = std::sin(angle);
  const LongVector on_sphere = combined(c, circle.x, s, circle.tangent);
  const LongVector tangent = combined(-s, circle.x, c, circle.tangent);
  const Long index = 1 + c * circle.w + s * circle.tangent_w, slope = -s * circle.w + c * circle.tangent_w;
  const LongVector x = combined(R / index, on_sphere, 0, tangent);
  // p = n^2 dx/dt, dx/dt = [tangent - (slope/n) X]/n
  const LongVector p = combined(index, tangent, -slope, on_sphere);
  const Long size = std::max({length(x), length(p), Long(R)});
  return {narrowed(x), narrowed(p), bound(size, 2 / index, angle)};
}

ExactValue fisheye_affine_parameter(double R, const Vector& x0, const Vector& p0, double optical_path) {
  const GreatCircle circle = great_circle(R, x0, p0);
  require_finite("optical path t", optical_path);
  const LongVector x = widened(x0), p = widened(p0);
  // n = 1 + e cos(f), f = t/R + f0; 1 - e^2 = (angular momentum of the ray, for |p| = n, over R)^2.
  const Long momentum = length(cross(x, p)) * (1 + circle.w) / (length(p) * R);
  if (!(momentum > 0)) throw std::domain_error("the ray passes through the centre: lambda grows without bound");
  const Long e = std::hypot(circle.w, circle.tangent_w);
  const Long f0 = std::atan2(-circle.tangent_w, circle.w), f1 = f0 + Long(optical_path) / R;
  const auto mean_anomaly = [&](Long f) {
    const Long turns = std::round(f / (2 * std::numbers::pi_v<Long>));
    const Long rest = f - turns * 2 * std::numbers::pi_v<Long>;
    const Long eccentric = 2 * std::atan2(momentum * std::sin(rest / 2), (1 + e) * std::cos(rest / 2));
    return turns * 2 * std::numbers::pi_v<Long> + eccentric - e * std::sin(eccentric);
  };
  const Long scale = R / (momentum * momentum * momentum);
  const Long lambda = scale * (mean_anomaly(f1) - mean_anomaly(f0));
  // x cross p and 1 - e lose digits as the ray nears the centre: 1/momentum for each of them.
  const Long lost = 64 * long_epsilon * scale * (1 + std::abs(f1)) / (momentum * momentum);
  return {static_cast<double>(lambda), static_cast<double>(epsilon * std::abs(lambda) + lost)};
}

ExactPoint fisheye_image(double R, const Vector& x0) {
  require_radius(R);
  require_finite("x0", x0);
  const LongVector x = widened(x0);
  const Long square = dot(x, x);
  if (!(square > 0)) throw std::domain_error("x0 = 0 has its image at infinity");
  const LongVector image = combined(-(Long(R) * R) / square, x, 0, x);
  return {narrowed(image), bound(length(image), 1)};
}

ExactValue fisheye_optical_period(double R) {
  require_radius(R);
  const double period = 2 * std::numbers::pi * R;
  return {period, 2 * epsilon * period};
}

RayCircle fisheye_circle(double R, const Vector& x0, const Vector& p0) {
  require_radius(R);
  require_finite("x0", x0);
  require_finite("p0", p0);
  // The power of the centre with respect to the circle is -R^2, and the centre lies on the normal at x0.
  const LongVector x = widened(x0), p = widened(p0);
  const LongVector momentum = cross(x, p);
  const Long size = length(momentum), p_length = length(p);
  if (!(size > 0)) throw std::domain_error("the ray passes through the centre: its circle is a straight line");
  const Long radius = (dot(x, x) + Long(R) * R) * p_length / (2 * size);
  const LongVector inward = cross(p, momentum);  // p x (x x p) = x p^2 - p (x.p), outward along x
  const LongVector centre = combined(1, x, -radius / (p_length * size), inward);
  return {narrowed(centre), static_cast<double>(radius), bound(radius + length(x), 1 + length(x) * p_length / size)};
}

}  // namespace xpr::medium_exact
