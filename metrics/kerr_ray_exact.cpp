#include "metrics/kerr_ray_exact.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "metrics/bounded.hpp"

namespace xpr::kerr_exact {

struct KerrRay::Prepared {
  double mass;
  double orientation;
  Wide r0;
  int radial_sign;
  UnitConstants constants;
  PolarStart polar;
};

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double last_places = 4.0 * epsilon;

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

/// Cosine and sine of theta; the double nearest to pi/2 means the equator.
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

Wide wide(const Quad& x) {
  const auto high = static_cast<double>(x);
  return {high, static_cast<double>(Quad(x - high))};
}

/// (dc/dtau)^2 at the start from the constants, cosine and sine being off by `relative_error`.
void set_rate(PolarStart& start, const UnitConstants& constants, const Wide& cosine, const Wide& sine,
              double relative_error) {
  const Wide s2 = sine * sine, c2 = cosine * cosine;
  const Wide a2 = constants.spin * constants.spin, l2 = constants.lambda * constants.lambda;
  start.rate_squared = static_cast<double>(constants.eta * s2 + c2 * (a2 * s2 - l2));
  start.rate_squared_error =
      relative_error * static_cast<double>(Wide(std::abs(constants.eta.high)) * s2 + c2 * (scaled(a2, 2.0) * s2 + l2)) +
      epsilon * std::abs(start.rate_squared);
}

/// The sign of dc/dtau against that of p_theta; a ray on the axis can only leave it.
int polar_direction(const PolarStart& start, int polar_sign) {
  if (start.sine == 0.0) return start.cosine > 0.0 ? -1 : 1;
  return -polar_sign;
}

Wide over(double x, double mass) { return mass == 1.0 ? Wide(x) : Wide(x) / Wide(mass); }

double orientation_of(const RayHole& hole) { return hole.spin < 0.0 ? -1.0 : 1.0; }

}  // namespace

KerrRay::KerrRay(const Prepared& prepared)
    : mass_(prepared.mass),
      orientation_(prepared.orientation),
      r0_(prepared.r0),
      radial_sign_(prepared.radial_sign),
      radial_(prepared.constants),
      polar_(prepared.constants, prepared.polar) {
  set_fate();
}

KerrRay::KerrRay(const RayHole& hole, const RayStart& start)
    : KerrRay([&] {
        require_hole(hole);
        require_sign("p_r", start.radial_sign);
        require_sign("p_theta", start.polar_sign);
        require_finite("r", start.r);
        require_finite("lambda", start.lambda);
        require_finite("eta", start.eta);
        PolarStart polar = placed(start.theta, start.lambda);
        const UnitConstants constants{over(std::abs(hole.spin), hole.mass),
                                      over(orientation_of(hole) * start.lambda, hole.mass),
                                      over(start.eta, hole.mass) / Wide(hole.mass)};
        set_rate(polar, constants, Wide(polar.cosine), Wide(polar.sine), 1.5 * epsilon);
        if (polar.rate_squared < 1e6 * polar.rate_squared_error) {
          // Next to a turning point the roundings of cosine and sine would cost half the digits.
          const Quad theta = start.theta;
          set_rate(polar, constants, polar.cosine == 0.0 ? Wide(0.0) : wide(cos(theta)),
                   polar.sine == 0.0 ? Wide(0.0) : wide(sin(theta)), 0x1p-98);
        }
        if (!(polar.rate_squared >= -1e-14 * (std::abs(start.eta) / hole.mass / hole.mass + 1.0))) {
          throw std::domain_error(
              fmt::format("eta = {} at theta = {} with lambda = {}: Theta < 0, no light passes there", start.eta,
                          start.theta, start.lambda));
        }
        if (polar.rate_squared < 0.0) polar.rate_squared_error -= polar.rate_squared;
        polar.rate_squared = std::max(polar.rate_squared, 0.0);
        polar.direction = polar_direction(polar, start.polar_sign);
        return Prepared{hole.mass, orientation_of(hole), over(start.r, hole.mass), start.radial_sign, constants, polar};
      }()) {}

KerrRay::KerrRay(const RayHole& hole, const RayMomentum& start)
    : KerrRay([&] {
        require_hole(hole);
        require_sign("p_r", start.radial_sign);
        require_finite("r", start.r);
        require_finite("lambda", start.lambda);
        require_finite("p_theta", start.p_theta);
        PolarStart polar = placed(start.theta, start.lambda);
        const Wide s2 = Wide(polar.sine) * polar.sine;
        const Wide c2 = std::abs(polar.cosine) > polar.sine ? Wide(1.0) - s2 : Wide(polar.cosine) * polar.cosine;
        const Wide spin = over(std::abs(hole.spin), hole.mass);
        const Wide lambda = over(orientation_of(hole) * start.lambda, hole.mass);
        const Wide p_theta = over(start.p_theta, hole.mass);
        Wide eta = p_theta * p_theta - c2 * spin * spin;
        if (start.lambda != 0.0) eta = eta + c2 * lambda * lambda / s2;
        const double rate = static_cast<double>(p_theta) * polar.sine;
        polar.rate_squared = rate * rate;
        polar.rate_squared_error = 2.0 * epsilon * polar.rate_squared;
        polar.direction = polar_direction(polar, start.p_theta < 0.0 ? -1 : 1);
        return Prepared{hole.mass,         orientation_of(hole), over(start.r, hole.mass),
                        start.radial_sign, {spin, lambda, eta},  polar};
      }()) {}

// Everything about the ray's class is here: where it starts against the roots, and which way it goes.
void KerrRay::set_fate() {
  const double r0 = static_cast<double>(r0_);
  if (!(radial_.above_outer_horizon(r0_) > 0.0)) {
    throw std::domain_error(fmt::format("r = {}, needs r > r+ = {}", mass_ * r0, mass_ * radial_.outer_horizon()));
  }
  fate_ = radial_sign_ > 0 ? Fate::escaped : Fate::captured;
  if (!radial_.turns_outside) return;
  const bool outside = r0 > 0.5 * static_cast<double>(radial_.s);
  const Wide& turn = outside ? radial_.r4 : radial_.r3;
  const double beyond = static_cast<double>(outside ? turn - r0_ : r0_ - turn);
  if (beyond > last_places * r0) {
    throw std::domain_error(fmt::format("r = {}: R < 0 between the turning points r3 = {} and r4 = {}", mass_ * r0,
                                        mass_ * static_cast<double>(radial_.r3),
                                        mass_ * static_cast<double>(radial_.r4)));
  }
  if (beyond > 0.0) r0_ = turn;
  fate_ = outside ? Fate::escaped : Fate::captured;
  turns_ = outside == (radial_sign_ < 0);
  if (turns_ && radial_.spherical) {
    fate_ = Fate::asymptotic;
    turns_ = false;
  }
}

double KerrRay::turning_radius() const {
  if (!turns_) throw std::domain_error("this ray has no turning point ahead");
  return mass_ * static_cast<double>(radial_sign_ < 0 ? radial_.r4 : radial_.r3);
}

RadialSums KerrRay::radial_path(const Wide& r, bool via_turn) const {
  if (via_turn) {
    RadialSums sums = leg_to_turn(radial_, r0_);
    sums += r.high == r0_.high && r.low == r0_.low ? sums : leg_to_turn(radial_, r);
    return sums;
  }
  return radial_sign_ < 0 ? straight_leg(radial_, r0_, r) : straight_leg(radial_, r, r0_);
}

// No further than to the turning point; a radius just beyond it is the turning point.
bool KerrRay::comes_to(Wide& r, int radial_turns) const {
  const bool via_turn = radial_turns == 1;
  if (radial_turns < 0 || radial_turns > 1 || (via_turn && !turns_)) return false;
  if (turns_ || fate_ == Fate::asymptotic) {
    const Wide& turn = radial_sign_ < 0 ? radial_.r4 : radial_.r3;
    const double beyond = radial_sign_ * static_cast<double>(r - turn);
    if (beyond > last_places * static_cast<double>(r)) return false;
    if (beyond >= 0.0) {
      if (fate_ == Fate::asymptotic) return false;
      r = turn;
    }
  }
  return via_turn || radial_sign_ * static_cast<double>(r - r0_) >= 0.0;
}

Arrival KerrRay::at_radius(double r_given, int radial_turns) const {
  Wide r = over(r_given, mass_);
  Arrival arrival;
  arrival.fate = fate_;
  if (!std::isfinite(r_given) || !(radial_.above_outer_horizon(r) > 0.0)) {
    throw std::domain_error(
        fmt::format("r = {}, needs a finite r > r+ = {}", r_given, mass_ * radial_.outer_horizon()));
  }
  if (!comes_to(r, radial_turns)) return arrival;
  const bool via_turn = radial_turns == 1;
  const RadialSums radial = radial_path(r, via_turn);
  const PolarEnd polar = polar_.after(radial.mino, radial.mino_error);
  arrival.reached = true;
  arrival.r = mass_ * static_cast<double>(r);
  arrival.radial_sign = via_turn ? -radial_sign_ : radial_sign_;
  arrival.polar_sign = -polar.direction;
  arrival.radial_turns = radial_turns;
  arrival.polar_turns = polar.turns;
  arrival.axis_crossings = polar.axis_crossings;
  arrival.cos_theta = polar.cosine;
  arrival.sin_theta = polar.sine;
  arrival.theta = {std::atan2(polar.sine, polar.cosine), polar.theta_error};
  set_sums(arrival, radial, polar);
  arrival.direction_error = std::min(std::hypot(polar.theta_error, polar.sine * arrival.phi.error), std::numbers::pi);
  return arrival;
}

void KerrRay::set_sums(Arrival& arrival, const RadialSums& radial, const PolarEnd& polar) const {
  const double a2 = radial_.a * radial_.a;
  // A crossing of the axis adds pi whatever the sense of rotation.
  const double polar_sense = polar.axis_crossings > 0 ? 1.0 : orientation_;
  const auto with_rounding = [](double value, double error) {
    return ExactValue{value, error + 2.0 * epsilon * std::abs(value)};
  };
  arrival.phi = with_rounding(orientation_ * radial.azimuth + polar_sense * polar.azimuth,
                              radial.azimuth_error + polar.azimuth_error);
  arrival.time = with_rounding(mass_ * (radial.time + a2 * polar.cosine_squared),
                               mass_ * (radial.time_error + a2 * polar.cosine_squared_error));
  arrival.affine = with_rounding(mass_ * (radial.affine + a2 * polar.cosine_squared),
                                 mass_ * (radial.affine_error + a2 * polar.cosine_squared_error));
  arrival.mino = with_rounding(radial.mino / mass_, radial.mino_error / mass_);
}

Arrival KerrRay::at_end(double r_out, double r_in) const {
  if (fate_ == Fate::asymptotic) {
    Arrival never;
    never.fate = fate_;
    return never;
  }
  return at_radius(fate_ == Fate::captured ? r_in : r_out, turns_ ? 1 : 0);
}

std::array<double, 3> Arrival::direction(double phi0) const {
  return {sin_theta * std::cos(phi0 + phi.value), sin_theta * std::sin(phi0 + phi.value), cos_theta};
}

}  // namespace xpr::kerr_exact
