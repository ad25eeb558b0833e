// The harness itself, on tiny cases: selection, order, errors as rows, and what counts as a catch.
#include <gtest/gtest.h>

#include "validation/suite.hpp"

#include <cmath>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

namespace xpr {
namespace {

Row row_of(std::string label, double value, double tolerance, double truth_error = 0.0) {
  Row row;
  row.label = std::move(label);
  row.value = value;
  row.reference = 1.0;
  row.reference_error = truth_error;
  row.tolerance = tolerance;
  judge(row);
  return row;
}

Case case_of(std::string id, std::function<std::vector<Row>(const Lab&)> run, bool quick = true) {
  Case one;
  one.info.id = id;
  one.info.family = id.substr(0, id.find('/'));
  one.info.claim = "one is one";
  one.quick = quick;
  one.run = std::move(run);
  return one;
}

/// Two rows: one stays right under every fault, the other becomes what the named fault makes of it.
Case fragile_case() {
  return case_of("toy/fragile", [](const Lab& lab) {
    double value = 1.0;
    double truth_error = 0.0;
    if (lab.planted("far-off")) value = 1.5;
    if (lab.planted("slightly-off")) value = 1.005;
    if (lab.planted("not-a-number")) value = std::numeric_limits<double>::quiet_NaN();
    if (lab.planted("vague-truth")) {
      value = 1.5;
      truth_error = 1.0;
    }
    if (lab.planted("throws")) throw std::runtime_error("no such ray");
    return std::vector<Row>{row_of("steady", 1.0, 1e-3), row_of("fragile", value, 1e-3, truth_error)};
  });
}

FaultResult plant(const std::string& id, const std::vector<Case>& all, const std::string& case_id = "toy/fragile") {
  Fault fault;
  fault.id = id;
  fault.case_id = case_id;
  const std::vector<Fault> planted = {fault};
  const std::vector<FaultResult> results = run_self_test(planted, all, SuiteSize::quick, {.threads = 1});
  return results.at(0);
}

TEST(SelfTest, catches_a_fault_that_fails_far_above_tolerance) {
  const FaultResult result = plant("far-off", {fragile_case()});
  EXPECT_TRUE(result.caught);
  EXPECT_TRUE(result.twin_passed);
  EXPECT_EQ(result.row, "fragile");
  EXPECT_DOUBLE_EQ(result.error, 0.5);
  EXPECT_DOUBLE_EQ(result.tolerance, 1e-3);
}

TEST(SelfTest, does_not_count_a_failure_within_ten_tolerances) {
  const FaultResult result = plant("slightly-off", {fragile_case()});
  EXPECT_FALSE(result.caught);
  EXPECT_NE(result.note.find("10 times"), std::string::npos);
}

TEST(SelfTest, does_not_count_what_is_no_finite_failure) {
  for (const char* id : {"not-a-number", "vague-truth", "throws", "changes-nothing"}) {
    const FaultResult result = plant(id, {fragile_case()});
    EXPECT_FALSE(result.caught) << id;
    EXPECT_FALSE(result.note.empty()) << id;
  }
  EXPECT_NE(plant("throws", {fragile_case()}).note.find("no such ray"), std::string::npos);
}

TEST(SelfTest, does_not_count_a_row_whose_twin_fails_too) {
  const Case broken = case_of("toy/broken", [](const Lab&) { return std::vector<Row>{row_of("off", 2.0, 1e-3)}; });
  const FaultResult result = plant("far-off", {broken}, "toy/broken");
  EXPECT_FALSE(result.caught);
  EXPECT_FALSE(result.twin_passed);
}

TEST(SelfTest, says_when_a_fault_names_no_case) {
  const FaultResult result = plant("far-off", {fragile_case()}, "toy/fragil");
  EXPECT_FALSE(result.caught);
  EXPECT_NE(result.note.find("toy/fragil"), std::string::npos);
}

TEST(Suite, order_and_rows_do_not_depend_on_threads) {
  std::vector<Case> all;
  for (int i = 0; i < 20; ++i) {
    all.push_back(case_of("toy/case-" + std::to_string(i),
                          [i](const Lab&) { return std::vector<Row>{row_of("row", 1.0 + i, 0.5)}; }));
  }
  const std::vector<const Case*> selected = select_cases(all, {});
  const std::vector<CaseResult> one = run_cases(selected, SuiteSize::quick, {.threads = 1});
  const std::vector<CaseResult> four = run_cases(selected, SuiteSize::quick, {.threads = 4});
  ASSERT_EQ(one.size(), all.size());
  ASSERT_EQ(four.size(), all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(one[i].info.id, all[i].info.id);
    EXPECT_EQ(four[i].info.id, all[i].info.id);
    EXPECT_EQ(one[i].rows.at(0).value, four[i].rows.at(0).value);
  }
}

TEST(Suite, digests_the_rays_that_a_case_traced) {
  const auto tracing = [](double end) {
    return case_of("toy/tracing", [end](const Lab& lab) {
      TraceSettings settings;
      settings.lambda_max = end;
      const auto flat = lab.spacetime("minkowski", "cartesian");
      const RayEnd ray = lab.trace(*flat, {{0.0, 0.0, 0.0, 0.0}, {-1.0, 1.0, 0.0, 0.0}}, 1, settings);
      return std::vector<Row>{row_of("length", ray.y[1] / end, 1e-12)};
    });
  };
  const auto digest = [](const Case& one) {
    const std::vector<const Case*> selected = {&one, &one};
    const std::vector<CaseResult> results = run_cases(selected, SuiteSize::quick, {.threads = 2});
    EXPECT_EQ(results.at(0).transported, results.at(1).transported);
    return results.at(0).transported;
  };
  EXPECT_EQ(digest(tracing(2.0)), digest(tracing(2.0)));
  EXPECT_NE(digest(tracing(2.0)), digest(tracing(std::nextafter(2.0, 3.0))));
}

TEST(Suite, an_exception_becomes_one_error_row) {
  const std::vector<Case> all = {case_of(
      "toy/throws", [](const Lab&) -> std::vector<Row> { throw std::runtime_error("no bracket for b = 5.2"); })};
  const std::vector<CaseResult> results = run_cases(select_cases(all, {}), SuiteSize::quick);
  ASSERT_EQ(results.at(0).rows.size(), 1U);
  EXPECT_EQ(results[0].rows[0].verdict, Verdict::error);
  EXPECT_NE(results[0].rows[0].note.find("no bracket"), std::string::npos);
}

TEST(Suite, a_case_without_rows_is_an_error) {
  const std::vector<Case> all = {case_of("toy/empty", [](const Lab&) { return std::vector<Row>{}; })};
  const std::vector<CaseResult> results = run_cases(select_cases(all, {}), SuiteSize::quick);
  EXPECT_EQ(results.at(0).rows.at(0).verdict, Verdict::error);
}

TEST(Suite, progress_counts_up_to_the_whole) {
  const std::vector<Case> all = {fragile_case(), fragile_case(), fragile_case()};
  std::vector<std::size_t> seen;
  const SuiteOptions options{
      .threads = 2, .progress = [&](const Progress& at) { seen.push_back(at.done); }, .stop = {}};
  (void)run_cases(select_cases(all, {}), SuiteSize::quick, options);
  EXPECT_EQ(seen, (std::vector<std::size_t>{1, 2, 3}));
}

TEST(Suite, a_stop_leaves_out_what_has_not_begun) {
  std::stop_source source;
  const std::vector<Case> all = {case_of("toy/first",
                                         [&](const Lab&) {
                                           source.request_stop();
                                           return std::vector<Row>{row_of("row", 1.0, 0.5)};
                                         }),
                                 fragile_case()};
  const std::vector<CaseResult> results =
      run_cases(select_cases(all, {}), SuiteSize::quick, {.threads = 1, .progress = {}, .stop = source.get_token()});
  ASSERT_EQ(results.size(), 1U);
  EXPECT_EQ(results[0].info.id, "toy/first");
}

TEST(Selection, takes_suites_globs_and_words) {
  std::vector<Case> all = {case_of("kerr/deflection", {}), case_of("kerr/shadow", {}, false),
                           case_of("numerical/order", {}, false)};
  all[2].info.grades_metric = false;
  const auto ids = [&](const Selection& selection) {
    std::vector<std::string> out;
    for (const Case* one : select_cases(all, selection)) out.push_back(one->info.id);
    return out;
  };
  using Ids = std::vector<std::string>;
  EXPECT_EQ(ids({}), (Ids{"kerr/deflection"}));
  EXPECT_EQ(ids({.suite = "full", .globs = {}, .contains = {}}).size(), 3U);
  EXPECT_EQ(ids({.suite = "metrics", .globs = {}, .contains = {}}), (Ids{"kerr/deflection", "kerr/shadow"}));
  EXPECT_EQ(ids({.suite = "numerical", .globs = {}, .contains = {}}), (Ids{"numerical/order"}));
  EXPECT_EQ(ids({.suite = "full", .globs = {"kerr/*"}, .contains = {"shadow"}}), (Ids{"kerr/shadow"}));
  EXPECT_EQ(ids({.suite = "quick", .globs = {"numerical/orde?"}, .contains = {}}), (Ids{"numerical/order"}));
}

TEST(Selection, refuses_what_it_does_not_know) {
  const std::vector<Case> all = {case_of("kerr/deflection", {})};
  EXPECT_THROW((void)select_cases(all, {.suite = "quik", .globs = {}, .contains = {}}), std::invalid_argument);
  EXPECT_THROW((void)select_cases(all, {.suite = "full", .globs = {"ker/*"}, .contains = {}}), std::invalid_argument);
}

TEST(Glob, matches_as_a_shell_does) {
  EXPECT_TRUE(matches_glob("*", ""));
  EXPECT_TRUE(matches_glob("kerr/*", "kerr/shadow"));
  EXPECT_TRUE(matches_glob("*a*ow", "kerr/shadow"));
  EXPECT_TRUE(matches_glob("k?rr/shadow", "kerr/shadow"));
  EXPECT_FALSE(matches_glob("kerr", "kerr/shadow"));
  EXPECT_FALSE(matches_glob("*shado", "kerr/shadow"));
}

}  // namespace
}  // namespace xpr
