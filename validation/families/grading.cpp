// Grading of other codes, put to the test: our own rays handed in like a stranger's, and a table with known errors.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "metrics/coordinates.hpp"
#include "validation/families.hpp"
#include "validation/grading/card.hpp"
#include "validation/kit.hpp"

namespace xpr {

namespace {

constexpr const char* wrapped_fault = "grading-adapter-phi-wrapped";
constexpr const char* upper_fault = "grading-adapter-p-upper-index";
constexpr const char* time_fault = "grading-adapter-time-unsigned";
constexpr const char* affine_fault = "grading-adapter-lambda-at-unit-energy";
constexpr const char* float_fault = "grading-truth-parameters-in-single-precision";
constexpr const char* carried_fault = "grading-adapter-nan-carried-forward";
constexpr const char* percentile_fault = "grading-card-p90-for-p99";

/// A set, and the charts in which rays that run forwards and backwards in time are transported.
struct Subject {
  std::string_view set, forwards, backwards;
};
constexpr std::array<Subject, 4> subjects{{{"flat", "cartesian", "cartesian"},
                                           {"schwarzschild-core", "kerr-schild", "kerr-schild-outgoing"},
                                           {"kerr-core", "kerr-schild", "kerr-schild-outgoing"},
                                           {"ellis-core", "isotropic", "isotropic"}}};

constexpr std::int64_t rays_of_a_set = 60;

/// What an adapter between a code and a ray table gets wrong, where the fault is planted.
void spoil(const Lab& lab, const Spacetime& home, double energy, HandedRay& ray) {
  if (lab.planted(wrapped_fault)) ray.end[3] = std::remainder(ray.end[3], 2.0 * std::numbers::pi);
  if (lab.planted(upper_fault)) {
    const Vec4<double> p = raise_index(home.inverse_metric(ray.end.x()), ray.end.p());
    for (std::size_t i = 0; i < 4; ++i) ray.end[i + 4] = p[i];
  }
  if (lab.planted(time_fault)) ray.end[0] = std::abs(ray.end[0]);
  if (lab.planted(affine_fault)) ray.lambda *= energy;
}

HandIn own_rays(const Lab& lab, const Subject& subject, const Examiner& examiner, const MethodAt& method) {
  const ChallengeSet& set = examiner.set();
  const auto home = lab.spacetime(set.metric, set.home_chart, set.parameters);
  const auto forwards = lab.spacetime(set.metric, subject.forwards, set.parameters);
  const auto backwards = lab.spacetime(set.metric, subject.backwards, set.parameters);
  TraceSettings settings = trace_settings(method, set.length_unit);
  settings.r_max = set.r_max;
  settings.r_min = home->default_r_min();
  HandIn hand_in;
  hand_in.chart = std::string(set.home_chart);
  hand_in.has_status = hand_in.has_momentum = hand_in.has_lambda = true;
  for (std::size_t k = 0; k < static_cast<std::size_t>(examiner.count()); ++k) {
    const PhaseState<double>& start = examiner.ray(k).ray.start;
    const Spacetime& chart = start[4] < 0.0 ? *forwards : *backwards;
    const SweptRay ray = trace_swept(lab, *home, chart, change_chart(*home, chart, start), settings);
    HandedRay handed{.status = ray.end.status, .end = ray.end_classical, .lambda = ray.end.lambda};
    // phi as it was at the start, not as the way through the other chart left it.
    handed.end[3] += start[3] - ray.start_classical[3];
    spoil(lab, *home, std::abs(start[4]), handed);
    hand_in.rays.push_back(handed);
  }
  return hand_in;
}

std::vector<Row> own_rays_rows(const Lab& lab) {
  std::vector<Row> rows;
  const MethodAt method{"dop853", 1e-12};
  for (const Subject& subject : subjects) {
    ChallengeSet set = challenge_set(subject.set);
    const Examiner rays(set, rays_of_a_set);
    const HandIn hand_in = own_rays(lab, subject, rays, method);
    if (lab.planted(float_fault)) {
      for (NamedValue& parameter : set.parameters) {
        parameter.value = static_cast<double>(static_cast<float>(parameter.value));
      }
    }
    const Examiner examiner(set, rays_of_a_set);
    const Marks marks = grade(examiner, hand_in).as_handed_in;
    const auto add = [&](std::string_view what, double value, const Tolerance& most) {
      Row row = make_row(fmt::format("{}: {}", set.id, what), examiner.home(), method, {});
      grade_bound(row, value, most);
      rows.push_back(std::move(row));
    };
    for (std::size_t q = 0; q < quantity_count; ++q) {
      add(fmt::format("{}, p99 of the scaled errors", quantity_cards[q].id), marks.tail[q].scaled_p99,
          {letter_errors[0], "what the letter A+ allows: a hundred tolerances"});
    }
    const Tolerance none{1e-3, fmt::format("none of them; one is {:.3g}", 1.0 / static_cast<double>(rays_of_a_set))};
    const auto all = static_cast<double>(marks.rays);
    add("share of rays that failed", static_cast<double>(marks.failed) / all, none);
    add("share of rays with a wrong number of turns", static_cast<double>(marks.wrong_turns) / all, none);
  }
  return rows;
}

// 400 rays with these errors in phi, and eight of nan.
constexpr std::int64_t lost = 8, far_off = 6, off = 60, near = 334;
constexpr double far_error = 1e-3, error = 1e-5, near_error = 1e-7;

HandIn known_errors(const Lab& lab, const Examiner& examiner) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  HandIn hand_in;
  hand_in.chart = std::string(examiner.set().home_chart);
  hand_in.has_status = true;
  for (std::int64_t k = 0; k < examiner.count(); ++k) {
    const ExactRay& exact = examiner.exact(static_cast<std::size_t>(k));
    HandedRay ray{.status = Status::escaped, .end = exact.at(examiner.set().r_max, exact.turns_at_end()).state};
    // Spread over the table, so that no run of neighbours holds one kind: 151 and 408 have no common divisor.
    const std::int64_t place = 151 * k % examiner.count();
    ray.end[3] += place < far_off ? far_error : place < far_off + off ? error : near_error;
    if (place >= far_off + off + near) {
      ray.end = {{nan, nan, nan, nan}, {nan, nan, nan, nan}};
      ray.status = Status::not_finite;
      if (lab.planted(carried_fault)) {
        ray.end = exact.at(examiner.set().r_max, exact.turns_at_end()).state;
        ray.status = Status::escaped;
      }
    }
    hand_in.rays.push_back(ray);
  }
  return hand_in;
}

std::vector<Row> known_errors_rows(const Lab& lab) {
  const ChallengeSet& set = challenge_set("flat");
  const Examiner examiner(set, near + off + far_off + lost);
  const Marks marks = grade(examiner, known_errors(lab, examiner)).as_handed_in;
  const Tail& swept = marks.tail[static_cast<std::size_t>(Quantity::swept)];
  std::vector<Row> rows;
  const auto add = [&](std::string label, double value, double wanted, const Tolerance& tolerance) {
    Row row = make_row(std::move(label), examiner.home(), {"", 0.0}, {});
    grade(row, value, {wanted, 0.0}, tolerance);
    rows.push_back(std::move(row));
  };
  const Tolerance rounding{1e-14, "round-off of azimuths of up to 10 rad, some ten units of it"};
  add("median of 400 errors", swept.median, near_error, rounding);
  add("p90 of 400 errors", swept.p90, error, rounding);
  add("p99 of 400 errors", lab.planted(percentile_fault) ? swept.p90 : swept.p99, far_error, rounding);
  add("the largest of 400 errors", swept.most, far_error, rounding);
  const auto all = static_cast<double>(examiner.count());
  add("share of rays that failed", static_cast<double>(marks.failed) / all, static_cast<double>(lost) / all,
      {1e-15, "a ratio of small integers"});
  return rows;
}

}  // namespace

std::vector<Case> grading_cases() {
  return {{closed_form_case(
               "grading", "own-rays",
               "Rays of the challenge sets, traced here and handed in like another code's, get an A+.",
               "Traced by dop853 at 1e-12 in a regular chart, handed in in the classical one, compared with the "
               "closed form at their own end points; scaled by each ray's condition (docs/grading.md).",
               "closed forms of single rays", "GrallaLupsasca2020Geodesics Ellis1973"),
           true, own_rays_rows},
          {closed_form_case("grading", "known-errors", "A card shows the errors that were put into its table.",
                            "Exact ends with azimuths off by 1e-7, 1e-5 and 1e-3 rad, and rows of nan: percentiles by "
                            "nearest rank over what was compared, failures over all.",
                            "the errors that were put in", "MisnerThorneWheeler1973"),
           true, known_errors_rows}};
}

std::vector<Fault> grading_faults() {
  return {{.id = wrapped_fault,
           .description = "an adapter that hands in phi modulo 2 pi, where it should count its turns",
           .case_id = "grading/own-rays"},
          {.id = upper_fault,
           .description = "an adapter that hands in p^mu in the place of p_mu",
           .case_id = "grading/own-rays"},
          {.id = time_fault,
           .description = "an adapter that loses the sign of t of rays traced back in time",
           .case_id = "grading/own-rays"},
          {.id = affine_fault,
           .description = "an adapter that normalises lambda to unit energy and forgets to turn it back",
           .case_id = "grading/own-rays"},
          {.id = float_fault,
           .description = "closed forms evaluated at the spin's single-precision value",
           .case_id = "grading/own-rays"},
          {.id = carried_fault,
           .description = "a table's rows of nan filled in, so that failed rays pass for good ones",
           .case_id = "grading/known-errors"},
          {.id = percentile_fault,
           .description = "a card that prints the 90th percentile as the 99th",
           .case_id = "grading/known-errors"}};
}

}  // namespace xpr
