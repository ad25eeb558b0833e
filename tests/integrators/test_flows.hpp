// Mechanics with known answers, as flows on phase space: what every method is tried on.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "integrators/stepper.hpp"
#include "metrics/scalar/dual.hpp"
#include "metrics/tensor.hpp"

namespace xpr::test {

/// Kepler's problem H = p^2 / 2 - 1 / |x|, with dt/dlambda = 1. Separates.
struct Kepler {
  template <class T>
  PhaseState<T> operator()(const PhaseState<T>& y) const {
    const T r_sq = y[1] * y[1] + y[2] * y[2] + y[3] * y[3];
    const T pull = 1.0 / (r_sq * sqrt(r_sq));
    return {{T(1.0), y[5], y[6], y[7]}, {T(0.0), -(pull * y[1]), -(pull * y[2]), -(pull * y[3])}};
  }
  static double energy(const PhaseState<double>& y) {
    const double r = std::sqrt(y[1] * y[1] + y[2] * y[2] + y[3] * y[3]);
    return 0.5 * (y[5] * y[5] + y[6] * y[6] + y[7] * y[7]) - 1.0 / r;
  }
};

/// An elliptic orbit with semi-major axis 1 (period 2 pi), tilted and turned, so that no component is special.
struct KeplerOrbit {
  double eccentricity;
  double phase;  ///< mean anomaly at lambda = 0

  /// The state at lambda in closed form: Kepler's equation solved by Newton's method.
  [[nodiscard]] PhaseState<double> at(double lambda) const {
    const double e = eccentricity;
    const double mean = phase + lambda;
    double anomaly = mean;
    for (int i = 0; i < 50; ++i) anomaly -= (anomaly - e * std::sin(anomaly) - mean) / (1.0 - e * std::cos(anomaly));
    const double axis = std::sqrt(1.0 - e * e);
    const double rate = 1.0 / (1.0 - e * std::cos(anomaly));
    const std::array<double, 2> x = {std::cos(anomaly) - e, axis * std::sin(anomaly)};
    const std::array<double, 2> v = {-std::sin(anomaly) * rate, axis * std::cos(anomaly) * rate};
    // Axes of the orbit's plane: an orthonormal pair with small whole numbers, (2, 1, 2)/3 and (-2, 2, 1)/3.
    const auto place = [](const std::array<double, 2>& w, std::size_t i) {
      constexpr std::array<double, 3> first = {2.0 / 3, 1.0 / 3, 2.0 / 3};
      constexpr std::array<double, 3> second = {-2.0 / 3, 2.0 / 3, 1.0 / 3};
      return first[i] * w[0] + second[i] * w[1];
    };
    return {{lambda, place(x, 0), place(x, 1), place(x, 2)}, {-1.0, place(v, 0), place(v, 1), place(v, 2)}};
  }
};

inline constexpr std::array<KeplerOrbit, 3> orbits{{{0.1, 0.3}, {0.2, 2.0}, {0.3, 4.0}}};

/// Tao's example H = (x^2 + 1)(p^2 + 1) / 2 in three dimensions: does not separate.
struct NotSeparable {
  template <class T>
  PhaseState<T> operator()(const PhaseState<T>& y) const {
    const T a = y[1] * y[1] + y[2] * y[2] + y[3] * y[3] + 1.0;
    const T b = y[5] * y[5] + y[6] * y[6] + y[7] * y[7] + 1.0;
    return {{T(1.0), a * y[5], a * y[6], a * y[7]}, {T(0.0), -(b * y[1]), -(b * y[2]), -(b * y[3])}};
  }
  static double energy(const PhaseState<double>& y) {
    return 0.5 * (y[1] * y[1] + y[2] * y[2] + y[3] * y[3] + 1.0) * (y[5] * y[5] + y[6] * y[6] + y[7] * y[7] + 1.0);
  }
};

inline double largest_difference(const PhaseState<double>& a, const PhaseState<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < 8; ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

/// Root mean square over all components: what orders are observed in (one component can cross zero).
inline double distance(const PhaseState<double>& a, const PhaseState<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 8; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

inline StepperSettings settings_with_tolerance(double tol) {
  StepperSettings settings;
  settings.error_scale.absolute.fill(tol);
  settings.tao_omega = 3.0;
  return settings;
}

/// The slope of log(error) against log(step) through two points.
inline double observed_order(double coarse_error, double fine_error, double ratio = 2.0) {
  return std::log(coarse_error / fine_error) / std::log(ratio);
}

}  // namespace xpr::test
