// Published results, reproduced: every paper's claims, and what must turn them red.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "validation/paper.hpp"
#include "validation/suite.hpp"

namespace xpr {
namespace {

std::string troubles(const PaperResult& result) {
  std::string out;
  for (const Claim& claim : result.claims) {
    for (const Row& row : claim.rows) {
      if (row.verdict == Verdict::pass || row.verdict == Verdict::skipped) continue;
      out += row.label + ": " + std::string(to_string(row.verdict)) + " " + row.note + "\n";
    }
  }
  return out;
}

class EachPaper : public testing::TestWithParam<std::size_t> {};

TEST_P(EachPaper, holds_its_claims_by_two_routes_or_more) {
  const PaperResult result = run_paper(all_papers()[GetParam()], Lab(SuiteSize::quick));
  EXPECT_EQ(troubles(result), "") << result.info.id;
  ASSERT_FALSE(result.claims.empty());
  std::set<std::string> labels;
  for (const Claim& claim : result.claims) {
    const auto routes = std::count_if(claim.rows.begin(), claim.rows.end(), [](const Row& row) {
      return row.verdict != Verdict::skipped && row.label.find(": as printed") == std::string::npos;
    });
    EXPECT_GE(routes, 2) << claim.quantity;
    EXPECT_EQ(claim.misprint && result.findings.empty(), false) << claim.quantity << ": a misprint without a finding";
    EXPECT_FALSE(claim.exact_by.empty()) << claim.quantity;
    for (const Row& row : claim.rows) EXPECT_TRUE(labels.insert(row.label).second) << row.label;
  }
}

INSTANTIATE_TEST_SUITE_P(Papers, EachPaper, testing::Range<std::size_t>(0, all_papers().size()), [](const auto& of) {
  std::string name = all_papers()[of.param].info.id;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(Papers, a_wrong_formula_planted_in_one_turns_a_claim_red) {
  const std::vector<Fault> planted = paper_faults();
  const std::vector<Case> all = paper_cases();
  for (const FaultResult& result : run_self_test(planted, all, SuiteSize::quick)) {
    EXPECT_TRUE(result.caught) << result.id << ": " << result.note;
  }
}

TEST(Papers, an_unknown_id_is_answered_with_the_nearest) {
  try {
    (void)find_paper("darwin-1995");
    FAIL() << "found a paper that there is not";
  } catch (const std::invalid_argument& refusal) {
    EXPECT_STREQ(refusal.what(), "unknown paper 'darwin-1995'; did you mean 'darwin-1959'?");
  }
}

TEST(PrintedNumber, counts_half_a_unit_of_its_last_digit) {
  EXPECT_DOUBLE_EQ(printed_number("162").half_unit, 0.5);
  EXPECT_DOUBLE_EQ(printed_number("5.40").half_unit, 0.005);
  EXPECT_DOUBLE_EQ(printed_number("-0.4002").half_unit, 0.00005);
  EXPECT_DOUBLE_EQ(printed_number("1.2e-6").half_unit, 0.5e-7);
  EXPECT_DOUBLE_EQ(printed_number("3.21").value, 3.21);
  EXPECT_THROW((void)printed_number("about 17"), std::invalid_argument);
}

struct OneClaim {
  PaperResult result;
  ClaimSheet claim() {
    result.claims.emplace_back();
    result.claims.back().quantity = "area";
    return {result, result.claims.size() - 1};
  }
  Verdict verdict() const { return verdict_of(result.claims.back()); }
};

TEST(ClaimSheet, a_printed_number_that_does_not_round_from_the_exact_one_fails) {
  OneClaim good, bad;
  good.claim().exact({3.14159, 1e-12}, "pi").printed("3.14", "a table");
  bad.claim().exact({3.14159, 1e-12}, "pi").printed("3.15", "a table");
  EXPECT_EQ(good.verdict(), Verdict::pass);
  EXPECT_EQ(bad.verdict(), Verdict::fail);
}

TEST(ClaimSheet, a_misprint_is_claimed_in_vain_where_the_printed_number_is_right) {
  OneClaim right, wrong;
  right.claim().exact({3.14159, 1e-12}, "pi").misprinted("3.15", "a table");
  wrong.claim().exact({3.14159, 1e-12}, "pi").misprinted("3.14", "a table");
  EXPECT_EQ(right.verdict(), Verdict::pass);
  EXPECT_EQ(wrong.verdict(), Verdict::fail);
}

TEST(ClaimSheet, a_wrong_formula_has_to_be_wrong) {
  OneClaim wrong, right;
  wrong.claim().exact({3.14159, 1e-12}, "pi").wrong_formula("22/7", 22.0 / 7.0, 1e-4, "off by 1e-3");
  right.claim().exact({3.14159, 1e-12}, "pi").wrong_formula("3.14159", 3.14159, 1e-4, "off by 1e-3");
  EXPECT_EQ(wrong.verdict(), Verdict::pass);
  EXPECT_NE(right.verdict(), Verdict::pass);
}

TEST(ClaimSheet, what_is_known_from_memory_only_is_skipped_and_no_oracle) {
  OneClaim one;
  one.claim().exact({3.14159, 1e-12}, "pi").not_established("3.2", "heard somewhere");
  EXPECT_EQ(one.verdict(), Verdict::skipped);
  EXPECT_TRUE(one.result.claims.back().printed.empty());
}

}  // namespace
}  // namespace xpr
