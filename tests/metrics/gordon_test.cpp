// Gordon's metric: it is one metric, at rest it is the static medium, and its vortex sweeps what is printed of it.
#include "metrics/gordon.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "metrics/derived.hpp"
#include "metrics/medium.hpp"
#include "metrics/shaped_media_exact.hpp"
#include "metrics/vortex_exact.hpp"

namespace xpr {
namespace {

TEST(Gordon, covariant_and_contravariant_metric_are_inverse_to_each_other) {
  for (const double n : {0.7, 1.0, 4.0 / 3.0, 2.4}) {
    for (const std::array<double, 3>& v : {std::array<double, 3>{0.0, 0.0, 0.0}, {0.3, -0.5, 0.1}, {0.0, 0.9, -0.3}}) {
      const Vec4<double> u = four_velocity(v);
      const SymTensor4<double> upper = gordon_inverse(n, u), lower = gordon_covariant(n, u);
      for (std::size_t a = 0; a < 4; ++a) {
        for (std::size_t b = 0; b < 4; ++b) {
          double sum = 0.0;
          for (std::size_t c = 0; c < 4; ++c) sum += upper(a, c) * lower(c, b);
          EXPECT_NEAR(sum, a == b ? 1.0 : 0.0, 1e-13 * square(u[0]) * square(u[0]));
        }
      }
    }
  }
}

TEST(Gordon, at_rest_is_the_static_medium) {
  for (const double n : {0.7, 1.0, 1.5}) {
    const SymTensor4<double> moving = gordon_inverse(n, four_velocity<double>({0.0, 0.0, 0.0}));
    const SymTensor4<double> still = MediumUniform{{.n = n}}.inverse_metric(Vec4<double>{});
    for (std::size_t c = 0; c < 10; ++c) EXPECT_NEAR(moving.c[c], still.c[c], 4e-16);
  }
}

TEST(Gordon, adds_velocities_as_relativity_does) {
  // Along a flow of 0.1 in n = 1.5 light runs at (1/n + v)/(1 + v/n) [Fizeau]: a null vector of g_{mn}.
  const SymTensor4<double> g = gordon_covariant(1.5, four_velocity<double>({0.1, 0.0, 0.0}));
  for (const double speed : {(1.0 / 1.5 + 0.1) / (1.0 + 0.1 / 1.5), (-1.0 / 1.5 + 0.1) / (1.0 - 0.1 / 1.5)}) {
    const Vec4<double> V = {1.0, speed, 0.0, 0.0};
    EXPECT_NEAR(contract(V, raise_index(g, V)), 0.0, 1e-15);
  }
}

TEST(Vortex, turns_where_its_radial_momentum_vanishes) {
  for (const double J : {5.0, -5.0, 0.9, -1.5}) {
    const vortex_exact::Light light{.n = 4.0 / 3.0, .W = 0.25, .J = J, .p_z = 0.2};
    const double r0 = vortex_exact::periapsis(light);
    EXPECT_NEAR(vortex_exact::radial_momentum_squared(light, r0), 0.0, 1e-13);
    EXPECT_GT(vortex_exact::radial_momentum_squared(light, 1.001 * r0), 0.0);
  }
  // Against the vortex light falls in sooner: at J = -1.1 the discriminant of P is 0.71 - 0.93.
  EXPECT_THROW((void)vortex_exact::periapsis({.n = 4.0 / 3.0, .W = 0.25, .J = -1.1, .p_z = 0.2}), std::domain_error);
  EXPECT_THROW((void)vortex_exact::periapsis({.n = 1.5, .W = 0.25, .J = 0.0}), std::domain_error);
  EXPECT_THROW((void)vortex_exact::swept({.n = 1.5, .W = 0.25, .J = 5.0}, 1.0, 20.0), std::domain_error);
}

TEST(Vortex, sweeps_what_is_printed) {
  // n = 4/3, W = 0.25, J = n b - k W, both senses, from infinity to infinity; mpmath, 18 digits. Beyond r light goes
  // straight but for W^2/r^3: the tail is asin(b/r).
  const double n = 4.0 / 3.0, k = n * n - 1.0, r = 4000.0;
  for (const auto& [b, wanted] : {std::pair{4.0, 3.14807243272816392}, {-4.0, -3.14970638543444791}}) {
    const ExactValue swept = vortex_exact::swept({.n = n, .W = 0.25, .J = n * b - k * 0.25}, r, r);
    // k W (1/J r) shifts cancel between in and out up to W/r^2.
    EXPECT_NEAR(swept.value + 2.0 * std::asin(b / r), wanted, 1e-7);
    EXPECT_LT(swept.error, 1e-14);
  }
}

TEST(FibreExact, solves_hamiltons_equations) {
  const PhaseState<double> start({0.0, 1.2, -0.7, 0.3}, {-1.0, 0.6, 0.5, 0.9});
  constexpr double n0 = 1.5, g = 0.3, at = 7.3, h = 1e-3;
  const auto y = [&](double lambda) { return shaped_media_exact::fibre_ray(n0, g, start, lambda).y; };
  const PhaseState<double> here = y(at), before = y(at - h), after = y(at + h);
  const double n_sq = n0 * n0 * (1.0 - g * g * (here[1] * here[1] + here[2] * here[2]));
  const std::array<double, 8> rate = {
      n_sq, here[5], here[6], here[7], 0.0, -n0 * n0 * g * g * here[1], -n0 * n0 * g * g * here[2], 0.0};
  // Central differences: h^2 times the third derivative, of order one, over six.
  for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR((after[i] - before[i]) / (2.0 * h), rate[i], 3e-7) << i;
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(y(0.0)[i], start[i]);
}

}  // namespace
}  // namespace xpr
