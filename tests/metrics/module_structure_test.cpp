// What holds for every module alike: inverse, derivatives, Killing vectors, domains.
#include <gtest/gtest.h>

#include <limits>

#include "metrics/scalar/multiprecision.hpp"
#include "metrics/spacetimes.hpp"
#include "module_samples.hpp"

namespace xpr {
namespace {

constexpr double unit = std::numeric_limits<double>::epsilon() / 2;

/// |a| |b|: what the round-off of a product of matrices is measured against.
Matrix4<double> product_of_sizes(const Matrix4<double>& a, const Matrix4<double>& b) {
  Matrix4<double> out{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t k = 0; k < 4; ++k) out[i][j] += std::abs(a[i][k] * b[k][j]);
    }
  }
  return out;
}

Matrix4<double> full(const SymTensor4<double>& g) {
  Matrix4<double> out{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) out[i][j] = g(i, j);
  }
  return out;
}

TEST(EveryModule, covariant_metric_is_the_inverse) {
  samples::for_each_state([](const auto& module, const PhaseState<double>& y) {
    const Matrix4<double> up = full(module.inverse_metric(y.x())), down = full(covariant_metric(module, y.x()));
    const Matrix4<double> condition = product_of_sizes(up, down);
    double worst = 1.0;
    for (std::size_t mu = 0; mu < 4; ++mu) worst = std::max(worst, condition[mu][mu]);
    for (std::size_t mu = 0; mu < 4; ++mu) {
      for (std::size_t nu = 0; nu < 4; ++nu) {
        double sum = 0.0;
        for (std::size_t k = 0; k < 4; ++k) sum += up[mu][k] * down[k][nu];
        // Minors are sums of a dozen products, and share one determinant: its round-off grows with the worst condition
        // of any component. Next to the horizon Boyer-Lindquist's block of t and phi is nearly singular.
        EXPECT_NEAR(sum, mu == nu ? 1.0 : 0.0, 16.0 * unit * worst * condition[mu][nu])
            << samples::describe(module.card, y);
      }
    }
  });
}

TEST(EveryModule, derivatives_by_duals_are_those_of_fifty_digit_differences) {
  const Real50 h("1e-16");
  samples::for_each_state([&](const auto& module, const PhaseState<double>& y) {
    const Vec4<Real50> x = samples::widened<Real50>(y).x();
    const auto g = module.inverse_metric(variables(x));
    for (std::size_t mu = 0; mu < 4; ++mu) {
      Vec4<Real50> before = x, after = x;
      before[mu] -= h;
      after[mu] += h;
      const SymTensor4<Real50> lower = module.inverse_metric(before), upper = module.inverse_metric(after);
      for (std::size_t c = 0; c < 10; ++c) {
        const Real50 slope = (upper.c[c] - lower.c[c]) / (2 * h);
        // Truncation h^2 g''' / 6: at the sharpest point, 1e-5 from the axis, g''' / g is 2e16.
        const Real50 scale = abs(g.c[c].derivative[mu]) + abs(g.c[c].value);
        EXPECT_LE(abs(slope - g.c[c].derivative[mu]), scale * Real50("1e-15")) << samples::describe(module.card, y);
      }
    }
  });
}

TEST(EveryModule, ignorable_coordinates_do_not_appear_in_the_metric) {
  samples::for_each_state([](const auto& module, const PhaseState<double>& y) {
    const auto g = module.inverse_metric(variables(y.x()));
    for (std::size_t mu = 0; mu < 4; ++mu) {
      if (!module.card.ignorable[mu]) continue;
      for (const auto& component : g.c) EXPECT_EQ(component.derivative[mu], 0.0) << samples::describe(module.card, y);
    }
  });
}

/// d(constant)/dlambda along the flow, with the size of the terms that cancel in it.
struct Drift {
  double rate = 0.0;
  double scale = 0.0;
};

Drift drift(const Dual<double, 8>& constant, const PhaseState<double>& rate) {
  Drift out;
  for (std::size_t i = 0; i < 8; ++i) {
    out.rate += constant.derivative[i] * rate[i];
    out.scale += std::abs(constant.derivative[i] * rate[i]);
  }
  return out;
}

TEST(EveryModule, killing_vectors_make_constants_of_the_motion) {
  samples::for_each_state([](const auto& module, const PhaseState<double>& y) {
    const PhaseState<Dual<double, 8>> state = samples::seeded(y);
    const PhaseState<double> rate = derived_flow(module, y);
    double largest_force = 0.0;
    for (std::size_t i = 4; i < 8; ++i) largest_force = std::max(largest_force, std::abs(rate[i]));
    for (const auto& killing : killing_vectors_of(module, state.x())) {
      const Drift along = drift(contract(killing.component, state.p()), rate);
      // Off the cone too: the bracket with H vanishes everywhere. 64 units: the flow's own round-off, 16 units of its
      // terms (see module_precision_test), which near the axis are larger than what is left of them.
      double reach = 0.0;
      for (const auto& component : killing.component) reach = std::max(reach, std::abs(component.value));
      EXPECT_LE(std::abs(along.rate), 64.0 * unit * (along.scale + reach * largest_force))
          << killing.name << " of " << samples::describe(module.card, y);
    }
  });
}

TEST(EveryModule, carters_constant_is_constant_where_it_exists) {
  int modules = 0;
  for_each_module([&]<class M>(std::type_identity<M> module) {
    if constexpr (requires(const M& m, const PhaseState<double>& y) { m.carter_constant(y); }) {
      ++modules;
      samples::for_each_state(module, [](const M& kerr, const PhaseState<double>& y) {
        const PhaseState<Dual<double, 8>> state = samples::seeded(y);
        const PhaseState<double> rate = derived_flow(kerr, y);
        const Drift along = drift(kerr.carter_constant(state), rate);
        EXPECT_LE(std::abs(along.rate), 1e-12 * along.scale) << samples::describe(M::card, y);
      });
    }
  });
  EXPECT_EQ(modules, 3);
}

TEST(EveryModule, admits_no_event_with_nan_or_infinity) {
  for_each_module([]<class M>(std::type_identity<M> tag) {
    const SpacetimeOf<M> spacetime{M{}};
    const Vec4<double> good = samples::samples_of(tag)[0].events[0];
    EXPECT_TRUE(spacetime.inside_domain(good)) << M::card.metric << " " << M::card.chart;
    for (std::size_t mu = 0; mu < 4; ++mu) {
      for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        Vec4<double> x = good;
        x[mu] = bad;
        EXPECT_FALSE(spacetime.inside_domain(x)) << M::card.metric << " " << M::card.chart << " component " << mu;
      }
    }
  });
}

}  // namespace
}  // namespace xpr
