// Every module against itself at 50 digits, and every hand-written flow against the derived one.
#include <gtest/gtest.h>

#include <limits>

#include "metrics/derived.hpp"
#include "metrics/scalar/multiprecision.hpp"
#include "module_samples.hpp"

namespace xpr {
namespace {

constexpr double unit = std::numeric_limits<double>::epsilon() / 2;

/// |v| as a double.
double size(const Real50& v) { return std::abs(static_cast<double>(v)); }

/// The inverse metric at 50 digits, with its derivatives.
template <class M>
SymTensor4<Dual<Real50, 4>> truth(const M& module, const PhaseState<double>& y) {
  return module.inverse_metric(variables(samples::widened<Real50>(y).x()));
}

/// How much a component moves when every coordinate moves by its own size: what one unit of round-off in an
/// intermediate radius or angle is worth.
double conditioned_size(const Dual<Real50, 4>& component, const PhaseState<double>& y) {
  double out = size(component.value);
  for (std::size_t mu = 0; mu < 4; ++mu) out += size(component.derivative[mu]) * std::abs(y[mu]);
  return out;
}

TEST(EveryModule, inverse_metric_agrees_with_fifty_digits_to_round_off) {
  samples::for_each_state([&](const auto& module, const PhaseState<double>& y) {
    const SymTensor4<double> g = module.inverse_metric(y.x());
    const auto exact = truth(module, y);
    for (std::size_t i = 0; i < 10; ++i) {
      const double error = size(g.c[i] - exact.c[i].value);
      // In Cartesian charts every component is what gravity takes from, or adds to, a flat metric of size one.
      const double flat = samples::is_cartesian(module.card) ? 1.0 : 0.0;
      const double scale = (conditioned_size(exact.c[i], y) + flat) * unit;
      // Half a dozen roundings on the way to a component; 3.6 units measured.
      EXPECT_LE(error, 8.0 * scale) << samples::describe(module.card, y) << " component " << i;
    }
  });
}

/// The flow at 50 digits, derived from the inverse metric alone. `scale` is the size of the terms that make up a
/// component, plus how much it moves when every coordinate moves by its own size.
struct FlowTruth {
  std::array<Real50, 8> rate{};
  std::array<double, 8> scale{};
};

template <class M>
FlowTruth flow_truth(const M& module, const PhaseState<double>& y) {
  PhaseState<Dual<Real50, 4>> state(variables(samples::widened<Real50>(y).x()), {});
  for (std::size_t i = 4; i < 8; ++i) state[i] = Real50(y[i]);
  const PhaseState<Dual<Real50, 4>> rate = derived_flow(module, state);
  const auto g = truth(module, y);
  FlowTruth out;
  for (std::size_t i = 0; i < 8; ++i) {
    out.rate[i] = rate[i].value;
    out.scale[i] = conditioned_size(rate[i], y);
  }
  for (std::size_t mu = 0; mu < 4; ++mu) {
    for (std::size_t a = 0; a < 4; ++a) {
      out.scale[mu] += size(g(mu, a).value) * std::abs(y[4 + a]);
      for (std::size_t b = 0; b < 4; ++b) {
        out.scale[4 + mu] += 0.5 * size(g(a, b).derivative[mu]) * std::abs(y[4 + a] * y[4 + b]);
      }
    }
  }
  return out;
}

TEST(EveryModule, both_flows_agree_with_fifty_digits_to_round_off) {
  samples::for_each_state([&](const auto& module, const PhaseState<double>& y) {
    const FlowTruth exact = flow_truth(module, y);
    const PhaseState<double> fast = flow(module, y);
    const PhaseState<double> derived = derived_flow(module, y);
    double largest = 0.0;
    for (std::size_t i = 4; i < 8; ++i) largest = std::max(largest, exact.scale[i]);
    for (std::size_t i = 0; i < 8; ++i) {
      const bool share = i >= 4 && samples::is_cartesian(module.card);  // forces of one unit, made from one vector
      const double scale = (share ? largest : exact.scale[i]) * unit;
      // A dozen roundings on the way to a sum of terms; 8.0 units measured by hand, 5.1 derived.
      EXPECT_LE(size(fast[i] - exact.rate[i]), 16.0 * scale) << samples::describe(module.card, y) << " component " << i;
      EXPECT_LE(size(derived[i] - exact.rate[i]), 16.0 * scale)
          << samples::describe(module.card, y) << " component " << i;
    }
  });
}

}  // namespace
}  // namespace xpr
