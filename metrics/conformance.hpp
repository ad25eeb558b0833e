// What must hold of every spacetime chart, whatever it describes: the checks behind `xprimeray conform`.
//
// Works on any Spacetime, built-in or a user's: algebra of g, derivatives, the flow, symmetries, field equations or
// declared curvature, asymptotics, orientation, axis and horizon, and the maps to the other charts of the same
// spacetime. Every check samples points off the equator, near the axis and on both sides of horizon and throat, from a
// seed; errors are relative and measured in an orthonormal frame, so that a wrong sin^2 theta shows as much as a
// wrong g_tt.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "metrics/spacetime.hpp"

namespace xpr {

enum class FindingState { passed, failed, not_checked };

/// What one check found.
struct Finding {
  std::string check;  ///< id, as "vacuum"
  std::string claim;  ///< one sentence that is true of a module that conforms
  FindingState state = FindingState::not_checked;
  double error = 0.0;      ///< the worst over all points, relative unless the claim says otherwise
  double tolerance = 0.0;  ///< 0 where nothing was checked
  std::string tolerance_reason;
  Vec4<double> where{};   ///< the event with the worst error
  std::string component;  ///< the component that is worst, where there is one
  std::string message;    ///< in words: what is off, where, by what ratio; or why it was not checked
};

struct ConformanceOptions {
  std::uint64_t seed = 20260101;
  int points = 24;  ///< events sampled
};

/// All checks of one chart, in a fixed order. `siblings` are the other charts of the same spacetime with the same
/// parameters (the chart itself may be among them and is left out). Never throws for what the numbers do.
[[nodiscard]] std::vector<Finding> check_conformance(const Spacetime& chart,
                                                     std::span<const Spacetime* const> siblings = {},
                                                     const ConformanceOptions& options = {});

/// Whether no finding has failed.
[[nodiscard]] bool conforms(std::span<const Finding> findings);

}  // namespace xpr
