#include "validation/truth/kerr_first_integrals.hpp"

#include <array>

namespace xpr {

namespace {

Real50 squared(const Real50& x) { return x * x; }

/// How far a ray of the sizes used here may go, many times over.
constexpr double far = 1e4;

}  // namespace

KerrRayStart kerr_ray_start(const KerrRay& ray) {
  const Real50 a = ray.spin, r = ray.r, L = ray.L, theta = ray.theta;
  const Real50 Q = squared(Real50(ray.p_theta)) + squared(cos(theta)) * (squared(L / sin(theta)) - squared(a));
  const Real50 delta = r * r - 2 * r + a * a, P = r * r + a * a - a * L;
  return {Q, -sqrt(P * P - delta * (Q + squared(L - a))) / delta};
}

KerrRayEnd kerr_ray_by_first_integrals(const KerrRay& ray) {
  const Real50 a = ray.spin, L = ray.L, r0 = ray.r, theta0 = ray.theta;
  const auto [Q, p_r] = kerr_ray_start(ray);
  const Real50 c2 = a * a - L * L - Q, c3 = 2 * (Q + squared(L - a)), c4 = -a * a * Q;
  // u, u', c, c', phi, t, affine.
  const Rates50 rates = [=](const std::vector<Real50>& y, std::vector<Real50>& rate) {
    const Real50 &u = y[0], &c = y[2];
    const Real50 r = 1 / u, area = r * r + a * a, over_delta = (area - a * L) / (area - 2 * r);
    const Real50 sine_squared = 1 - c * c;
    rate[0] = y[1];
    rate[1] = u * (c2 + u * (3 * c3 / 2 + u * 2 * c4));
    rate[2] = y[3];
    rate[3] = c * (c2 - 2 * a * a * c * c);
    rate[4] = a * over_delta + L / sine_squared - a;
    rate[5] = area * over_delta + a * (L - a * sine_squared);
    rate[6] = r * r + a * a * c * c;
  };
  const Real50 delta = r0 * r0 - 2 * r0 + a * a;
  const std::vector<Real50> start = {
      1 / r0, -delta * p_r / (r0 * r0), cos(theta0), -sin(theta0) * Real50(ray.p_theta), 0, 0, 0};
  const Real50 u_end = 1 / Real50(ray.r_end);
  const Path50 path = integrate50_to(
      rates, start, [&](const std::vector<Real50>& y) { return Real50(y[0] - u_end); }, ray.outward ? -1 : 1,
      Real50(0.1) / r0, Real50(far));
  return {path.y[5], acos(path.y[2]), path.y[4], path.y[6], path.at};
}

KerrRayEnd kerr_ray_by_hamiltonian(const KerrRay& ray) {
  const std::array<NamedValue, 2> values = {{{"M", 1.0}, {"a", ray.spin}}};
  const Rates50 rates = flow50("kerr", "boyer-lindquist", values);
  const std::vector<Real50> start = {0, ray.r, ray.theta, 0, -1, kerr_ray_start(ray).p_r, ray.p_theta, ray.L};
  const Path50 path = integrate50_to(
      rates, start, [&](const std::vector<Real50>& y) { return Real50(y[1] - ray.r_end); }, ray.outward ? 1 : -1,
      Real50(0.1 * ray.r), Real50(far));
  return {path.y[0], path.y[2], path.y[3], path.at, 0};
}

}  // namespace xpr
