// Metric modules that are wrong on purpose, as someone would have got them wrong: what the suite must fail.
//
// Each is the right module with one slip in its inverse metric. Radius, horizon, Killing vectors, declared curvature
// and chart maps stay those of the right one, and a hand-written flow is dropped, so that rays follow the wrong metric.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "metrics/spacetime_of.hpp"
#include "validation/case.hpp"

namespace xpr {

/// M with `Slip` made in g^{mu nu}: Slip{}(module, x, g).
template <class M, class Slip>
struct Wrong : M {
  static constexpr bool for_lanes = false;  // the suite traces its rays one by one
  template <Scalar T>
  [[nodiscard]] SymTensor4<T> inverse_metric(const Vec4<T>& x) const {
    SymTensor4<T> g = M::inverse_metric(x);
    Slip{}(static_cast<const M&>(*this), x, g);
    return g;
  }
  void flow() const = delete;  // hides the right flow: the wrong one is derived
  template <class T>
  [[nodiscard]] PhaseState<T> flow_of_side(const PhaseState<T>& y, bool /*inside*/) const {
    return derived_flow(*this, y);
  }
};

/// For slips that people make in g_{mu nu}: Slip{}(module, x, g) on the covariant components.
template <class Slip>
struct InLowerIndices {
  template <class M, class T>
  void operator()(const M& module, const Vec4<T>& x, SymTensor4<T>& g) const {
    SymTensor4<T> lower = inverse(g);
    Slip{}(module, x, lower);
    g = inverse(lower);
  }
};

/// Wrong<M, Slip> in place of M where that chart is asked for; else null.
template <class M, class Slip>
[[nodiscard]] std::unique_ptr<Spacetime> wrong_chart(std::string_view metric, std::string_view chart,
                                                     [[maybe_unused]] std::span<const NamedValue> values) {
  if (metric != M::card.metric || (chart != M::card.chart && !chart.empty())) return nullptr;
  Wrong<M, Slip> module;
  if constexpr (requires { M::parameters; }) {
    for (const NamedValue& value : values) {
      for (const auto& parameter : M::parameters) {
        if (parameter.name == value.name) module.*(parameter.member) = value.value;
      }
    }
  }
  return std::make_unique<SpacetimeOf<Wrong<M, Slip>>>(std::move(module));
}

/// A fault that puts the slip into one chart.
template <class M, class Slip>
[[nodiscard]] Fault slip_in(std::string id, std::string description, std::string case_id) {
  return {.id = std::move(id),
          .description = std::move(description),
          .case_id = std::move(case_id),
          .spacetime = wrong_chart<M, Slip>,
          .stepper = {},
          .settings = {}};
}

[[nodiscard]] std::vector<Fault> heuristic_faults();      // faulty_heuristics.cpp
[[nodiscard]] std::vector<Fault> kerr_metric_faults();    // faulty_kerr.cpp
[[nodiscard]] std::vector<Fault> static_metric_faults();  // faulty_static.cpp

}  // namespace xpr
