#include "validation/grading/score.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/polar_fold.hpp"
#include "metrics/coordinates.hpp"
#include "validation/grading/challenge_starts.hpp"

namespace xpr {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double turn = 2.0 * std::numbers::pi;

template <Quantity q>
constexpr std::size_t at = static_cast<std::size_t>(q);

bool finite_event(const PhaseState<double>& y) { return all_finite(y.x()); }

Direction scaled_to_one(Direction v) {
  const double size = std::hypot(v[0], v[1], v[2]);
  for (double& component : v) component /= size;
  return v;
}

// The start with a little less (or, from nothing, a little more) momentum along component `index`, on the light cone
// again: p_r follows, or where the ray starts at a turning point the other momentum across.
PhaseState<double> nudged(const Spacetime& home, const PhaseState<double>& y, std::size_t index, double by) {
  PhaseState<double> out = y;
  const bool tangent = y[5] == 0.0;
  if (tangent && index == 6) index = 5;
  out[index] -= out[index] == 0.0 ? -by : std::copysign(by, out[index]);
  const std::size_t follows = tangent ? 6 : 5;
  const SymTensor4<double> g = home.inverse_metric(y.x());
  double rest = 2.0 * g(0, 3) * out[4] * out[7];
  for (std::size_t mu = 0; mu < 4; ++mu) {
    if (mu + 4 != follows) rest += g(mu, mu) * out[mu + 4] * out[mu + 4];
  }
  out[follows] = std::copysign(std::sqrt(std::max(0.0, -rest / g(follows - 4, follows - 4))), y[follows]);
  return out;
}

// In a Cartesian medium: p turned a little, its length kept.
PhaseState<double> turned(const PhaseState<double>& y, std::size_t index, double by) {
  PhaseState<double> out = y;
  out[5 + index] += by;
  const double before = std::hypot(y[5], y[6], y[7]), after = std::hypot(out[5], out[6], out[7]);
  for (std::size_t i = 5; i < 8; ++i) out[i] *= before / after;
  return out;
}

}  // namespace

double RayScore::scaled(std::size_t quantity) const {
  const double amplified = condition[quantity];
  const double own = quantity < conditioned_quantities ? truth_error : 0.0;
  return (error[quantity] + own) / (amplified > 1.0 ? amplified : 1.0);
}

Examiner::Examiner(const ChallengeSet& set, std::int64_t count)
    : set_(set),
      home_(set.spacetime(set.home_chart)),
      spherical_(home_->card().coordinates[3].kind == CoordinateKind::azimuth),
      rays_(static_cast<std::size_t>(count)),
      exact_(rays_.size()) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays_.size(), 256), [&](const auto& range) {
    for (std::size_t k = range.begin(); k < range.end(); ++k) {
      rays_[k] = set_.ray(*home_, static_cast<std::int64_t>(k));
      exact_[k] = exact_ray(set_.metric, set_.parameters, rays_[k].ray.start);
    }
  });
}

double Examiner::length_along(const PhaseState<double>& y) const {
  return spherical_ ? y[1] : std::hypot(y[1], y[2], y[3]);
}

Direction Examiner::direction(const PhaseState<double>& y) const {
  return spherical_ ? unit_direction(y[2], y[3]) : scaled_to_one({y[1], y[2], y[3]});
}

// Along the axes of a static grid's orthonormal frame, as a vector in space: near a pole its components turn, it does
// not.
Direction Examiner::heading(const Spacetime& home, const PhaseState<double>& y) const {
  if (!spherical_) return scaled_to_one({y[5], y[6], y[7]});
  const SymTensor4<double> up = home.inverse_metric(y.x());
  const double azimuthal = y[7] == 0.0 ? 0.0 : y[7] / std::sqrt(home.metric(y.x())(3, 3));
  const double radial = y[5] * std::sqrt(up(1, 1)), polar = y[6] * std::sqrt(up(2, 2));
  const double st = std::sin(y[2]), ct = std::cos(y[2]), sp = std::sin(y[3]), cp = std::cos(y[3]);
  const double along = radial * st + polar * ct;
  return scaled_to_one({along * cp - azimuthal * sp, along * sp + azimuthal * cp, radial * ct - polar * st});
}

double Examiner::drift(const ExaminedRay& ray, const PhaseState<double>& end) const {
  const PhaseState<double>& start = ray.start;
  const double energy = std::abs(start[4]);
  const double least = energy * set_.length_unit;
  const double energy_drift = std::abs(end[4] - start[4]) / energy;
  if (!spherical_) {
    const auto moment = [](const PhaseState<double>& y) {
      return Direction{y[2] * y[7] - y[3] * y[6], y[3] * y[5] - y[1] * y[7], y[1] * y[6] - y[2] * y[5]};
    };
    const Direction a = moment(start), b = moment(end);
    return std::max(energy_drift,
                    std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]) / std::max(least, std::hypot(a[0], a[1], a[2])));
  }
  const auto third = [&](const PhaseState<double>& y) {
    if (const auto carter = ray.home.carter_constant(y)) return *carter;
    const double across = y[7] == 0.0 ? 0.0 : y[7] / std::sin(y[2]);
    return y[6] * y[6] + across * across;
  };
  const double carter = third(start);
  return std::max({energy_drift, std::abs(end[7] - start[7]) / std::max(least, std::abs(start[7])),
                   std::abs(third(end) - carter) / std::max(least * least, std::abs(carter))});
}

Examiner::Difference Examiner::difference(const ExaminedRay& ray, const ExactEnd& exact, const PhaseState<double>& end,
                                          double lambda, bool windings_known) const {
  const PhaseState<double>& start = ray.start;
  Difference out{.error = {}, .windings = nan};
  out.error.fill(nan);
  out.error[at<Quantity::direction>] = angle_between(direction(end), exact.direction);
  if (spherical_) {
    const double apart = end[3] - exact.state[3];
    out.error[at<Quantity::swept>] = std::abs(std::remainder(apart, turn));
    // A ray without angular momentum may go either way around the axis.
    if (windings_known && start[7] != 0.0) out.windings = std::round(apart / turn);
  }
  const double elapsed = std::abs(exact.state[0] - start[0]);
  out.error[at<Quantity::time>] = std::abs(end[0] - exact.state[0]) / std::max(set_.length_unit, elapsed);
  out.error[at<Quantity::affine>] =
      std::abs(lambda - exact.lambda) / std::max(set_.length_unit / std::abs(start[4]), exact.lambda);
  out.error[at<Quantity::heading>] = angle_between(heading(ray.home, end), heading(ray.home, exact.state));
  return out;
}

Errors Examiner::conditions(const ExaminedRay& ray, const PhaseState<double>& end) const {
  Errors most;
  most.fill(1.0);
  const PhaseState<double>& start = ray.start;
  const double radius = length_along(end);
  const int turns = ray.exact.turns_at_end();
  const ExactEnd here = ray.exact.at(radius, turns);
  if (!here.reached) return most;
  // Far above the closed form's rounding (1e-15), far below the least distance of a ray from the critical ones (5e-6).
  constexpr double step = 1e-8;
  const double by = step * set_.length_unit;
  const auto take = [&](const ExactEnd& there) {
    if (!there.reached) return;
    const Errors moved = difference(ray, here, there.state, there.lambda, false).error;
    for (std::size_t q = 0; q < conditioned_quantities; ++q) {
      if (moved[q] > most[q] * step) most[q] = moved[q] / step;
    }
  };
  take(ray.exact.at(radius + by, turns));
  const double energy = std::abs(start[4]);
  for (std::size_t index = 0; index < (spherical_ ? 2 : 3); ++index) {
    const PhaseState<double> near =
        spherical_ ? nudged(ray.home, start, 6 + index, by * energy) : turned(start, index, step * energy);
    try {
      take(exact_ray(set_.metric, ray.home.parameters(), near)->at(radius, turns));
    } catch (const std::domain_error&) {
      continue;  // a start at the edge of where light goes has no neighbour on that side
    }
  }
  return most;
}

Status Examiner::status_of(const HandedRay& end, bool has_status) const {
  // `crossed` is how rays end that were stopped at a distance from a throat.
  if (has_status) return end.status == Status::crossed ? Status::escaped : end.status;
  if (home_->radius(end.end.x()) >= 0.9 * set_.r_max) return Status::escaped;
  // Light that is this far in does not come out again: halfway between the horizon and the innermost photon orbit lies
  // the default stop, and a code may stop a little before it.
  const auto stop = home_->default_r_min();
  if (set_.captures && stop && home_->radius(end.end.x()) < *stop + 0.1 * *home_->horizon_radius()) {
    return Status::captured;
  }
  return Status::max_steps;
}

Outcome Examiner::outcome_of(const ExactRay& exact, Status status, const PhaseState<double>& end) const {
  if (!finite_event(end)) return Outcome::not_finite;
  if (status != Status::escaped && status != Status::captured) return Outcome::unfinished;
  if ((status == Status::captured) != exact.captured()) return Outcome::wrong_status;
  if (set_.metric == "ellis" && (end[1] < 0.0) != (exact.side() < 0)) return Outcome::wrong_status;
  const auto horizon = home_->horizon_radius();
  if (exact.captured() && horizon && end[1] <= *horizon) return Outcome::uncompared;
  return Outcome::compared;
}

// Of a ray that is still on its way, the branch that is nearer.
ExactEnd Examiner::counterpart(const ExactRay& exact, Outcome outcome, const PhaseState<double>& end) const {
  const double radius = length_along(end);
  const ExactEnd last = exact.at(radius, exact.turns_at_end());
  if (outcome == Outcome::compared || exact.turns_at_end() == 0) return last;
  const ExactEnd first = exact.at(radius, 0);
  if (!first.reached || !last.reached) return first.reached ? first : last;
  const Direction n = direction(end);
  return angle_between(first.direction, n) < angle_between(last.direction, n) ? first : last;
}

RayScore Examiner::compare(const ExaminedRay& ray, const HandedRay& handed, bool has_status,
                           bool windings_known) const {
  RayScore score;
  score.error.fill(nan);
  score.condition.fill(1.0);
  score.position = score.windings = score.truth_error = nan;
  PhaseState<double> end = handed.end;
  if (spherical_ && finite_event(end)) fold_polar_angle(end, 2, 3);
  score.status = has_status || finite_event(end) ? status_of(handed, has_status) : Status::not_finite;
  score.outcome = outcome_of(ray.exact, score.status, end);
  if (score.outcome != Outcome::compared && score.outcome != Outcome::unfinished) return score;
  const ExactEnd there = counterpart(ray.exact, score.outcome, end);
  if (!there.reached) {
    if (score.outcome == Outcome::compared) {
      score.outcome = ray.exact.has_closed_form() ? Outcome::off_the_ray : Outcome::uncompared;
    }
    return score;
  }
  const Difference apart = difference(ray, there, end, handed.lambda, windings_known);
  score.error = apart.error;
  score.windings = apart.windings;
  score.position = 2.0 * home_->radius(end.x()) * std::sin(0.5 * score.error[at<Quantity::direction>]);
  score.error[at<Quantity::conserved>] = drift(ray, end);
  score.error[at<Quantity::null>] = ray.home.null_residual(end);
  score.truth_error = there.direction_error;
  return score;
}

}  // namespace xpr
