// The modules' connection and curvature against closed forms printed in textbooks.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "metrics/spacetimes.hpp"
#include "module_samples.hpp"

namespace xpr {
namespace {

constexpr double unit = std::numeric_limits<double>::epsilon() / 2;

TEST(SchwarzschildAreal, has_the_textbook_christoffel_symbols) {
  const SchwarzschildAreal hole{{.M = 1.3}};
  const double M = 1.3, r = 5.2, theta = 0.8;
  const double s = std::sin(theta), c = std::cos(theta);
  // [MisnerThorneWheeler1973]; every symbol not named is zero.
  Connection<double> expected{};
  expected[0](0, 1) = M / (r * (r - 2.0 * M));
  expected[1](0, 0) = M * (r - 2.0 * M) / (r * r * r);
  expected[1](1, 1) = -M / (r * (r - 2.0 * M));
  expected[1](2, 2) = -(r - 2.0 * M);
  expected[1](3, 3) = -(r - 2.0 * M) * s * s;
  expected[2](1, 2) = expected[3](1, 3) = 1.0 / r;
  expected[2](3, 3) = -s * c;
  expected[3](2, 3) = c / s;
  const Connection<double> gamma = christoffel(hole, Vec4<double>{0.0, r, theta, 0.3});
  for (std::size_t l = 0; l < 4; ++l) {
    for (std::size_t k = 0; k < 10; ++k) {
      EXPECT_NEAR(gamma[l].c[k], expected[l].c[k], 32.0 * unit * (1.0 + std::abs(expected[l].c[k]))) << l << k;
    }
  }
}

double largest_riemann(const Curvature& curvature) {
  double out = 0.0;
  for (const double v : curvature.riemann) out = std::max(out, std::abs(v));
  return out;
}

/// R_{abcd} R^{abcd}.
double kretschmann(const Spacetime& spacetime, const Vec4<double>& x) {
  const Curvature curvature = spacetime.curvature(x);
  const SymTensor4<double> down = spacetime.metric(x), up = spacetime.inverse_metric(x);
  double sum = 0.0;
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = 0; b < 4; ++b) {
      for (std::size_t c = 0; c < 4; ++c) {
        for (std::size_t d = 0; d < 4; ++d) {
          // R_{abcd} with the first index lowered, R^{abcd} with the last three raised.
          double lowered = 0.0, raised = 0.0;
          for (std::size_t e = 0; e < 4; ++e) {
            lowered += down(a, e) * curvature(e, b, c, d);
            for (std::size_t f = 0; f < 4; ++f) {
              for (std::size_t g = 0; g < 4; ++g) {
                raised += up(b, e) * up(c, f) * up(d, g) * curvature(a, e, f, g);
              }
            }
          }
          sum += lowered * raised;
        }
      }
    }
  }
  return sum;
}

/// Calls check(module, x) at sampled events of a module within 20 length units, away from where the chart ends: the
/// axis of polar charts, and horizons on which g^{tt} is infinite.
template <class M, class Check>
void for_each_near_event(std::type_identity<M> tag, const Check& check) {
  for (const auto& sample : samples::samples_of(tag)) {
    for (const Vec4<double>& x : sample.events) {
      if (sample.module.radius(x) > 20.5) continue;
      const bool polar = M::card.coordinates[2].kind == CoordinateKind::polar_angle;
      if (polar && std::sin(x[2]) < 0.1) continue;
      if (std::abs(sample.module.inverse_metric(x)(0, 0)) > 100.0) continue;
      check(sample.module, x);
    }
  }
}

TEST(VacuumModules, are_ricci_flat_where_the_curvature_is_not_small) {
  int graded = 0;
  for_each_module([&]<class M>(std::type_identity<M> tag) {
    if constexpr (M::card.vacuum) {
      for_each_near_event(tag, [&](const M& module, const Vec4<double>& x) {
        const Curvature curvature = xpr::curvature(module, x);
        double ricci = 0.0;
        for (const double v : curvature.ricci.c) ricci = std::max(ricci, std::abs(v));
        // Sums of a few dozen terms as large as those of the connection; 30 units measured.
        const double round_off = 100.0 * unit * curvature.connection_scale;
        EXPECT_LE(ricci, round_off) << M::card.metric << " " << M::card.chart << " r = " << module.radius(x);
        if (largest_riemann(curvature) > 1e3 * round_off) ++graded;
      });
    }
  });
  EXPECT_GT(graded, 200);  // elsewhere space is flat, or too flat to tell
}

TEST(Schwarzschild, has_the_kretschmann_scalar_of_its_mass_in_every_chart) {
  for_each_module([]<class M>(std::type_identity<M> tag) {
    if constexpr (std::is_base_of_v<SchwarzschildMass, M>) {
      for_each_near_event(tag, [](const M& module, const Vec4<double>& x) {
        const double r = module.radius(x);
        const double expected = 48.0 * module.M * module.M / std::pow(r, 6);
        // Curvature falls as M / r^3 while the terms it is made of fall as 1 / r^2; 1.2e-14 (1 + r / M) measured.
        EXPECT_NEAR(kretschmann(SpacetimeOf<M>(module), x) / expected, 1.0, 1e-13 * (1.0 + r / module.M))
            << M::card.chart << " r = " << r;
      });
    }
  });
}

TEST(Kerr, has_the_kretschmann_scalar_of_its_mass_and_spin_in_every_chart) {
  for_each_module([]<class M>(std::type_identity<M> tag) {
    if constexpr (std::is_base_of_v<KerrParameters, M>) {
      for_each_near_event(tag, [](const M& module, const Vec4<double>& x) {
        const double r = module.radius(x);
        const double cos_theta = samples::is_cartesian(M::card) ? x[3] / r : std::cos(x[2]);
        const double u = r * r, v = module.a * module.a * cos_theta * cos_theta;
        const double expected = 48.0 * module.M * module.M * (u - v) * (square(u + v) - 16.0 * u * v);
        const double size = 48.0 * module.M * module.M * (u + v) * (square(u + v) + 16.0 * u * v);
        EXPECT_NEAR(kretschmann(SpacetimeOf<M>(module), x) * std::pow(u + v, 6) / size, expected / size,
                    1e-13 * (1.0 + r / module.M))
            << M::card.chart << " a = " << module.a << " r = " << r;
      });
    }
  });
}

TEST(Ellis, has_one_ricci_component_and_it_is_negative) {
  const EllisProperDistance wormhole{{.b0 = 1.4}};
  for (const double l : {-3.0, -0.1, 0.0, 0.7, 5.0}) {
    const SymTensor4<double> ricci = curvature(wormhole, Vec4<double>{0.0, l, 0.9, 0.2}).ricci;
    const double expected = -2.0 * 1.96 / square(1.96 + l * l);
    for (std::size_t mu = 0; mu < 4; ++mu) {
      for (std::size_t nu = mu; nu < 4; ++nu) {
        EXPECT_NEAR(ricci(mu, nu), mu == 1 && nu == 1 ? expected : 0.0, 1e-13) << l << mu << nu;
      }
    }
  }
}

TEST(Ellis, isotropic_chart_has_the_same_ricci_scalar) {
  const EllisIsotropic wormhole{{.b0 = 1.4}};
  for (const double rho : {0.5, 0.7, 1.1, 4.0}) {
    const Vec4<double> x{0.0, 0.6 * rho, 0.0, -0.8 * rho};
    const SymTensor4<double> ricci = curvature(wormhole, x).ricci, up = wormhole.inverse_metric(x);
    double scalar = 0.0;
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = 0; b < 4; ++b) scalar += up(a, b) * ricci(a, b);
    }
    const double l = wormhole.proper_distance(x, 1);
    EXPECT_NEAR(scalar, -2.0 * 1.96 / square(1.96 + l * l), 1e-13) << rho;
  }
}

TEST(Ellipsoid, has_the_gaussian_curvature_of_the_spheroid_in_both_charts) {
  for_each_module([]<class M>(std::type_identity<M> tag) {
    if constexpr (std::is_base_of_v<Spheroid, M>) {
      for_each_near_event(tag, [](const M& module, const Vec4<double>& x) {
        const double nu_3 = std::is_same_v<M, EllipsoidGeographic> ? std::sin(x[1]) : std::cos(x[1]) * std::sin(x[2]);
        const double e_sq = module.f * (2.0 - module.f);
        // 1 / (m N), the product of the principal curvatures.
        const double gauss = square(1.0 - e_sq * nu_3 * nu_3) / (square(module.a_axis) * (1.0 - e_sq));
        const Curvature curvature = xpr::curvature(module, x);
        const SymTensor4<double> g = covariant_metric(module, x);
        const double scale = curvature.connection_scale + gauss * (std::abs(g(1, 1)) + std::abs(g(2, 2)));
        for (std::size_t mu = 0; mu < 4; ++mu) {
          for (std::size_t nu = mu; nu < 4; ++nu) {
            const bool on_surface = (mu == 1 || mu == 2) && (nu == 1 || nu == 2);
            EXPECT_NEAR(curvature.ricci(mu, nu), on_surface ? gauss * g(mu, nu) : 0.0, 1e3 * unit * scale)
                << M::card.chart << " f = " << module.f << " at " << x[1] << " " << x[2];
          }
        }
      });
    }
  });
}

}  // namespace
}  // namespace xpr
