// The same source gives the same bits in every lane of every width, and under duals of both.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "metrics/derived.hpp"
#include "module_samples.hpp"

namespace xpr {
namespace {

/// Equal to the bit; any NaN equals any other.
bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (std::isnan(a) && std::isnan(b));
}

template <int W>
PhaseState<Pack<W>> packed(const std::vector<PhaseState<double>>& states, std::size_t first) {
  PhaseState<Pack<W>> out;
  for (std::size_t i = 0; i < 8; ++i) {
    for (int lane_index = 0; lane_index < W; ++lane_index) {
      set_lane(out[i], lane_index, states[(first + static_cast<std::size_t>(lane_index)) % states.size()][i]);
    }
  }
  return out;
}

/// How many components differ between W lanes and the same rays one by one: metric, both flows, H.
template <int W, class M>
int differing_components(const M& module, const std::vector<PhaseState<double>>& states) {
  int differing = 0;
  for (std::size_t first = 0; first < states.size(); first += W) {
    const PhaseState<Pack<W>> y = packed<W>(states, first);
    const SymTensor4<Pack<W>> g = module.inverse_metric(y.x());
    const PhaseState<Pack<W>> fast = flow(module, y), derived = derived_flow(module, y);
    const Pack<W> h = hamiltonian(module, y);
    for (int i = 0; i < W; ++i) {
      const PhaseState<double>& alone = states[(first + static_cast<std::size_t>(i)) % states.size()];
      const SymTensor4<double> g_alone = module.inverse_metric(alone.x());
      const PhaseState<double> fast_alone = flow(module, alone), derived_alone = derived_flow(module, alone);
      for (std::size_t c = 0; c < 10; ++c) differing += same_bits(lane(g.c[c], i), g_alone.c[c]) ? 0 : 1;
      for (std::size_t c = 0; c < 8; ++c) {
        differing += same_bits(lane(fast[c], i), fast_alone[c]) ? 0 : 1;
        differing += same_bits(lane(derived[c], i), derived_alone[c]) ? 0 : 1;
      }
      differing += same_bits(lane(h, i), hamiltonian(module, alone)) ? 0 : 1;
    }
  }
  return differing;
}

/// Calls check(module, states) for every module and every choice of its parameters.
template <class Check>
void for_each_sample(const Check& check) {
  for_each_module([&]<class M>(std::type_identity<M> module) {
    std::uint64_t seed = 7;
    for (const samples::Sample<M>& sample : samples::samples_of(module)) {
      std::vector<PhaseState<double>> states;
      for (const Vec4<double>& x : sample.events) states.emplace_back(x, samples::momentum_at(M::card, x, ++seed));
      SCOPED_TRACE(std::string(M::card.metric) + " in " + std::string(M::card.chart));
      check(sample.module, states);
    }
  });
}

TEST(EveryModule, gives_the_same_bits_at_every_lane_width) {
  for_each_sample([](const auto& module, const std::vector<PhaseState<double>>& states) {
    EXPECT_EQ(differing_components<1>(module, states), 0);
    EXPECT_EQ(differing_components<2>(module, states), 0);
    EXPECT_EQ(differing_components<4>(module, states), 0);
    EXPECT_EQ(differing_components<8>(module, states), 0);
  });
}

TEST(EveryModule, gives_the_same_bits_when_derivatives_are_carried_along) {
  for_each_sample([](const auto& module, const std::vector<PhaseState<double>>& states) {
    int differing = 0;
    for (const PhaseState<double>& y : states) {
      const PhaseState<double> plain = flow(module, y);
      const PhaseState<Dual<double, 8>> with_derivatives = flow(module, samples::seeded(y));
      for (std::size_t c = 0; c < 8; ++c) differing += same_bits(plain[c], with_derivatives[c].value) ? 0 : 1;
    }
    EXPECT_EQ(differing, 0);
  });
}

TEST(EveryModule, gives_the_same_bits_for_duals_of_packs_lane_by_lane) {
  for_each_sample([](const auto& module, const std::vector<PhaseState<double>>& states) {
    int differing = 0;
    for (std::size_t first = 0; first < states.size(); first += 4) {
      const auto wide = module.inverse_metric(variables(packed<4>(states, first).x()));
      for (int i = 0; i < 4; ++i) {
        const auto alone =
            module.inverse_metric(variables(states[(first + static_cast<std::size_t>(i)) % states.size()].x()));
        for (std::size_t c = 0; c < 10; ++c) {
          for (std::size_t mu = 0; mu < 4; ++mu) {
            const double in_lane = lane(wide.c[c], i).derivative[mu];
            differing += same_bits(in_lane, alone.c[c].derivative[mu]) ? 0 : 1;
          }
        }
      }
    }
    EXPECT_EQ(differing, 0);
  });
}

}  // namespace
}  // namespace xpr
