#include "metrics/kerr_ray_exact.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "metrics/kerr_ray_start_exact.hpp"

namespace xpr::kerr_exact {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double last_places = 4.0 * epsilon;

Wide over(double x, double mass) { return mass == 1.0 ? Wide(x) : Wide(x) / Wide(mass); }

}  // namespace

KerrRay::KerrRay(const PreparedStart& prepared)
    : mass_(prepared.mass),
      orientation_(prepared.orientation),
      time_sense_(prepared.time_sense),
      r0_(prepared.r0),
      radial_sign_(prepared.radial_sign),
      radial_(prepared.constants),
      polar_(prepared.constants, prepared.polar) {
  set_fate();
}

KerrRay::KerrRay(const RayHole& hole, const RayStart& start) : KerrRay(prepared(hole, start)) {}
KerrRay::KerrRay(const RayHole& hole, const RayMomentum& start) : KerrRay(prepared(hole, start)) {}
KerrRay::KerrRay(const RayHole& hole, const RayEvent& start) : KerrRay(prepared(hole, start)) {}

// Everything about the ray's class is here: where it starts against the roots, and which way it goes.
void KerrRay::set_fate() {
  const double r0 = static_cast<double>(r0_);
  if (!(radial_.above_outer_horizon(r0_) > 0.0)) {
    throw std::domain_error(fmt::format("r = {}, needs r > r+ = {}", mass_ * r0, mass_ * radial_.outer_horizon()));
  }
  // dt/dtau > 0 with E > 0 needs r^2 + a^2 > a lambda, next to the horizon of a rotating hole.
  if (!(static_cast<double>(r0_ * r0_ + radial_.constants.spin * (radial_.constants.spin - radial_.constants.lambda)) >
        0.0)) {
    throw std::domain_error(fmt::format("lambda = {} at r = {}: light there has E <= 0",
                                        orientation_ * mass_ * radial_.lambda, mass_ * r0));
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
  arrival.phi = with_rounding(time_sense_ * (orientation_ * radial.azimuth + polar_sense * polar.azimuth),
                              radial.azimuth_error + polar.azimuth_error);
  arrival.time = with_rounding(time_sense_ * mass_ * (radial.time + a2 * polar.cosine_squared),
                               mass_ * (radial.time_error + a2 * polar.cosine_squared_error));
  arrival.affine = with_rounding(time_sense_ * mass_ * (radial.affine + a2 * polar.cosine_squared),
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
