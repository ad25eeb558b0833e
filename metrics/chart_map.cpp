#include "metrics/chart_map.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace xpr {

ChartState change_chart(const Spacetime& from, const Spacetime& to, const PhaseState<double>& y, int sheet) {
  if (from.card().metric != to.card().metric) {
    throw std::invalid_argument(
        fmt::format("no map from a chart of '{}' to one of '{}'", from.card().metric, to.card().metric));
  }
  if (from.card().chart == to.card().chart) return {y, sheet};
  const auto [state, new_sheet] = to.from_hub(from.to_hub(y, sheet));
  return {state, new_sheet};
}

}  // namespace xpr
