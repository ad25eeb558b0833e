// Where a ray of a spherically symmetric spacetime points after it swept an angle chi in its plane: theta and unwrapped
// phi from the start's theta, L = p_phi and p_theta. The plane meets the sphere in a great circle,
//   n(chi) = n0 cos chi + e sin chi,   n0 = (sin theta0, 0, cos theta0),   e = (p_theta theta^ + (L/sin theta0)
//   phi^)/b,
// b^2 = p_theta^2 + L^2/sin^2 theta0. For L = 0, which crosses the axis, phi grows by pi at each crossing.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "metrics/exact_value.hpp"

namespace xpr {

/// The direction reached. Errors for chi off by the given error.
struct PlaneEnd {
  ExactValue theta;
  ExactValue phi;
  double cos_theta = 0.0;
  double sin_theta = 0.0;
  double direction_error = 0.0;  ///< as an angle on the sphere
  int polar_sign = 1;            ///< of p_theta
  int polar_turns = 0;
  int axis_crossings = 0;  ///< L = 0 only
};

class OrbitalPlane {
 public:
  /// theta0 in [0, pi]; L = 0 where it is on the axis.
  OrbitalPlane(double cos_theta0, double sin_theta0, double angular_momentum, double p_theta)
      : cosine_(cos_theta0), sine_(sin_theta0), angular_momentum_(angular_momentum) {
    const double across = angular_momentum == 0.0 ? 0.0 : angular_momentum / sin_theta0;
    impact_ = std::hypot(p_theta, across);
    if (impact_ > 0.0) down_ = p_theta / impact_, across_ = across / impact_;
  }

  /// b.
  [[nodiscard]] double impact_parameter() const { return impact_; }

  [[nodiscard]] PlaneEnd after(double chi, double chi_error) const {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    constexpr double pi = std::numbers::pi;
    const double cosine = std::cos(chi), sine = std::sin(chi);
    const double x = sine_ * cosine + cosine_ * down_ * sine, y = across_ * sine;
    PlaneEnd end;
    end.cos_theta = cosine_ * cosine - sine_ * down_ * sine;
    end.sin_theta = std::hypot(x, y);
    end.direction_error = chi_error + 8.0 * epsilon;
    end.theta = {std::atan2(end.sin_theta, end.cos_theta), end.direction_error};
    end.polar_sign = sine_ * down_ * cosine + cosine_ * sine < 0.0 ? -1 : 1;
    // cos theta = const cos(chi + ahead): passages through its extremes, and of the axis where they reach it.
    const double ahead = std::atan2(sine_ * down_, cosine_);
    const int passages = static_cast<int>(std::floor((chi + ahead) / pi) - std::floor(ahead / pi));
    if (angular_momentum_ == 0.0) {
      end.axis_crossings = passages;
      end.phi = {pi * passages, 2.0 * epsilon * pi * passages};
      return end;
    }
    end.polar_turns = passages;
    const double turns = std::floor(chi / (2.0 * pi));
    const double rest = std::atan2(std::abs(y) * (sine < 0.0 ? -1.0 : 1.0), x);
    const double phi = 2.0 * pi * turns + (rest < 0.0 ? rest + 2.0 * pi : rest);
    const double rate = std::abs(across_) * sine_ / std::max(end.sin_theta * end.sin_theta, 1e-300);
    end.phi = {std::copysign(phi, across_), chi_error * rate + 4.0 * epsilon * (phi + 1.0 + 1.0 / end.sin_theta)};
    return end;
  }

 private:
  double cosine_, sine_, angular_momentum_;
  double impact_ = 0.0;
  double down_ = 0.0, across_ = 0.0;  ///< e along theta^ and phi^
};

}  // namespace xpr
