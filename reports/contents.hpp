// What a report says and in which order, before anyone lays it out.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "reports/datasets.hpp"
#include "reports/digest.hpp"
#include "reports/figures.hpp"
#include "reports/page.hpp"
#include "validation/result.hpp"

namespace xpr {

/// All that a page of the report is made from.
struct Contents {
  const SuiteResult& suite;
  const Digest& digest;
  Coverage coverage;
  FigureSet figures;
  Hashes hashes;
  std::string command;        ///< that reproduces the run
  std::string configuration;  ///< resolved, as text
  Facts provenance;
};

/// Fills the page from top to bottom: verdict, how to reproduce, failures, and then everything.
void compose(const Contents& contents, Page& page);

/// Anchor of a case's section.
[[nodiscard]] std::string case_anchor(const CaseResult& result);

}  // namespace xpr
