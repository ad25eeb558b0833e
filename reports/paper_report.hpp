// The report of paper reproductions: a directory that is complete or absent.
//
//   overview.md, .html     one line a paper
//   <id>.md, <id>.html     one page a paper: printed, exact, ours; the figure; findings; what was not checked
//   paper.h5               every number: /cases as in report.h5, /papers/<id>/claims, /figures/<id>
//   junit.xml, summary.json
//   figures/<id>.svg, .png drawn from paper.h5 by tools/figures/paper_figures.py
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/io/json.hpp"
#include "core/io/provenance.hpp"
#include "reports/datasets.hpp"
#include "reports/figures.hpp"
#include "validation/paper.hpp"

namespace xpr {

struct PaperReportInputs {
  std::vector<PaperResult> results;
  std::string command;  ///< that repeats it
  Json configuration;   ///< resolved
  Provenance provenance;
  double seconds = 0.0;
  FigureTools figure_tools;
};

struct PaperReportOutcome {
  Hashes hashes;
  std::vector<std::string> figure_problems;
};

/// Throws where no report can be written there, before any work is done.
void check_paper_directory(const std::filesystem::path& directory);

[[nodiscard]] PaperReportOutcome write_paper_report(const PaperReportInputs& inputs,
                                                    const std::filesystem::path& directory);

/// The papers as a suite: rows, counts, exit code.
[[nodiscard]] SuiteResult as_suite(const std::vector<PaperResult>& results);

/// "darwin-1959: 33 claims: 33 passed by 92 routes; 4 findings." with a line end.
[[nodiscard]] std::string paper_line(const PaperResult& result);

/// The table of a paper's claims and its verdict as text, for the terminal.
[[nodiscard]] std::string paper_text(const PaperResult& result);

}  // namespace xpr
