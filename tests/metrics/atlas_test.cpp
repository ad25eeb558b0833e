// Where one chart hands a ray over to another: Ellis' throat, the ellipsoid's poles.
#include "metrics/atlas.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "metrics/chart_map.hpp"
#include "metrics/spacetimes.hpp"
#include "module_samples.hpp"

namespace xpr {
namespace {

constexpr double unit = std::numeric_limits<double>::epsilon() / 2;

TEST(EllisAtlas, goes_over_only_inside_the_throat_and_stays_the_same_event) {
  const SpacetimeOf<EllisIsotropic> wormhole({{.b0 = 1.4}});
  const SpacetimeOf<EllisProperDistance> whole({{.b0 = 1.4}});
  EXPECT_FALSE(wormhole.atlas_switch({{0.0, 0.71, 0.0, 0.0}, {-1.0, -1.0, 0.2, 0.1}}, 1).has_value());
  for (const int sheet : {1, -1}) {
    const PhaseState<double> y({0.4, 0.3, -0.2, 0.5}, {-1.0, 0.7, -0.4, 0.2});
    const auto move = wormhole.atlas_switch(y, sheet);
    ASSERT_TRUE(move.has_value());
    EXPECT_EQ(move->chart, &wormhole);
    EXPECT_EQ(move->sheet, -sheet);
    EXPECT_GE(euclidean_radius(move->state.x()), 0.7);
    EXPECT_FALSE(wormhole.atlas_switch(move->state, move->sheet).has_value());
    const PhaseState<double> before = wormhole.to_hub(y, sheet), after = wormhole.to_hub(move->state, move->sheet);
    // theta and phi go on unchanged, and so do l and every momentum.
    for (std::size_t i = 0; i < 8; ++i)
      EXPECT_NEAR(after[i], before[i], 16.0 * unit * (1.0 + std::abs(before[i]))) << i;
    EXPECT_NEAR(wormhole.hamiltonian(move->state), wormhole.hamiltonian(y), 16.0 * unit);
    const auto l_before = wormhole.proper_distance(y.x(), sheet);
    const auto l_after = wormhole.proper_distance(move->state.x(), move->sheet);
    EXPECT_NEAR(*l_after, *l_before, 16.0 * unit);
    EXPECT_LT(*l_before * sheet, 0.0);
  }
}

TEST(EllisAtlas, inversion_is_its_own_inverse_and_symplectic) {
  const EllisIsotropic wormhole{{.b0 = 1.4}};
  samples::for_each_state(std::type_identity<EllisIsotropic>{}, [&](const auto&, const PhaseState<double>& y) {
    const auto image = wormhole.inverted(samples::seeded(y));
    const PhaseState<double> back = wormhole.inverted(wormhole.inverted(y));
    for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(back[i], y[i], 32.0 * unit * (1.0 + std::abs(y[i])));
    for (std::size_t i = 0; i < 8; ++i) {
      for (std::size_t j = 0; j < 8; ++j) {
        double sum = 0.0, scale = 1.0;
        for (std::size_t mu = 0; mu < 4; ++mu) {
          const double a = image[mu].derivative[i] * image[4 + mu].derivative[j];
          const double b = image[4 + mu].derivative[i] * image[mu].derivative[j];
          sum += a - b;
          scale += std::abs(a) + std::abs(b);
        }
        EXPECT_NEAR(sum, j == i + 4 ? 1.0 : (i == j + 4 ? -1.0 : 0.0), 32.0 * unit * scale);
      }
    }
  });
}

TEST(EllisCharts, name_the_sheet_by_the_side_of_the_throat) {
  const SpacetimeOf<EllisIsotropic> regular({{.b0 = 1.0}});
  const SpacetimeOf<EllisProperDistance> whole({{.b0 = 1.0}});
  for (const double l : {-3.0, -0.01, 0.01, 3.0}) {
    const PhaseState<double> y({0.0, l, 1.1, 0.4}, {-1.0, 0.5, 0.3, -0.2});
    const ChartState there = change_chart(whole, regular, y, 1);
    EXPECT_EQ(there.sheet, l < 0.0 ? -1 : 1);
    EXPECT_NEAR(regular.radius(there.state.x()), std::sqrt(1.0 + l * l), 16.0 * unit * (1.0 + std::abs(l)));
    const ChartState back = change_chart(regular, whole, there.state, there.sheet);
    EXPECT_EQ(back.sheet, there.sheet);
    for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(back.state[i], y[i], 64.0 * unit);
  }
}

TEST(EllipsoidAtlas, hands_over_near_the_poles_and_comes_back_to_the_chart_it_left) {
  const SpacetimeOf<EllipsoidGeographic> earth({{.a_axis = 6.4, .f = 0.2}});
  const PhaseState<double> mid({0.0, 1.0, 0.3, 0.0}, {-1.0, 0.4, 0.9, 0.0});
  EXPECT_FALSE(earth.atlas_switch(mid, 1).has_value());
  for (const double lat : {1.2, -1.5}) {
    const PhaseState<double> y({0.0, lat, 2.3, 0.0}, {-1.0, 0.4, 0.9, 0.0});
    const auto move = earth.atlas_switch(y, 1);
    ASSERT_TRUE(move.has_value());
    const Spacetime& turned = *move->chart;
    EXPECT_EQ(turned.card().chart, "geographic-turned");
    EXPECT_EQ(turned.parameters()[0].value, 6.4);
    // No flip-flop: the state lies deep inside the chart it was handed to.
    EXPECT_FALSE(turned.atlas_switch(move->state, 1).has_value());
    EXPECT_LT(std::abs(std::sin(move->state[1])), 0.44);
    EXPECT_NEAR(turned.hamiltonian(move->state), earth.hamiltonian(y), 64.0 * unit);
    EXPECT_NEAR(turned.radius(move->state.x()), earth.radius(y.x()), 64.0 * unit);
    for (std::size_t k = 0; k < 3; ++k) {
      const KillingVector here = earth.killing_vectors(y.x())[k], there = turned.killing_vectors(move->state.x())[k];
      EXPECT_EQ(here.name, there.name);
      EXPECT_NEAR(contract(there.component, move->state.p()), contract(here.component, y.p()), 64.0 * unit)
          << here.name;
    }
  }
  // From the turned chart's own pole back: the very chart object that the ray started in.
  const auto move = earth.atlas_switch({{0.0, 1.2, 0.1, 0.0}, {-1.0, 0.4, 0.9, 0.0}}, 1);
  const auto back = move->chart->atlas_switch({{0.0, 1.3, 0.1, 0.0}, {-1.0, 0.4, 0.9, 0.0}}, 1);
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(back->chart, &earth);
}

TEST(EllipsoidAtlas, starts_in_either_chart) {
  const SpacetimeOf<EllipsoidTurned> turned({{.a_axis = 1.0, .f = 0.1}});
  const auto move = turned.atlas_switch({{0.0, -1.3, 0.1, 0.0}, {-1.0, 0.4, 0.9, 0.0}}, 1);
  ASSERT_TRUE(move.has_value());
  EXPECT_EQ(move->chart->card().chart, "geographic");
}

TEST(Media, name_the_rim_where_the_gradient_jumps) {
  EXPECT_EQ(SpacetimeOf<Luneburg>({{.R = 2.5}}).interface_radius(), 2.5);
  EXPECT_EQ(SpacetimeOf<MaxwellFisheye>({{.R = 2.5}}).interface_radius(), std::nullopt);
  EXPECT_EQ(SpacetimeOf<KerrSchildIngoing>({}).interface_radius(), std::nullopt);
}

TEST(Media, have_the_printed_indices) {
  const auto index = [](const Spacetime& medium, double r) {
    return std::sqrt(-medium.inverse_metric({0.0, 0.6 * r, 0.0, -0.8 * r})(0, 0));
  };
  const SpacetimeOf<Luneburg> lens({{.R = 2.0}});
  const SpacetimeOf<MaxwellFisheye> fisheye({{.R = 2.0}});
  for (const double r : {0.0, 0.5, 1.9}) {
    EXPECT_NEAR(index(lens, r), std::sqrt(2.0 - r * r / 4.0), 4.0 * unit);
    EXPECT_NEAR(index(fisheye, r), 2.0 / (1.0 + r * r / 4.0), 8.0 * unit);
  }
  EXPECT_EQ(index(lens, 2.5), 1.0);
  EXPECT_NEAR(index(fisheye, 2.0), 1.0, 4.0 * unit);
  EXPECT_EQ(index(SpacetimeOf<MediumUniform>({{.n = 1.5}}), 3.0), 1.5);
}

}  // namespace
}  // namespace xpr
