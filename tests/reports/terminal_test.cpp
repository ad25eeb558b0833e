#include "reports/terminal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "sample_suite.hpp"

namespace xpr {
namespace {

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(TerminalVerdict, of_a_passing_suite_ends_with_the_verdict_and_the_report) {
  const std::string text = terminal_verdict(passing_suite(), "out/report");
  EXPECT_NE(text.find("\nPASSED: all 98 graded rows"), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with("report: out/report/report.html\n")) << text;
}

TEST(TerminalVerdict, names_failures_faults_and_skipped_rows) {
  const std::string text = terminal_verdict(troubled_suite(), "out");
  for (const char* said : {"FAIL         7.0 x tolerance, schwarzschild/deflection: b = 5.656854 M, dopri54",
                           "NOT CAUGHT   planted fault sin-for-sin-squared", "SKIPPED      schwarzschild/deflection"}) {
    EXPECT_NE(text.find(said), std::string::npos) << said << " not in:\n" << text;
  }
}

TEST(TerminalVerdict, fits_one_screen_however_much_goes_wrong) {
  SuiteResult suite = troubled_suite();
  for (int k = 0; k < 40; ++k) {
    CaseResult more = suite.cases[static_cast<std::size_t>(k) % 4];
    more.info.family = "family-" + std::to_string(k);
    suite.cases.push_back(more);
  }
  const std::string text = terminal_verdict(suite, "out");
  EXPECT_LE(lines_of(text), screen_lines) << text;
  EXPECT_NE(text.find("more families"), std::string::npos) << text;
  EXPECT_NE(text.find("... and "), std::string::npos) << text;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("ERROR:")) continue;  // the verdict may wrap
    EXPECT_LE(line.size(), 100U) << line;
  }
}

TEST(TerminalVerdict, of_nothing_is_no_pass) {
  EXPECT_NE(terminal_verdict({}, "").find("NOTHING GRADED"), std::string::npos);
}

}  // namespace
}  // namespace xpr
