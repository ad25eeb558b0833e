// flow50 for some of the modules: every fourth of AllModules, so that a new module is compiled here without a line of
// its own and the compiler's work spreads over cores.
#pragma once

#include <cstddef>
#include <utility>

#include "metrics/derived.hpp"
#include "metrics/modules.hpp"
#include "validation/truth/fifty_digits.hpp"

namespace xpr::flow50_detail {

inline constexpr std::size_t slices = 4;

template <class M>
Rates50 flow_of(std::span<const NamedValue> values) {
  M module;
  if constexpr (requires { M::parameters; }) {
    for (const auto& parameter : M::parameters) {
      for (const NamedValue& value : values) {
        if (value.name == parameter.name) module.*(parameter.member) = value.value;
      }
    }
  }
  return [module](const std::vector<Real50>& y, std::vector<Real50>& rate) {
    PhaseState<Real50> state;
    for (std::size_t i = 0; i < 8; ++i) state[i] = y[i];
    const PhaseState<Real50> out = derived_flow(module, state);
    for (std::size_t i = 0; i < 8; ++i) rate[i] = out[i];
  };
}

template <std::size_t slice, class... Modules>
Rates50 find_flow(ModuleList<Modules...>, std::string_view metric, std::string_view chart,
                  std::span<const NamedValue> values) {
  Rates50 found;
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    const auto look = [&]<std::size_t index, class M>(std::integral_constant<std::size_t, index>,
                                                      std::type_identity<M>) {
      if constexpr (index % slices == slice) {
        if (M::card.metric == metric && M::card.chart == chart) found = flow_of<M>(values);
      }
    };
    (look(std::integral_constant<std::size_t, I>{}, std::type_identity<Modules>{}), ...);
  }
  (std::index_sequence_for<Modules...>{});
  return found;
}

/// Empty where the chart is in another slice.
template <std::size_t slice>
Rates50 flow_in_slice(std::string_view metric, std::string_view chart, std::span<const NamedValue> values) {
  return find_flow<slice>(AllModules{}, metric, chart, values);
}

}  // namespace xpr::flow50_detail
