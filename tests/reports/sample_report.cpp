// Writes the report of a hand-made suite: sample_report passing|troubled DIRECTORY [--other-circumstances].
// What the tests in Python read.
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "core/io/errors.hpp"
#include "reports/report.hpp"
#include "sample_suite.hpp"

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() < 2) return 2;
  try {
    xpr::ReportInputs inputs = xpr::sample_inputs(words[0] == "passing" ? xpr::passing_suite() : xpr::troubled_suite());
    inputs.figure_tools = xpr::found_figure_tools();
    if (words.size() > 2) {
      inputs.circumstances = {{"threads", "64"}};
      inputs.provenance.date = "2031-01-01T00:00:00Z";
      inputs.provenance.cpu = "another processor";
      for (xpr::CaseResult& result : inputs.suite.cases) result.seconds += 1.0;
      for (xpr::Sweep& sweep : inputs.suite.sweeps) {
        for (xpr::SweepPoint& point : sweep.points) point.seconds_per_ray *= 2.0;
      }
    }
    for (const std::string& problem : xpr::write_report(inputs, words[1]).figure_problems) {
      std::fprintf(stderr, "%s\n", problem.c_str());
    }
  } catch (const xpr::FaultError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
