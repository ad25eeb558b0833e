// What a black hole's charts must get right beyond the field equations: Kerr with the sense of rotation reversed solves
// them too.
#include "metrics/kerr.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "metrics/catalogue.hpp"
#include "metrics/chart_map.hpp"
#include "metrics/null_cone.hpp"
#include "metrics/spacetimes.hpp"

namespace xpr {
namespace {

constexpr double unit = std::numeric_limits<double>::epsilon() / 2;

/// g(d_t, d_phi) at a point of any chart: what drags frames.
double dragging(const Spacetime& kerr, const Vec4<double>& x) {
  const std::vector<KillingVector> killing = kerr.killing_vectors(x);
  return contract(killing[0].component, raise_index(kerr.metric(x), killing[1].component));
}

TEST(Kerr, drags_frames_along_with_its_rotation_in_every_chart) {
  for (const double a : {0.3, 0.9, 1.0}) {
    const double r = 4.0, theta = 1.1, rho_sq = r * r + a * a;
    const double x = std::sqrt(rho_sq) * std::sin(theta), z = r * std::cos(theta);
    // -2 M a r sin^2 theta / Sigma, [BoyerLindquist1967].
    const double expected = -2.0 * a * r * square(std::sin(theta)) / (r * r + square(a * std::cos(theta)));
    for (const double sense : {1.0, -1.0}) {
      const SpacetimeOf<KerrSchildIngoing> in({{.M = 1.0, .a = sense * a}});
      const SpacetimeOf<KerrSchildOutgoing> out({{.M = 1.0, .a = sense * a}});
      const SpacetimeOf<KerrBoyerLindquist> classical({{.M = 1.0, .a = sense * a}});
      EXPECT_NEAR(dragging(in, {0.0, 0.6 * x, -0.8 * x, z}), sense * expected, 64.0 * unit);
      EXPECT_NEAR(dragging(out, {0.0, 0.6 * x, -0.8 * x, z}), sense * expected, 64.0 * unit);
      EXPECT_NEAR(dragging(classical, {0.0, r, theta, 0.7}), sense * expected, 64.0 * unit);
      EXPECT_LT(sense * dragging(classical, {0.0, r, theta, 0.7}), 0.0);
    }
  }
}

TEST(Kerr, boyer_lindquist_is_the_inverse_of_the_printed_line_element) {
  const double M = 1.3, a = 0.8, r = 3.7, theta = 0.6;
  const double s2 = square(std::sin(theta)), sigma = r * r + a * a * (1.0 - s2), delta = r * r - 2.0 * M * r + a * a;
  const SymTensor4<double> g = covariant_metric(KerrBoyerLindquist{{.M = M, .a = a}}, Vec4<double>{0.0, r, theta, 0.0});
  SymTensor4<double> expected = diagonal(-(1.0 - 2.0 * M * r / sigma), sigma / delta, sigma,
                                         (r * r + a * a + 2.0 * M * a * a * r * s2 / sigma) * s2);
  expected(0, 3) = -2.0 * M * a * r * s2 / sigma;
  for (std::size_t k = 0; k < 10; ++k)
    EXPECT_NEAR(g.c[k], expected.c[k], 32.0 * unit * (1.0 + std::abs(expected.c[k])));
}

/// The impact parameter b = L_z / E at which equatorial light turns at r: the root of H(p_r = 0) = 0 of the given
/// sense.
double turning_impact_parameter(const KerrBoyerLindquist& kerr, double r, double sense) {
  const SymTensor4<double> g = kerr.inverse_metric(Vec4<double>{0.0, r, 0.5 * std::numbers::pi, 0.0});
  return (g(0, 3) + sense * std::sqrt(g(0, 3) * g(0, 3) - g(0, 0) * g(3, 3))) / g(3, 3);
}

/// Where |b| is least: the circular photon orbit. Golden section on the module's own potential.
double photon_orbit(const KerrBoyerLindquist& kerr, double sense) {
  double lower = kerr.horizon_radius() * (1.0 + 1e-9), upper = 5.0 * kerr.M;
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  while (upper - lower > 1e-9) {
    const double left = upper - golden * (upper - lower), right = lower + golden * (upper - lower);
    const bool keep_left =
        sense * turning_impact_parameter(kerr, left, sense) < sense * turning_impact_parameter(kerr, right, sense);
    (keep_left ? upper : lower) = keep_left ? right : left;
  }
  return 0.5 * (lower + upper);
}

TEST(Kerr, prograde_photon_orbit_lies_inside_the_retrograde_one) {
  for (const double a : {0.3, 0.7, 0.9}) {
    const KerrBoyerLindquist kerr{{.M = 1.0, .a = a}};
    const double prograde = photon_orbit(kerr, 1.0), retrograde = photon_orbit(kerr, -1.0);
    EXPECT_LT(prograde, 3.0);
    EXPECT_GT(retrograde, 3.0);
    // 2 M [1 + cos((2/3) arccos(-+a/M))], [BardeenPressTeukolsky1972]; a least value is located to the root of
    // round-off.
    EXPECT_NEAR(prograde, 2.0 * (1.0 + std::cos(2.0 / 3.0 * std::acos(-a))), 1e-7);
    EXPECT_NEAR(retrograde, 2.0 * (1.0 + std::cos(2.0 / 3.0 * std::acos(a))), 1e-7);
    EXPECT_NEAR(kerr.photon_orbit_gap(), prograde - kerr.horizon_radius(), 1e-7);
  }
}

TEST(Kerr, default_r_min_lies_between_horizon_and_prograde_photon_orbit) {
  for (const double a : {0.0, 0.5, 0.9, 0.998, 1.0 - 1e-9, 1.0 - 1e-15, 1.0, -0.9}) {
    const KerrParameters kerr{.M = 1.0, .a = a};
    EXPECT_GT(kerr.default_r_min(), kerr.horizon_radius()) << a;
    if (std::abs(a) < 1.0 - 1e-14) {
      EXPECT_LT(kerr.default_r_min(), kerr.horizon_radius() + kerr.photon_orbit_gap()) << a;
    }
    EXPECT_LE(kerr.default_r_min(), 1.005 * kerr.horizon_radius() * (1.0 + 4.0 * unit)) << a;
  }
  EXPECT_DOUBLE_EQ((KerrParameters{.M = 1.0, .a = 0.0}.default_r_min()), 2.01);
  EXPECT_DOUBLE_EQ((KerrParameters{.M = 3.0, .a = 3.0}.default_r_min()), 3.0 + 3e-12);
  EXPECT_DOUBLE_EQ((SchwarzschildMass{.M = 2.0}.default_r_min()), 4.02);
  // Where 1.01 r+ would already lie outside the photon orbit.
  const KerrParameters fast{.M = 1.0, .a = 0.999};
  EXPECT_LT(fast.photon_orbit_gap(), 0.01 * fast.horizon_radius());
}

TEST(Kerr, without_spin_is_schwarzschild_to_round_off) {
  const PhaseState<double> y({0.3, 1.7, -2.2, 0.9}, {-1.0, 0.4, -0.3, 0.8});
  const PhaseState<double> spinless = KerrSchildIngoing{{.M = 1.0, .a = 0.0}}.flow(y),
                           hole = SchwarzschildIngoing{}.flow(y);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(spinless[i], hole[i], 16.0 * unit);
}

TEST(KerrSchild, light_at_the_horizon_it_is_regular_on_keeps_a_bounded_momentum) {
  // Radial light, E = 1, at r+(1 + 1e-6): falling in the ingoing chart, and its reverse in time in the outgoing one. In
  // the other chart the same ray has p_r of order 1 / (r - r+).
  const SpacetimeOf<SchwarzschildIngoing> in({{.M = 1.0}});
  const SpacetimeOf<SchwarzschildOutgoing> out({{.M = 1.0}});
  const Vec4<double> x{0.0, 2.0 * (1.0 + 1e-6), 0.0, 0.0};
  const PhaseState<double> falling(x, {-1.0, -1.0, 0.0, 0.0});
  EXPECT_LT(in.null_residual(falling), 4.0 * unit);
  const PhaseState<double> back_in_time(x, {1.0, -1.0, 0.0, 0.0});  // p^t = p^r = -1: back in time to the past horizon
  EXPECT_LT(out.null_residual(back_in_time), 4.0 * unit);
  EXPECT_GT(std::abs(change_chart(in, out, falling).state[5]), 1e6);
}

TEST(CarterConstant, is_the_same_on_the_axis_and_beside_it) {
  const KerrSchildIngoing kerr{{.M = 1.0, .a = 0.9}};
  const Vec4<double> p{-1.0, 0.4, -0.3, 0.8};
  const double on_axis = kerr.carter_constant(PhaseState<double>({0.0, 0.0, 0.0, 3.0}, p));
  const double beside = kerr.carter_constant(PhaseState<double>({0.0, 1e-9, 0.0, 3.0}, p));
  EXPECT_TRUE(std::isfinite(on_axis));
  EXPECT_NEAR(beside, on_axis, 1e-8 * on_axis);  // Q moves by its slope times 1e-9
}

TEST(NullMomentum, puts_a_ray_on_the_cone_in_the_sense_asked_for) {
  for (const CatalogueEntry& entry : catalogue()) {
    const auto spacetime = make_spacetime(entry.card->metric, entry.card->chart);
    Vec4<double> x{0.0, 3.1, 0.9, 0.4};
    if (entry.card->metric == "ellipsoid") x[1] = 0.7;
    for (const double sign : {1.0, -1.0}) {
      const auto p = null_momentum(*spacetime, x, {77.0, 0.3, -0.7, 0.2}, sign);
      ASSERT_TRUE(p.has_value()) << entry.card->metric;
      // A dozen operations, on a root that does not cancel.
      EXPECT_LT(spacetime->null_residual({x, *p}), 16.0 * unit) << entry.card->metric << " " << entry.card->chart;
      EXPECT_GT(sign * raise_index(spacetime->inverse_metric(x), *p)[0], 0.0) << entry.card->metric;
      EXPECT_EQ((*p)[1], 0.3);
    }
  }
}

TEST(NullMomentum, finds_the_small_root_without_cancellation) {
  // Light that hovers at the horizon: p_t is 1e-9 of the spatial momentum.
  const SpacetimeOf<SchwarzschildIngoing> hole({{.M = 1.0}});
  const Vec4<double> x{0.0, 2.0 * (1.0 + 1e-9), 0.0, 0.0};
  const auto p = null_momentum(hole, x, {0.0, 1.0, 0.0, 0.0}, 1.0);
  ASSERT_TRUE(p.has_value());
  // p_t = -(1 - f) / (1 + f) p_r with f = 1 / (1 + 1e-9); 1 - f keeps seven digits of the position's sixteen.
  EXPECT_NEAR((*p)[0] / -0.5e-9, 1.0, 1e-6);
}

TEST(NullMomentum, says_when_there_is_no_such_ray) {
  const SpacetimeOf<KerrBoyerLindquist> kerr({{.M = 1.0, .a = 0.5}});
  // Between the horizons t is spacelike: purely angular momentum has no null completion.
  EXPECT_FALSE(null_momentum(kerr, {0.0, 1.0, 1.5, 0.0}, {0.0, 0.0, 1.0, 0.0}, 1.0).has_value());
  EXPECT_FALSE(null_momentum(kerr, {0.0, std::nan(""), 1.5, 0.0}, {0.0, 0.0, 1.0, 0.0}, 1.0).has_value());
}

}  // namespace
}  // namespace xpr
