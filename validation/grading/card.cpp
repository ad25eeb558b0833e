#include "validation/grading/card.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace xpr {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Letters by the number of limits that a value exceeds.
Letter letter_beyond(double value, const std::array<double, 5>& limits) {
  const auto within = [&](double limit) { return value <= limit; };
  return static_cast<Letter>(std::find_if(limits.begin(), limits.end(), within) - limits.begin());
}

double share(std::int64_t part, std::int64_t all) {
  return all > 0 ? static_cast<double>(part) / static_cast<double>(all) : 0.0;
}

/// By nearest rank, of sorted values.
double quantile(const std::vector<double>& sorted, double q) {
  const auto rank = static_cast<std::size_t>(std::ceil(q * static_cast<double>(sorted.size())));
  return sorted[std::max<std::size_t>(rank, 1) - 1];
}

struct Scored {
  std::int64_t id;
  std::int64_t family;
  const RayScore* score;
};

Tail tail_of(const std::vector<Scored>& rays, std::size_t quantity) {
  Tail tail{
      .median = nan, .p90 = nan, .p99 = nan, .most = nan, .scaled_median = nan, .scaled_p99 = nan, .scaled_most = nan};
  std::vector<double> errors, scaled;
  for (const Scored& ray : rays) {
    const RayScore& score = *ray.score;
    if (score.outcome != Outcome::compared || std::isnan(score.error[quantity])) continue;
    errors.push_back(score.error[quantity]);
    scaled.push_back(score.scaled(quantity));
    if (tail.worst < 0 || scaled.back() > tail.scaled_most) tail.scaled_most = scaled.back(), tail.worst = ray.id;
  }
  tail.rays = static_cast<std::int64_t>(errors.size());
  if (errors.empty()) return tail;
  std::sort(errors.begin(), errors.end());
  std::sort(scaled.begin(), scaled.end());
  tail.median = quantile(errors, 0.5);
  tail.p90 = quantile(errors, 0.9);
  tail.p99 = quantile(errors, 0.99);
  tail.most = errors.back();
  tail.scaled_median = quantile(scaled, 0.5);
  tail.scaled_p99 = quantile(scaled, 0.99);
  tail.letter = letter_of_error(tail.scaled_p99);
  return tail;
}

Marks marks_of(const std::vector<Scored>& rays) {
  Marks marks;
  for (std::size_t q = 0; q < quantity_count; ++q) marks.tail[q] = tail_of(rays, q);
  for (const Scored& ray : rays) {
    ++marks.rays;
    ++marks.outcomes[static_cast<std::size_t>(ray.score->outcome)];
    if (failed(ray.score->outcome)) ++marks.failed;
    if (ray.score->outcome != Outcome::compared || std::isnan(ray.score->windings)) continue;
    ++marks.counted_turns;
    if (ray.score->windings != 0.0) ++marks.wrong_turns;
  }
  marks.status_letter = letter_of_share(share(marks.failed, marks.rays));
  marks.turns_letter = letter_of_share(share(marks.wrong_turns, marks.counted_turns));
  marks.grade = std::max(marks.status_letter, marks.turns_letter);
  for (const Tail& tail : marks.tail) {
    if (tail.rays > 0) marks.grade = std::max(marks.grade, tail.letter);
  }
  // Nothing was compared: there is nothing to praise.
  if (marks.tail[0].rays == 0) marks.grade = Letter::f;
  return marks;
}

std::vector<RayScore> scores_of(const Examiner& examiner, const Undoing& undoing) {
  std::vector<RayScore> scores(static_cast<std::size_t>(examiner.count()));
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, scores.size(), 64), [&](const auto& range) {
    for (std::size_t k = range.begin(); k < range.end(); ++k) {
      scores[k] = undoing.score(k);
    }
  });
  return scores;
}

std::vector<Scored> scored(const Examiner& examiner, const std::vector<RayScore>& scores) {
  std::vector<Scored> rays;
  for (std::size_t k = 0; k < scores.size(); ++k) {
    rays.push_back({examiner.ray(k).ray.id, examiner.ray(k).family, &scores[k]});
  }
  return rays;
}

std::vector<FamilyMarks> families_of(const Examiner& examiner, const std::vector<Scored>& rays) {
  std::vector<FamilyMarks> out;
  for (std::size_t f = 0; f < examiner.set().families.size(); ++f) {
    const RayFamily& family = examiner.set().families[f];
    std::vector<Scored> own;
    for (const Scored& ray : rays) {
      if (ray.family == static_cast<std::int64_t>(f)) own.push_back(ray);
    }
    const Marks marks = marks_of(own);
    out.push_back({family.name, family.what, marks.rays, marks.failed, marks.tail});
  }
  return out;
}

}  // namespace

Letter letter_of_error(double error) { return letter_beyond(error, letter_errors); }
Letter letter_of_share(double part) { return letter_beyond(part, letter_shares); }
std::string_view to_string(Letter letter) { return letter_names[static_cast<std::size_t>(letter)]; }

ReportCard grade(const Examiner& examiner, HandIn hand_in) {
  ReportCard card;
  card.hand_in = std::move(hand_in);
  card.tolerance = nan;
  card.mistakes = recognised_conventions(examiner, card.hand_in);
  std::vector<const Convention*> undone;
  for (const ConventionFound& found : card.mistakes) undone.push_back(found.convention);
  card.scores = scores_of(examiner, Undoing(examiner, card.hand_in, undone));
  const std::vector<Scored> rays = scored(examiner, card.scores);
  card.undone = card.as_handed_in = marks_of(rays);
  card.families = families_of(examiner, rays);
  if (!card.mistakes.empty()) {
    const std::vector<RayScore> as_they_are = scores_of(examiner, Undoing(examiner, card.hand_in, {}));
    card.as_handed_in = marks_of(scored(examiner, as_they_are));
  }
  return card;
}

}  // namespace xpr
