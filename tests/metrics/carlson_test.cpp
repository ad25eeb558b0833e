#include "metrics/carlson.hpp"

#include <gtest/gtest.h>

#include <boost/math/special_functions/ellint_rd.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <boost/math/special_functions/ellint_rj.hpp>
#include <cmath>
#include <random>

#include "metrics/bounded.hpp"
#include "metrics/scalar/pack.hpp"
#include "metrics/wide.hpp"

namespace {

using namespace xpr;

double relative(double value, const Quad& reference) { return std::abs(static_cast<double>(value / reference - 1)); }

// Legendre's arguments from tiny to complete amplitudes, parameters to 100, characteristics within 1e-12 of one;
// against Boost's integrals at 113 bits.
TEST(Carlson, three_integrals_keep_fifteen_digits) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double worst = 0.0;
  for (int i = 0; i < 400; ++i) {
    const double amplitude = 1.57 * unit(engine) * (i % 3 == 0 ? 1e-3 : 1.0);
    const double sine = i % 5 == 0 ? 1.0 : std::sin(amplitude), cosine = i % 5 == 0 ? 0.0 : std::cos(amplitude);
    const double m = std::pow(10.0, -8.0 + 10.0 * unit(engine)), rest = std::pow(10.0, -12.0 * unit(engine));
    const double x = cosine * cosine, y = 1.0 + m * sine * sine, z = 1.0, p = x + rest * sine * sine;
    const auto got = carlson::first_second_third(x, y, z, p);
    worst = std::max({worst, relative(got.f, boost::math::ellint_rf(Quad(x), Quad(y), Quad(z))),
                      relative(got.d, boost::math::ellint_rd(Quad(x), Quad(y), Quad(z))),
                      relative(got.j, boost::math::ellint_rj(Quad(x), Quad(y), Quad(z), Quad(p)))});
  }
  EXPECT_LE(worst, 1e-15);  // some five duplications of a few roundings each: 3 units of 2.2e-16 at worst
}

TEST(Carlson, lanes_are_the_double) {
  Pack<2> x(0.0), p(0.25);
  set_lane(x, 1, 0.3);
  set_lane(p, 1, 0.31);
  const auto both = carlson::first_second_third<Pack<2>>(x, 1.5, 1.0, p);
  for (int i = 0; i < 2; ++i) {
    const auto one = carlson::first_second_third(lane(x, i), 1.5, 1.0, lane(p, i));
    // A lane may go through one duplication more for its neighbour's sake.
    EXPECT_NEAR(lane(both.f, i), one.f, 1e-15 * one.f);
    EXPECT_NEAR(lane(both.d, i), one.d, 1e-15 * one.d);
    EXPECT_NEAR(lane(both.j, i), one.j, 1e-15 * one.j);
  }
}

TEST(Wide, keeps_thirty_digits) {
  std::mt19937_64 engine(2);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const Wide x = Wide(unit(engine)) + Wide(1e-17 * unit(engine)), y = Wide(unit(engine)) + Wide(1e-17 * unit(engine));
    const Quad a = Quad(x.high) + x.low, b = Quad(y.high) + y.low;
    const auto close = [](const Wide& got, const Quad& truth, const Quad& size) {
      EXPECT_LE(static_cast<double>(abs(Quad(got.high) + got.low - truth) / size), 0x1p-100);
    };
    close(x + y, a + b, abs(a) + abs(b));
    close(x - y, a - b, abs(a) + abs(b));
    close(x * y, a * b, abs(a * b));
    close(x / y, a / b, abs(a / b));
    close(sqrt(x * x), abs(a), abs(a));
    const double theta = 3.14159 * std::abs(unit(engine));
    const WideSincos wide = wide_sincos(theta);
    close(wide.sine, sin(Quad(theta)), Quad(1));
    close(wide.cosine, cos(Quad(theta)), Quad(1));
  }
  EXPECT_EQ(sqrt(Wide(0.0)).high, 0.0);
}

}  // namespace
