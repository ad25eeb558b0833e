// First integrals in Mino time as a tracer: the axis, stops, statuses, tolerance, the same bits at every width.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "first_integral_rays.hpp"
#include "metrics/kerr_exact.hpp"
#include "metrics/schwarzschild.hpp"

namespace xpr {
namespace {

using test::angle_between;
using test::Dice;
using test::equatorial;
using test::kerr;
using test::screen_rays;
using test::settings_of;
using test::trace_one;

constexpr double turn = 2.0 * std::numbers::pi;

TEST(FirstIntegrals, pass_over_the_axis) {
  const SeparatedLight light = kerr(0.9).separated();
  const FirstIntegralSettings settings = settings_of(kerr(0.9), 100.0);
  const auto trace = [&](double lambda) {
    return trace_one(light, separated_start(light, lambda, 50.0, 1.0, 0.01, 1.0, false, false), settings);
  };
  // Through the axis, and close by on either side: the ends agree as lambda does, the azimuths differ by a turn.
  const FirstIntegralEnd through = trace(0.0);
  EXPECT_EQ(through.status, Status::escaped);
  for (const double lambda : {1e-3, 1e-6, 1e-9, 1e-13}) {
    const FirstIntegralEnd left = trace(lambda), right = trace(-lambda);
    EXPECT_LT(angle_between(left.state.n, through.state.n), lambda + 1e-12);
    EXPECT_LT(angle_between(right.state.n, through.state.n), lambda + 1e-12);
    EXPECT_NEAR(left.swept_azimuth - right.swept_azimuth, turn, 4.0 * lambda + 1e-12);
    EXPECT_NEAR(left.state.t, through.state.t, 10.0 * lambda + 1e-9);
  }
  // From the axis itself to the other side of it and away.
  const FirstIntegralEnd from =
      trace_one(light, separated_start(light, 0.0, 30.0, 1.0, 0.01, 0.0, false, true), settings);
  EXPECT_EQ(from.status, Status::escaped);
  const FirstIntegralEnd close =
      trace_one(light, separated_start(light, 1e-9, 30.0, 1.0, 0.01, 1e-8, false, true), settings);
  EXPECT_LT(std::abs(from.state.n[2] - close.state.n[2]), 1e-7);
}

TEST(FirstIntegrals, turn_time_and_drag_round_for_rays_traced_back) {
  const SeparatedLight light = kerr(0.8).separated();
  const FirstIntegralSettings settings = settings_of(kerr(0.8), 60.0);
  SeparatedState forward = separated_start(light, 3.0, 20.0, 1.0, 0.05, 1.2, false, true);
  const FirstIntegralEnd there = trace_one(light, forward, settings);
  ASSERT_EQ(there.status, Status::escaped);
  // The same light from its end: momentum and energy change sign, the constants do not.
  SeparatedState backward = there.state;
  backward.energy_sign = -1.0;
  backward.u_rate = -backward.u_rate;
  for (double& rate : backward.n_rate) rate = -rate;
  FirstIntegralSettings home = settings;
  home.r_max = 20.0;
  const FirstIntegralEnd back = trace_one(light, backward, home);
  EXPECT_EQ(back.status, Status::escaped);
  EXPECT_LT(back.state.u_rate, 0.0);
  // It first meets r = 20 on its way in, where nothing stops it, then on the way out: where `forward` is, reversed.
  EXPECT_LT(angle_between(back.state.n, forward.n), 1e-11);
  EXPECT_NEAR(back.swept_azimuth, -there.swept_azimuth, 1e-11);
  EXPECT_NEAR(back.state.t, 0.0, 1e-10);
}

/// The bits of everything that an end says.
std::vector<std::uint64_t> bits_of(const FirstIntegralEnd& end) {
  std::vector<std::uint64_t> bits{static_cast<std::uint64_t>(end.status), static_cast<std::uint64_t>(end.steps)};
  for (const double x :
       {end.swept_azimuth, end.mino_time, end.affine, end.state.t, end.state.u, end.state.u_rate, end.state.n[0],
        end.state.n[1], end.state.n[2], end.state.n_rate[0], end.state.n_rate[1], end.state.n_rate[2]}) {
    bits.push_back(std::isnan(x) ? 0 : std::bit_cast<std::uint64_t>(x));
  }
  return bits;
}

TEST(FirstIntegrals, give_the_same_bits_at_every_width_and_among_any_neighbours) {
  Dice dice;
  for (const double a : {0.0, 0.9, 1.0}) {
    const SeparatedLight light = kerr(a).separated();
    std::vector<SeparatedState> rays = screen_rays(light, 301, dice);
    rays[7].u = std::nan("");
    rays[8].n_rate[1] += 0.1;
    rays[9].u = 2.0;
    rays[10] = separated_start(light, 0.0, 20.0, -1.0, 0.02, 1.0, false, true);
    for (const bool timed : {false, true}) {
      for (const double tol : {1e-8, 1e-12}) {
        FirstIntegralSettings settings = settings_of(kerr(a), 900.0, tol);
        settings.r_min = std::max(settings.r_min, 1.01);
        settings.timed = timed;
        settings.lanes = 1;
        std::vector<FirstIntegralEnd> alone(rays.size());
        for (std::size_t i = 0; i < rays.size(); ++i) alone[i] = trace_one(light, rays[i], settings);
        EXPECT_EQ(alone[7].status, Status::not_finite);
        EXPECT_EQ(alone[8].status, Status::constraint_violated);
        EXPECT_EQ(alone[9].status, Status::outside_domain);
        for (const int lanes : {1, 2, 4, 8}) {
          settings.lanes = lanes;
          std::vector<FirstIntegralEnd> ends(rays.size());
          trace_first_integrals(light, rays, ends, settings);
          for (std::size_t i = 0; i < rays.size(); ++i) {
            ASSERT_EQ(bits_of(ends[i]), bits_of(alone[i])) << "a " << a << " lanes " << lanes << " ray " << i;
          }
        }
      }
    }
  }
}

TEST(FirstIntegrals, meet_stops_that_a_turning_ray_only_touches) {
  const SeparatedLight light = kerr(0.9).separated();
  const double b = 7.0, periapsis = kerr_exact::equatorial_periapsis(1.0, 0.9, b).value;
  for (const double gap : {1e-2, 1e-4, 1e-6, 1e-9}) {
    FirstIntegralSettings settings{.tol = 1e-13, .r_min = periapsis * (1.0 - gap), .r_max = 100.0};
    const SeparatedState ray = equatorial(light, b, 0.01, false);
    EXPECT_EQ(trace_one(light, ray, settings).status, Status::escaped) << gap;
    settings.r_min = periapsis * (1.0 + gap);
    const FirstIntegralEnd caught = trace_one(light, ray, settings);
    EXPECT_EQ(caught.status, Status::captured) << gap;
    EXPECT_EQ(caught.state.u, 1.0 / settings.r_min);
    EXPECT_NEAR(caught.swept_azimuth,
                kerr_exact::equatorial_swept_angle(1.0, 0.9, b, 100.0, settings.r_min, false).value,
                1e-13 + 1e-13 / std::sqrt(gap))
        << "the tolerance over the slope of r there";
  }
  // Light that rises from next to the horizon, with more angular momentum than the photon orbit lets out, falls back.
  const SeparatedState rising = equatorial(light, 2.9, 1.0 / 1.45, true);
  FirstIntegralSettings settings{.tol = 1e-12, .r_min = 1.44, .r_max = 50.0};
  const FirstIntegralEnd fallen = trace_one(light, rising, settings);
  EXPECT_EQ(fallen.status, Status::captured);
  EXPECT_EQ(fallen.state.u, 1.0 / 1.44);
  EXPECT_GT(fallen.state.u_rate, 0.0);
  settings.r_max = 1.4505;
  EXPECT_EQ(trace_one(light, rising, settings).status, Status::escaped);
}

TEST(FirstIntegrals, start_beyond_a_stop_by_where_they_go) {
  const SeparatedLight light = KerrParameters{.M = 1.0, .a = 0.0}.separated();
  FirstIntegralSettings settings{.tol = 1e-12, .r_min = 4.0, .r_max = 20.0};
  const auto trace = [&](double b, double r, bool outward) {
    return trace_one(light, equatorial(light, b, 1.0 / r, outward), settings);
  };
  EXPECT_EQ(trace(8.0, 30.0, true).status, Status::escaped);
  EXPECT_EQ(trace(8.0, 30.0, true).steps, 0);
  const FirstIntegralEnd through = trace(8.0, 30.0, false);
  EXPECT_EQ(through.status, Status::escaped);
  EXPECT_EQ(through.state.u, 1.0 / 20.0);
  EXPECT_GT(through.swept_azimuth, std::numbers::pi / 2);
  const FirstIntegralEnd outside = trace(25.0, 30.0, false);
  EXPECT_EQ(outside.status, Status::escaped) << "never inside: escaped where it turns outward";
  EXPECT_NEAR(1.0 / outside.state.u, kerr_exact::equatorial_periapsis(1.0, 0.0, 25.0).value, 1e-10);
  EXPECT_EQ(trace(2.0, 3.0, false).status, Status::captured);
  EXPECT_EQ(trace(2.0, 3.0, true).status, Status::escaped);
  settings.max_steps = 2;
  EXPECT_EQ(trace(8.0, 19.0, false).status, Status::max_steps);
}

TEST(FirstIntegrals, tell_captured_from_escaped_next_to_the_critical_curve) {
  for (const double a : {0.5, 0.9, 0.99}) {
    const SeparatedLight light = kerr(a).separated();
    for (const double r : {kerr_exact::polar_photon_orbit_radius(1.0, a).value, 2.9, 3.1}) {
      const kerr_exact::SphericalOrbit orbit = kerr_exact::spherical_orbit(1.0, a, r);
      for (const double gap : {1e-3, 1e-6, 1e-9, 1e-11}) {
        // More angular momentum of every kind: U falls by kappa's share everywhere.
        for (const double side : {1.0, -1.0}) {
          const double eta = orbit.eta.value * (1.0 + side * gap);
          const FirstIntegralSettings settings = settings_of(kerr(a), 1000.0, 1e-12);
          const FirstIntegralEnd end = trace_one(
              light, separated_start(light, orbit.xi.value, eta, 1.0, 1e-3, 0.5 * std::numbers::pi, false, true),
              settings);
          EXPECT_EQ(end.status, side > 0.0 ? Status::escaped : Status::captured) << a << " " << r << " " << gap;
        }
      }
    }
  }
}

TEST(FirstIntegrals, keep_their_tolerance) {
  Dice dice;
  const SeparatedLight light = kerr(0.9).separated();
  const std::vector<SeparatedState> rays = screen_rays(light, 1000, dice);
  const auto trace = [&](double tol) {
    std::vector<FirstIntegralEnd> ends(rays.size());
    trace_first_integrals(light, rays, ends, settings_of(kerr(0.9), 1000.5, tol));
    return ends;
  };
  const std::vector<FirstIntegralEnd> truth = trace(1e-15);
  for (const double tol : {1e-6, 1e-8, 1e-10, 1e-12}) {
    const std::vector<FirstIntegralEnd> ends = trace(tol);
    std::vector<double> errors;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      EXPECT_EQ(ends[i].status, truth[i].status);
      errors.push_back(angle_between(ends[i].state.n, truth[i].state.n));
    }
    std::sort(errors.begin(), errors.end());
    // Half of all rays within the tolerance, and no coarser than a hundredth of it: the steps are not wasted.
    EXPECT_LT(errors[errors.size() / 2], tol) << tol;
    EXPECT_GT(errors[errors.size() / 2], 0.005 * tol) << tol;
  }
}

TEST(FirstIntegrals, refuse_settings_that_make_no_sense) {
  const SeparatedLight light = kerr(0.9).separated();
  const SeparatedState ray = equatorial(light, 8.0, 0.01, false);
  const FirstIntegralSettings good = settings_of(kerr(0.9), 100.0);
  const auto refused = [&](auto change) {
    FirstIntegralSettings settings = good;
    change(settings);
    EXPECT_THROW(static_cast<void>(trace_one(light, ray, settings)), std::invalid_argument);
  };
  refused([](auto& s) { s.tol = 0.0; });
  refused([](auto& s) { s.tol = std::nan(""); });
  refused([](auto& s) { s.lanes = 3; });
  refused([](auto& s) { s.r_min = 1.0; });
  refused([](auto& s) { s.r_min = 200.0; });
  refused([](auto& s) { s.mino_max = 0.0; });
  EXPECT_THROW(static_cast<void>(trace_one({.mass = 1.0, .spin = 1.1, .charge_squared = 0.0}, ray, good)),
               std::invalid_argument);
  EXPECT_THROW(static_cast<void>(separated_start(light, 8.0, 0.0, 1.0, 0.3, 1.5, false, true)), std::domain_error);
}

static_assert(Separable<KerrParameters> && Separable<SchwarzschildMass> && Separable<KerrBoyerLindquist>);

}  // namespace
}  // namespace xpr
