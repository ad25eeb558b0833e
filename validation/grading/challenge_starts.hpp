// How the rays of the challenge sets start: numbers between 0 and 1 that fill space evenly, and light built from them.
#pragma once

#include <array>
#include <cstdint>

#include "metrics/spacetime.hpp"

namespace xpr {

/// Five numbers in [0, 1) for each k, spread evenly however many are taken: k + 1 times the powers of the positive root
/// of x^6 = x + 1, modulo 1 (Roberts' sequence), from k = 1 on.
[[nodiscard]] std::array<double, 5> even_numbers(std::int64_t k);

/// low + (high - low) u.
[[nodiscard]] constexpr double between(double low, double high, double u) { return low + (high - low) * u; }

/// Where light starts in a spherical chart, and how it goes across: p_t, p_theta and p_phi are its own, p_r follows.
struct Departing {
  double x1 = 0.0;  ///< r, or l
  double theta = 0.0;
  double phi = 0.0;
  double p_t = -1.0;
  double p_theta = 0.0;
  double p_phi = 0.0;
  int radial_sign = -1;  ///< of p_r; 0: p_r is given and |p_theta| follows
  double p_r = 0.0;
};

/// Puts it on the light cone. What light cannot do there is halved (p_theta and p_phi) until it can.
[[nodiscard]] PhaseState<double> departed(const Spacetime& home, Departing start);

/// theta of a point whose cos theta is even in (-most, most).
[[nodiscard]] double even_theta(double u, double most);
/// An azimuth in (-pi, pi).
[[nodiscard]] double even_phi(double u);

/// Light from far away with |p| across = b, in direction psi (0: along theta, 1: a whole turn).
[[nodiscard]] Departing aimed(double x1, double theta, double phi, double b, double psi);

/// A camera's ray of Kerr, traced back in time, from radius 50 M at that inclination.
[[nodiscard]] PhaseState<double> camera_ray(const Spacetime& home, double inclination, double phi, double alpha,
                                            double beta);

/// The same ray with its momentum doubled: what is affine must follow.
[[nodiscard]] PhaseState<double> doubled(PhaseState<double> y);

/// In a Cartesian medium at distance `distance` in direction (theta, phi): light at the angle `from_inward` to the way
/// to the centre, turned by psi about it.
[[nodiscard]] PhaseState<double> medium_ray(const Spacetime& home, double distance, double theta, double phi,
                                            double from_inward, double psi);

/// Light that a chart map has brought off the cone, p_r found anew: p + s dr, so that p_t and the angular momenta stay.
/// Next to a horizon a chart that is regular for the ray is reached through one that is not, where p_r and phi diverge:
/// p comes out with the square of 2 M r / Delta times round-off, 1e-9 at the worst here.
[[nodiscard]] PhaseState<double> on_the_cone_again(const Spacetime& chart, PhaseState<double> y);

/// The named parameter of a spacetime, or the fallback.
[[nodiscard]] double parameter_of(const Spacetime& spacetime, std::string_view name, double fallback);

}  // namespace xpr
