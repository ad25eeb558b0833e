// The charts of one spacetime describe one spacetime: maps are symplectic, undo each other, and leave H and the
// constants of the motion alone.
#include "metrics/chart_map.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "metrics/catalogue.hpp"
#include "metrics/scalar/multiprecision.hpp"
#include "metrics/spacetimes.hpp"
#include "module_samples.hpp"

namespace xpr {
namespace {

constexpr double unit = std::numeric_limits<double>::epsilon() / 2;

/// Whether the hub chart has room for the event: outside the isotropic charts' own limits nothing else holds back.
template <class M>
bool mappable(const M& module, const PhaseState<double>& y) {
  if constexpr (std::is_same_v<M, EllisIsotropic>) return euclidean_radius(y.x()) >= 0.5 * module.b0;
  return true;
}

template <class M>
constexpr bool has_map = requires(const M& m, const PhaseState<double>& y) {
  m.to_hub(y, 1);
}
|| requires(const M& m, const Vec4<double>& x) { m.to_hub(x, 1); };

/// The largest of |J^T Omega J - Omega| over its 64 components, in units of the products that make it up.
double symplectic_defect(const PhaseState<Dual<Real50, 8>>& image) {
  Real50 worst = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t j = 0; j < 8; ++j) {
      Real50 sum = 0, scale = 1;
      for (std::size_t mu = 0; mu < 4; ++mu) {
        const Real50 a = image[mu].derivative[i] * image[4 + mu].derivative[j];
        const Real50 b = image[4 + mu].derivative[i] * image[mu].derivative[j];
        sum += a - b;
        scale += abs(a) + abs(b);
      }
      const int expected = j == i + 4 ? 1 : (i == j + 4 ? -1 : 0);
      worst = max(worst, Real50(abs(sum - expected) / scale));
    }
  }
  return static_cast<double>(worst);
}

TEST(ChartMaps, are_symplectic) {
  for_each_module([]<class M>(std::type_identity<M> tag) {
    if constexpr (has_map<M>) {
      samples::for_each_state(tag, [](const M& module, const PhaseState<double>& y) {
        if (!mappable(module, y)) return;
        constexpr bool two_sided = requires(const M& m, const Vec4<double>& x) { m.hub_sheet(x); };
        for (const int sheet : {1, -1}) {
          if (sheet < 0 && !two_sided) continue;
          // At 50 digits, so that no conditioning hides a wrong factor: 1e-35 leaves fifteen digits for it.
          const auto hub = state_to_hub(module, samples::seeded<Real50>(y), sheet);
          EXPECT_LE(symplectic_defect(hub), 1e-35) << M::card.metric << " " << M::card.chart;
        }
      });
    }
  });
}

TEST(ChartMaps, undo_each_other_to_fifty_digits) {
  for_each_module([]<class M>(std::type_identity<M> tag) {
    if constexpr (has_map<M>) {
      samples::for_each_state(tag, [](const M& module, const PhaseState<double>& start) {
        if (!mappable(module, start)) return;
        const PhaseState<Real50> y = samples::widened<Real50>(start);
        const PhaseState<Real50> back = state_from_hub(module, state_to_hub(module, y, 1), 1);
        for (std::size_t i = 0; i < 8; ++i) {
          Real50 difference = back[i] - y[i];
          if (i < 4 && M::card.coordinates[i].kind == CoordinateKind::azimuth) {
            difference -= 2 * pi<Real50>() * rint(difference / (2 * pi<Real50>()));
          }
          // Fifty digits less what conditioning costs at the sampled points: 1e-5 from the axis; at 1e-3 from the
          // extremal horizon, where Delta is 1e-6, the Jacobian holds 1 / Delta^2.
          EXPECT_LE(abs(difference), Real50("1e-28") * (1 + abs(y[i])))
              << M::card.metric << " " << M::card.chart << " component " << i;
        }
      });
    }
  });
}

/// What every chart must agree upon, and the size of the terms of H.
struct Invariants {
  double hamiltonian = 0.0;
  double hamiltonian_scale = 0.0;
  std::vector<NamedValue> constants;
  double radius = 0.0;
};

Invariants invariants(const Spacetime& chart, const PhaseState<double>& y) {
  Invariants out;
  out.hamiltonian = chart.hamiltonian(y);
  const SymTensor4<double> g = chart.inverse_metric(y.x());
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = 0; b < 4; ++b) out.hamiltonian_scale += std::abs(g(a, b) * y[4 + a] * y[4 + b]);
  }
  for (const KillingVector& killing : chart.killing_vectors(y.x())) {
    out.constants.push_back({killing.name, killing.sign * contract(killing.component, y.p())});
  }
  if (const auto q = chart.carter_constant(y)) out.constants.push_back({"Q", *q});
  out.radius = chart.radius(y.x());
  return out;
}

/// Events outside horizons and away from the axis, where every chart of a metric is good, as spherical coordinates.
struct Place {
  std::string_view metric;
  std::vector<NamedValue> values;
  std::string_view chart;
  std::vector<double> radii;
};
const std::vector<Place> places = {
    {"minkowski", {}, "spherical", {0.3, 7.0}},
    {"schwarzschild", {{"M", 1.3}}, "areal", {2.7, 4.0, 30.0}},
    {"kerr", {{"M", 1.0}, {"a", 0.9}}, "boyer-lindquist", {1.5, 2.3, 6.0, 50.0}},
    {"kerr", {{"M", 1.0}, {"a", 1.0}}, "boyer-lindquist", {1.2, 6.0}},
    {"kerr", {{"M", 1.0}, {"a", -0.4}}, "boyer-lindquist", {2.2, 6.0}},
    {"ellis", {{"b0", 1.4}}, "proper-distance", {-6.0, -0.2, 0.0, 0.2, 6.0}},
    {"ellipsoid", {{"f", 0.2}}, "geographic", {-0.9, 0.3, 1.1}},
};

TEST(ChartMaps, leave_the_invariants_alone_between_any_two_charts) {
  int compared = 0;
  for (const Place& place : places) {
    const auto classical = make_spacetime(place.metric, place.chart, place.values);
    std::uint64_t seed = 99;
    for (const double r : place.radii) {
      for (const auto& [theta, phi] : {std::pair{0.7, 0.4}, {1.5, -2.3}, {2.6, 2.9}}) {
        const Vec4<double> x{0.8, r, theta, phi};
        const PhaseState<double> start(x, samples::momentum_at(classical->card(), x, ++seed));
        const Invariants expected = invariants(*classical, start);
        for (const CatalogueEntry& first : catalogue()) {
          for (const CatalogueEntry& second : catalogue()) {
            if (first.card->metric != place.metric || second.card->metric != place.metric) continue;
            const auto chart_a = first.make(place.values), chart_b = second.make(place.values);
            const ChartState a = change_chart(*classical, *chart_a, start);
            const ChartState b = change_chart(*chart_a, *chart_b, a.state, a.sheet);
            const Invariants found = invariants(*chart_b, b.state);
            SCOPED_TRACE(fmt::format("{} {} -> {} at r = {}", place.metric, first.card->chart, second.card->chart, r));
            // Three maps of some twenty operations each; 1 / Delta and f, at worst 25 here, enlarge their round-off.
            const double tolerance = 2000.0 * unit;
            EXPECT_NEAR(found.hamiltonian, expected.hamiltonian,
                        tolerance * (found.hamiltonian_scale + expected.hamiltonian_scale));
            ASSERT_EQ(found.constants.size() >= expected.constants.size(), true);
            for (const NamedValue& constant : expected.constants) {
              for (const NamedValue& other : found.constants) {
                if (other.name != constant.name) continue;
                // Angular momenta are r times momenta, Carter's constant their square.
                const double size = 1.0 + square(r) + square(start[6]) + square(start[7]);
                EXPECT_NEAR(other.value, constant.value, tolerance * size) << constant.name;
                ++compared;
              }
            }
            EXPECT_NEAR(found.radius, expected.radius, tolerance * expected.radius);
            const auto l = chart_b->proper_distance(b.state.x(), b.sheet);
            EXPECT_NEAR(l.value_or(r), r, tolerance * (1.0 + std::abs(r)));
          }
        }
      }
    }
  }
  EXPECT_GT(compared, 500);
}

TEST(ChartMaps, are_the_identity_to_the_bit_within_one_chart) {
  const auto kerr = make_spacetime("kerr", "boyer-lindquist"), same = make_spacetime("kerr", "boyer-lindquist");
  const PhaseState<double> y({0.1, 3.3, 0.2, -0.7}, {-1.0, 0.3, 2.2, 0.1});
  EXPECT_EQ(change_chart(*kerr, *same, y, -1).state.c, y.c);
  EXPECT_EQ(change_chart(*kerr, *same, y, -1).sheet, -1);
}

TEST(ChartMaps, refuse_to_go_between_metrics) {
  EXPECT_THROW((void)change_chart(*make_spacetime("kerr", ""), *make_spacetime("ellis", ""), {}),
               std::invalid_argument);
}

TEST(ChartMaps, keep_their_accuracy_near_and_on_the_axis_between_regular_charts) {
  for (const auto& [metric, charts] :
       {std::pair{"kerr", std::vector<std::string_view>{"kerr-schild", "kerr-schild-outgoing"}},
        {"schwarzschild", {"kerr-schild", "kerr-schild-outgoing", "isotropic"}}}) {
    for (const std::string_view from : charts) {
      for (const std::string_view to : charts) {
        const auto chart_a = make_spacetime(metric, from), chart_b = make_spacetime(metric, to);
        for (const double offset : {0.0, 1e-300, 1e-12, 1e-3}) {
          const PhaseState<double> y({0.5, offset, -0.4 * offset, 4.0}, {-1.0, 0.3, 0.2, -0.8});
          const PhaseState<double> back =
              change_chart(*chart_b, *chart_a, change_chart(*chart_a, *chart_b, y).state).state;
          for (std::size_t i = 0; i < 8; ++i) {
            // Two maps of some forty operations; their Jacobians hold 2 M r / Delta = 1 and less.
            EXPECT_NEAR(back[i], y[i], 64.0 * unit * (i == 1 || i == 2 ? offset : 4.0)) << metric << from << to << i;
          }
        }
      }
    }
  }
}

TEST(ChartMaps, lose_next_to_a_horizon_what_the_other_chart_cannot_hold) {
  // 2026-11-22: light at 1.03 horizon radii of a = 0.999 M lost nine digits of p between the two Kerr-Schild charts:
  // the round-off of the angle between them was multiplied by p_r = 1e3 and again by Phi' = 5e2.
  const std::vector<NamedValue> values{{"M", 1.0}, {"a", 0.999}};
  const auto out = make_spacetime("kerr", "kerr-schild-outgoing", values),
             in = make_spacetime("kerr", "kerr-schild", values);
  for (const double factor : {1.02, 1.05, 1.4, 3.0}) {
    const double r = factor * out->horizon_radius().value();
    const double amplified = 2.0 * r / ((r - 1.0) * (r - 1.0) - (1.0 - 0.999) * (1.0 + 0.999));
    for (const double phi : {0.3, 2.0, -1.4}) {
      const double across = std::hypot(r, 0.999) * std::sin(1.2);
      const PhaseState<double> y({0.5, across * std::cos(phi), across * std::sin(phi), r * std::cos(1.2)},
                                 {-1.0, 0.6, -0.8, 0.4});
      const PhaseState<double> back = change_chart(*in, *out, change_chart(*out, *in, y).state).state;
      // p_r = 2 M r / Delta there, and L is good to its round-off; 2 a L / Delta is taken off again.
      for (std::size_t i = 5; i < 8; ++i) EXPECT_NEAR(back[i], y[i], 16.0 * unit * square(amplified) + 64.0 * unit);
    }
  }
}

TEST(ChartMaps, through_a_spherical_chart_lose_next_to_the_axis_what_angles_cannot_hold) {
  const auto regular = make_spacetime("kerr", "kerr-schild"), polar = make_spacetime("kerr", "boyer-lindquist");
  for (const double z : {4.0, -4.0}) {
    for (const double offset : {1e-12, 1e-8, 1e-3}) {
      const PhaseState<double> y({0.5, offset, -0.4 * offset, z}, {-1.0, 0.3, 0.2, -0.8});
      const PhaseState<double> back = change_chart(*polar, *regular, change_chart(*regular, *polar, y).state).state;
      // theta near pi is a multiple of 4.4e-16: r times half of it, plus round-off. Directions about the axis turn by
      // that over the offset.
      const double lost = z < 0.0 ? 4.0 * 2.3e-16 : 0.0;
      for (const std::size_t i : {1U, 2U}) EXPECT_NEAR(back[i], y[i], 2.0 * lost + 64.0 * unit * offset) << z << offset;
      for (const std::size_t i : {5U, 6U, 7U}) EXPECT_NEAR(back[i], y[i], lost / offset + 64.0 * unit) << z << offset;
    }
  }
}

TEST(ChartMaps, take_a_ray_on_the_axis_into_the_plane_of_its_azimuth) {
  const auto regular = make_spacetime("schwarzschild", "kerr-schild");
  const auto polar = make_spacetime("schwarzschild", "areal");
  const PhaseState<double> on_axis({0.0, 5.0, 0.0, 0.6}, {-1.0, 0.3, 2.0, 0.0});
  const PhaseState<double> y = change_chart(*polar, *regular, on_axis).state;
  EXPECT_EQ(y[1], 0.0);
  EXPECT_EQ(y[2], 0.0);
  // p_theta / r along the azimuth 0.6, nothing across it.
  EXPECT_NEAR(y[5], 0.4 * std::cos(0.6), 4.0 * unit);
  EXPECT_NEAR(y[6], 0.4 * std::sin(0.6), 4.0 * unit);
}

/// T(r) and Phi(r) as the design prints them, at 50 digits.
KerrShift<Real50> printed_shift(double mass, double spin, double radius) {
  const Real50 M = mass, a = spin, r = radius, w = sqrt(M * M - a * a);
  if (w == 0) return {2 * M * log(abs((r - M) / (2 * M))) - 2 * M * M / (r - M), -a / (r - M)};
  const Real50 r_plus = M + w, r_minus = M - w;
  return {2 * M / (r_plus - r_minus) *
              (r_plus * log(abs((r - r_plus) / (2 * M))) - r_minus * log(abs((r - r_minus) / (2 * M)))),
          a / (r_plus - r_minus) * log(abs((r - r_plus) / (r - r_minus)))};
}

TEST(KerrShift, has_the_printed_constants_up_to_the_extremal_spin) {
  for (const double a : {0.3, -0.9, 0.998, 1.0 - 1e-9, 1.0 - 0x1p-53, 1.0}) {
    const KerrParameters kerr{.M = 1.0, .a = a};
    for (const double r : {0.4, 1.2, 1.9, 2.0, 3.7, 10.0, 1e4}) {
      const KerrShift<Real50> exact = printed_shift(1.0, a, r);
      const KerrShift<double> shift = kerr_shift(kerr, r);
      // Round-off of r - r+- and of the logarithms, both of order one at these radii.
      EXPECT_NEAR(shift.time, static_cast<double>(exact.time), 32.0 * unit * (4.0 + std::abs(shift.time)))
          << "a = " << a << " r = " << r;
      EXPECT_NEAR(shift.azimuth, static_cast<double>(exact.azimuth), 32.0 * unit * (1.0 + std::abs(shift.azimuth)))
          << "a = " << a << " r = " << r;
    }
  }
}

TEST(KerrShift, is_that_of_schwarzschild_without_spin) {
  for (const double r : {1.0, 2.2, 30.0}) {
    EXPECT_NEAR(kerr_shift(KerrParameters{.M = 1.0, .a = 0.0}, r).time, SchwarzschildMass{}.time_shift(r - 2.0),
                16.0 * unit * (1.0 + std::abs(std::log(r))));
  }
}

TEST(ChartMaps, give_what_a_chart_says_of_its_azimuth_modulo_whole_turns) {
  for (const double a : {0.0, 0.9, -0.7, 0.998}) {
    const std::array<NamedValue, 2> hole{{{"M", 1.0}, {"a", a}}};
    const auto classical = make_spacetime("kerr", "boyer-lindquist", hole);
    const double w = std::sqrt(1.0 - a * a), outer = 1.0 + w, inner = 1.0 - w;
    for (const double sense : {1.0, -1.0}) {
      const auto regular = make_spacetime("kerr", sense > 0.0 ? "kerr-schild" : "kerr-schild-outgoing", hole);
      for (const double r : {30.0, 3.0, outer * (1.0 + 1e-3), outer * (1.0 + 1e-9)}) {
        const PhaseState<double> y({0.0, r, 0.8, 0.4}, {-1.0, 0.0, 0.0, 0.0});
        const PhaseState<double> image = change_chart(*classical, *regular, y).state;
        const double offset = regular->azimuth_offset(image.x()).value();
        // r - r+ comes back from Cartesian coordinates with a few units of round-off of r+, and its logarithm with as
        // many over 1e-9, times a / (r+ - r-) <= 8.
        const double tolerance = 1e-14 + 64.0 * unit * outer / (r - outer);
        const double winding = a / (2.0 * w) * std::log(std::abs((r - outer) / (r - inner)));
        EXPECT_NEAR(offset, -sense * (winding + std::atan(a / r)), tolerance) << a << " " << r << " " << sense;
        const double mapped = 0.4 - std::atan2(image[2], image[1]);
        EXPECT_NEAR(std::remainder(mapped - offset, 2.0 * std::numbers::pi), 0.0, tolerance) << a << " " << r;
      }
    }
  }
  EXPECT_FALSE(make_spacetime("minkowski", "cartesian")->azimuth_offset({}).has_value());
}

}  // namespace
}  // namespace xpr
