// Rays of another code against the exact ones, each at its own end point: nobody is graded for stopping elsewhere.
//
// Given the radius at which a code ended, the closed form says where the ray is there; their differences are the
// errors. The condition of a ray says how much a quantity at that end changes with the start's angular momentum, per
// length unit for E = 1: near-critical rays and azimuths next to an axis amplify every error by it, and are compared
// by the error over the condition where that is more than 1.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "validation/grading/challenge.hpp"
#include "validation/grading/exact_ray.hpp"
#include "validation/grading/hand_in.hpp"

namespace xpr {

/// What is compared. The first five have a condition.
enum class Quantity { direction, swept, time, heading, affine, conserved, null };

struct QuantityCard {
  std::string_view id;
  std::string_view unit;
  std::string_view meaning;
};

inline constexpr std::size_t quantity_count = 7;
inline constexpr std::size_t conditioned_quantities = 5;
inline constexpr std::array<QuantityCard, quantity_count> quantity_cards{{
    {"direction", "radian", "angle on the sphere between the end and the exact one at the same radius"},
    {"swept", "radian", "azimuth swept along the ray, whole turns counted apart"},
    {"time", "1", "elapsed t, over its exact value (over the length unit where that is less than 1)"},
    {"heading", "radian", "angle between the momenta at the ends"},
    {"affine", "1", "affine parameter, relative as the time"},
    {"conserved", "1", "drift of energy, L_z and Carter's constant (|L| where there is none), relative"},
    {"null", "1", "null residual |g^{mn} p_m p_n| / (n.p)^2 at the end"},
}};

using Errors = std::array<double, quantity_count>;

/// What became of a row.
enum class Outcome {
  compared,      ///< right status; the errors say the rest
  uncompared,    ///< captured as it should be, where closed forms end: at or inside the horizon, or with E <= 0
  wrong_status,  ///< captured for escaped, the other side of a wormhole, or the other way round
  unfinished,    ///< a status that is no end: max_steps, step_underflow and the like; or still on its way
  not_finite,    ///< nan or inf in the event
  off_the_ray,   ///< right status, at a radius where the exact ray never is
};
inline constexpr std::array<std::string_view, 6> outcome_names = {"compared",   "uncompared", "wrong_status",
                                                                  "unfinished", "not_finite", "off_the_ray"};
[[nodiscard]] constexpr bool failed(Outcome outcome) {
  return outcome != Outcome::compared && outcome != Outcome::uncompared;
}

struct RayScore {
  Outcome outcome = Outcome::not_finite;
  Status status = Status::outside_domain;  ///< as handed in, or read off the end point
  Errors error{};                          ///< NaN where there is nothing to compare
  Errors condition{};                      ///< per length unit; 1 where there is none
  double position = 0.0;                   ///< distance to the exact end, a length
  double windings = 0.0;                   ///< whole turns of phi too many; NaN where they cannot be told
  double truth_error = 0.0;                ///< of the closed form, radian

  /// The error and the closed form's own, over the condition where that is more than 1.
  [[nodiscard]] double scaled(std::size_t quantity) const;
};

/// What a code is taken to have traced: a start in the home chart of a spacetime, and its exact course.
struct ExaminedRay {
  PhaseState<double> start;
  const ExactRay& exact;
  const Spacetime& home;
};

/// A set's first rays with their exact courses, ready to be compared with. Immutable but for its use of threads.
class Examiner {
 public:
  Examiner(const ChallengeSet& set, std::int64_t count);

  [[nodiscard]] const ChallengeSet& set() const { return set_; }
  [[nodiscard]] const Spacetime& home() const { return *home_; }
  [[nodiscard]] std::int64_t count() const { return static_cast<std::int64_t>(rays_.size()); }
  [[nodiscard]] const ChallengeRay& ray(std::size_t k) const { return rays_[k]; }
  [[nodiscard]] const ExactRay& exact(std::size_t k) const { return *exact_[k]; }

  /// Ray k as it should be traced.
  [[nodiscard]] ExaminedRay traced(std::size_t k) const { return {rays_[k].ray.start, *exact_[k], *home_}; }

  /// An end in the home chart against the exact course, without conditions. `windings_known`: phi counts its turns.
  [[nodiscard]] RayScore compare(const ExaminedRay& ray, const HandedRay& end, bool has_status,
                                 bool windings_known) const;
  /// The conditions of a ray at that end.
  [[nodiscard]] Errors conditions(const ExaminedRay& ray, const PhaseState<double>& end) const;

 private:
  struct Difference {
    Errors error;
    double windings;
  };
  [[nodiscard]] Difference difference(const ExaminedRay& ray, const ExactEnd& exact, const PhaseState<double>& end,
                                      double lambda, bool windings_known) const;
  [[nodiscard]] double length_along(const PhaseState<double>& y) const;
  [[nodiscard]] Direction direction(const PhaseState<double>& y) const;
  [[nodiscard]] Direction heading(const Spacetime& home, const PhaseState<double>& y) const;
  [[nodiscard]] double drift(const ExaminedRay& ray, const PhaseState<double>& end) const;
  [[nodiscard]] Status status_of(const HandedRay& end, bool has_status) const;
  [[nodiscard]] ExactEnd counterpart(const ExactRay& exact, Outcome outcome, const PhaseState<double>& end) const;
  [[nodiscard]] Outcome outcome_of(const ExactRay& exact, Status status, const PhaseState<double>& end) const;

  const ChallengeSet& set_;
  std::unique_ptr<Spacetime> home_;
  bool spherical_;
  std::vector<ChallengeRay> rays_;
  std::vector<std::unique_ptr<ExactRay>> exact_;
};

}  // namespace xpr
