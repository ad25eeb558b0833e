// Mistakes of convention, recognised and named: ends that are wrong by more than a tracer can be, and right once an
// angle's sign, its unit or an index's place is changed.
//
// A mistake is named only if undoing it brings the errors of three quarters of the rays down by a factor of 30 at
// least, to 0.03 or less. Half the mass, a wrong step or a wrong metric is none of these, and stays what it is.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "validation/grading/score.hpp"

namespace xpr {

/// How a mistake is undone: on the table as it stands, in its own chart; on an end in the home chart; or on what the
/// code took the start and the spacetime to be. Members not set do nothing.
struct Convention {
  std::string_view id;
  std::string_view says;
  Quantity shows;  ///< what is wrong by it: direction, heading, time, affine or (windings) swept
  HandedRay (*table)(const HandedRay& ray, const Spacetime& chart) = nullptr;
  HandedRay (*end)(const HandedRay& ray, const PhaseState<double>& start) = nullptr;
  PhaseState<double> (*start)(const PhaseState<double>& start) = nullptr;
  double spin_sign = 1.0;
  /// Where the mistake takes the start off the light cone: whether the code finds p_t from the rest (the p_i stay), or
  /// p_r (the constants of motion stay).
  bool energy_follows = false;
  std::string_view chart = {};  ///< the table is in this chart instead
};

/// A mistake found, with the third quartile of the errors in what it shows, as handed in and once it is undone. The
/// errors of wrapped windings are whole turns.
struct ConventionFound {
  const Convention* convention;
  double before;
  double after;
};

/// All conventions that are looked for.
[[nodiscard]] const std::vector<Convention>& conventions();

/// The rays' ends in the home chart and their exact courses, once mistakes are undone.
class Undoing {
 public:
  Undoing(const Examiner& examiner, const HandIn& hand_in, std::vector<const Convention*> undone);

  /// Ray k compared, without its conditions.
  [[nodiscard]] RayScore compare(std::size_t k) const;
  /// Ray k compared, with them.
  [[nodiscard]] RayScore score(std::size_t k) const;
  [[nodiscard]] HandedRay end(std::size_t k) const;
  /// Whether phi counts its turns.
  [[nodiscard]] bool windings_known() const { return windings_known_; }

 private:
  /// The exact ray that a code with these mistakes traces.
  struct Course {
    PhaseState<double> start;
    std::unique_ptr<ExactRay> exact;  ///< null where no light starts so
  };

  /// Nothing where it would be light of negative energy.
  [[nodiscard]] std::optional<PhaseState<double>> altered_start(std::size_t k) const;
  [[nodiscard]] Course altered_course(std::size_t k) const;
  [[nodiscard]] RayScore compare(std::size_t k, bool with_conditions) const;

  const Examiner& examiner_;
  const HandIn& hand_in_;
  std::vector<const Convention*> undone_;
  bool other_rays_ = false;  ///< the code traced other rays than those of the set
  bool spin_flipped_ = false;
  bool energy_follows_ = false;
  std::unique_ptr<Spacetime> chart_, home_;  ///< as the code has them
  std::unique_ptr<Spacetime> table_chart_;   ///< the chart in which the rays were handed out
  bool windings_known_;
};

/// What explains the errors of a table, most telling first. Empty where it is right, or wrong in a way of its own.
[[nodiscard]] std::vector<ConventionFound> recognised_conventions(const Examiner& examiner, const HandIn& hand_in);

}  // namespace xpr
