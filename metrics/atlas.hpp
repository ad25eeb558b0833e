// How charts of one spacetime meet: in the hub, through which states are carried from chart to chart, and while a ray
// is traced, where one chart hands it over to another.
#pragma once

#include "metrics/derived.hpp"
#include "metrics/tensor.hpp"

namespace xpr {

/// What a module answers when a ray has left its chart's good region: the state in the chart that goes on, which is the
/// module's `atlas_partner()` if it has one, else the same chart on another sheet.
struct AtlasMove {
  PhaseState<double> state;
  int sheet = 1;
};

/// (x, p) of the module's chart in the hub: by the module's map on phase space, else by its point map and the Jacobian
/// of the way back, else as it is (the module is the hub).
template <MetricModule M, class T>
[[nodiscard]] constexpr PhaseState<T> state_to_hub(const M& module, const PhaseState<T>& y, int sheet) {
  if constexpr (requires { module.to_hub(y, sheet); }) {
    return module.to_hub(y, sheet);
  } else if constexpr (requires { module.to_hub(y.x(), sheet); }) {
    return map_state([&](const auto& x) { return module.to_hub(x, sheet); },
                     [&](const auto& x) { return module.from_hub(x); }, y);
  } else {
    return y;
  }
}

/// The sheet of the module's chart on which a point of the hub lies; +1 where there is only one.
template <MetricModule M>
[[nodiscard]] int sheet_at_hub(const M& module, const Vec4<double>& x) {
  if constexpr (requires { module.hub_sheet(x); }) {
    return module.hub_sheet(x);
  } else {
    return 1;
  }
}

/// Undoes state_to_hub, on the given sheet.
template <MetricModule M, class T>
[[nodiscard]] constexpr PhaseState<T> state_from_hub(const M& module, const PhaseState<T>& y, int sheet) {
  if constexpr (requires { module.from_hub(y); }) {
    return module.from_hub(y);
  } else if constexpr (requires { module.from_hub(y.x()); }) {
    return map_state([&](const auto& x) { return module.from_hub(x); },
                     [&](const auto& x) { return module.to_hub(x, sheet); }, y);
  } else {
    return y;
  }
}

}  // namespace xpr
