#include "metrics/separable.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace xpr {
namespace {

/// The root of a potential. What is round-off of its terms counts as 0, of either sign: the ray is at a turning point,
/// or stays at a double root.
double speed(const char* which, double potential, double size) {
  if (!(potential >= -1e-13 * size)) {
    throw std::domain_error(fmt::format("no light here: {} potential = {}, needs >= 0", which, potential));
  }
  return potential > 1e-15 * size ? sqrt(potential) : 0.0;
}

}  // namespace

SeparatedState separated_start(const SeparatedLight& light, double lambda, double eta, double energy_sign, double u,
                               double theta, bool outward, bool theta_grows) {
  const SeparatedPotentials potentials = separated_potentials(light, lambda, eta);
  const auto [sine, cosine] = sincos(theta);
  const double across = sine == 0.0 && lambda == 0.0 ? 0.0 : lambda / sine;
  const double polar_size = abs(eta) + lambda * lambda + square(light.spin) + square(across);
  const double theta_speed =
      speed("polar", potentials.polar_constant + potentials.spin_squared * square(cosine) - square(across), polar_size);
  const double radial_size = 1.0 + u * u * (abs(potentials.c2) + u * (abs(potentials.c3) + u * abs(potentials.c4)));
  const double radial_speed = speed("radial", potentials.radial(u), radial_size);
  const double theta_rate = theta_grows ? theta_speed : -theta_speed;
  SeparatedState start;
  start.energy_sign = energy_sign;
  start.lambda = lambda;
  start.eta = eta;
  start.u = u;
  start.u_rate = outward ? -radial_speed : radial_speed;
  start.n = {sine, 0.0, cosine};
  start.n_rate = {theta_rate * cosine, energy_sign * across, -theta_rate * sine};
  return start;
}

}  // namespace xpr
