// Kerr rays of every kind, drawn from written seeds, each held against its truth: the closed form must keep its own
// error bound, and its bounds must stay small. Used by a quick test and by a program that does thousands.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "exact_kit.hpp"
#include "kerr_ray_truth.hpp"
#include "metrics/kerr_ray_exact.hpp"

namespace xpr::kerr_ray_sweep {

using exact_kit::Mp;
using kerr_exact::Arrival;
using kerr_exact::Fate;
using kerr_exact::KerrRay;
using kerr_exact::RayHole;
using kerr_exact::RayStart;

inline Wide wide(const Mp& x) {
  const auto high = static_cast<double>(x);
  return {high, static_cast<double>(Mp(x - high))};
}

/// The truth at the stored doubles of the start; the double nearest to pi/2 and to pi mean those angles.
inline kerr_ray_truth::Ray<Wide> truth_start(double spin, const RayStart& start) {
  kerr_ray_truth::Ray<Wide> ray{spin, start.lambda, start.eta, start.r, 0.0, 1.0, start.radial_sign, start.polar_sign};
  if (start.theta == std::numbers::pi) {
    ray.cosine = -1.0, ray.sine = 0.0;
  } else if (start.theta != std::numbers::pi / 2) {
    ray.cosine = wide(Mp(cos(Mp(start.theta)))), ray.sine = wide(Mp(sin(Mp(start.theta))));
  }
  return ray;
}

struct Finding {
  std::vector<double> misses;  ///< in units of 2^-52 max(1, |value|)
  double worst_ratio = 0.0;    ///< miss over claimed bound
  double widest_bound = 0.0;   ///< in units of max(1, |value|)
};

/// Everything found, by family and quantity, and what went wrong in words.
struct Report {
  std::map<std::string, Finding> findings;
  std::vector<std::string> faults;
  int rays = 0;

  void note(const std::string& name, double value, double miss, double bound, const std::string& where) {
    Finding& finding = findings[name];
    const double unit = std::max(1.0, std::abs(value));
    finding.misses.push_back(miss / unit * 0x1p52);
    finding.worst_ratio = std::max(finding.worst_ratio, miss / bound);
    finding.widest_bound = std::max(finding.widest_bound, bound / unit);
    if (!(miss <= bound))
      faults.push_back(fmt::format("{} = {}: off by {}, bound {}: {}", name, value, miss, bound, where));
  }
};

inline std::string described(double spin, const RayStart& s, double r_end, int turns) {
  return fmt::format("a = {}, r = {}, theta = {}, lambda = {}, eta = {}, signs {} {}, to r = {} after {} turns", spin,
                     s.r, s.theta, s.lambda, s.eta, s.radial_sign, s.polar_sign, r_end, turns);
}

/// One ray, to r_end after `turns` turning points.
inline void check(Report& report, const std::string& family, double spin, const RayStart& start, double r_end,
                  int turns) {
  const std::string where = described(spin, start, r_end, turns);
  const Arrival end = KerrRay(RayHole{1.0, spin}, start).at_radius(r_end, turns);
  ++report.rays;
  const auto truth = kerr_ray_truth::followed<Wide>(truth_start(spin, start), end.r, end.radial_sign);
  if (!end.reached || !truth.reached) {
    report.faults.push_back(fmt::format("{}: reached {}, in truth {}: {}", family, end.reached, truth.reached, where));
    return;
  }
  const auto miss = [](double value, const Wide& reference) {
    return std::abs(static_cast<double>(Wide(value) - reference));
  };
  const Wide pi = wide(exact_kit::pi());
  const auto note = [&](const char* name, const ExactValue& value, const Wide& reference) {
    report.note(family + " " + name, value.value, miss(value.value, reference), value.error, where);
  };
  note("mino", end.mino, truth.mino);
  note("phi", end.phi, truth.phi + pi * Wide(end.axis_crossings));  // the truth does not count what has L = 0
  note("time", end.time, truth.time);
  note("affine", end.affine, truth.affine);
  report.note(family + " theta", end.theta.value,
              std::hypot(miss(end.cos_theta, truth.cosine), miss(end.sin_theta, truth.sine)), end.theta.error, where);
  const int polar = end.polar_turns + end.axis_crossings;
  if (end.radial_turns != truth.radial_turns || polar != truth.polar_turns) {
    report.faults.push_back(fmt::format("{}: {} and {} turns, in truth {} and {}: {}", family, end.radial_turns, polar,
                                        truth.radial_turns, truth.polar_turns, where));
  }
}

/// A point (alpha, beta) of a camera's screen: lambda = -alpha sin i, eta = (alpha^2 - a^2) cos^2 i + beta^2.
struct Camera {
  double spin, r, inclination;

  [[nodiscard]] RayStart at(double alpha, double beta) const {
    const double cosine = inclination == std::numbers::pi / 2 ? 0.0 : std::cos(inclination);
    const double sine = inclination == std::numbers::pi ? 0.0 : std::sin(inclination);
    return {.r = r,
            .theta = inclination,
            .lambda = -alpha * sine,
            .eta = (alpha * alpha - spin * spin) * cosine * cosine + beta * beta,
            .radial_sign = -1,
            .polar_sign = beta > 0.0 ? -1 : 1};
  }
};

class Sweep {
 public:
  explicit Sweep(unsigned seed) : engine_(seed) {}

  /// Screens out to 100 M from one camera: a whole ray, parts of it, the ray reversed, the edge of the shadow.
  void camera(Report& report, const Camera& camera, int k) {
    const double r_plus = 1.0 + std::sqrt((1.0 - camera.spin) * (1.0 + camera.spin));
    const double r_min = 1.005 * r_plus;
    const double half_width = camera.r < 10.0 ? 5.0 : k % 3 == 2 ? std::min(100.0, 0.6 * camera.r) : 12.0;
    const double alpha = k % 7 == 5 ? 0.0 : half_width * symmetric(),
                 beta = k % 7 == 6 ? 0.0 : half_width * symmetric();
    RayStart start = camera.at(alpha, beta);
    const KerrRay ray(RayHole{1.0, camera.spin}, start);
    const bool escapes = ray.fate() == Fate::escaped;
    check(report, "screen", camera.spin, start, escapes ? camera.r : r_min, escapes ? 1 : 0);
    const double lowest = escapes ? ray.turning_radius() : r_min, middle = lowest + (camera.r - lowest) * uniform();
    check(report, "part", camera.spin, start, middle, 0);
    if (escapes) check(report, "part", camera.spin, start, middle + 2.0 * camera.r * uniform(), 1);
    start.radial_sign = 1;
    check(report, "outward", camera.spin, start, camera.r * (1.0 + 5.0 * uniform()), 0);
    if (k % 2 == 0) near_edge(report, camera, r_min);
  }

  /// From anywhere down to 1e-3 r+ above the horizon, in any direction that light can have there.
  void near_hole(Report& report, double spin) {
    const double r_plus = 1.0 + std::sqrt((1.0 - spin) * (1.0 + spin));
    const double r = r_plus * (1.0 + std::pow(10.0, -3.0 + 3.5 * uniform()));
    const double theta = std::acos(symmetric()), cosine = std::cos(theta), sine = std::sin(theta);
    for (;;) {
      const double size = 8.0 * uniform(), angle = 2.0 * std::numbers::pi * uniform();
      const double lambda = size * std::cos(angle) * sine, p_theta = size * std::sin(angle);
      const double eta = p_theta * p_theta + cosine * cosine * (lambda * lambda / (sine * sine) - spin * spin);
      const double forward = r * r + spin * spin - spin * lambda;
      const double delta = r * (r - 2.0) + spin * spin;
      if (!(forward > 0.0 && forward * forward > 1.0001 * delta * (eta + (lambda - spin) * (lambda - spin)))) continue;
      const RayStart start{r, theta, lambda, eta, symmetric() < 0.0 ? -1 : 1, p_theta > 0.0 ? 1 : -1};
      const KerrRay ray(RayHole{1.0, spin}, start);
      const int turns = ray.turns() ? 1 : 0;
      if (ray.fate() == Fate::captured) {
        check(report, turns == 1 ? "turning inside" : "falling", spin, start, r_plus + (r - r_plus) * uniform(), turns);
      } else {
        check(report, "from near", spin, start, 100.0, turns);
      }
      return;
    }
  }

  /// eta < 0: light that stays on its side of the equator, in from 20 M or out again.
  void vortical(Report& report, double spin) {
    const double r_plus = 1.0 + std::sqrt((1.0 - spin) * (1.0 + spin));
    const double theta = std::acos(symmetric()), cosine = std::cos(theta), sine = std::sin(theta);
    const double lambda = spin * sine * symmetric();
    const double lowest = -cosine * cosine * (spin * spin - lambda * lambda / (sine * sine));
    const double near = r_plus * (1.0 + std::pow(10.0, -2.0 * uniform()));
    const bool inward = symmetric() < 0.0;
    const RayStart start{inward ? 20.0 : near, theta,           lambda,
                         lowest * uniform(),   inward ? -1 : 1, symmetric() < 0.0 ? -1 : 1};
    check(report, "vortical", spin, start, inward ? near : 20.0, 0);
  }

  /// Light that falls past four real roots, all of them inside the horizon: lambda near a, eta small, a near M.
  void past_hidden_roots(Report& report, double spin) {
    const double r_plus = 1.0 + std::sqrt((1.0 - spin) * (1.0 + spin));
    for (int tries = 0; tries < 100000; ++tries) {
      const double lambda = spin * 2.0 * uniform(), eta = uniform() * spin * spin;
      const kerr_exact::RadialMotion motion({spin, lambda, eta});
      if (motion.kind != kerr_exact::PairKind::real_pair || motion.turns_outside) continue;
      const RayStart start{20.0, std::numbers::pi / 2, lambda, eta, -1, symmetric() < 0.0 ? -1 : 1};
      check(report, "hidden roots", spin, start, r_plus * (1.0 + std::pow(10.0, -3.0 * uniform())), 0);
      return;
    }
    report.faults.push_back(fmt::format("no ray with hidden roots found at a = {}", spin));
  }

 private:
  double uniform() { return unit_(engine_); }
  double symmetric() { return 2.0 * unit_(engine_) - 1.0; }

  /// Both sides of the shadow's edge, 1e-2 ... 1e-10 away.
  void near_edge(Report& report, const Camera& camera, double r_min) {
    const double angle = 2.0 * std::numbers::pi * uniform(), x = std::cos(angle), y = std::sin(angle);
    const auto captured = [&](double size) {
      return KerrRay(RayHole{1.0, camera.spin}, camera.at(size * x, size * y)).fate() == Fate::captured;
    };
    double inside = 0.0, outside = camera.r < 10.0 ? 5.5 : 9.0;
    if (!captured(inside) || captured(outside)) return;  // the shadow does not cover the screen's centre
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (inside + outside);
      (captured(middle) ? inside : outside) = middle;
    }
    const double away = std::pow(10.0, -2.0 - 8.0 * uniform());
    const RayStart beyond = camera.at(outside * (1.0 + away) * x, outside * (1.0 + away) * y);
    const RayStart within = camera.at(inside * (1.0 - away) * x, inside * (1.0 - away) * y);
    check(report, "just escaping", camera.spin, beyond, camera.r, 1);
    check(report, "just captured", camera.spin, within, r_min, 0);
  }

  std::mt19937_64 engine_;
  std::uniform_real_distribution<double> unit_{0.0, 1.0};
};

/// `each` rays from every `stride`-th of the cameras at six spins, seven inclinations and three distances.
inline Report swept(unsigned seed, int each, int stride) {
  Sweep sweep(seed);
  Report report;
  int cameras = 0;
  constexpr double degree = std::numbers::pi / 180.0;
  for (const double spin : {0.0, 1e-6, 0.3, 0.9, 0.998, 1.0}) {
    for (const double inclination :
         {0.0, 0.05 * degree, 17 * degree, 60 * degree, std::numbers::pi / 2, 120 * degree, std::numbers::pi}) {
      for (const double r : {6.0, 50.0, 1000.0}) {
        if (cameras++ % stride != 0) continue;
        for (int k = 0; k < each; ++k) {
          sweep.camera(report, Camera{spin, r, inclination}, k);
          sweep.near_hole(report, spin);
          if (spin >= 0.3) sweep.vortical(report, spin);
          if (spin >= 0.9) sweep.past_hidden_roots(report, spin);
        }
      }
    }
  }
  return report;
}

}  // namespace xpr::kerr_ray_sweep
