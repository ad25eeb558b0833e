// Constraint projection: drift goes to round-off, the order stays, and nothing moves that should not.
#include <gtest/gtest.h>

#include <string>

#include "integrators/projection.hpp"
#include "rays.hpp"

namespace xpr {
namespace {

constexpr Projection all_projections[] = {Projection::energy, Projection::momentum, Projection::full};

/// A ray past a Kerr hole, off the equator, close enough to drift.
PhaseState<double> kerr_ray(const Spacetime& kerr) {
  PhaseState<double> y{{0.0, 12.0, 5.5, 1.0}, {-1.0, -1.0, 0.02, -0.03}};
  EXPECT_TRUE(restore_momentum(kerr, y));
  return y;
}

double constant(const Spacetime& spacetime, const PhaseState<double>& y, std::string_view name) {
  for (const KillingConstant& k : spacetime.killing_constants(y)) {
    if (k.name == name) return k.value;
  }
  ADD_FAILURE() << "no constant " << name;
  return 0.0;
}

TEST(Projection, drives_the_null_residual_to_round_off) {
  const auto kerr = make_spacetime("kerr", "kerr-schild");
  const PhaseState<double> start = kerr_ray(*kerr);
  TraceSettings settings;
  settings.tol = 1e-6;
  settings.r_max = 30.0;
  const RayEnd free = trace_ray(*kerr, start, 1, settings);
  ASSERT_EQ(free.status, Status::escaped);
  EXPECT_GT(free.null_residual_max, 1e-9) << "without projection it drifts";
  for (const Projection projection : all_projections) {
    settings.projection = projection;
    const RayEnd end = trace_ray(*kerr, start, 1, settings);
    EXPECT_EQ(end.status, Status::escaped);
    EXPECT_LE(end.null_residual, 1e-14) << static_cast<int>(projection);
    EXPECT_LE(end.null_residual_max, 1e-14) << static_cast<int>(projection);
  }
}

TEST(FullProjection, keeps_the_impact_parameter_where_the_free_ray_loses_it) {
  const auto hole = make_spacetime("schwarzschild", "isotropic");
  const PhaseState<double> start = test::isotropic_ray(*hole, {0.0, -30.0, 6.0, 1.0}, {0.0, 1.0, 0.0, 0.0});
  TraceSettings settings;
  settings.method = "rk4";
  settings.step = 0.2;
  settings.r_max = 40.0;
  const auto drift = [&](Projection projection) {
    settings.projection = projection;
    const RayEnd end = trace_ray(*hole, start, 1, settings);
    EXPECT_EQ(end.status, Status::escaped);
    double worst = 0.0;
    for (const char* name : {"L_x", "L_y", "L_z"}) {
      const double before = constant(*hole, start, name) / constant(*hole, start, "E");
      const double after = constant(*hole, end.y, name) / constant(*hole, end.y, "E");
      worst = std::max(worst, std::abs(after - before));
    }
    return worst;
  };
  EXPECT_GT(drift(Projection::none), 1e-9);
  EXPECT_GT(drift(Projection::momentum), 1e-9) << "rescaling the momentum moves it";
  // x p_y - y p_x with |x| = 40: a few roundings of terms of size 40.
  EXPECT_LT(drift(Projection::full), 5e-14);
}

TEST(Projection, keeps_the_order_of_the_method) {
  const auto medium = test::fisheye();
  for (const char* method : {"heun2", "rk4"}) {
    for (const Projection projection : all_projections) {
      TraceSettings settings;
      settings.method = method;
      settings.projection = projection;
      settings.step = method[0] == 'h' ? 0.01 : 0.05;
      const double coarse = test::turn_error(*medium, settings);
      settings.step /= 2;
      const double fine = test::turn_error(*medium, settings);
      EXPECT_GT(std::log2(coarse / fine), method_card(method).order - 0.15)
          << method << " " << static_cast<int>(projection);
    }
  }
}

TEST(EnergyProjection, keeps_the_sign_of_the_time_rate) {
  const auto kerr = make_spacetime("kerr", "kerr-schild");
  for (const double sense : {+1.0, -1.0}) {
    PhaseState<double> y = kerr_ray(*kerr);
    for (std::size_t i = 4; i < 8; ++i) y[i] *= sense;
    const double rate = kerr->flow(y)[0];
    y[4] *= 1.001;
    ASSERT_TRUE(restore_energy(*kerr, y));
    EXPECT_GT(rate * kerr->flow(y)[0], 0.0);
    EXPECT_NEAR(y[4], -sense, 1e-12);
  }
}

TEST(EnergyProjection, works_inside_the_ergosphere_and_near_the_horizon) {
  const auto kerr = make_spacetime("kerr", "kerr-schild", std::array{NamedValue{"a", 0.9}});
  // r_+ = 1.436, ergosphere up to 2 on the equator.
  for (const double x : {1.8, 2.0, 2.19}) {
    PhaseState<double> y{{0.0, x, 0.3, 0.1}, {-1.0, -0.4, 0.5, 0.1}};
    ASSERT_TRUE(restore_energy(*kerr, y)) << x;
    EXPECT_LT(kerr->null_residual(y), 1e-14) << x;
  }
}

TEST(FullProjection, changes_least_and_leaves_what_is_right_alone) {
  const auto hole = make_spacetime("schwarzschild", "isotropic");
  const PhaseState<double> start = test::isotropic_ray(*hole, {0.0, -30.0, 6.0, 1.0}, {0.0, 1.0, 0.1, 0.0});
  Projector projector(Projection::full);
  projector.begin(*hole, start, component_units(*hole, start, 1.0));
  PhaseState<double> y = start;
  ASSERT_TRUE(projector.restore(*hole, y));
  for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(y[i], start[i], 1e-14) << i;

  PhaseState<double> off = start;
  off[5] += 1e-6;
  ASSERT_TRUE(projector.restore(*hole, off));
  EXPECT_LT(hole->null_residual(off), 1e-14);
  // The error was made in one component; the correction is of its size, not of the lever arm's.
  for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(off[i], start[i], 1e-4) << i;
}

TEST(FullProjection, takes_a_radial_ray_whose_angular_momentum_has_no_gradient) {
  const auto hole = make_spacetime("schwarzschild", "isotropic");
  const PhaseState<double> start = test::isotropic_ray(*hole, {0.0, -30.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 0.0});
  TraceSettings settings;
  settings.projection = Projection::full;
  settings.r_min = 2.1;
  const RayEnd end = trace_ray(*hole, start, 1, settings);
  EXPECT_EQ(end.status, Status::captured);
  EXPECT_EQ(end.y[2], 0.0) << "stays on its line";
  EXPECT_EQ(end.y[6], 0.0);
  EXPECT_LE(end.null_residual_max, 1e-14);
}

TEST(Projection, ends_a_ray_that_cannot_be_put_back) {
  const auto hole = make_spacetime("schwarzschild", "isotropic");
  PhaseState<double> start = test::isotropic_ray(*hole, {0.0, -30.0, 6.0, 0.0}, {0.0, 1.0, 0.0, 0.0});
  for (std::size_t i = 5; i < 8; ++i) start[i] = 0.0;
  TraceSettings settings;
  settings.projection = Projection::momentum;  // no factor makes a zero momentum null
  EXPECT_EQ(trace_ray(*hole, start, 1, settings).status, Status::constraint_violated);
}

TEST(KillingConstants, have_the_gradients_of_their_values) {
  for (const auto& [metric, chart] : {std::pair{"kerr", "kerr-schild"}, std::pair{"ellis", "isotropic"},
                                      std::pair{"schwarzschild", "areal"}, std::pair{"luneburg", "cartesian"}}) {
    const auto spacetime = make_spacetime(metric, chart);
    const PhaseState<double> y{{0.3, 4.0, 1.1, 0.7}, {-1.0, 0.4, -0.6, 0.2}};
    const auto constants = spacetime->killing_constants(y);
    const auto vectors = spacetime->killing_vectors(y.x());
    ASSERT_EQ(constants.size(), vectors.size());
    for (std::size_t k = 0; k < constants.size(); ++k) {
      EXPECT_EQ(constants[k].name, vectors[k].name);
      EXPECT_NEAR(constants[k].value, vectors[k].sign * contract(vectors[k].component, y.p()), 1e-14);
      for (std::size_t i = 0; i < 8; ++i) {
        PhaseState<double> above = y, below = y;
        above[i] += 1e-5;
        below[i] -= 1e-5;
        const double slope =
            (spacetime->killing_constants(above)[k].value - spacetime->killing_constants(below)[k].value) / 2e-5;
        // Central differences: h^2 of the third derivative, and round-off of 1e-15 / h.
        EXPECT_NEAR(constants[k].gradient[i], slope, 1e-8) << metric << " " << constants[k].name << " " << i;
      }
    }
  }
}

}  // namespace
}  // namespace xpr
