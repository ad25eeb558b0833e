// Where every metric module is tested: its parameters and events, off the equator, near the axis, on both sides of
// horizon and throat, without spin and at the extremal one. A new module joins the battery by one overload here.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "metrics/modules.hpp"
#include "metrics/scalar/dual.hpp"

namespace xpr::samples {

/// A module with its parameters set, and events at which it is tested.
template <class M>
struct Sample {
  M module;
  std::vector<Vec4<double>> events;
};

/// The directions (theta, phi) in which events lie: generic, near both ends of the axis, on the equator.
struct Direction {
  double theta;
  double phi;
};
inline const std::vector<Direction> directions = {
    {0.7, 0.4}, {1.2, -2.3}, {2.1, 2.9}, {1e-5, 1.1}, {std::numbers::pi - 1e-3, -0.8}, {0.5 * std::numbers::pi, 1.9}};

inline bool is_cartesian(const Card& card) { return card.coordinates[1].name == "x"; }

/// One event at every radius and direction; a length `a` bends the directions as spheroidal coordinates do.
inline std::vector<Vec4<double>> events_at(const Card& card, const std::vector<double>& radii, double a = 0.0) {
  std::vector<Vec4<double>> out;
  for (const double r : radii) {
    for (const auto& [theta, phi] : directions) {
      const double t = 0.3 * r - 1.7;
      if (!is_cartesian(card)) {
        out.push_back({t, r, theta, phi});
        continue;
      }
      const double x = (r * std::cos(phi) - a * std::sin(phi)) * std::sin(theta);
      const double y = (r * std::sin(phi) + a * std::cos(phi)) * std::sin(theta);
      out.push_back({t, x, y, r * std::cos(theta)});
    }
  }
  return out;
}

template <class M>
std::vector<Sample<M>> kerr_samples() {
  std::vector<Sample<M>> out;
  for (const auto& [mass, a] : {std::pair{1.0, 0.0}, {1.0, 0.9}, {2.0, -1.3}, {1.0, 0.998}, {1.0, 1.0}}) {
    M module;
    module.M = mass;
    module.a = a;
    const double r_plus = module.horizon_radius();
    out.push_back({module, events_at(M::card,
                                     {0.93 * r_plus, 0.999 * r_plus, 1.001 * r_plus, 1.3 * r_plus, 3.0 * mass,
                                      7.3 * mass, 20.0 * mass, 1000.0 * mass},
                                     a)});
  }
  return out;
}

template <class M>
std::vector<Sample<M>> samples_of(std::type_identity<M>) {
  if constexpr (std::is_base_of_v<KerrParameters, M>) {
    return kerr_samples<M>();
  } else if constexpr (std::is_same_v<M, SchwarzschildIsotropic>) {
    M heavy;
    heavy.M = 1.7;
    return {{M{}, events_at(M::card, {0.501, 0.75, 1.9, 5.0, 20.0, 1000.0})}, {heavy, events_at(M::card, {0.9, 3.3})}};
  } else if constexpr (std::is_base_of_v<SchwarzschildMass, M>) {
    M heavy;
    heavy.M = 1.7;
    return {{M{}, events_at(M::card, {1.2, 1.999, 2.001, 3.0, 7.3, 20.0, 1000.0})},
            {heavy, events_at(M::card, {0.9, 4.4})}};
  } else if constexpr (std::is_same_v<M, EllisIsotropic>) {
    M wide;
    wide.b0 = 2.6;
    return {{M{}, events_at(M::card, {0.4, 0.4999, 0.5001, 0.8, 3.0, 20.0})}, {wide, events_at(M::card, {1.1, 4.4})}};
  } else if constexpr (std::is_same_v<M, EllisProperDistance>) {
    M wide;
    wide.b0 = 2.6;
    return {{M{}, events_at(M::card, {-20.0, -1.4, -1e-3, 0.0, 1e-3, 0.8, 20.0})}, {wide, events_at(M::card, {-1.1})}};
  } else if constexpr (std::is_same_v<M, MediumUniform>) {
    return {{M{}, events_at(M::card, {0.3, 4.0})}};
  } else if constexpr (std::is_base_of_v<LuneburgIndex, M> || std::is_base_of_v<FisheyeIndex, M>) {
    M large;
    large.R = 2.7;
    return {{M{}, events_at(M::card, {0.1, 0.6, 0.999, 1.001, 3.0})}, {large, events_at(M::card, {1.1, 3.1})}};
  } else if constexpr (std::is_base_of_v<Spheroid, M>) {
    std::vector<Sample<M>> out;
    for (const auto& [axis, f] : {std::pair{1.0, 1.0 / 298.257223563}, {6.4, 1.0 / 3.0}, {1.3, -0.2}, {1.0, 0.0}}) {
      Sample<M> sample;
      sample.module.a_axis = axis;
      sample.module.f = f;
      for (const double lat : {-1.3, -0.4, 1e-9, 0.3, 1.1, 1.56}) {
        for (const double lon : {-2.9, -0.6, 0.8, 1.9}) sample.events.push_back({0.4, lat, lon, -0.7});
      }
      out.push_back(sample);
    }
    return out;
  } else {
    return {{M{}, events_at(M::card, {1e-3, 1.0, 20.0})}};
  }
}

/// Which module and where, for a failure's message.
inline std::string describe(const Card& card, const PhaseState<double>& y) {
  std::string out = std::string(card.metric) + " in " + std::string(card.chart) + " at";
  for (const double c : y.c) out += " " + std::to_string(c);
  return out;
}

/// A covector of order one, generic but fixed by `seed`; angular components grow with the radius so that all matter.
inline Vec4<double> momentum_at(const Card& card, const Vec4<double>& x, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Vec4<double> p{};
  for (double& component : p) {
    component = static_cast<double>(random() >> 11) * 0x1p-52 - 1.0;  // not std::uniform: the same on every library
  }
  for (std::size_t mu = 1; mu < 4; ++mu) {
    const CoordinateKind kind = card.coordinates[mu].kind;
    if (kind == CoordinateKind::polar_angle) p[mu] *= std::abs(x[1]) + 1.0;
    if (kind == CoordinateKind::azimuth && card.coordinates[2].kind == CoordinateKind::polar_angle) {
      p[mu] *= (std::abs(x[1]) + 1.0) * std::sin(x[2]);
    }
  }
  return p;
}

/// Calls check(module, y) at every sampled point of phase space of M.
template <class M, class Check>
void for_each_state(std::type_identity<M> module, const Check& check) {
  std::uint64_t seed = 20250101;
  for (const Sample<M>& sample : samples_of(module)) {
    for (const Vec4<double>& x : sample.events) {
      check(sample.module, PhaseState<double>(x, momentum_at(M::card, x, ++seed)));
    }
  }
}

/// Calls check(module, y) at every sampled point of phase space of every module.
template <class Check>
void for_each_state(const Check& check) {
  for_each_module([&](auto module) { for_each_state(module, check); });
}

template <class T>
PhaseState<T> widened(const PhaseState<double>& y) {
  PhaseState<T> out;
  for (std::size_t i = 0; i < 8; ++i) out[i] = T(y[i]);
  return out;
}

/// y with one dual direction for each of its eight components.
template <class T = double>
PhaseState<Dual<T, 8>> seeded(const PhaseState<double>& y) {
  PhaseState<Dual<T, 8>> out;
  out.c = variables(widened<T>(y).c);
  return out;
}

}  // namespace xpr::samples
