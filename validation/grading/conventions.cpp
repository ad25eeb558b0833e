#include "validation/grading/conventions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "metrics/catalogue.hpp"
#include "metrics/chart_map.hpp"
#include "metrics/null_cone.hpp"

namespace xpr {
namespace {

constexpr double pi = std::numbers::pi;
// Rays looked at: quantiles of 200 and more are good to a few per cent.
constexpr std::size_t sample_size = 256;
// Too few to tell a rule from chance.
constexpr std::size_t fewest = 8;

bool has_angles(const Spacetime& chart) { return chart.card().coordinates[3].kind == CoordinateKind::azimuth; }

// On the table as it stands.

HandedRay from_degrees(const HandedRay& ray, const Spacetime& chart) {
  HandedRay out = ray;
  for (const std::size_t i : {std::size_t{2}, std::size_t{3}}) {
    if (has_angles(chart)) out.end[i] *= pi / 180.0;
  }
  return out;
}

HandedRay from_the_equator(const HandedRay& ray, const Spacetime& chart) {
  HandedRay out = ray;
  if (!has_angles(chart)) return out;
  out.end[2] = 0.5 * pi - ray.end[2];
  out.end[6] = -ray.end[6];
  return out;
}

HandedRay lowered(const HandedRay& ray, const Spacetime& chart) {
  HandedRay out = ray;
  const Vec4<double> p = raise_index(chart.metric(ray.end.x()), ray.end.p());
  for (std::size_t i = 0; i < 4; ++i) out.end[i + 4] = p[i];
  return out;
}

HandedRay with_p_negated(const HandedRay& ray, const Spacetime& /*chart*/) {
  HandedRay out = ray;
  for (std::size_t i = 4; i < 8; ++i) out.end[i] = -ray.end[i];
  return out;
}

// On an end in the home chart. In a Cartesian one phi -> -phi is y -> -y.

HandedRay with_phi_negated(const HandedRay& ray, const PhaseState<double>& /*start*/) {
  HandedRay out = ray;
  out.end[3] = -ray.end[3];
  out.end[7] = -ray.end[7];
  return out;
}

HandedRay with_y_negated(const HandedRay& ray, const PhaseState<double>& /*start*/) {
  HandedRay out = ray;
  out.end[2] = -ray.end[2];
  out.end[6] = -ray.end[6];
  return out;
}

HandedRay swept_the_other_way(const HandedRay& ray, const PhaseState<double>& start) {
  HandedRay out = ray;
  out.end[3] = 2.0 * start[3] - ray.end[3];
  out.end[7] = -ray.end[7];
  return out;
}

HandedRay counted_from_the_start(const HandedRay& ray, const PhaseState<double>& start) {
  HandedRay out = ray;
  out.end[3] += start[3];
  return out;
}

HandedRay with_t_negated(const HandedRay& ray, const PhaseState<double>& /*start*/) {
  HandedRay out = ray;
  out.end[0] = -ray.end[0];
  return out;
}

HandedRay with_p_at_its_energy(const HandedRay& ray, const PhaseState<double>& start) {
  HandedRay out = ray;
  for (std::size_t i = 4; i < 8; ++i) out.end[i] *= std::abs(start[4]);
  return out;
}

HandedRay with_lambda_at_its_energy(const HandedRay& ray, const PhaseState<double>& start) {
  HandedRay out = ray;
  out.lambda /= std::abs(start[4]);
  return out;
}

HandedRay with_lambda_negated(const HandedRay& ray, const PhaseState<double>& /*start*/) {
  HandedRay out = ray;
  out.lambda = -ray.lambda;
  return out;
}

// On what the start was taken to be.

PhaseState<double> mirrored_left_to_right(const PhaseState<double>& start) {
  PhaseState<double> out = start;
  out[7] = -start[7];
  return out;
}

PhaseState<double> mirrored_top_to_bottom(const PhaseState<double>& start) {
  PhaseState<double> out = start;
  out[6] = -start[6];
  return out;
}

PhaseState<double> turned_back(const PhaseState<double>& start) {
  PhaseState<double> out = start;
  for (std::size_t i = 4; i < 8; ++i) out[i] = -start[i];
  return out;
}

std::vector<Convention> listed() {
  std::vector<Convention> all{
      {.id = "degrees",
       .says = "angles are in degrees, not in radians",
       .shows = Quantity::direction,
       .table = from_degrees},
      {.id = "theta-from-equator",
       .says = "theta is measured from the equator (a latitude), not from the axis",
       .shows = Quantity::direction,
       .table = from_the_equator},
      {.id = "phi-sign",
       .says = "the sign of phi: phi is handed in as -phi",
       .shows = Quantity::direction,
       .end = with_phi_negated},
      {.id = "y-sign", .says = "the sign of y (and so of phi)", .shows = Quantity::direction, .end = with_y_negated},
      {.id = "phi-swept-backwards",
       .says =
           "the sign of phi: it runs the other way from its start (where nothing rotates, a screen mirrored left to "
           "right or p_phi of the wrong sign looks the same)",
       .shows = Quantity::direction,
       .end = swept_the_other_way},
      {.id = "phi-from-start",
       .says = "phi is counted from the start's instead of from 0",
       .shows = Quantity::direction,
       .end = counted_from_the_start},
      {.id = "spin-flipped",
       .says = "the spin is flipped: the hole turns the other way (the sign of a, or of g_tphi)",
       .shows = Quantity::direction,
       .spin_sign = -1.0,
       .energy_follows = true},
      {.id = "spin-flipped",
       .says = "the spin is flipped: the hole turns the other way (the sign of a, or of g_tphi), for light of the same "
               "E, L and Q",
       .shows = Quantity::direction,
       .spin_sign = -1.0},
      {.id = "screen-mirrored",
       .says = "the screen is mirrored left to right (p_phi of the wrong sign at the start)",
       .shows = Quantity::direction,
       .start = mirrored_left_to_right},
      {.id = "screen-mirrored",
       .says = "the screen is mirrored left to right (p_phi of the wrong sign at the start, where p_t follows)",
       .shows = Quantity::direction,
       .start = mirrored_left_to_right,
       .energy_follows = true},
      {.id = "screen-upside-down",
       .says = "the screen is mirrored top to bottom (p_theta of the wrong sign at the start)",
       .shows = Quantity::direction,
       .start = mirrored_top_to_bottom},
      {.id = "traced-backwards",
       .says = "rays are traced the other way, along -p",
       .shows = Quantity::direction,
       .start = turned_back},
      {.id = "p-upper", .says = "p is handed in with an upper index", .shows = Quantity::heading, .table = lowered},
      {.id = "p-sign",
       .says = "the sign of p (signature + - - -, or light the other way in time)",
       .shows = Quantity::heading,
       .table = with_p_negated},
      {.id = "p-unit-energy",
       .says = "p is normalised to unit energy, not the p of the start",
       .shows = Quantity::heading,
       .end = with_p_at_its_energy},
      {.id = "t-sign", .says = "the sign of t", .shows = Quantity::time, .end = with_t_negated},
      {.id = "lambda-unit-energy",
       .says = "the affine parameter is that of unit energy: dx/dlambda is p/E, not p",
       .shows = Quantity::affine,
       .end = with_lambda_at_its_energy},
      {.id = "lambda-sign",
       .says = "the sign of the affine parameter, which grows along p",
       .shows = Quantity::affine,
       .end = with_lambda_negated},
      {.id = "phi-wrapped",
       .says = "phi is wrapped into one turn: windings are lost, and phi is graded without them",
       .shows = Quantity::swept}};
  for (const CatalogueEntry& entry : catalogue()) {
    const Convention other{.id = "other-chart",
                           .says = "the table is in another chart than said",
                           .shows = Quantity::direction,
                           .chart = entry.card->chart};
    const auto same = [&](const Convention& c) { return c.chart == other.chart; };
    if (std::none_of(all.begin(), all.end(), same)) all.push_back(other);
  }
  return all;
}

bool applies(const Convention& convention, const Examiner& examiner, const HandIn& hand_in) {
  const std::string_view metric = examiner.set().metric;
  const bool spherical = has_angles(examiner.home());
  const auto chart_exists = [&](std::string_view chart) {
    return std::any_of(catalogue().begin(), catalogue().end(), [&](const CatalogueEntry& entry) {
      return entry.card->metric == metric && entry.card->chart == chart;
    });
  };
  const bool table_has_angles = has_angles(*examiner.set().spacetime(hand_in.chart));
  if (convention.spin_sign < 0.0) return metric == "kerr";
  if (convention.energy_follows) return metric == "kerr";  // elsewhere the start stays light
  if (!convention.chart.empty()) return convention.chart != hand_in.chart && chart_exists(convention.chart);
  if (convention.id == "degrees" || convention.id == "theta-from-equator") return table_has_angles;
  if (convention.id == "y-sign") return !spherical;
  if (convention.shows == Quantity::heading) return hand_in.has_momentum;
  if (convention.shows == Quantity::affine) return hand_in.has_lambda;
  if (convention.shows == Quantity::swept) return table_has_angles && hand_in.chart == examiner.set().home_chart;
  if (convention.end != nullptr && convention.shows == Quantity::direction) return spherical;
  if (convention.id.starts_with("screen")) return spherical;
  return true;
}

double error_of(Quantity shows, const RayScore& score) {
  const auto value = [&](Quantity q) { return score.error[static_cast<std::size_t>(q)]; };
  const bool known = score.outcome == Outcome::compared || score.outcome == Outcome::unfinished;
  double error = known ? value(shows) : pi;
  if (shows == Quantity::heading && known) error = std::max(error, std::min(pi, value(Quantity::conserved)));
  return std::isnan(error) ? pi : error;
}

class Recognition {
 public:
  Recognition(const Examiner& examiner, const HandIn& hand_in) : examiner_(examiner), hand_in_(hand_in) {
    const std::size_t rays = hand_in.rays.size(), wanted = std::min(rays, sample_size);
    for (std::size_t n = 0; n < wanted; ++n) {
      const std::size_t k = n * rays / wanted;
      const PhaseState<double>& end = hand_in.rays[k].end;
      if (std::isfinite(end[1]) && std::isfinite(end[2]) && std::isfinite(end[3])) sample_.push_back(k);
    }
  }

  std::vector<ConventionFound> run() {
    if (sample_.size() < fewest) return {};
    for (const Quantity shows : {Quantity::direction, Quantity::heading, Quantity::time, Quantity::affine}) {
      look_for(shows);
    }
    look_for_wrapping();
    return std::move(found_);
  }

 private:
  using Set = std::vector<const Convention*>;

  [[nodiscard]] Set undone() const {
    Set set;
    for (const ConventionFound& found : found_) set.push_back(found.convention);
    return set;
  }

  /// The third quartile of the errors in a quantity, with these mistakes undone too.
  [[nodiscard]] double measure(Quantity shows, const Set& more) const {
    Set set = undone();
    set.insert(set.end(), more.begin(), more.end());
    const Undoing undoing(examiner_, hand_in_, set);
    std::vector<double> errors;
    for (const std::size_t k : sample_) {
      const RayScore score = undoing.compare(k);
      // What ends inside the horizon tells nothing, whatever is undone.
      if (score.outcome != Outcome::uncompared) errors.push_back(error_of(shows, score));
    }
    if (errors.size() < fewest) return pi;
    const auto third_quartile = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() * 3 / 4);
    std::nth_element(errors.begin(), third_quartile, errors.end());
    return *third_quartile;
  }

  void look_for(Quantity shows) {
    const double before = measure(shows, {});
    // Below it no sign and no unit is wrong.
    if (!(before > 1e-6)) return;
    Set candidates;
    for (const Convention& convention : conventions()) {
      if (convention.shows == shows && applies(convention, examiner_, hand_in_)) candidates.push_back(&convention);
    }
    std::vector<Set> attempts;
    for (const Convention* one : candidates) attempts.push_back({one});
    Set best = best_of(shows, attempts, before);
    if (best.empty()) {
      attempts.clear();
      for (std::size_t i = 0; i < candidates.size(); ++i) {
        for (std::size_t j = i + 1; j < candidates.size(); ++j) attempts.push_back({candidates[i], candidates[j]});
      }
      best = best_of(shows, attempts, before);
    }
    if (best.empty()) return;
    const double after = measure(shows, best);
    for (const Convention* convention : best) found_.push_back({convention, before, after});
  }

  /// The first of the attempts that is as good as the best, within a factor that rounding and chance explain.
  [[nodiscard]] Set best_of(Quantity shows, const std::vector<Set>& attempts, double before) const {
    std::vector<double> errors;
    for (const Set& attempt : attempts) errors.push_back(measure(shows, attempt));
    const double least = errors.empty() ? pi : *std::min_element(errors.begin(), errors.end());
    if (!(least <= before / 30.0) || !(least <= 0.03)) return {};
    const auto first = std::find_if(errors.begin(), errors.end(), [&](double e) { return e <= 10.0 * least; });
    return attempts[static_cast<std::size_t>(first - errors.begin())];
  }

  void look_for_wrapping() {
    const auto convention = std::find_if(conventions().begin(), conventions().end(),
                                         [](const Convention& c) { return c.id == "phi-wrapped"; });
    if (!applies(*convention, examiner_, hand_in_)) return;
    const Undoing undoing(examiner_, hand_in_, undone());
    if (!undoing.windings_known()) return;
    double least = 0.0, most = 0.0, off = 0.0;
    for (std::size_t k = 0; k < hand_in_.rays.size(); ++k) {
      const double phi = undoing.end(k).end[3];
      if (!std::isfinite(phi)) continue;
      least = std::min(least, phi);
      most = std::max(most, phi);
      const double windings = undoing.compare(k).windings;
      if (std::isfinite(windings)) off = std::max(off, std::abs(windings));
    }
    constexpr double slack = 1e-9;  // of phi printed with ten digits
    const bool one_turn = (least >= -pi - slack && most <= pi + slack) || (least >= -slack && most <= 2.0 * pi + slack);
    if (off > 0.0 && one_turn) found_.push_back({&*convention, 2.0 * pi * off, 0.0});
  }

  const Examiner& examiner_;
  const HandIn& hand_in_;
  std::vector<std::size_t> sample_;
  std::vector<ConventionFound> found_;
};

}  // namespace

const std::vector<Convention>& conventions() {
  static const std::vector<Convention> all = listed();
  return all;
}

Undoing::Undoing(const Examiner& examiner, const HandIn& hand_in, std::vector<const Convention*> undone)
    : examiner_(examiner), hand_in_(hand_in), undone_(std::move(undone)) {
  std::string_view chart = hand_in.chart;
  bool wrapped = false;
  for (const Convention* convention : undone_) {
    if (!convention->chart.empty()) chart = convention->chart;
    wrapped = wrapped || convention->shows == Quantity::swept;
    spin_flipped_ = spin_flipped_ || convention->spin_sign < 0.0;
    energy_follows_ = energy_follows_ || convention->energy_follows;
    other_rays_ = other_rays_ || spin_flipped_ || convention->start != nullptr;
  }
  const ChallengeSet& set = examiner.set();
  std::vector<NamedValue> parameters = set.parameters;
  for (NamedValue& parameter : parameters) {
    if (spin_flipped_ && parameter.name == "a") parameter.value = -parameter.value;
  }
  chart_ = make_spacetime(set.metric, chart, parameters);
  home_ = make_spacetime(set.metric, set.home_chart, parameters);
  table_chart_ = set.spacetime(chart);
  windings_known_ = !wrapped && chart == set.home_chart && has_angles(*chart_);
}

HandedRay Undoing::end(std::size_t k) const {
  HandedRay ray = hand_in_.rays[k];
  for (const Convention* convention : undone_) {
    if (convention->table != nullptr) ray = convention->table(ray, *chart_);
  }
  ray.end = change_chart(*chart_, *home_, ray.end, ray.sheet).state;
  for (const Convention* convention : undone_) {
    if (convention->end != nullptr) ray = convention->end(ray, examiner_.ray(k).ray.start);
  }
  return ray;
}

// The code reads the numbers of its table for what they are not; what it needs to make light of them it finds anew.
std::optional<PhaseState<double>> Undoing::altered_start(std::size_t k) const {
  PhaseState<double> start = examiner_.ray(k).ray.start;
  for (const Convention* convention : undone_) {
    if (convention->start != nullptr) start = convention->start(start);
  }
  ChartState read{start};
  if (spin_flipped_) read = change_chart(examiner_.home(), *table_chart_, start);
  const Spacetime& there = spin_flipped_ ? *chart_ : *home_;
  if (energy_follows_) {
    PhaseState<double>& y = read.state;
    const auto p = null_momentum(there, y.x(), y.p(), start[4] < 0.0 ? 1.0 : -1.0);
    if (!p || !((*p)[0] * start[4] > 0.0)) return std::nullopt;
    y[4] = (*p)[0];
  }
  return spin_flipped_ ? change_chart(there, *home_, read.state, read.sheet).state : read.state;
}

Undoing::Course Undoing::altered_course(std::size_t k) const {
  std::optional<PhaseState<double>> start = altered_start(k);
  if (!start) return {{}, negative_energy_ray()};
  try {
    auto exact = exact_ray(examiner_.set().metric, home_->parameters(), *start);
    // Light once more: of p_r only the sign was heeded.
    const ExactEnd begin = has_angles(*home_) ? exact->at((*start)[1], 0) : ExactEnd{};
    if (begin.reached) (*start)[5] = begin.state[5];
    return {*start, std::move(exact)};
  } catch (const std::domain_error&) {
    return {*start, nullptr};  // no light starts so: this is not what the code did
  }
}

RayScore Undoing::compare(std::size_t k, bool with_conditions) const {
  const Course other = other_rays_ ? altered_course(k) : Course{};
  if (other_rays_ && other.exact == nullptr) return {};
  const ExaminedRay ray = other_rays_ ? ExaminedRay{other.start, *other.exact, *home_} : examiner_.traced(k);
  const HandedRay handed = end(k);
  RayScore score = examiner_.compare(ray, handed, hand_in_.has_status, windings_known_);
  if (with_conditions && score.outcome == Outcome::compared) score.condition = examiner_.conditions(ray, handed.end);
  return score;
}

RayScore Undoing::compare(std::size_t k) const { return compare(k, false); }
RayScore Undoing::score(std::size_t k) const { return compare(k, true); }

std::vector<ConventionFound> recognised_conventions(const Examiner& examiner, const HandIn& hand_in) {
  return Recognition(examiner, hand_in).run();
}

}  // namespace xpr
