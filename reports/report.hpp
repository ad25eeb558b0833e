// The report of a suite: a directory that is complete or absent.
//
//   report.md, report.html   for people: verdict on top, failures first, then every number
//   report.h5                every number, for programs (layout in reports/datasets.hpp)
//   junit.xml, summary.json  for machines that watch
//   figures/                 SVG and PNG, drawn from report.h5 by tools/figures/report_figures.py
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/io/provenance.hpp"
#include "reports/datasets.hpp"
#include "reports/digest.hpp"
#include "reports/figures.hpp"
#include "validation/result.hpp"

namespace xpr {

inline constexpr std::int64_t report_schema_version = 1;

struct ReportInputs {
  SuiteResult suite;
  std::string command;    ///< what a person types to reproduce the run
  Json configuration;     ///< resolved; without paths or threads, which belong to `circumstances`
  Provenance provenance;  ///< date, CPU and flags of it go to /volatile
  /// What the results must not depend on, name and text: host, threads, paths, wall time. Written under /volatile.
  std::vector<std::pair<std::string, std::string>> circumstances;
  /// What exists, in the order to print: the axes of the coverage matrix.
  std::vector<ChartName> charts;
  std::vector<std::string> methods;
  FigureTools figure_tools = found_figure_tools();
};

/// What was written.
struct ReportOutcome {
  Hashes hashes;
  std::vector<std::string> figure_problems;  ///< empty where all figures were drawn; else say so loudly
};

/// Throws as write_report would for a directory that cannot be written or holds something else: to be asked before a
/// long run, not after it.
void check_report_directory(const std::filesystem::path& directory);

/// Writes the report; a report that stands at `directory` is replaced whole. A figure that cannot be drawn is said in
/// the report and in the outcome, and nothing else suffers. Throws InputError for a directory that cannot be written or
/// holds something else, FaultError for a full disk; then nothing is left behind and what stood there still stands.
ReportOutcome write_report(const ReportInputs& inputs, const std::filesystem::path& directory);

}  // namespace xpr
