#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/transport.hpp"
#include "grading_rays.hpp"
#include "metrics/catalogue.hpp"

namespace xpr {
namespace {

using testing::end_radius;
using testing::exact_hand_in;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// What a code with other physics hands in: exact ends of its own rays, where they go the same way.
HandIn rays_of_other_physics(const Examiner& examiner, const std::vector<NamedValue>& parameters) {
  return exact_hand_in(examiner, examiner.set().home_chart, [&](std::size_t k, HandedRay& ray) {
    try {
      const auto other = exact_ray(examiner.set().metric, parameters, examiner.ray(k).ray.start);
      const ExactEnd end = other->at(end_radius(examiner, k), other->turns_at_end());
      ray.status = other->captured() ? Status::captured : Status::escaped;
      ray.end = end.reached ? end.state : PhaseState<double>{{nan, nan, nan, nan}, {nan, nan, nan, nan}};
    } catch (const std::domain_error&) {
      ray.end = {{nan, nan, nan, nan}, {nan, nan, nan, nan}};
    }
  });
}

TEST(ChallengeSets, begin_with_the_same_rays_whatever_their_number_and_share_no_id) {
  std::set<std::int64_t> ids;
  for (const ChallengeSet& set : challenge_sets()) {
    const Examiner few(set, 20), many(set, 50);
    for (std::size_t k = 0; k < 50; ++k) {
      const Ray& ray = many.ray(k).ray;
      EXPECT_TRUE(ids.insert(ray.id).second) << ray.id;
      EXPECT_EQ(set_of_id(ray.id), &set);
      if (k < 20) {
        EXPECT_EQ(few.ray(k).ray.start.c, ray.start.c) << set.id;
      }
    }
  }
  EXPECT_EQ(set_of_id(7), nullptr);
}

TEST(ChallengeSets, are_light_in_every_chart) {
  for (const ChallengeSet& set : challenge_sets()) {
    const auto home = set.spacetime(set.home_chart);
    for (const CatalogueEntry& entry : catalogue()) {
      if (entry.card->metric != set.metric) continue;
      const auto chart = set.spacetime(entry.card->chart);
      for (std::int64_t k = 0; k < 120; ++k) {
        const Ray there = set.ray_in(*chart, *home, k);
        // Round-off of H; in kerr-hard p_r comes to 1e3 in charts that the horizon is singular in.
        EXPECT_LT(chart->null_residual(there.start), 1e-12) << set.id << " " << entry.card->chart << " " << k;
      }
    }
  }
}

TEST(ChallengeSets, hand_out_one_ray_in_every_chart) {
  // 2026-11-22: starts next to the horizon of kerr-hard lost nine digits on their way to the outgoing chart.
  for (const ChallengeSet& set : challenge_sets()) {
    const auto home = set.spacetime(set.home_chart);
    for (const CatalogueEntry& entry : catalogue()) {
      if (entry.card->metric != set.metric) continue;
      const auto chart = set.spacetime(entry.card->chart);
      for (std::int64_t k = 0; k < 120; ++k) {
        const PhaseState<double> start = set.ray(*home, k).ray.start, there = set.ray_in(*chart, *home, k).start;
        EXPECT_EQ(there[4], start[4]);
        // p as large as 1e3 holds L to 1e-13. Carter's constant is a difference of squares of momenta.
        const double largest = std::max({std::abs(there[5]), std::abs(there[6]), std::abs(there[7])});
        const auto constants = home->killing_constants(start), found = chart->killing_constants(there);
        for (const KillingConstant& constant : constants) {
          for (const KillingConstant& other : found) {
            if (other.name != constant.name) continue;
            EXPECT_NEAR(other.value, constant.value, 2e-12 * (1.0 + std::abs(constant.value))) << set.id << k;
          }
        }
        const auto carter = home->carter_constant(start), found_carter = chart->carter_constant(there);
        if (carter && found_carter) {
          EXPECT_NEAR(*found_carter, *carter, 2e-12 * (1.0 + std::abs(*carter)) + 1e-15 * largest * largest)
              << set.id << entry.card->chart << k;
        }
      }
    }
  }
}

TEST(ExactRay, agrees_with_rays_traced_by_dop853) {
  // Two routes: closed forms against an integrator. At tol 1e-12 its errors scale to some 1e-12; an extremal horizon,
  // next to which the step's error grows, takes them to some 1e-9.
  for (const ChallengeSet& set : challenge_sets()) {
    const Examiner examiner(set, 120);
    TransportSettings settings{
        .metric = std::string(set.metric), .parameters = set.parameters, .chart = std::string(set.home_chart)};
    settings.trace.method = "dop853";
    settings.trace.tol = 1e-12;
    settings.trace.r_max = set.r_max;
    const Transport transport(settings);
    HandIn hand_in;
    hand_in.chart = settings.chart;
    hand_in.has_status = hand_in.has_momentum = hand_in.has_lambda = true;
    for (std::size_t k = 0; k < 120; ++k) {
      const TracedRay end = transport.trace(examiner.ray(k).ray);
      hand_in.rays.push_back({end.status, end.sheet, end.end, end.lambda});
    }
    const ReportCard card = grade(examiner, hand_in);
    EXPECT_TRUE(card.mistakes.empty()) << set.id;
    EXPECT_EQ(card.undone.failed, 0) << set.id;
    EXPECT_EQ(card.undone.wrong_turns, 0) << set.id;
    EXPECT_LE(card.undone.grade, set.id == "kerr-hard" ? Letter::a : Letter::a_plus) << set.id;
  }
}

TEST(Grade, is_the_best_for_exact_rays_in_every_chart) {
  for (const ChallengeSet& set : challenge_sets()) {
    const Examiner examiner(set, 300);
    for (const CatalogueEntry& entry : catalogue()) {
      if (entry.card->metric != set.metric) continue;
      const ReportCard card = grade(examiner, exact_hand_in(examiner, entry.card->chart));
      EXPECT_TRUE(card.mistakes.empty()) << set.id << " " << entry.card->chart;
      EXPECT_EQ(card.undone.failed, 0) << set.id;
      EXPECT_EQ(card.undone.grade, Letter::a_plus) << set.id << " " << entry.card->chart;
      EXPECT_EQ(card.as_handed_in.grade, Letter::a_plus) << set.id;
    }
  }
}

TEST(Grade, is_the_same_wherever_a_code_stops) {
  const Examiner examiner(challenge_set("kerr-core"), 60);
  const ReportCard card =
      grade(examiner, exact_hand_in(examiner, "boyer-lindquist", [&](std::size_t k, HandedRay& ray) {
              const ExactRay& exact = examiner.exact(k);
              const double r = exact.captured() ? 1.9 : 70.0 + 20.0 * static_cast<double>(k);
              const ExactEnd end = exact.at(r, exact.turns_at_end());
              ray.end = end.state;
              ray.lambda = end.lambda;
            }));
  EXPECT_EQ(card.undone.grade, Letter::a_plus);
  EXPECT_EQ(card.undone.failed, 0);
}

TEST(Grade, has_letters_two_decades_wide) {
  EXPECT_EQ(letter_of_error(1e-10), Letter::a_plus);
  EXPECT_EQ(letter_of_error(1.1e-10), Letter::a);
  EXPECT_EQ(letter_of_error(1e-3), Letter::d);
  EXPECT_EQ(letter_of_error(0.02), Letter::f);
  EXPECT_EQ(letter_of_error(nan), Letter::f);
  EXPECT_EQ(letter_of_share(0.0), Letter::a_plus);
  EXPECT_EQ(letter_of_share(0.0005), Letter::b);
  EXPECT_EQ(letter_of_share(0.5), Letter::f);
}

TEST(Grade, measures_errors_of_the_size_that_they_have) {
  const Examiner examiner(challenge_set("schwarzschild-core"), 200);
  // Every azimuth 1e-5 too large, every time 1e-7 of itself, p_theta and p_phi alike turned a little.
  const ReportCard card = grade(examiner, exact_hand_in(examiner, "areal", [&](std::size_t, HandedRay& ray) {
                                  ray.end[3] += 1e-5;
                                  ray.end[0] *= 1.0 + 1e-7;
                                }));
  const Marks& marks = card.as_handed_in;
  EXPECT_TRUE(card.mistakes.empty());
  EXPECT_NEAR(marks.tail[1].median, 1e-5, 1e-13);
  EXPECT_NEAR(marks.tail[1].most, 1e-5, 1e-11);
  EXPECT_LE(marks.tail[0].most, 1.0000001e-5);  // times sin theta
  EXPECT_GT(marks.tail[0].median, 2e-6);
  EXPECT_NEAR(marks.tail[2].median, 1e-7, 1e-10);
  EXPECT_EQ(marks.tail[5].letter, Letter::a_plus);
  EXPECT_EQ(marks.grade, Letter::c);
}

TEST(Grade, counts_failed_rays_and_never_drops_them) {
  const Examiner examiner(challenge_set("kerr-core"), 300);
  const ReportCard card =
      grade(examiner, exact_hand_in(examiner, "boyer-lindquist", [&](std::size_t k, HandedRay& ray) {
              if (k == 3) ray.end[1] = nan;
              if (k == 4) ray.end[0] = std::numeric_limits<double>::infinity();
              if (k == 8) ray.status = Status::captured;  // a scattered ray
              if (k == 9) ray.status = Status::escaped;   // a captured one
              if (k == 14) ray.status = Status::step_underflow;
              if (k == 20) ray.end[1] = 2.0;  // scattered, never that far in
            }));
  const Marks& marks = card.as_handed_in;
  EXPECT_EQ(marks.rays, 300);
  EXPECT_EQ(marks.failed, 6);
  EXPECT_EQ(marks.outcomes[static_cast<std::size_t>(Outcome::not_finite)], 2);
  EXPECT_EQ(marks.outcomes[static_cast<std::size_t>(Outcome::wrong_status)], 2);
  EXPECT_EQ(marks.outcomes[static_cast<std::size_t>(Outcome::unfinished)], 1);
  EXPECT_EQ(marks.outcomes[static_cast<std::size_t>(Outcome::off_the_ray)], 1);
  // 6 of 300 are 2 %.
  EXPECT_EQ(marks.grade, Letter::d);
  EXPECT_EQ(marks.tail[0].letter, Letter::a_plus);
}

TEST(Grade, is_f_where_nothing_can_be_compared) {
  const Examiner examiner(challenge_set("flat"), 20);
  const ReportCard card =
      grade(examiner, exact_hand_in(examiner, "spherical", [](std::size_t, HandedRay& ray) { ray.end[1] = nan; }));
  EXPECT_EQ(card.as_handed_in.grade, Letter::f);
  EXPECT_TRUE(card.mistakes.empty());
}

TEST(Grade, counts_turns_of_phi_apart_from_its_error) {
  const Examiner examiner(challenge_set("kerr-core"), 100);
  const ReportCard card =
      grade(examiner, exact_hand_in(examiner, "boyer-lindquist", [&](std::size_t k, HandedRay& ray) {
              if (k == 2) ray.end[3] += 8.0 * std::acos(-1.0);
            }));
  EXPECT_EQ(card.as_handed_in.wrong_turns, 1);
  EXPECT_EQ(card.as_handed_in.turns_letter, Letter::c);
  EXPECT_EQ(card.as_handed_in.tail[1].letter, Letter::a_plus);
  EXPECT_EQ(card.as_handed_in.grade, Letter::c);
}

TEST(Grade, reads_the_status_off_the_radius_where_none_is_handed_in) {
  const Examiner examiner(challenge_set("kerr-core"), 60);
  HandIn hand_in = exact_hand_in(examiner, "boyer-lindquist");
  hand_in.has_status = false;
  EXPECT_EQ(grade(examiner, hand_in).as_handed_in.failed, 0);
  hand_in.rays[2].end[1] = 30.0;  // still on its way, in or out
  EXPECT_EQ(grade(examiner, hand_in).as_handed_in.failed, 1);
}

TEST(Grade, takes_half_the_mass_for_what_it_is) {
  for (const char* id : {"schwarzschild-core", "kerr-core"}) {
    const Examiner examiner(challenge_set(id), 300);
    std::vector<NamedValue> parameters = examiner.set().parameters;
    for (NamedValue& p : parameters) p.value *= 0.5;
    const ReportCard card = grade(examiner, rays_of_other_physics(examiner, parameters));
    EXPECT_TRUE(card.mistakes.empty()) << id << ": " << card.mistakes.front().convention->id;
    EXPECT_EQ(card.as_handed_in.grade, Letter::f) << id;
  }
}

TEST(Grade, takes_a_wrong_spin_or_no_lens_for_what_it_is) {
  const Examiner kerr(challenge_set("kerr-core"), 300);
  EXPECT_TRUE(grade(kerr, rays_of_other_physics(kerr, {{"M", 1.0}, {"a", 0.45}})).mistakes.empty());
  const Examiner lens(challenge_set("grin-core"), 300);
  EXPECT_TRUE(grade(lens, rays_of_other_physics(lens, {{"R", 0.5}})).mistakes.empty());
}

}  // namespace
}  // namespace xpr
