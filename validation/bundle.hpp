// Seeded bundles of rays, the same on every machine: what orders, tolerances and sweeps are measured on.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "integrators/stepper.hpp"
#include "metrics/spacetime.hpp"
#include "validation/case.hpp"

namespace xpr {

/// Numbers that look random and are the same everywhere: Steele, Lea and Flood's SplitMix64.
class SeededNumbers {
 public:
  explicit SeededNumbers(std::uint64_t seed) : state_(seed) {}
  /// Uniform in [low, high).
  [[nodiscard]] double uniform(double low, double high);
  /// Uniform on the unit sphere.
  [[nodiscard]] std::array<double, 3> direction();

 private:
  [[nodiscard]] std::uint64_t next();
  std::uint64_t state_;
};

/// Rays in one chart, each followed over its own affine length, and where they then truly are.
struct Bundle {
  std::unique_ptr<Spacetime> chart;
  std::vector<PhaseState<double>> starts;
  std::vector<double> spans;             ///< affine length of each ray
  std::vector<PhaseState<double>> ends;  ///< the truth
  double truth_error = 0.0;              ///< root mean square over rays and components, lengths in their unit
  double length_unit = 1.0;

  [[nodiscard]] Flow flow() const;
};

/// How far light is followed in the fish-eye.
enum class FisheyePath {
  arc,     ///< over 0.45 turns in the affine parameter
  closed,  ///< once around, back to the start
};

/// Light in Maxwell's fish-eye of radius R. Every orbit is a great circle of the sphere in stereographic projection,
/// run through uniformly in t; it closes after the affine length 2 pi R^4 / L^3 (L = |x cross p|, E = 1).
[[nodiscard]] Bundle fisheye_orbits(const Lab& lab, int rays, FisheyePath path, double R = 1.0);

/// Parallel light in a Luneburg lens of radius R, of a direction of its own for each ray: from a distance of 2 R
/// through the rim at a height up to 0.9 R to the focus R d, a quarter of a turn of x = x0 cos(lambda/R) + R p0
/// sin(lambda/R).
[[nodiscard]] Bundle luneburg_rays(const Lab& lab, int rays, double R);

/// The hole that bundles of light pass.
struct KerrHole {
  double mass = 1.0;
  double spin = 0.9;
};

/// Light that passes a Kerr hole off the equator, from 15 M inwards, over the affine length 30 M, in the `kerr-schild`
/// chart; without the truth.
[[nodiscard]] Bundle kerr_rays(const Lab& lab, int rays, KerrHole hole = {});

/// The same with the truth: dop853 in 600 equal steps, far finer than what is graded. truth_error is its distance to
/// Gauss-Legendre's order 6 in 1500 steps: two methods that share nothing but the flow. Self-convergence, which grades
/// steppers only.
[[nodiscard]] Bundle kerr_scattering(const Lab& lab, int rays, KerrHole hole = {});

/// A stepper's walk in equal steps.
struct Walk {
  PhaseState<double> y;
  bool converged = true;
};
[[nodiscard]] Walk walk(Stepper& stepper, const PhaseState<double>& start, double span, std::int64_t steps);

/// The graded components of many states, x^i and p_i, one after the other.
[[nodiscard]] std::vector<double> spatial_components(const std::vector<PhaseState<double>>& states);

}  // namespace xpr
