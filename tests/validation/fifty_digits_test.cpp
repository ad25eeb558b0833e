// The 50-digit integrator: right where the answer is known, honest about its own error, in every chart; and Kerr by two
// formulations.
#include "validation/truth/fifty_digits.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "metrics/catalogue.hpp"
#include "validation/truth/kerr_first_integrals.hpp"

namespace xpr {
namespace {

double miss(const Real50& x, const Real50& y) { return static_cast<double>(abs(x - y)); }

TEST(FiftyDigits, an_oscillator_turns_as_sine_and_cosine) {
  const Rates50 oscillator = [](const std::vector<Real50>& y, std::vector<Real50>& rate) {
    rate[0] = y[1];
    rate[1] = -y[0];
  };
  for (const double until : {1.0, 20.0, -7.0}) {
    const Path50 end = integrate50(oscillator, {0, 1}, Real50(until));
    // Some steps, each within 1e-42.
    EXPECT_LT(miss(end.y[0], sin(Real50(until))), 1e-40) << until;
    EXPECT_LT(miss(end.y[1], cos(Real50(until))), 1e-40) << until;
    EXPECT_EQ(miss(end.at, Real50(until)), 0.0);
  }
  // From -1 at pi, where the sine falls through zero; not at the start, where it rises.
  const Path50 half = integrate50_to(
      oscillator, {0, 1}, [](const std::vector<Real50>& y) { return y[0]; }, -1, Real50(0.5), Real50(10));
  EXPECT_LT(miss(half.at, Constants<Real50>::pi()), 1e-40);
  EXPECT_THROW((void)integrate50_to(
                   oscillator, {0, 1}, [](const std::vector<Real50>& y) { return Real50(y[0] - 2); }, 1, Real50(0.5),
                   Real50(10)),
               std::runtime_error);
}

TEST(FiftyDigits, a_pole_in_the_way_is_an_error_not_a_number) {
  const Rates50 explodes = [](const std::vector<Real50>& y, std::vector<Real50>& rate) { rate[0] = y[0] * y[0]; };
  EXPECT_LT(miss(integrate50(explodes, {1}, Real50(0.5)).y[0], 2), 1e-40);
  EXPECT_THROW((void)integrate50(explodes, {1}, Real50(2)), std::runtime_error);
}

TEST(FiftyDigits, columns_raise_the_order_by_two_each) {
  const Rates50 grows = [](const std::vector<Real50>& y, std::vector<Real50>& rate) { rate[0] = y[0]; };
  // A tolerance that every step meets: steps are the same, until/16 and up to 4 times as long each.
  const auto error = [&](int columns, double until) {
    return miss(integrate50(grows, {1}, Real50(until), {.columns = columns, .tol = 1.0}).y[0], exp(Real50(until)));
  };
  for (const int columns : {2, 4, 6}) {
    const double order = std::log2(error(columns, 0.5) / error(columns, 0.25)) - 1.0;  // the local order is one more
    EXPECT_NEAR(order, 2.0 * columns, 0.5) << columns;
  }
}

TEST(FiftyDigits, hold_the_light_cone_and_the_constants_in_kerr) {
  const std::array<NamedValue, 2> values = {{{"M", 1.0}, {"a", 0.9}}};
  const Rates50 flow = flow50("kerr", "boyer-lindquist", values);
  const KerrRay ray{0.9, 10.0, 1.2, 1.5, 3.0, 10.0, true};
  const auto carter = [&](const std::vector<Real50>& y) {
    const Real50 c = cos(y[2]), s = sin(y[2]), a = 0.9;
    return Real50(y[6] * y[6] + c * c * (y[7] * y[7] / (s * s) - a * a * y[4] * y[4]));
  };
  const std::vector<Real50> start = {0, 10, 1.2, 0, -1, kerr_ray_start(ray).p_r, 3, 1.5};
  const Path50 end = integrate50(flow, start, Real50(6));
  EXPECT_LT(miss(carter(end.y), kerr_ray_start(ray).Q), 1e-38);
  EXPECT_EQ(miss(end.y[4], -1), 0.0);
  EXPECT_EQ(miss(end.y[7], 1.5), 0.0);
}

TEST(FiftyDigits, know_every_chart_of_the_catalogue) {
  for (const CatalogueEntry& entry : catalogue()) {
    EXPECT_TRUE(flow50(entry.card->metric, entry.card->chart)) << entry.card->metric << " " << entry.card->chart;
  }
  EXPECT_THROW((void)flow50("kerr", "areal"), std::invalid_argument);
}

// Gralla and Lupsasca's elliptic integrals and a Hamiltonian integration elsewhere agree on this ray to 1e-33; 18 of
// the digits are written down.
TEST(KerrRay, by_first_integrals_and_by_hamiltonian_ends_where_others_have_it) {
  const KerrRay ray{0.6, 50.0, 1.0, 2.0, 6.0, 50.0, true};
  EXPECT_LT(miss(kerr_ray_start(ray).Q, Real50("37.5440381403280533")), 1e-16);
  EXPECT_LT(miss(kerr_ray_start(ray).p_r, Real50("-1.03322680185732755")), 1e-17);
  const KerrRayEnd end = kerr_ray_by_first_integrals(ray);
  EXPECT_LT(miss(end.theta, Real50("1.2812911704019574")), 1e-16);
  EXPECT_LT(miss(end.phi, Real50("3.58737316228051762")), 1e-17);
  EXPECT_LT(miss(end.t, Real50("118.228672106212655")), 1e-15);
  EXPECT_LT(miss(end.affine, Real50("102.455218678658406")), 1e-15);
  EXPECT_LT(miss(end.mino, Real50("0.627716918138907188")), 1e-18);
}

}  // namespace
}  // namespace xpr
