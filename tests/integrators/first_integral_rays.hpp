// Separated light for tests: rays of every kind and one-ray traces.
#pragma once

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "integrators/first_integrals.hpp"
#include "metrics/kerr.hpp"

namespace xpr::test {

inline KerrParameters kerr(double a) { return {.M = 1.0, .a = a}; }

inline FirstIntegralSettings settings_of(const KerrParameters& hole, double r_max, double tol = 1e-13) {
  return {.tol = tol, .r_min = hole.default_r_min(), .r_max = r_max};
}

inline FirstIntegralEnd trace_one(const SeparatedLight& light, const SeparatedState& ray,
                                  const FirstIntegralSettings& settings) {
  FirstIntegralEnd end;
  trace_first_integrals(light, std::span(&ray, 1), std::span(&end, 1), settings);
  return end;
}

inline double angle_between(const std::array<double, 3>& v, const std::array<double, 3>& w) {
  const std::array cross{v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]};
  return std::atan2(std::hypot(cross[0], cross[1], cross[2]), v[0] * w[0] + v[1] * w[1] + v[2] * w[2]);
}

/// Reproducible numbers in [0, 1).
class Dice {
 public:
  double operator()() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state_ >> 11U) * 0x1p-53;
  }
  double between(double low, double high) { return low + (high - low) * (*this)(); }

 private:
  std::uint64_t state_ = 20240611;
};

/// Camera rays and their reverses on a screen of half-width 12, from r = 5 to 1000 at any inclination.
inline std::vector<SeparatedState> screen_rays(const SeparatedLight& light, int count, Dice& dice) {
  std::vector<SeparatedState> rays;
  for (int i = 0; i < count; ++i) {
    const double r = std::pow(10.0, dice.between(0.7, 3.0)), theta = std::acos(dice.between(-1.0, 1.0));
    const double size = std::min(12.0, 0.9 * r);
    const double alpha = dice.between(-size, size), beta = dice.between(-size, size);
    const double lambda = -alpha * std::sin(theta);
    const double eta = (alpha * alpha - light.spin * light.spin) * std::cos(theta) * std::cos(theta) + beta * beta;
    const SeparatedPotentials p = separated_potentials(light, lambda, eta);
    if (p.radial(1.0 / r) < 0.0) continue;
    const double energy_sign = dice() < 0.5 ? 1.0 : -1.0;
    const bool outward = dice() < 0.2;
    rays.push_back(separated_start(light, lambda, eta, energy_sign, 1.0 / r, theta, outward, beta > 0.0));
  }
  return rays;
}

/// A ray in the equatorial plane, from r inward or outward.
inline SeparatedState equatorial(const SeparatedLight& light, double b, double u, bool outward) {
  return separated_start(light, b, 0.0, 1.0, u, 0.5 * std::numbers::pi, outward, true);
}

}  // namespace xpr::test
