// The exact course of one ray of a challenge set: where it is, and how it got there, at any radius that another code
// may have ended at. Closed forms behind one interface; no stepping.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "metrics/spacetime.hpp"
#include "validation/directions.hpp"

namespace xpr {

/// The ray at a radius. Nothing is meaningful unless `reached`.
struct ExactEnd {
  bool reached = false;
  PhaseState<double> state;      ///< in the home chart, spherical angles continuous from the start's
  double lambda = 0.0;           ///< affine parameter since the start, dx/dlambda = p
  Direction direction{};         ///< unit vector from the centre to the end
  double direction_error = 0.0;  ///< of the closed form itself, radian
};

class ExactRay {
 public:
  virtual ~ExactRay() = default;
  /// Ends at the horizon.
  [[nodiscard]] virtual bool captured() const = 0;
  /// Where it is can be said; false for light of negative energy, of which only its end is known.
  [[nodiscard]] virtual bool has_closed_form() const { return true; }
  /// On which side of a wormhole it ends, +1 or -1; +1 elsewhere.
  [[nodiscard]] virtual int side() const { return 1; }
  /// Radial turning points passed on the way to its end, 0 or 1.
  [[nodiscard]] virtual int turns_at_end() const = 0;
  /// At a radius (r, l or |x|, as the home chart has it) after 0 or 1 turning points.
  [[nodiscard]] virtual ExactEnd at(double radius, int turns) const = 0;
};

/// The ray with this start in the home chart of one of the challenge sets' metrics; of p_r its sign counts, its size
/// follows from the rest. Throws std::domain_error for a start that no light passes, std::invalid_argument for a metric
/// without closed form.
[[nodiscard]] std::unique_ptr<ExactRay> exact_ray(std::string_view metric, const std::vector<NamedValue>& parameters,
                                                  const PhaseState<double>& start);

/// Light of energy E <= 0, which there is in an ergosphere only and which falls in.
[[nodiscard]] std::unique_ptr<ExactRay> negative_energy_ray();

}  // namespace xpr
