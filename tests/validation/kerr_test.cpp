// The Kerr family's quick suite is green, what is skipped says why, and each planted fault is caught.
#include <gtest/gtest.h>

#include "validation/families.hpp"

#include <vector>

#include "validation/suite.hpp"

namespace xpr {
namespace {

TEST(KerrFamily, every_quick_row_passes) {
  for (const Case& one : kerr_cases()) {
    EXPECT_FALSE(one.info.claim.empty()) << one.info.id;
    EXPECT_FALSE(one.info.cites.empty()) << one.info.id;
    const std::vector<Row> rows = one.run(Lab(SuiteSize::quick));
    EXPECT_FALSE(rows.empty()) << one.info.id;
    for (const Row& row : rows) {
      const bool explained = row.verdict == Verdict::skipped && !row.note.empty();
      EXPECT_TRUE(row.verdict == Verdict::pass || explained)
          << one.info.id << ": " << row.label << ": error " << row.error << ", tolerance " << row.tolerance << ' '
          << row.note;
    }
  }
}

TEST(KerrFamily, every_planted_fault_is_caught) {
  const std::vector<Case> all = kerr_cases();
  for (const FaultResult& fault : run_self_test(kerr_faults(), all, SuiteSize::quick, {.threads = 1})) {
    EXPECT_TRUE(fault.caught) << fault.id << ": " << fault.note;
  }
}

}  // namespace
}  // namespace xpr
