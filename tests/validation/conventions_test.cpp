#include "validation/grading/conventions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "grading_rays.hpp"
#include "metrics/catalogue.hpp"
#include "metrics/null_cone.hpp"

namespace xpr {
namespace {

using testing::end_radius;
using testing::exact_hand_in;

constexpr double pi = std::numbers::pi;

using Alter = std::function<void(std::size_t, HandedRay&)>;

std::vector<std::string> named(const ReportCard& card) {
  std::vector<std::string> ids;
  for (const ConventionFound& found : card.mistakes) ids.emplace_back(found.convention->id);
  return ids;
}

using Names = std::vector<std::string>;

/// Expects a mistake planted into exact rays to be named, to spoil the grade, and to explain all of it.
void expect_named(const Examiner& examiner, const HandIn& hand_in, const Names& names) {
  const ReportCard card = grade(examiner, hand_in);
  EXPECT_EQ(named(card), names) << examiner.set().id;
  EXPECT_GT(card.as_handed_in.grade, Letter::b) << examiner.set().id;
  EXPECT_EQ(card.undone.grade, Letter::a_plus) << examiner.set().id;
  EXPECT_EQ(card.undone.failed, 0) << examiner.set().id;
}

void expect_named(const char* set, const Alter& alter, const Names& names) {
  const Examiner examiner(challenge_set(set), 300);
  expect_named(examiner, exact_hand_in(examiner, examiner.set().home_chart, alter), names);
}

using AlterStart = std::function<void(PhaseState<double>&)>;

/// What a code finds anew where its idea of the start is no light: p_t, or p_r from E, L and Q.
enum class Follows { p_t, p_r };

/// A code that takes other rays for those of the set, and hands in their exact ends.
HandIn ends_of(const Examiner& examiner, double spin_sign, const AlterStart& alter, Follows follows = Follows::p_r) {
  std::vector<NamedValue> parameters = examiner.set().parameters;
  for (NamedValue& p : parameters) p.value *= p.name == "a" ? spin_sign : 1.0;
  const auto home = make_spacetime(examiner.set().metric, examiner.set().home_chart, parameters);
  return exact_hand_in(examiner, examiner.set().home_chart, [&](std::size_t k, HandedRay& ray) {
    PhaseState<double> start = examiner.ray(k).ray.start;
    alter(start);
    const double sign = start[4] < 0.0 ? 1.0 : -1.0;
    if (follows == Follows::p_t) start[4] = null_momentum(*home, start.x(), start.p(), sign).value()[0];
    const double horizon = examiner.home().horizon_radius().value_or(0.0);
    if (start[4] * sign >= 0.0) {  // light of negative energy falls in; where, no closed form tells
      ray.status = Status::captured;
      ray.end[1] = 1.02 * horizon;
      return;
    }
    const auto exact = exact_ray(examiner.set().metric, parameters, start);
    const double r = exact->captured() ? 1.02 * horizon : examiner.set().r_max;
    const ExactEnd end = exact->at(r, exact->turns_at_end());
    ray.status = exact->captured() ? Status::captured : Status::escaped;
    ray.end = end.state;
    ray.lambda = end.lambda;
  });
}

void in_degrees(std::size_t, HandedRay& ray) {
  ray.end[2] *= 180.0 / pi;
  ray.end[3] *= 180.0 / pi;
}

void as_latitude(std::size_t, HandedRay& ray) {
  ray.end[2] = 0.5 * pi - ray.end[2];
  ray.end[6] = -ray.end[6];
}

TEST(Conventions, degrees_are_recognised) {
  for (const char* set : {"flat", "schwarzschild-core", "kerr-core", "kerr-hard", "ellis-core"}) {
    expect_named(set, in_degrees, {"degrees"});
  }
}

TEST(Conventions, theta_from_the_equator_is_recognised) {
  for (const char* set : {"flat", "schwarzschild-core", "kerr-core", "ellis-core"}) {
    expect_named(set, as_latitude, {"theta-from-equator"});
  }
}

TEST(Conventions, a_sign_of_phi_is_recognised) {
  const Alter negated = [](std::size_t, HandedRay& ray) {
    ray.end[3] = -ray.end[3];
    ray.end[7] = -ray.end[7];
  };
  for (const char* set : {"flat", "schwarzschild-core", "kerr-core", "kerr-hard", "ellis-core"}) {
    expect_named(set, negated, {"phi-sign"});
  }
  expect_named("grin-core",
               [](std::size_t, HandedRay& ray) {
                 ray.end[2] = -ray.end[2];
                 ray.end[6] = -ray.end[6];
               },
               {"y-sign"});
}

TEST(Conventions, phi_that_runs_the_other_way_is_recognised) {
  const Examiner kerr(challenge_set("kerr-core"), 300);
  expect_named(kerr,
               exact_hand_in(kerr, "boyer-lindquist",
                             [&](std::size_t k, HandedRay& ray) {
                               ray.end[3] = 2.0 * kerr.ray(k).ray.start[3] - ray.end[3];
                               ray.end[7] = -ray.end[7];
                             }),
               {"phi-swept-backwards"});
}

TEST(Conventions, phi_counted_from_the_start_is_recognised) {
  const Examiner kerr(challenge_set("kerr-core"), 300);
  expect_named(kerr,
               exact_hand_in(kerr, "boyer-lindquist",
                             [&](std::size_t k, HandedRay& ray) { ray.end[3] -= kerr.ray(k).ray.start[3]; }),
               {"phi-from-start"});
}

TEST(Conventions, a_flipped_spin_is_recognised) {
  for (const char* set : {"kerr-core", "kerr-hard"}) {
    const Examiner examiner(challenge_set(set), 300);
    const ReportCard card = grade(examiner, ends_of(
                                                examiner, -1.0, [](PhaseState<double>&) {}, Follows::p_t));
    EXPECT_EQ(named(card), Names{"spin-flipped"}) << set;
    EXPECT_LE(card.undone.grade, Letter::a) << set;
    EXPECT_GT(card.as_handed_in.grade, Letter::c) << set;
  }
  // Light of the same E, L and Q; in kerr-hard some of it would start between its turning points.
  const Examiner kerr(challenge_set("kerr-core"), 300);
  const ReportCard card = grade(kerr, ends_of(kerr, -1.0, [](PhaseState<double>&) {}));
  EXPECT_EQ(named(card), Names{"spin-flipped"});
  EXPECT_LE(card.undone.grade, Letter::a);
}

TEST(Conventions, a_flipped_spin_is_recognised_in_kerr_schild_too) {
  // x + iy = (r + ia) e^{i phi}: with a of the wrong sign the same numbers are another event.
  const Examiner kerr(challenge_set("kerr-core"), 300);
  const std::vector<NamedValue> flipped{{"M", 1.0}, {"a", -0.9}};
  const auto said = kerr.set().spacetime("kerr-schild"), taken = make_spacetime("kerr", "kerr-schild", flipped);
  const auto home = make_spacetime("kerr", "boyer-lindquist", flipped);
  HandIn hand_in = exact_hand_in(kerr, "kerr-schild");
  for (std::size_t k = 0; k < hand_in.rays.size(); ++k) {
    PhaseState<double> y = change_chart(kerr.home(), *said, kerr.ray(k).ray.start).state;
    y[4] = null_momentum(*taken, y.x(), y.p(), y[4] < 0.0 ? 1.0 : -1.0).value()[0];
    const auto exact = exact_ray("kerr", flipped, change_chart(*taken, *home, y).state);
    const double r = exact->captured() ? 1.1 * home->horizon_radius().value() : 100.0;
    const ExactEnd end = exact->at(r, exact->turns_at_end());
    hand_in.rays[k] = {exact->captured() ? Status::captured : Status::escaped, 1,
                       change_chart(*home, *taken, end.state).state, end.lambda};
  }
  const ReportCard card = grade(kerr, hand_in);
  EXPECT_EQ(named(card), Names{"spin-flipped"});
  EXPECT_LE(card.undone.grade, Letter::a);
}

TEST(Conventions, are_recognised_where_captured_rays_end_inside_the_horizon) {
  const Examiner schwarzschild(challenge_set("schwarzschild-core"), 300);
  expect_named(schwarzschild,
               exact_hand_in(schwarzschild, "areal",
                             [](std::size_t, HandedRay& ray) {
                               if (ray.status == Status::captured) ray.end[1] = 1.9;
                               ray.end[3] = -ray.end[3];
                               ray.end[7] = -ray.end[7];
                             }),
               {"phi-sign"});
}

TEST(Conventions, a_mirrored_screen_is_recognised) {
  const Examiner kerr(challenge_set("kerr-core"), 300);
  const AlterStart mirrored = [](PhaseState<double>& start) { start[7] = -start[7]; };
  expect_named(kerr, ends_of(kerr, 1.0, mirrored), {"screen-mirrored"});
  expect_named(kerr, ends_of(kerr, 1.0, mirrored, Follows::p_t), {"screen-mirrored"});
  expect_named(kerr, ends_of(kerr, 1.0, [](PhaseState<double>& start) { start[6] = -start[6]; }),
               {"screen-upside-down"});
  // Where nothing rotates, a mirrored screen cannot be told from phi that runs the other way.
  const Examiner schwarzschild(challenge_set("schwarzschild-core"), 300);
  expect_named(schwarzschild, ends_of(schwarzschild, 1.0, mirrored), {"phi-swept-backwards"});
}

TEST(Conventions, p_with_an_upper_index_is_recognised) {
  for (const char* set : {"schwarzschild-core", "kerr-core", "ellis-core", "flat", "grin-fisheye"}) {
    const Examiner examiner(challenge_set(set), 300);
    expect_named(examiner,
                 exact_hand_in(examiner, examiner.set().home_chart,
                               [&](std::size_t, HandedRay& ray) {
                                 const auto p = raise_index(examiner.home().inverse_metric(ray.end.x()), ray.end.p());
                                 for (std::size_t i = 0; i < 4; ++i) ray.end[i + 4] = p[i];
                               }),
                 {"p-upper"});
  }
}

TEST(Conventions, signs_and_scales_of_p_t_and_lambda_are_recognised) {
  const Alter negative_p = [](std::size_t, HandedRay& ray) {
    for (std::size_t i = 4; i < 8; ++i) ray.end[i] = -ray.end[i];
  };
  expect_named("kerr-core", negative_p, {"p-sign"});
  expect_named("kerr-core", [](std::size_t, HandedRay& ray) { ray.end[0] = -ray.end[0]; }, {"t-sign"});
  expect_named("kerr-core", [](std::size_t, HandedRay& ray) { ray.lambda = -ray.lambda; }, {"lambda-sign"});
  const Examiner kerr(challenge_set("kerr-core"), 300);
  expect_named(kerr,
               exact_hand_in(kerr, "boyer-lindquist",
                             [&](std::size_t k, HandedRay& ray) {
                               const double energy = std::abs(kerr.ray(k).ray.start[4]);
                               for (std::size_t i = 4; i < 8; ++i) ray.end[i] /= energy;
                               ray.lambda *= energy;
                             }),
               {"p-unit-energy", "lambda-unit-energy"});
}

TEST(Conventions, wrapped_phi_is_recognised_and_graded_without_turns) {
  for (const char* set : {"kerr-core", "kerr-hard", "schwarzschild-core"}) {
    const Examiner examiner(challenge_set(set), 300);
    for (const double low : {0.0, -pi}) {
      const ReportCard card =
          grade(examiner, exact_hand_in(examiner, examiner.set().home_chart, [&](std::size_t, HandedRay& ray) {
                  ray.end[3] -= 2.0 * pi * std::floor((ray.end[3] - low) / (2.0 * pi));
                }));
      EXPECT_EQ(named(card), Names{"phi-wrapped"}) << set;
      EXPECT_EQ(card.undone.grade, Letter::a_plus) << set;
      EXPECT_EQ(card.undone.counted_turns, 0) << set;
      EXPECT_EQ(card.as_handed_in.turns_letter, Letter::f) << set;
    }
  }
}

TEST(Conventions, another_chart_than_said_is_recognised) {
  const Examiner kerr(challenge_set("kerr-core"), 300);
  HandIn hand_in = exact_hand_in(kerr, "kerr-schild");
  hand_in.chart = "kerr-schild-outgoing";
  const ReportCard card = grade(kerr, hand_in);
  EXPECT_EQ(named(card), Names{"other-chart"});
  EXPECT_EQ(card.mistakes.front().convention->chart, "kerr-schild");
  EXPECT_EQ(card.undone.grade, Letter::a_plus);
}

TEST(Conventions, two_mistakes_at_once_are_both_named) {
  expect_named("kerr-core",
               [](std::size_t k, HandedRay& ray) {
                 as_latitude(k, ray);
                 in_degrees(k, ray);
               },
               {"degrees", "theta-from-equator"});
  expect_named("schwarzschild-core",
               [](std::size_t k, HandedRay& ray) {
                 in_degrees(k, ray);
                 for (std::size_t i = 4; i < 8; ++i) ray.end[i] = -ray.end[i];
                 ray.end[0] = -ray.end[0];
               },
               {"degrees", "p-sign", "t-sign"});
}

TEST(Conventions, are_recognised_in_rays_that_are_not_good_either) {
  // A code with errors of 3e-4 rad, whose spin has the wrong sign.
  const Examiner kerr(challenge_set("kerr-core"), 300);
  HandIn hand_in = ends_of(kerr, -1.0, [](PhaseState<double>&) {});
  for (std::size_t k = 0; k < hand_in.rays.size(); ++k) {
    hand_in.rays[k].end[2] += 3e-4 * std::sin(static_cast<double>(k));
    hand_in.rays[k].end[3] += 3e-4 * std::cos(static_cast<double>(k));
  }
  EXPECT_EQ(named(grade(kerr, hand_in)), Names{"spin-flipped"});
}

TEST(Conventions, noise_is_not_explained) {
  const Examiner kerr(challenge_set("kerr-core"), 300);
  const auto noisy = [&](double size) {
    return exact_hand_in(kerr, "boyer-lindquist", [size](std::size_t k, HandedRay& ray) {
      ray.end[2] += size * std::sin(7.0 * static_cast<double>(k));
      ray.end[3] += size * std::cos(5.0 * static_cast<double>(k));
    });
  };
  for (const double size : {1e-4, 1e-2, 0.1, 0.5}) EXPECT_TRUE(grade(kerr, noisy(size)).mistakes.empty()) << size;
}

}  // namespace
}  // namespace xpr
