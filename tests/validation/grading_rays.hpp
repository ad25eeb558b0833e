// Rays handed in by imagined codes: exact ends, with one thing wrong.
#pragma once

#include <functional>
#include <string_view>

#include "metrics/chart_map.hpp"
#include "validation/grading/card.hpp"

namespace xpr::testing {

/// Where a good code ends: outside, at r_max or a little short of it, or next to the horizon.
inline double end_radius(const Examiner& examiner, std::size_t k) {
  const ExactRay& exact = examiner.exact(k);
  if (exact.captured()) return 1.02 * examiner.home().horizon_radius().value();
  const double r = examiner.set().r_max * (k % 2 == 0 ? 1.0 : 0.97);
  return examiner.set().metric == "ellis" ? exact.side() * r : r;
}

/// The exact ends as a table in a chart of the set; `alter` may spoil each.
inline HandIn exact_hand_in(const Examiner& examiner, std::string_view chart,
                            const std::function<void(std::size_t, HandedRay&)>& alter = {}) {
  HandIn hand_in;
  hand_in.chart = std::string(chart);
  hand_in.has_status = hand_in.has_momentum = hand_in.has_lambda = true;
  const auto there = examiner.set().spacetime(chart);
  for (std::size_t k = 0; k < static_cast<std::size_t>(examiner.count()); ++k) {
    const ExactRay& exact = examiner.exact(k);
    const ExactEnd end = exact.at(end_radius(examiner, k), exact.turns_at_end());
    const ChartState state = change_chart(examiner.home(), *there, end.state);
    HandedRay ray{.status = exact.captured() ? Status::captured : Status::escaped,
                  .sheet = state.sheet,
                  .end = state.state,
                  .lambda = end.lambda};
    if (alter) alter(k, ray);
    hand_in.rays.push_back(ray);
  }
  return hand_in;
}

}  // namespace xpr::testing
