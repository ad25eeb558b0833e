// Challenge sets: numbered light rays around one spacetime, whose ends are known in closed form, for any code to trace.
//
// Ray k of a set depends on k alone, so a set of 100,000 rays begins with the same rays as one of 600. Ids of different
// sets never meet. A set is written down in its home chart, the classical one of its spacetime, and can be handed out
// in any other. Starts are made by arithmetic and this project's own elementary functions: they have the same bits on
// every machine.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "core/transport.hpp"
#include "metrics/spacetime.hpp"

namespace xpr {

/// A ray with the family it belongs to, an index into ChallengeSet::families.
struct ChallengeRay {
  Ray ray;
  std::int64_t family = 0;
};

/// A kind of ray in a set: its name, what it is for, and how the k-th of its kind starts.
struct RayFamily {
  std::string_view name;
  std::string_view what;
  PhaseState<double> (*start)(const Spacetime& home, std::int64_t k);
};

struct ChallengeSet {
  std::string_view id;
  std::string_view title;
  std::string_view metric;
  std::vector<NamedValue> parameters;
  std::string_view home_chart;
  double length_unit = 1.0;  ///< M, b0 or R
  double r_max = 0.0;        ///< going outward through it: escaped
  bool captures = false;     ///< some rays end at a horizon
  std::int64_t first_id = 0;
  std::int64_t usual_rays = 600;
  std::vector<RayFamily> families;

  [[nodiscard]] std::unique_ptr<Spacetime> spacetime(std::string_view chart) const;
  /// Ray k, counted from 0, in the home chart. It has the id first_id + k.
  [[nodiscard]] ChallengeRay ray(const Spacetime& home, std::int64_t k) const;
  /// The same in another chart of the spacetime, on the light cone there to round-off.
  [[nodiscard]] Ray ray_in(const Spacetime& chart, const Spacetime& home, std::int64_t k) const;
};

/// Ids of one set: this many.
inline constexpr std::int64_t ids_of_a_set = 1'000'000;

[[nodiscard]] const std::vector<ChallengeSet>& challenge_sets();

/// Throws std::invalid_argument naming the nearest set.
[[nodiscard]] const ChallengeSet& challenge_set(std::string_view id);

/// The set that an id belongs to, if any.
[[nodiscard]] const ChallengeSet* set_of_id(std::int64_t id);

}  // namespace xpr
