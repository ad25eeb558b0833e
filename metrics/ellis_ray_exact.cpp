#include "metrics/ellis_ray_exact.hpp"

#include <fmt/core.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "metrics/carlson.hpp"

namespace xpr::ellis_exact {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

void require_good(double throat_radius, const WormholeStart& start) {
  if (!(throat_radius > 0.0) || !std::isfinite(throat_radius)) {
    throw std::invalid_argument(fmt::format("throat radius b0 = {}, needs a finite b0 > 0", throat_radius));
  }
  if (start.radial_sign != 1 && start.radial_sign != -1) {
    throw std::invalid_argument(fmt::format("sign of p_l = {}, needs +1 or -1", start.radial_sign));
  }
  if (!std::isfinite(start.l) || !std::isfinite(start.lambda) || !std::isfinite(start.p_theta)) {
    throw std::invalid_argument(
        fmt::format("l = {}, lambda = {}, p_theta = {}, needs finite numbers", start.l, start.lambda, start.p_theta));
  }
  if (!(start.theta >= 0.0 && start.theta <= std::numbers::pi)) {
    throw std::domain_error(fmt::format("theta = {}, needs 0 <= theta <= pi", start.theta));
  }
  if ((start.theta == 0.0 || start.theta == std::numbers::pi) && start.lambda != 0.0) {
    throw std::domain_error(
        fmt::format("lambda = {} on the axis theta = {}, needs lambda = 0", start.lambda, start.theta));
  }
}

/// The doubles nearest to pi/2 and pi mean those angles.
double sine_of(double theta) { return theta == std::numbers::pi ? 0.0 : std::sin(theta); }
double cosine_of(double theta) { return theta == std::numbers::pi / 2 ? 0.0 : std::cos(theta); }

Wide impact_squared(const WormholeStart& start) {
  const Wide square = Wide(start.p_theta) * start.p_theta;
  if (start.lambda == 0.0) return square;
  const double sine = sine_of(start.theta);
  return square + Wide(start.lambda) * start.lambda / (Wide(sine) * sine);
}

}  // namespace

EllisRay::EllisRay(double throat_radius, const WormholeStart& start)
    : throat_(throat_radius),
      l0_((require_good(throat_radius, start), start.l)),
      sign_(start.radial_sign),
      plane_(cosine_of(start.theta), sine_of(start.theta), start.lambda, start.p_theta),
      excess_(impact_squared(start) - Wide(throat_radius) * throat_radius),
      slip_(start.lambda == 0.0 || start.theta == std::numbers::pi / 2
                ? 0.0
                : epsilon * static_cast<double>(impact_squared(start)) / std::abs(excess_.high)),
      scatters_(excess_.high > 0.0),
      critical_(excess_.high == 0.0) {
  end_ = sign_ > 0 ? WormholeEnd::positive : WormholeEnd::negative;
  if (!scatters_ && !critical_) return;
  if (critical_ && l0_ == 0.0) throw std::domain_error("b = b0 at the throat l = 0: the ray never leaves it");
  if (scatters_) {
    const double turn = static_cast<double>(sqrt(excess_));
    if (std::abs(l0_) < turn * (1.0 - 4.0 * epsilon)) {
      throw std::domain_error(fmt::format("l = {}: this ray turns at |l| = {}", l0_, turn));
    }
  }
  const bool inward = sign_ * l0_ < 0.0;
  turns_ = scatters_ && inward;
  if (turns_) end_ = l0_ > 0.0 ? WormholeEnd::positive : WormholeEnd::negative;
  if (critical_ && inward) end_ = WormholeEnd::throat;
}

double EllisRay::variable(double l) const {
  if (!scatters_) return l;
  const Wide square = Wide(l) * l - excess_;
  return square.high > 0.0 ? std::sqrt(square.high) : 0.0;
}

EllisRay::Leg EllisRay::leg(double l) const {
  if (critical_) {
    const double angle = std::asinh(throat_ / std::abs(l));
    return {-angle, std::hypot(l, throat_) - throat_ * angle};
  }
  const double q = variable(l);
  const double b = plane_.impact_parameter(), larger = std::max(b, throat_);
  const double smaller_squared = std::abs(static_cast<double>(excess_)), squared = q * q;
  const double middle = smaller_squared * (1.0 + q / larger * (q / larger));
  const auto integrals =
      carlson::first_second_third(middle, smaller_squared + squared, smaller_squared, smaller_squared);
  return {b / larger * q * integrals.f,
          q * (larger * integrals.f + smaller_squared / larger * squared / 3.0 * integrals.d)};
}

WormholeArrival EllisRay::at(double l, int radial_turns) const {
  WormholeArrival arrival;
  arrival.end = end_;
  const bool via_turn = radial_turns == 1;
  if (!std::isfinite(l) || radial_turns < 0 || radial_turns > 1 || (via_turn && !turns_)) return arrival;
  if (scatters_ || critical_) {
    if (l * l0_ <= 0.0) return arrival;
    const double turn = static_cast<double>(sqrt(critical_ ? Wide(0.0) : excess_));
    if (std::abs(l) < turn * (1.0 - 4.0 * epsilon)) return arrival;
  }
  if (!via_turn && sign_ * (l - l0_) < 0.0) return arrival;
  const Leg from = leg(l0_), to = leg(l);
  const double sign = via_turn ? 1.0 : -1.0;
  const double swept = std::abs(to.swept + sign * from.swept), time = std::abs(to.time + sign * from.time);
  // q is off by the rounding of l and B, which chi and t pass on with slopes up to 1; some ten roundings follow.
  constexpr double rounding = 16.0 * epsilon;
  arrival.reached = true;
  arrival.l = l;
  arrival.radial_sign = via_turn ? -sign_ : sign_;
  arrival.radial_turns = radial_turns;
  // A relative change of B^2 acts as half of it on the logarithm in which both grow next to b = b0.
  arrival.swept = {swept, rounding * (std::abs(to.swept) + std::abs(from.swept)) + slip_};
  arrival.time = {time, rounding * (std::abs(to.time) + std::abs(from.time)) + slip_ * throat_};
  arrival.direction = plane_.after(swept, arrival.swept.error);
  return arrival;
}

WormholeArrival EllisRay::at_end(double distance) const {
  if (end_ == WormholeEnd::throat) {
    WormholeArrival never;
    never.end = end_;
    return never;
  }
  return at(end_ == WormholeEnd::positive ? distance : -distance, turns_ ? 1 : 0);
}

}  // namespace xpr::ellis_exact
