#include "metrics/conformance.hpp"

#include <fmt/format.h>

#include "metrics/conformance_kit.hpp"

namespace xpr {

std::vector<Finding> check_conformance(const Spacetime& chart, std::span<const Spacetime* const> siblings,
                                       const ConformanceOptions& options) {
  using namespace conformance;
  const Subject subject = make_subject(chart, siblings, options);
  std::vector<Finding> findings;
  check_algebra(subject, findings);
  check_symmetries(subject, findings);
  check_curvature(subject, findings);
  check_far_field(subject, findings);
  check_orientation(subject, findings);
  check_regularity(subject, findings);
  check_chart_maps(subject, findings);
  return findings;
}

bool conforms(std::span<const Finding> findings) {
  return std::none_of(findings.begin(), findings.end(),
                      [](const Finding& finding) { return finding.state == FindingState::failed; });
}

}  // namespace xpr
