#include "validation/grading/exact_ray.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "metrics/ellis_ray_exact.hpp"
#include "metrics/kerr_potentials.hpp"
#include "metrics/kerr_ray_exact.hpp"
#include "metrics/orbital_plane.hpp"
#include "validation/directions.hpp"
#include "validation/grading/exact_medium_ray.hpp"

namespace xpr {
namespace {

/// What every ray in a spherical chart knows of its start. Light traced back in time has p_t > 0.
struct SphericalStart {
  explicit SphericalStart(const PhaseState<double>& y)
      : state(y), energy(std::abs(y[4])), time_sense(y[4] < 0.0 ? 1.0 : -1.0) {}

  [[nodiscard]] int radial_sign() const { return state[5] < 0.0 ? -1 : 1; }
  /// The momentum's own sign of p_theta, its size from p_theta^2 / E^2.
  [[nodiscard]] double p_theta(double square, int sign) const {
    return std::copysign(energy * std::sqrt(std::max(square, 0.0)), sign);
  }

  PhaseState<double> state;
  double energy;
  double time_sense;
};

class KerrCourse final : public ExactRay {
 public:
  KerrCourse(double mass, double spin, const PhaseState<double>& y)
      : mass_(mass),
        spin_(spin),
        start_(y),
        ray_({mass, spin},
             kerr_exact::RayEvent{.r = y[1], .theta = y[2], .p_t = y[4], .p_r = y[5], .p_theta = y[6], .p_phi = y[7]}) {
  }

  [[nodiscard]] bool captured() const override { return ray_.fate() == kerr_exact::Fate::captured; }
  [[nodiscard]] int turns_at_end() const override { return ray_.turns() ? 1 : 0; }

  [[nodiscard]] ExactEnd at(double r, int turns) const override {
    ExactEnd end;
    const double horizon = mass_ + std::sqrt((mass_ - spin_) * (mass_ + spin_));
    if (!(r > horizon) || !std::isfinite(r)) return end;
    const kerr_exact::Arrival there = ray_.at_radius(r, turns);
    if (!there.reached) return end;
    const PhaseState<double>& y = start_.state;
    const kerr_exact::RayConstants<double> light = constants();
    const double delta = r * (r - 2.0 * mass_) + spin_ * spin_;
    const double radial = std::max(0.0, kerr_exact::radial_potential(mass_, spin_, light, r));
    const double across = y[7] == 0.0 ? 0.0 : light.angular_momentum / there.sin_theta;
    const double cosine_sq = there.cos_theta * there.cos_theta;
    const double polar = light.carter + cosine_sq * spin_ * spin_ - across * across * cosine_sq;
    end.reached = true;
    end.state = {{y[0] + there.time.value, r, there.theta.value, y[3] + there.phi.value},
                 {y[4], there.radial_sign * start_.energy * std::sqrt(radial) / delta,
                  start_.p_theta(polar, there.polar_sign), y[7]}};
    end.lambda = std::abs(there.affine.value) / start_.energy;
    end.direction = there.direction(y[3]);
    end.direction_error = there.direction_error;
    return end;
  }

 private:
  /// Of the ray at unit energy, with L as p_phi has it, so that lambda is that of the light run along p.
  [[nodiscard]] kerr_exact::RayConstants<double> constants() const {
    const PhaseState<double>& y = start_.state;
    const double momentum = start_.time_sense * y[7] / start_.energy;
    const double cosine = std::cos(y[2]), sine = std::sin(y[2]);
    const double across = momentum == 0.0 ? 0.0 : momentum / sine;
    const double p_theta = y[6] / start_.energy;
    return {1.0, momentum, p_theta * p_theta + cosine * cosine * (across * across - spin_ * spin_)};
  }

  double mass_, spin_;
  SphericalStart start_;
  kerr_exact::KerrRay ray_;
};

/// Flat space: with s the way along the ray from its point next to the centre, r^2 = b^2 + s^2.
class StraightCourse final : public ExactRay {
 public:
  explicit StraightCourse(const PhaseState<double>& y)
      : start_(y),
        plane_(std::cos(y[2]), std::sin(y[2]), y[7] / start_.energy, y[6] / start_.energy),
        way_(y[1] * y[5] / start_.energy) {}

  [[nodiscard]] bool captured() const override { return false; }
  [[nodiscard]] int turns_at_end() const override { return way_ < 0.0 ? 1 : 0; }

  [[nodiscard]] ExactEnd at(double r, int turns) const override {
    ExactEnd end;
    const double b = plane_.impact_parameter();
    if (!(r >= b) || !std::isfinite(r) || turns > turns_at_end()) return end;
    const double size = std::sqrt((r - b) * (r + b));
    const double way = turns == 0 && way_ < 0.0 ? -size : size;
    if (way < way_) return end;
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    const PlaneEnd there = plane_.after(std::atan2(way, b) - std::atan2(way_, b), 8.0 * epsilon);
    const PhaseState<double>& y = start_.state;
    const double across = y[7] == 0.0 ? 0.0 : y[7] / (start_.energy * there.sin_theta);
    end.reached = true;
    end.state = {{y[0] + start_.time_sense * (way - way_), r, there.theta.value, y[3] + there.phi.value},
                 {y[4], start_.energy * way / r, start_.p_theta((b - across) * (b + across), there.polar_sign), y[7]}};
    end.lambda = (way - way_) / start_.energy;
    end.direction = unit_direction(there.theta.value, end.state[3]);
    end.direction_error = there.direction_error;
    return end;
  }

 private:
  SphericalStart start_;
  OrbitalPlane plane_;
  double way_;
};

class EllisCourse final : public ExactRay {
 public:
  EllisCourse(double throat, const PhaseState<double>& y)
      : throat_(throat),
        start_(y),
        impact_(std::hypot(y[6], y[7] == 0.0 ? 0.0 : y[7] / std::sin(y[2])) / start_.energy),
        ray_(throat, {.l = y[1],
                      .theta = y[2],
                      .lambda = y[7] / start_.energy,
                      .p_theta = y[6] / start_.energy,
                      .radial_sign = start_.radial_sign()}) {}

  [[nodiscard]] bool captured() const override { return false; }
  [[nodiscard]] int side() const override { return ray_.end() == ellis_exact::WormholeEnd::negative ? -1 : 1; }
  [[nodiscard]] int turns_at_end() const override { return ray_.turns() ? 1 : 0; }

  [[nodiscard]] ExactEnd at(double l, int turns) const override {
    ExactEnd end;
    if (!std::isfinite(l)) return end;
    const ellis_exact::WormholeArrival there = ray_.at(l, turns);
    if (!there.reached) return end;
    const PhaseState<double>& y = start_.state;
    const double across = y[7] == 0.0 ? 0.0 : y[7] / (start_.energy * there.direction.sin_theta);
    const double radius_sq = l * l + throat_ * throat_;
    const double radial = std::sqrt(std::max(0.0, 1.0 - impact_ * impact_ / radius_sq));
    end.reached = true;
    end.state = {
        {y[0] + start_.time_sense * there.time.value, l, there.direction.theta.value, y[3] + there.direction.phi.value},
        {y[4], there.radial_sign * start_.energy * radial,
         start_.p_theta((impact_ - across) * (impact_ + across), there.direction.polar_sign), y[7]}};
    end.lambda = there.time.value / start_.energy;
    end.direction = unit_direction(there.direction.theta.value, end.state[3]);
    end.direction_error = there.direction.direction_error;
    return end;
  }

 private:
  double throat_;
  SphericalStart start_;
  double impact_;
  ellis_exact::EllisRay ray_;
};

class NegativeEnergyCourse final : public ExactRay {
 public:
  [[nodiscard]] bool captured() const override { return true; }
  [[nodiscard]] bool has_closed_form() const override { return false; }
  [[nodiscard]] int turns_at_end() const override { return 0; }
  [[nodiscard]] ExactEnd at(double /*radius*/, int /*turns*/) const override { return {}; }
};

double value_of(const std::vector<NamedValue>& parameters, std::string_view name, double fallback) {
  for (const NamedValue& parameter : parameters) {
    if (parameter.name == name) return parameter.value;
  }
  return fallback;
}

}  // namespace

std::unique_ptr<ExactRay> exact_ray(std::string_view metric, const std::vector<NamedValue>& parameters,
                                    const PhaseState<double>& start) {
  if (metric == "minkowski") return std::make_unique<StraightCourse>(start);
  if (metric == "kerr" || metric == "schwarzschild") {
    return std::make_unique<KerrCourse>(value_of(parameters, "M", 1.0), value_of(parameters, "a", 0.0), start);
  }
  if (metric == "ellis") return std::make_unique<EllisCourse>(value_of(parameters, "b0", 1.0), start);
  if (metric == "luneburg") return luneburg_course(value_of(parameters, "R", 1.0), start);
  if (metric == "maxwell-fisheye") return fisheye_course(value_of(parameters, "R", 1.0), start);
  throw std::invalid_argument("metric '" + std::string(metric) + "' has no closed form for single rays");
}

std::unique_ptr<ExactRay> negative_energy_ray() { return std::make_unique<NegativeEnergyCourse>(); }

}  // namespace xpr
