#include "core/camera/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "metrics/catalogue.hpp"
#include "metrics/chart_map.hpp"
#include "metrics/schwarzschild_exact.hpp"

namespace xpr {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

SceneCamera camera_at(const Vec3& position, const Vec3& forward) {
  SceneCamera camera;
  camera.position = position;
  camera.forward = normalized(forward);
  camera.up = {0.0, 0.0, 1.0};
  camera.fov = 90.0 * degree;
  return camera;
}

void expect_orthonormal(const Spacetime& chart, const SceneCamera& camera, const Tetrad& frame) {
  const SymTensor4<double> g = chart.metric({camera.time, camera.position.x, camera.position.y, camera.position.z});
  const std::array<const Vec4<double>*, 4> axes{&frame.time, &frame.right, &frame.up, &frame.forward};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const double expected = i != j ? 0.0 : i == 0 ? -1.0 : 1.0;
      // Rounding of products of components of size gamma.
      EXPECT_NEAR(inner(g, *axes[i], *axes[j]), expected, 1e-13) << i << ", " << j;
    }
  }
}

double constant(const Spacetime& chart, const PhaseState<double>& y, std::string_view name) {
  for (const KillingConstant& found : chart.killing_constants(y)) {
    if (found.name == name) return found.value;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// The camera's ray in that direction of its frame.
PhaseState<double> looking(const CameraView& view, double right, double up) { return view.ray({right, up}).value(); }

TEST(Camera, every_frame_is_orthonormal) {
  const auto kerr = make_spacetime("kerr", "kerr-schild-outgoing", std::array{NamedValue{"a", 0.9}});
  const SceneCamera camera = camera_at({6.0, 3.0, 0.0}, {-1.0, -0.4, 0.2});
  for (const ObserverKind kind : {ObserverKind::at_rest, ObserverKind::zamo, ObserverKind::circular_orbit,
                                  ObserverKind::falling, ObserverKind::boosted}) {
    const CameraView view(*kerr, camera, {.kind = kind, .velocity = {0.3, -0.5, 0.6}, .prograde = true}, 1.0);
    expect_orthonormal(*kerr, camera, view.tetrad());
  }
}

TEST(Camera, directions_are_those_of_the_models) {
  const auto flat = make_spacetime("minkowski", "cartesian", {});
  SceneCamera camera = camera_at({0.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
  camera.fov = 60.0 * degree;
  const CameraView pinhole(*flat, camera, {}, 16.0 / 9.0);
  // The middle of the upper edge is half the field of view above the axis; right is +x where +y is ahead and +z above.
  const ViewDirection top = pinhole.direction({0.0, 1.0}).value();
  EXPECT_NEAR(std::atan2(top.up, top.forward), 30.0 * degree, 1e-15);
  const ViewDirection corner = pinhole.direction({1.0, 1.0}).value();
  EXPECT_NEAR(corner.right / corner.up, 16.0 / 9.0, 1e-15);
  const PhaseState<double> ray = pinhole.ray({0.5, 0.0}).value();
  EXPECT_GT(ray[5], 0.0);
  EXPECT_GT(ray[6], 0.0);
  // p^t = -p_t is negative: past-directed.
  EXPECT_DOUBLE_EQ(ray[4], 1.0);

  camera.model = CameraModel::fisheye;
  camera.fov = 200.0 * degree;
  const CameraView fisheye(*flat, camera, {}, 1.0);
  const ViewDirection side = fisheye.direction({0.6, 0.0}).value();
  EXPECT_NEAR(std::atan2(side.right, side.forward), 60.0 * degree, 1e-15);
  EXPECT_FALSE(fisheye.direction({1.9, 0.0}).has_value());

  camera.model = CameraModel::equirectangular;
  const CameraView globe(*flat, camera, {}, 2.0);
  const ViewDirection left = globe.direction({-0.5, 0.0}).value();
  EXPECT_NEAR(left.right, -1.0, 1e-15);
  EXPECT_NEAR(globe.direction({0.3, 1.0}).value().up, 1.0, 1e-15);

  camera.model = CameraModel::impact_parameter;
  camera.half_width = 12.0;
  const CameraView parallel(*flat, camera, {}, 2.0);
  const PhaseState<double> edge = parallel.ray({1.0, -1.0}).value();
  EXPECT_DOUBLE_EQ(edge[1], 12.0);
  EXPECT_DOUBLE_EQ(edge[3], -6.0);
  EXPECT_DOUBLE_EQ(edge[6], 1.0);
}

TEST(Camera, a_boosted_observer_sees_aberration_and_doppler_shift) {
  const auto flat = make_spacetime("minkowski", "cartesian", {});
  const double v = 0.8, gamma = 1.0 / 0.6;
  SceneObserver observer{.kind = ObserverKind::boosted, .velocity = {0.0, v, 0.0}, .prograde = true};
  const CameraView view(*flat, camera_at({0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}), observer, 1.0);
  for (const double angle : {0.0, 0.2, 0.7}) {
    const PhaseState<double> ray = looking(view, std::tan(angle), 0.0);
    // cos theta = (cos theta' - v) / (1 - v cos theta') for light seen at theta' by who moves towards theta = 0, and
    // nu / nu' = gamma (1 - v cos theta').
    const double seen = std::cos(angle);
    EXPECT_NEAR(ray[6] / std::hypot(ray[5], ray[6]), (seen - v) / (1.0 - v * seen), 1e-14);
    EXPECT_NEAR(ray[4], gamma * (1.0 - v * seen), 1e-14);
  }
  // Across the motion: the frame is boosted without rotation, so its right is the world's.
  EXPECT_EQ(view.tetrad().right[1], 1.0);
  EXPECT_EQ(view.tetrad().right[0], 0.0);
  observer.velocity = {0.0, 1.0, 0.0};
  EXPECT_THROW(CameraView(*flat, camera_at({0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}), observer, 1.0), std::invalid_argument);
}

TEST(Camera, one_at_rest_in_schwarzschild_sees_the_shadow_and_the_redshift_of_its_radius) {
  for (const char* id : {"kerr-schild", "kerr-schild-outgoing", "isotropic"}) {
    const auto hole = make_spacetime("schwarzschild", id, {});
    for (const double x : {3.5, 6.0, 40.0}) {
      const SceneCamera camera = camera_at({x, 0.0, 0.0}, {-1.0, 0.0, 0.0});
      const CameraView view(*hole, camera, {}, 1.0);
      const double r = hole->radius({0.0, x, 0.0, 0.0});
      // The angle from the hole at which the critical ray is seen. Cites: [Synge1966]
      const double sine = std::sqrt(27.0 * (1.0 - 2.0 / r)) / r;
      const PhaseState<double> ray = looking(view, 0.0, std::tan(std::asin(sine)));
      const double b = std::abs(constant(*hole, ray, "L_y") / ray[4]);
      EXPECT_NEAR(b, schwarzschild_exact::critical_impact_parameter(1.0).value, 2e-14 * r * r) << id;
      EXPECT_NEAR(std::abs(ray[4]), std::sqrt(1.0 - 2.0 / r), 1e-14) << id;
    }
  }
}

TEST(Camera, one_that_falls_sees_the_sky_behind_it_shifted_by_one_plus_its_speed) {
  for (const char* id : {"kerr-schild", "kerr-schild-outgoing", "isotropic"}) {
    const auto hole = make_spacetime("schwarzschild", id, {});
    const SceneCamera camera = camera_at({8.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
    const CameraView view(*hole, camera, {.kind = ObserverKind::falling, .velocity = {}, .prograde = true}, 1.0);
    const double r = hole->radius({0.0, 8.0, 0.0, 0.0});
    // nu at infinity over nu seen, looking straight outward, for one who fell from rest at infinity.
    EXPECT_NEAR(std::abs(looking(view, 0.0, 0.0)[4]), 1.0 + std::sqrt(2.0 / r), 1e-14) << id;
    const SymTensor4<double> g = hole->metric({0.0, 8.0, 0.0, 0.0});
    EXPECT_NEAR(raise_index(g, view.tetrad().time)[0], -1.0, 1e-14) << id;
  }
}

TEST(Camera, observers_turn_with_the_hole_as_the_orbits_do) {
  const double a = 0.9, r = 7.0;
  const auto kerr = make_spacetime("kerr", "kerr-schild", std::array{NamedValue{"a", a}});
  // x + iy = (r + ia) e^{i phi}: r^2 + a^2 is the square of the distance from the axis in the equatorial plane.
  const double distance = std::sqrt(r * r + a * a);
  const SceneCamera camera = camera_at({0.0, distance, 0.0}, {0.3, -1.0, 0.0});
  const auto angular_velocity = [&](ObserverKind kind, bool prograde) {
    const CameraView view(*kerr, camera, {.kind = kind, .velocity = {}, .prograde = prograde}, 1.0);
    const Vec4<double>& u = view.tetrad().time;
    // Along d_phi = x d_y - y d_x, at x = 0.
    EXPECT_NEAR(u[2], 0.0, 1e-15);
    return -u[1] / (distance * u[0]);
  };
  const double A = std::pow(r * r + a * a, 2) - (r * r - 2.0 * r + a * a) * a * a;
  EXPECT_NEAR(angular_velocity(ObserverKind::zamo, true), 2.0 * a * r / A, 1e-16);
  EXPECT_EQ(angular_velocity(ObserverKind::at_rest, true), 0.0);
  // [BardeenPressTeukolsky1972] eq. 2.16
  EXPECT_NEAR(angular_velocity(ObserverKind::circular_orbit, true), 1.0 / (std::pow(r, 1.5) + a), 1e-15);
  EXPECT_NEAR(angular_velocity(ObserverKind::circular_orbit, false), -1.0 / (std::pow(r, 1.5) - a), 1e-15);
}

TEST(Camera, says_who_can_stand_where) {
  const auto kerr = make_spacetime("kerr", "kerr-schild-outgoing", std::array{NamedValue{"a", 0.9}});
  const auto refusal = [&](const Vec3& at, ObserverKind kind) -> std::string {
    try {
      const CameraView view(*kerr, camera_at(at, {-1.0, 0.0, 0.0}), {.kind = kind, .velocity = {}, .prograde = true},
                            1.0);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refusal({2.0, 0.0, 0.0}, ObserverKind::at_rest).find("possible outside the horizon: zamo"),
            std::string::npos);
  EXPECT_EQ(refusal({2.0, 0.0, 0.0}, ObserverKind::zamo), "");
  EXPECT_NE(refusal({1.3, 0.0, 0.0}, ObserverKind::zamo).find("inside the horizon"), std::string::npos);
  EXPECT_NE(refusal({1.75, 0.0, 0.0}, ObserverKind::circular_orbit).find("inside the photon orbit"), std::string::npos);
  EXPECT_NE(refusal({6.0, 0.0, 1.0}, ObserverKind::circular_orbit).find("z = 0"), std::string::npos);
  EXPECT_EQ(refusal({6.0, 0.0, 1.0}, ObserverKind::falling), "");
}

}  // namespace
}  // namespace xpr
