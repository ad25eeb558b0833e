#include "metrics/kerr_ray_start_exact.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace xpr::kerr_exact {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

void require_hole(const RayHole& hole) {
  if (!(hole.mass > 0.0) || !std::isfinite(hole.mass)) {
    throw std::invalid_argument(fmt::format("mass M = {}, needs a finite M > 0", hole.mass));
  }
  if (!(std::abs(hole.spin) <= hole.mass)) {
    throw std::invalid_argument(fmt::format("spin a/M = {}, needs |a/M| <= 1", hole.spin / hole.mass));
  }
}

void require_sign(const char* name, int sign) {
  if (sign != 1 && sign != -1) throw std::invalid_argument(fmt::format("sign of {} = {}, needs +1 or -1", name, sign));
}

void require_finite(const char* name, double value) {
  if (!std::isfinite(value)) throw std::invalid_argument(fmt::format("{} = {}, needs a finite number", name, value));
}

/// Cosine and sine of theta; the doubles nearest to pi/2 and pi mean the equator and the axis.
PolarStart placed(double theta, double lambda) {
  if (!(theta >= 0.0 && theta <= std::numbers::pi)) {
    throw std::domain_error(fmt::format("theta = {}, needs 0 <= theta <= pi", theta));
  }
  PolarStart start{std::cos(theta), theta == std::numbers::pi ? 0.0 : std::sin(theta), 0.0, 0.0, 1};
  if (std::abs(start.cosine) < 1e-16) start.cosine = 0.0;
  if (start.sine == 0.0 && lambda != 0.0) {
    throw std::domain_error(fmt::format("lambda = {} on the axis theta = {}, needs lambda = 0", lambda, theta));
  }
  return start;
}

/// The squares of cosine and sine to thirty digits.
struct Squares {
  Wide cosine, sine;

  Squares(const PolarStart& start, double theta) {
    const WideSincos wide = wide_sincos(theta);
    cosine = start.cosine == 0.0 ? Wide(0.0) : wide.cosine * wide.cosine;
    sine = start.sine == 0.0 ? Wide(0.0) : wide.sine * wide.sine;
  }
};

/// The sign of dc/dtau against that of p_theta; a ray on the axis can only leave it.
int polar_direction(const PolarStart& start, int polar_sign) {
  if (start.sine == 0.0) return start.cosine > 0.0 ? -1 : 1;
  return -polar_sign;
}

Wide over(const Wide& x, double mass) { return mass == 1.0 ? x : x / Wide(mass); }

double orientation_of(const RayHole& hole) { return hole.spin < 0.0 ? -1.0 : 1.0; }

/// From lambda and p_theta for E = 1, lengths as given.
PreparedStart from_momentum(const RayHole& hole, double r, double theta, const Wide& lambda, const Wide& p_theta,
                            int radial_sign) {
  PolarStart polar = placed(theta, static_cast<double>(lambda));
  const Squares squares(polar, theta);
  const double orientation = orientation_of(hole);
  const Wide spin = over(std::abs(hole.spin), hole.mass);
  const Wide unit_lambda = over(orientation < 0.0 ? -lambda : lambda, hole.mass), unit_p = over(p_theta, hole.mass);
  Wide eta = unit_p * unit_p - squares.cosine * spin * spin;
  if (lambda.high != 0.0) eta = eta + squares.cosine * unit_lambda * unit_lambda / squares.sine;
  polar.rate_squared = square(static_cast<double>(unit_p) * polar.sine);
  polar.rate_squared_error = 3.0 * epsilon * polar.rate_squared;
  polar.direction = polar_direction(polar, p_theta.high < 0.0 ? -1 : 1);
  return {.mass = hole.mass,
          .orientation = orientation,
          .time_sense = 1.0,
          .r0 = over(r, hole.mass),
          .radial_sign = radial_sign,
          .constants = {spin, unit_lambda, eta},
          .polar = polar};
}

}  // namespace

PreparedStart prepared(const RayHole& hole, const RayStart& start) {
  require_hole(hole);
  require_sign("p_r", start.radial_sign);
  require_sign("p_theta", start.polar_sign);
  require_finite("r", start.r);
  require_finite("lambda", start.lambda);
  require_finite("eta", start.eta);
  PolarStart polar = placed(start.theta, start.lambda);
  const double orientation = orientation_of(hole);
  const UnitConstants constants{over(std::abs(hole.spin), hole.mass), over(orientation * start.lambda, hole.mass),
                                over(over(start.eta, hole.mass), hole.mass)};
  // (dc/dtau)^2; next to a turning point of theta it cancels.
  const Squares squares(polar, start.theta);
  const Wide a2 = constants.spin * constants.spin, l2 = constants.lambda * constants.lambda;
  const double rate = static_cast<double>(constants.eta * squares.sine + squares.cosine * (a2 * squares.sine - l2));
  const double size = std::abs(constants.eta.high) + a2.high + l2.high;
  // Roundings of lambda and eta may leave a start at a turning point just beyond it.
  if (!(rate >= -1e-14 * size)) {
    throw std::domain_error(fmt::format("eta = {} at theta = {} with lambda = {}: Theta < 0, no light passes there",
                                        start.eta, start.theta, start.lambda));
  }
  const double unknown = 0x1p-98 * size;  // below it the start is the turning point
  polar.rate_squared = rate > unknown ? rate : 0.0;
  polar.rate_squared_error = epsilon * std::abs(rate) + unknown + std::max(-rate, 0.0);
  polar.direction = polar_direction(polar, start.polar_sign);
  return {.mass = hole.mass,
          .orientation = orientation,
          .time_sense = 1.0,
          .r0 = over(start.r, hole.mass),
          .radial_sign = start.radial_sign,
          .constants = constants,
          .polar = polar};
}

PreparedStart prepared(const RayHole& hole, const RayMomentum& start) {
  require_hole(hole);
  require_sign("p_r", start.radial_sign);
  require_finite("r", start.r);
  require_finite("lambda", start.lambda);
  require_finite("p_theta", start.p_theta);
  return from_momentum(hole, start.r, start.theta, start.lambda, start.p_theta, start.radial_sign);
}

// Back in time it is light of momentum -p gone through in reverse: L/E is the same, and so are the integrals but for
// signs.
PreparedStart prepared(const RayHole& hole, const RayEvent& start) {
  require_hole(hole);
  require_finite("r", start.r);
  require_finite("p_t", start.p_t);
  require_finite("p_r", start.p_r);
  require_finite("p_theta", start.p_theta);
  require_finite("p_phi", start.p_phi);
  if (start.p_t == 0.0) throw std::domain_error("p_t = 0, needs E != 0");
  const double energy = std::abs(start.p_t);
  PreparedStart result = from_momentum(hole, start.r, start.theta, over(start.p_phi, -start.p_t),
                                       over(start.p_theta, energy), start.p_r > 0.0 ? 1 : -1);
  if (start.p_t > 0.0) result.time_sense = -1.0;
  return result;
}

}  // namespace xpr::kerr_exact
