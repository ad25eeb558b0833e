#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "core/transport.hpp"
#include "metrics/schwarzschild_exact.hpp"

namespace xpr {
namespace {

constexpr double pi_ = std::numbers::pi;

// Settings at which the truncation error of DOP853 lies below the tolerances here.
TransportSettings settings_for(const std::string& metric, const std::string& chart,
                               std::vector<NamedValue> parameters = {}) {
  TransportSettings settings{.metric = metric, .parameters = std::move(parameters), .chart = chart};
  settings.trace.method = "dop853";
  settings.trace.tol = 1e-13;
  return settings;
}

TransportSettings in_chart(TransportSettings settings, const std::string& transport_chart) {
  settings.transport_chart = transport_chart;
  return settings;
}

// A future-directed ray at `x` with E = 1 and the given p_2, p_3, put onto the cone by solving for p_1 (going inward),
// in a chart whose g^{01} and g^{1i} vanish.
Ray inward(const Transport& transport, const Vec4<double>& x, double p_2, double p_3) {
  const SymTensor4<double> g = transport.chart().inverse_metric(x);
  const Vec4<double> rest{-1.0, 0.0, p_2, p_3};
  const double p_1 = -std::sqrt(-contract(rest, raise_index(g, rest)) / g(1, 1));
  return {.id = 1, .start = {x, {-1.0, p_1, p_2, p_3}}};
}

// A past-directed ray that goes inward too: Kerr looks the same under t -> -t, phi -> -phi.
Ray past_directed(Ray ray) {
  ray.start[4] = -ray.start[4];
  ray.start[7] = -ray.start[7];
  return ray;
}

TEST(Transport, sweeps_the_exact_angle_through_several_turns) {
  TransportSettings settings = settings_for("schwarzschild", "areal");
  settings.trace.r_max = 60.0;
  const Transport cartesian(settings);
  const Transport spherical(in_chart(settings, "areal"));
  // b/b_c - 1 from a hundredth, half a turn, to a millionth, two and a half.
  for (const double excess : {1e-2, 1e-4, 1e-6}) {
    const double b = schwarzschild_exact::critical_impact_parameter(1.0).value * (1.0 + excess);
    const double truth = schwarzschild_exact::swept_angle(1.0, b, 50.0, 60.0, true).value;
    for (const double sense : {1.0, -1.0}) {
      const Ray ray = inward(cartesian, {0.0, 50.0, pi_ / 2, 0.3}, 0.0, sense * b);
      for (const Transport* transport : {&cartesian, &spherical}) {
        const TracedRay end = transport->trace(ray);
        EXPECT_EQ(end.status, Status::escaped);
        EXPECT_NEAR(end.end[1], 60.0, 1e-9);
        // The angle goes as the logarithm of excess: an error in b of tol, on the way in, becomes tol/excess.
        EXPECT_NEAR(end.end[3], 0.3 + sense * truth, 1e-11 + 1e-12 / excess) << excess << " " << sense;
      }
    }
  }
}

TEST(Transport, sweeps_the_same_angle_in_kerr_whatever_the_chart) {
  const std::vector<NamedValue> holes{{"a", 0.0}, {"a", 0.9}, {"a", -0.7}, {"a", 0.998}};
  for (const NamedValue& hole : holes) {
    TransportSettings settings = settings_for("kerr", "boyer-lindquist", {hole});
    settings.trace.r_max = 40.0;
    const Transport regular(settings);
    const Transport classical(in_chart(settings, "boyer-lindquist"));
    for (const double angular_momentum : {6.0, -7.5, 5.6, 0.7, -0.7}) {
      const Ray ray = inward(regular, {0.0, 30.0, 1.1, -2.0}, 1.5, angular_momentum);
      for (const Ray& start : {ray, past_directed(ray)}) {
        const TracedRay a = regular.trace(start);
        const TracedRay b = classical.trace(start);
        ASSERT_EQ(a.status, b.status) << hole.value << " " << angular_momentum;
        // Boyer-Lindquist azimuth winds up as the horizon nears and loses digits there with Delta.
        const double tolerance = a.status == Status::captured ? 1e-7 : 1e-9;
        for (std::size_t i = 0; i < 8; ++i) {
          EXPECT_NEAR(a.end[i], b.end[i], tolerance * std::fmax(1.0, std::abs(b.end[i])))
              << "component " << i << " a = " << hole.value << " L = " << angular_momentum;
        }
      }
    }
  }
}

TEST(Transport, follows_a_straight_line_past_the_axis) {
  TransportSettings settings = settings_for("minkowski", "spherical");
  settings.trace.r_max = 20.0;
  const Transport cartesian(settings);
  const Transport spherical(in_chart(settings, "spherical"));
  // From (x, y, z) = (0, offset, 10 cos) downwards past the axis: phi sweeps from one side to the other within a
  // distance `offset` of it.
  for (const double offset : {1.0, 1e-3, 1e-6}) {
    const double r = 10.0, theta = 0.5;
    const Ray ray = inward(cartesian, {0.0, r, theta, 0.0}, -r * std::sin(theta) * 0.9, offset);
    // Closed form: x(lambda) = x + p lambda with Cartesian p from the spherical components.
    const double p_r = ray.start[5], p_theta = ray.start[6] / r, p_phi = ray.start[7] / (r * std::sin(theta));
    const double p_x = p_r * std::sin(theta) + p_theta * std::cos(theta),
                 p_z = p_r * std::cos(theta) - p_theta * std::sin(theta);
    for (const Transport* transport : {&cartesian, &spherical}) {
      const TracedRay end = transport->trace(ray);
      const double x = r * std::sin(theta) + p_x * end.lambda, y = p_phi * end.lambda;
      const double z = r * std::cos(theta) + p_z * end.lambda;
      EXPECT_EQ(end.status, Status::escaped);
      EXPECT_NEAR(end.end[1], 20.0, 1e-11);
      EXPECT_NEAR(end.end[2], std::atan2(std::hypot(x, y), z), 1e-10);
      // The sense of rotation is that of p_phi > 0: atan2 has it within (0, pi). The spherical chart loses digits as
      // 1/offset on its axis.
      EXPECT_NEAR(end.end[3], std::atan2(y, x), transport == &cartesian ? 1e-12 : 1e-11 / offset);
    }
  }
}

TEST(Transport, adds_pi_to_phi_at_each_crossing_of_the_axis) {
  TransportSettings settings = settings_for("minkowski", "spherical");
  settings.trace.r_max = 20.0;
  for (const std::string chart : {"", "spherical"}) {
    const Transport transport(in_chart(settings, chart));
    const Ray ray = inward(transport, {0.0, 10.0, 0.5, 0.25}, -4.0, 0.0);
    const TracedRay end = transport.trace(ray);
    EXPECT_EQ(end.status, Status::escaped);
    // No angular momentum about the axis: modulo 2 pi is what can be asked.
    EXPECT_NEAR(std::cos(end.end[3] - (0.25 + pi_)), 1.0, 1e-12) << end.end[3];
    EXPECT_GT(end.end[2], 0.0);
    EXPECT_LT(end.end[2], pi_);
    // Beyond the axis theta grows: the part of p across the radius points away from the pole.
    EXPECT_NEAR(end.end[6], 4.0, 1e-9);
  }
}

TEST(Transport, keeps_angles_through_the_throat) {
  TransportSettings settings = settings_for("ellis", "proper-distance");
  settings.trace.l_min = -30.0;
  const Transport isotropic(settings);
  const Transport proper(in_chart(settings, "proper-distance"));
  for (const double angular_momentum : {0.99, -0.999, 0.3}) {
    const Ray ray = inward(isotropic, {0.0, 20.0, 1.2, 3.0}, 0.1, angular_momentum * 0.9);
    const TracedRay a = isotropic.trace(ray);
    const TracedRay b = proper.trace(ray);
    EXPECT_EQ(a.status, Status::crossed);
    EXPECT_EQ(a.sheet, -1);
    EXPECT_EQ(b.sheet, -1);
    for (std::size_t i = 0; i < 8; ++i) {
      EXPECT_NEAR(a.end[i], b.end[i], 1e-9 * std::fmax(1.0, std::abs(b.end[i]))) << i << " " << angular_momentum;
    }
  }
}

TEST(Transport, counts_longitude_around_the_poles_of_a_sphere) {
  // f = 0: great circles. Three times around and back to the start, 1, 30 and 89.99 degrees from the equator.
  TransportSettings settings = settings_for("ellipsoid", "geographic", {{"f", 0.0}});
  settings.trace.lambda_max = 6.0 * pi_;
  const Transport transport(settings);
  for (const double tilt : {1.0, 30.0, 89.99}) {
    const double inclination = tilt * pi_ / 180.0;
    for (const double sense : {1.0, -1.0}) {
      const Ray ray{.id = 1,
                    .start = {{0.0, 0.0, 0.4, 0.0}, {-1.0, std::sin(inclination), sense * std::cos(inclination), 0.0}}};
      const TracedRay end = transport.trace(ray);
      EXPECT_EQ(end.status, Status::max_affine);
      EXPECT_NEAR(end.end[1], 0.0, 1e-10);
      EXPECT_NEAR(end.end[2], 0.4 + sense * 6.0 * pi_, 1e-10 / std::cos(inclination)) << tilt;
    }
  }
}

TEST(Transport, takes_rays_back_in_time_to_the_past_horizon) {
  TransportSettings settings = settings_for("kerr", "boyer-lindquist", {{"a", 0.9}});
  settings.trace.r_min = 1.4358898943540673 + 1e-6;
  const Transport transport(settings);
  const Ray camera = past_directed(inward(transport, {0.0, 30.0, 1.2, 0.0}, 0.5, 1.0));
  const TracedRay end = transport.trace(camera);
  EXPECT_EQ(end.status, Status::captured);
  EXPECT_LT(end.steps, 500);
  EXPECT_NEAR(end.end[1], *settings.trace.r_min, 1e-10);
}

TEST(Transport, puts_rays_onto_the_cone_by_p0_alone) {
  const Transport transport(settings_for("kerr", "kerr-schild", {{"a", 0.9}}));
  // Far away, in the ergoregion (1.436 < r < 2) and inside the horizon; both directions in time.
  for (const double x : {50.0, 1.7, 1.0}) {
    for (const double sign : {1.0, -1.0}) {
      const Ray off{.id = 1, .start = {{0.0, x, 0.3, 0.2}, {-sign * 1.3, 0.4, -0.7, 0.2}}};
      const auto rate = [&](const Ray& ray) {
        return raise_index(transport.chart().inverse_metric(ray.start.x()), ray.start.p())[0];
      };
      const Ray on = transport.renormalised(off);
      EXPECT_GT(transport.off_cone(off), 1e-3);
      EXPECT_LT(transport.off_cone(on), 1e-14) << x << " " << sign;  // round-off of a few terms of the residual
      EXPECT_EQ(std::signbit(rate(on)), std::signbit(rate(off))) << x << " " << sign;
      for (const std::size_t i : {0u, 1u, 2u, 3u, 5u, 6u, 7u}) EXPECT_EQ(on.start[i], off.start[i]);
    }
  }
}

TEST(Transport, gives_a_row_to_a_start_that_physics_does_not_admit) {
  const Transport transport(settings_for("kerr", "boyer-lindquist", {{"a", 0.9}}));
  const Ray good = inward(transport, {0.0, 30.0, 1.2, 0.0}, 0.5, 1.0);
  EXPECT_TRUE(transport.admits(good));
  const auto with = [&](std::size_t component, double value) {
    Ray ray = good;
    ray.start[component] = value;
    return ray;
  };
  Ray far_side = good;
  far_side.sheet = -1;
  Ray at_rest = good;
  for (std::size_t i = 4; i < 8; ++i) at_rest.start[i] = 0.0;
  for (const Ray& ray : {with(1, -3.0), with(1, 0.0), with(2, -0.1), with(2, 3.2), far_side, at_rest}) {
    const TracedRay end = transport.trace(ray);
    EXPECT_EQ(end.status, Status::outside_domain);
    EXPECT_EQ(end.end.c, ray.start.c);
    EXPECT_EQ(end.steps, 0);
    EXPECT_TRUE(std::isnan(end.null_residual));
  }
}

TEST(Transport, stops_by_default_outside_the_horizon_and_far_away) {
  const Transport transport(settings_for("schwarzschild", "areal", {{"M", 2.0}}));
  const TracedRay in = transport.trace(inward(transport, {0.0, 30.0, 1.2, 0.0}, 0.0, 1.0));
  EXPECT_EQ(in.status, Status::captured);
  EXPECT_NEAR(in.end[1], 4.0 * 1.005, 1e-9);
  const TracedRay out = transport.trace(inward(transport, {0.0, 30.0, 1.2, 0.0}, 0.0, 25.0));
  EXPECT_EQ(out.status, Status::escaped);
  EXPECT_NEAR(out.end[1], 2000.0, 1e-7);
  const TracedRay farther = transport.trace(inward(transport, {0.0, 5000.0, 1.2, 0.0}, 0.0, 100.0));
  EXPECT_NEAR(farther.end[1], 10000.0, 1e-6);
}

TEST(Transport, refuses_settings_that_make_no_sense) {
  const auto message = [](const std::function<void(TransportSettings&)>& change) -> std::string {
    TransportSettings settings = settings_for("kerr", "boyer-lindquist");
    change(settings);
    try {
      const Transport transport(settings);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "no exception";
  };
  const auto says = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_EQ(message([](TransportSettings&) {}), "no exception");
  EXPECT_TRUE(says(message([](auto& s) { s.metric = "ker"; }), "kerr"));
  EXPECT_TRUE(says(message([](auto& s) { s.chart = "boyer-lindqist"; }), "boyer-lindquist"));
  EXPECT_TRUE(says(message([](auto& s) { s.transport_chart = "kerr-shild"; }), "kerr-schild"));
  EXPECT_TRUE(says(message([](auto& s) { s.trace.method = "dop583"; }), "dop853"));
  EXPECT_TRUE(says(message([](auto& s) { s.parameters = {{"a", 1.2}}; }), "1.2"));
  EXPECT_TRUE(says(message([](auto& s) { s.parameters = {{"M", 0.0}}; }), "M"));
  EXPECT_TRUE(says(message([](auto& s) { s.parameters = {{"Q", 0.1}}; }), "Q"));
  EXPECT_TRUE(says(message([](auto& s) { s.trace.tol = 0.0; }), "0 < tol < 1"));
  EXPECT_TRUE(says(message([](auto& s) { s.trace.tol = std::nan(""); }), "0 < tol < 1"));
  EXPECT_TRUE(says(message([](auto& s) { s.trace.method = "rk4", s.trace.step = -1.0; }), "step > 0"));
  EXPECT_TRUE(says(message([](auto& s) { s.trace.r_min = 50.0, s.trace.r_max = 20.0; }), "r-min"));
  EXPECT_TRUE(says(message([](auto& s) { s.trace.l_min = -5.0; }), "no throat"));
  EXPECT_TRUE(says(message([](auto& s) { s.trace.max_steps = 0; }), "max-steps > 0"));
  EXPECT_TRUE(says(message([](auto& s) { s.trace.lambda_max = -1.0; }), "lambda-max > 0"));
}

}  // namespace
}  // namespace xpr
