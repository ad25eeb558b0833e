// Every wrong-on-purpose metric is caught by the case that it names, and by nothing less than DESIGN's rule.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "validation/families.hpp"
#include "validation/suite.hpp"

namespace xpr {
namespace {

bool by_conformance(const Fault& fault) { return fault.case_id.starts_with("conformance/"); }

std::vector<FaultResult> planted_under_conformance() {
  std::vector<Fault> planted = metric_faults();
  std::erase_if(planted, [](const Fault& fault) { return !by_conformance(fault); });
  return run_self_test(planted, conformance_cases(), SuiteSize::quick);
}

TEST(MetricFaults, conformance_catches_each_that_names_it) {
  const std::vector<FaultResult> results = planted_under_conformance();
  EXPECT_GE(results.size(), 20U);
  for (const FaultResult& result : results) {
    EXPECT_TRUE(result.caught) << result.id << ": " << result.note;
    EXPECT_TRUE(result.twin_passed) << result.id;
    EXPECT_GT(result.error, 10.0 * result.tolerance) << result.id;
  }
}

TEST(MetricFaults, light_catches_each_that_names_a_case_of_rays) {
  std::vector<Fault> planted = metric_faults();
  std::erase_if(planted, by_conformance);
  std::set<std::string> named;
  for (const FaultResult& result : run_self_test(planted, cases(), SuiteSize::quick)) {
    EXPECT_TRUE(result.caught) << result.id << ": " << result.note;
    EXPECT_GT(result.error, 10.0 * result.tolerance) << result.id;
    named.insert(result.case_id);
  }
  for (const char* id : {"kerr/deflection", "kerr/charts", "kerr/constants", "schwarzschild/deflection"}) {
    EXPECT_TRUE(named.contains(id)) << id;
  }
}

TEST(MetricFaults, have_unique_ids_and_say_what_is_wrong) {
  std::vector<std::string> ids;
  for (const Fault& fault : metric_faults()) {
    ids.push_back(fault.id);
    EXPECT_FALSE(fault.description.empty()) << fault.id;
    EXPECT_TRUE(fault.spacetime) << fault.id;
  }
  std::sort(ids.begin(), ids.end());
  EXPECT_EQ(std::adjacent_find(ids.begin(), ids.end()), ids.end());
}

TEST(MetricFaults, leave_every_chart_but_their_own_alone) {
  for (const Fault& fault : metric_faults()) {
    EXPECT_EQ(fault.spacetime("kerr", "no-such-chart", {}), nullptr) << fault.id;
    EXPECT_EQ(fault.spacetime("no-such-metric", "cartesian", {}), nullptr) << fault.id;
  }
}

// What the notes of the rows say is what a person with a typo reads.
TEST(MetricFaults, are_named_in_words) {
  struct Expected {
    const char* fault;
    std::vector<const char*> words;
  };
  const std::vector<Expected> expected = {
      {"kerr-frame-dragging-sign", {"tφ", "-1.000", "sign is flipped"}},
      {"kerr-frame-dragging-factor", {"g^tφ", "2.000"}},
      {"kerr-sine-not-squared", {"g_φφ", "1/sin θ"}},
      {"kerr-polar-without-spin", {"g_θθ"}},
      {"schwarzschild-sine-not-squared", {"φφ", "sin θ"}},
      {"schwarzschild-radial-not-inverted", {"rr"}},
      {"ellis-sine-not-squared", {"φφ", "sin θ"}},
  };
  for (const Expected& want : expected) {
    const std::vector<Fault> all = metric_faults();
    const auto fault = std::find_if(all.begin(), all.end(), [&](const Fault& f) { return f.id == want.fault; });
    ASSERT_NE(fault, all.end()) << want.fault;
    const std::vector<Case> conformance = conformance_cases();
    const auto one = std::find_if(conformance.begin(), conformance.end(),
                                  [&](const Case& c) { return c.info.id == fault->case_id; });
    ASSERT_NE(one, conformance.end()) << want.fault;
    std::string notes;
    for (const Row& row : one->run(Lab(SuiteSize::quick, &*fault))) notes += row.note + "\n";
    for (const char* word : want.words) EXPECT_NE(notes.find(word), std::string::npos) << want.fault << ": " << notes;
  }
}

TEST(ConformanceCases, pass_as_they_stand) {
  const std::vector<Case> all = conformance_cases();
  std::vector<const Case*> selected;
  for (const Case& one : all) selected.push_back(&one);
  for (const CaseResult& result : run_cases(selected, SuiteSize::quick)) {
    EXPECT_GT(result.rows.size(), 5U) << result.info.id;
    for (const Row& row : result.rows) {
      EXPECT_EQ(row.verdict, Verdict::pass) << result.info.id << " " << row.label << ": " << row.note;
    }
  }
}

TEST(Lab, plants_a_metric_and_leaves_the_rest) {
  const std::vector<Fault> all = metric_faults();
  const Lab sound(SuiteSize::quick);
  const Lab broken(SuiteSize::quick, &all.front());
  const auto right = sound.spacetime("kerr", "boyer-lindquist");
  const auto wrong = broken.spacetime("kerr", "boyer-lindquist");
  const auto other = broken.spacetime("kerr", "kerr-schild");
  const Vec4<double> x{0.0, 6.0, 1.1, 0.3};
  EXPECT_EQ(wrong->inverse_metric(x)(0, 3), -right->inverse_metric(x)(0, 3));
  EXPECT_EQ(other->inverse_metric(x)(1, 2), sound.spacetime("kerr", "kerr-schild")->inverse_metric(x)(1, 2));
  EXPECT_TRUE(broken.planted(all.front().id));
  EXPECT_FALSE(sound.planted(all.front().id));
}

TEST(Lab, plants_a_stepper_under_a_trace) {
  Fault fault;
  fault.id = "stands-still";
  bool asked = false;
  fault.stepper = [&](std::string_view method, const Flow&, const StepperSettings&) -> std::unique_ptr<Stepper> {
    asked = asked || method == "rk4";
    return nullptr;
  };
  fault.settings = [](TraceSettings& settings) { settings.max_steps = 3; };
  const Lab lab(SuiteSize::quick, &fault);
  const auto flat = lab.spacetime("minkowski", "cartesian");
  TraceSettings settings;
  settings.method = "rk4";
  settings.step = 0.1;
  settings.r_max = 100.0;
  const RayEnd end = lab.trace(*flat, {{0.0, 0.0, 0.0, 0.0}, {-1.0, 1.0, 0.0, 0.0}}, 1, settings);
  EXPECT_TRUE(asked);
  EXPECT_EQ(end.status, Status::max_steps);
  EXPECT_EQ(end.steps, 3);
}

}  // namespace
}  // namespace xpr
