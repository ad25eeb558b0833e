#include "metrics/medium_exact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>

#include "exact_kit.hpp"

namespace {

using namespace xpr;
using exact_kit::integrate;
using exact_kit::Mp;
using medium_exact::Vector;
namespace exact = medium_exact;

using Long = long double;
using State = std::array<Long, 7>;  // x, p, t

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double norm(const Vector& a) { return std::sqrt(dot(a, a)); }

// Hamilton's equations by a fourth-order step in long double, written here from n^2 alone.
State integrated(const std::function<Long(Long)>& n_squared_of_r_squared, const Vector& x, const Vector& p, Long lambda,
                 int steps) {
  const auto slope = [&](const State& y) {
    const Long r2 = y[0] * y[0] + y[1] * y[1] + y[2] * y[2];
    const Long n2 = n_squared_of_r_squared(r2);
    const Long h = 1e-6L;  // central difference, O(h^2) cancelled by one Richardson step
    const auto difference = [&](Long step) {
      return (n_squared_of_r_squared(r2 + step) - n_squared_of_r_squared(r2 - step)) / (2 * step);
    };
    const Long slope_r2 = (4 * difference(h) - difference(2 * h)) / 3;
    return State{y[3], y[4], y[5], slope_r2 * y[0], slope_r2 * y[1], slope_r2 * y[2], n2};
  };
  const auto moved = [](State y, Long h, const State& k) {
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += h * k[i];
    return y;
  };
  State y{x[0], x[1], x[2], p[0], p[1], p[2], 0};
  const Long h = lambda / steps;
  for (int i = 0; i < steps; ++i) {
    const State k1 = slope(y), k2 = slope(moved(y, h / 2, k1)), k3 = slope(moved(y, h / 2, k2)),
                k4 = slope(moved(y, h, k3));
    for (std::size_t j = 0; j < y.size(); ++j) y[j] += h / 6 * (k1[j] + 2 * k2[j] + 2 * k3[j] + k4[j]);
  }
  return y;
}

// A start inside the sphere with |p| = n.
struct Start {
  Vector x, p;
};
Start random_start(std::mt19937_64& engine, const std::function<double(const Vector&)>& index) {
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> radius(0.05, 0.95);
  Vector x{gauss(engine), gauss(engine), gauss(engine)}, p{gauss(engine), gauss(engine), gauss(engine)};
  const double grow = radius(engine) / norm(x);
  for (double& component : x) component *= grow;
  const double scale = index(x) / norm(p);
  for (double& component : p) component *= scale;
  return {x, p};
}

double luneburg_index(const Vector& x) { return std::sqrt(exact::luneburg_index_squared(1.0, x)); }
double fisheye_index(const Vector& x) { return exact::fisheye_index(1.0, x); }

TEST(LuneburgExact, ray_solves_hamiltons_equations) {
  std::mt19937_64 engine(11);
  for (int i = 0; i < 20; ++i) {
    const Start start = random_start(engine, luneburg_index);
    const Long lambda = 0.3L + 0.4L * i;
    const State y = integrated([](Long r2) { return 2 - r2; }, start.x, start.p, lambda, 4000);
    const exact::RayPoint ray = exact::luneburg_ray(1.0, start.x, start.p, static_cast<double>(lambda));
    for (std::size_t k = 0; k < 3; ++k) {
      // (h = 2e-3)^4 lambda/120 of the test's own stepping, and 1e-13 of its derivative.
      EXPECT_NEAR(ray.position[k], static_cast<double>(y[k]), 2e-12);
      EXPECT_NEAR(ray.momentum[k], static_cast<double>(y[k + 3]), 2e-12);
    }
    EXPECT_NEAR(exact::luneburg_optical_path(1.0, start.x, start.p, static_cast<double>(lambda)).value,
                static_cast<double>(y[6]), 4e-12);
  }
}

TEST(LuneburgExact, error_bounds_hold_over_ten_thousand_orbits) {
  std::mt19937_64 engine(12);
  for (int i = 0; i < 1000; ++i) {
    const Start start = random_start(engine, luneburg_index);
    const double R = i % 2 == 0 ? 1.0 : 0.7;
    const double lambda = std::exp(std::uniform_real_distribution<double>(-5, 11)(engine));
    const exact::RayPoint ray = exact::luneburg_ray(R, start.x, start.p, lambda);
    EXPECT_LT(ray.error, 5e-14);  // 2^-63 of the angle, 9e4 at most, on components of 3
    const Mp angle = Mp(lambda) / R, c = cos(angle), s = sin(angle);
    Mp path = 2 * lambda;
    Mp x2 = 0, p2 = 0, xp = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LE(abs(Mp(ray.position[k]) - (c * start.x[k] + R * s * start.p[k])), Mp(ray.error));
      EXPECT_LE(abs(Mp(ray.momentum[k]) - (c * start.p[k] - s / R * start.x[k])), Mp(ray.error));
      x2 += Mp(start.x[k]) * start.x[k], p2 += Mp(start.p[k]) * start.p[k], xp += Mp(start.x[k]) * start.p[k];
    }
    path -= (x2 / (Mp(R) * R) + p2) * lambda / 2 + (x2 / (Mp(R) * R) - p2) * R * s * c / 2 + xp * s * s;
    const ExactValue t = exact::luneburg_optical_path(R, start.x, start.p, lambda);
    EXPECT_LE(abs(Mp(t.value) - path), Mp(t.error));
    EXPECT_LT(t.error, 1e-15 * (10 + lambda));
  }
}

TEST(LuneburgExact, parallel_rays_meet_at_the_focus_after_the_same_path) {
  EXPECT_NEAR(exact::luneburg_path_to_focus(1.0, 0.6).value, 2.3707963267949, 5e-14);
  for (const double R : {1.0, 2.5}) {
    for (const double height : {-0.99, -0.6, 0.0, 0.3, 0.6, 0.999}) {
      const double y = height * R;
      const Vector entry{-std::sqrt((R - y) * (R + y)), y, 0}, along_x{1, 0, 0};  // n = 1 on the rim
      const double quarter = R * M_PI / 2;
      const exact::RayPoint end = exact::luneburg_ray(R, entry, along_x, quarter);
      const exact::ExactPoint focus = exact::luneburg_focus(R);
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(end.position[k], focus.position[k], 1e-15 * R + end.error);
      EXPECT_NEAR(end.momentum[0], std::sqrt(1 - height * height), 2e-15);
      EXPECT_NEAR(end.momentum[1], -height, 2e-15);
      EXPECT_NEAR(exact::luneburg_optical_path(R, entry, along_x, quarter).value,
                  exact::luneburg_path_to_focus(R, y).value, 2e-15 * R);
    }
  }
}

TEST(FishEyeExact, ray_solves_hamiltons_equations) {
  std::mt19937_64 engine(21);
  for (int i = 0; i < 20; ++i) {
    const Start start = random_start(engine, fisheye_index);
    const double t = 0.1 + 0.11 * i;
    const double lambda = exact::fisheye_affine_parameter(1.0, start.x, start.p, t).value;
    const State y = integrated([](Long r2) { return 4 / ((1 + r2) * (1 + r2)); }, start.x, start.p, lambda,
                               2000 + static_cast<int>(2000 * lambda));
    const exact::RayPoint ray = exact::fisheye_ray(1.0, start.x, start.p, t);
    for (std::size_t k = 0; k < 3; ++k) {
      // The test's own stepping at h = 5e-4; p of the start has |p| = n to 1e-16.
      EXPECT_NEAR(ray.position[k], static_cast<double>(y[k]), 1e-11);
      EXPECT_NEAR(ray.momentum[k], static_cast<double>(y[k + 3]), 1e-11);
    }
    EXPECT_NEAR(static_cast<double>(y[6]), t, 1e-11);
  }
}

TEST(FishEyeExact, error_bounds_hold) {
  // The reference: the circle itself at 50 digits by rotation on the sphere, with cos and sin of t/R.
  std::mt19937_64 engine(22);
  for (int i = 0; i < 1000; ++i) {
    const Start start = random_start(engine, fisheye_index);
    const double t = std::exp(std::uniform_real_distribution<double>(-5, 10)(engine));
    Mp x2 = 0, p2 = 0, xp = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      x2 += Mp(start.x[k]) * start.x[k], p2 += Mp(start.p[k]) * start.p[k], xp += Mp(start.x[k]) * start.p[k];
    }
    const Mp p = sqrt(p2), n = 2 / (1 + x2), along = xp / p;
    // Tangent addition in the plane of x and p, by the Moebius map of the great circle: x = (a + b tau)/(c - d tau).
    const Mp c = cos(Mp(t)), s = sin(Mp(t));
    const Mp denominator = 1 + c * (n - 1) - s * n * along;
    const exact::RayPoint ray = exact::fisheye_ray(1.0, start.x, start.p, t);
    for (std::size_t k = 0; k < 3; ++k) {
      const Mp numerator = c * n * start.x[k] + s * (start.p[k] / p - n * along * start.x[k]);
      EXPECT_LE(abs(Mp(ray.position[k]) - numerator / denominator), Mp(ray.error)) << i;
    }
    const double far = 1 + dot(ray.position, ray.position);
    EXPECT_LT(ray.error, 1e-14 * far * far);  // 2^-63 of the angle, up to 2e4
  }
}

TEST(FishEyeExact, affine_parameter_matches_quadrature) {
  std::mt19937_64 engine(23);
  exact_kit::BoundCheck check(1e-10);  // a ray that nearly meets the centre has lambda of order (R/|x cross p|)^3
  for (int i = 0; i < 20; ++i) {
    const Start start = random_start(engine, fisheye_index);
    Mp x2 = 0, p2 = 0, xp = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      x2 += Mp(start.x[k]) * start.x[k], p2 += Mp(start.p[k]) * start.p[k], xp += Mp(start.x[k]) * start.p[k];
    }
    const Mp n = 2 / (1 + x2), along = n * xp / sqrt(p2);
    const double t = 0.9 * (i + 1);
    Mp lambda = 0;  // dlambda = dt/n^2, in pieces short enough for one quadrature each
    for (int piece = 0; piece <= i; ++piece) {
      lambda += integrate([&](const Mp& s) { return Mp(1 / exact_kit::sq(1 + (n - 1) * cos(s) - along * sin(s))); },
                          Mp(t) * piece / (i + 1), Mp(t) * (piece + 1) / (i + 1));
    }
    check(exact::fisheye_affine_parameter(1.0, start.x, start.p, t), lambda, std::to_string(i));
  }
}

TEST(FishEyeExact, rays_are_circles_that_meet_at_the_image_and_close) {
  const exact::ExactPoint image = exact::fisheye_image(1.0, {0.5, 0, 0});
  EXPECT_NEAR(image.position[0], -2, image.error);
  std::mt19937_64 engine(24);
  for (const double R : {1.0, 3.0}) {
    for (int i = 0; i < 100; ++i) {
      Start start = random_start(engine, fisheye_index);
      for (double& component : start.x) component *= R;
      const exact::RayCircle circle = exact::fisheye_circle(R, start.x, start.p);
      const exact::ExactPoint antipode = exact::fisheye_image(R, start.x);
      const double period = exact::fisheye_optical_period(R).value;
      const exact::RayPoint half = exact::fisheye_ray(R, start.x, start.p, period / 2);
      const exact::RayPoint whole = exact::fisheye_ray(R, start.x, start.p, period);
      for (std::size_t k = 0; k < 3; ++k) {
        // 2 pi as a double is off by 2.4e-16.
        EXPECT_NEAR(half.position[k], antipode.position[k], half.error + antipode.error + 1e-14 * norm(half.position));
        EXPECT_NEAR(whole.position[k], start.x[k], whole.error + 4e-16 * R);
        EXPECT_NEAR(whole.momentum[k], start.p[k], whole.error + 1e-15);
      }
      for (int step = 1; step < 12; ++step) {
        const exact::RayPoint point = exact::fisheye_ray(R, start.x, start.p, period * step / 12);
        Vector spoke;
        for (std::size_t k = 0; k < 3; ++k) spoke[k] = point.position[k] - circle.centre[k];
        EXPECT_NEAR(norm(spoke), circle.radius, 8 * (circle.error + point.error));
        // Bouguer: n r sin(angle) is kept; |p| = n.
        EXPECT_NEAR(norm(point.momentum), exact::fisheye_index(R, point.position), 4 * point.error);
      }
    }
  }
}

TEST(MediumExact, bad_arguments_throw) {
  EXPECT_THROW((void)exact::luneburg_focus(0.0), std::invalid_argument);
  EXPECT_THROW((void)exact::luneburg_path_to_focus(1.0, 1.1), std::domain_error);
  EXPECT_THROW((void)exact::luneburg_ray(1.0, {std::nan(""), 0, 0}, {1, 0, 0}, 1), std::domain_error);
  EXPECT_THROW((void)exact::fisheye_image(1.0, {0, 0, 0}), std::domain_error);
  EXPECT_THROW((void)exact::fisheye_ray(1.0, {0.5, 0, 0}, {0, 0, 0}, 1), std::domain_error);
  EXPECT_THROW((void)exact::fisheye_circle(1.0, {0.5, 0, 0}, {1, 0, 0}), std::domain_error);
  EXPECT_THROW((void)exact::fisheye_affine_parameter(1.0, {0.5, 0, 0}, {1, 0, 0}, 1), std::domain_error);
}

}  // namespace
