#include "core/geometry/path_envelope.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/geometry/bernstein.hpp"
#include "tests/core/geometry_kit.hpp"

namespace xpr {
namespace {

using testing::Draw;

constexpr double rounding = 1e-14;  // of numbers up to 10: evaluation loses at most 28 units of 2^-53 of the largest

/// sum_j a[j] theta^j as a path: c_k = sum_j binomial(k, j) / binomial(n, j) a_j.
RayPath from_powers(const std::vector<Vec3>& a) {
  RayPath path;
  path.degree = static_cast<int>(a.size()) - 1;
  for (std::size_t k = 0; k < a.size(); ++k) {
    for (std::size_t j = 0; j <= k; ++j) {
      path.control[k] = path.control[k] + (bernstein::binomials[k][j] / bernstein::binomials[a.size() - 1][j]) * a[j];
    }
  }
  return path;
}

/// A step as tracers take them: each power of theta bends less than the one before.
RayPath smooth_step(Draw& draw) {
  std::vector<Vec3> a{draw.in_cube(5.0)};
  double size = draw.uniform(0.01, 3.0);
  const double ratio = std::exp(draw.uniform(-7.0, -0.3));
  for (int j = 1, degree = draw.whole(2, RayPath::max_degree); j <= degree; ++j, size *= ratio) {
    a.push_back(size * draw.direction());
  }
  return from_powers(a);
}

TEST(RayPath, is_the_polynomial_that_its_control_points_stand_for) {
  Draw draw(11);
  for (int repeat = 0; repeat < 200; ++repeat) {
    std::vector<Vec3> a;
    for (int j = 0, degree = draw.whole(1, RayPath::max_degree); j <= degree; ++j) a.push_back(draw.in_cube(1.0));
    const RayPath path = from_powers(a);
    for (const double theta : {0.0, 0.125, 0.3, 0.5, 0.77, 1.0}) {
      Vec3 value{}, slope{};
      double power = 1.0;
      for (std::size_t j = 0; j < a.size(); ++j, power *= theta) {
        value = value + power * a[j];
        if (j + 1 < a.size()) slope = slope + (static_cast<double>(j + 1) * power) * a[j + 1];
      }
      EXPECT_LT(length(point(path, theta) - value), rounding);
      // The slope of degree 7 takes differences of control points seven times.
      EXPECT_LT(length(velocity(path, theta) - slope), 30 * rounding);
    }
  }
}

TEST(RayPath, meets_its_ends_exactly) {
  Draw draw(12);
  for (int repeat = 0; repeat < 200; ++repeat) {
    const RayPath path = draw.path(3.0, 2.0);
    EXPECT_EQ(point(path, 0.0), path.control[0]);
    EXPECT_EQ(point(path, 1.0), path.control[static_cast<std::size_t>(path.degree)]);
  }
}

TEST(RayPath, halves_are_the_same_curve) {
  Draw draw(13);
  for (int repeat = 0; repeat < 200; ++repeat) {
    const RayPath path = draw.path(3.0, 2.0);
    const auto [first, second] = halves(path);
    for (const double theta : {0.0, 0.2, 0.5, 0.9, 1.0}) {
      EXPECT_LT(length(point(first, theta) - point(path, 0.5 * theta)), rounding);
      EXPECT_LT(length(point(second, theta) - point(path, 0.5 + 0.5 * theta)), rounding);
    }
  }
}

TEST(RayPath, maps_as_its_points_do) {
  const Affine3 map{{0.3, 0.1, 0.0}, {0.0, -2.0, 0.4}, {0.2, 0.0, 1.0}, {1.0, 2.0, -3.0}};
  Draw draw(14);
  for (int repeat = 0; repeat < 100; ++repeat) {
    const RayPath path = draw.path(3.0, 2.0);
    EXPECT_LT(length(point(mapped(path, map), 0.37) - map.point(point(path, 0.37))), 2 * rounding);
  }
}

TEST(Affine3, inverse_undoes_it_and_normals_stay_across_surfaces) {
  const Affine3 map{{0.3, 0.1, 0.0}, {0.0, -2.0, 0.4}, {0.2, 0.0, 1.0}, {1.0, 2.0, -3.0}};
  const Affine3 back = map.inverse();
  Draw draw(15);
  for (int repeat = 0; repeat < 50; ++repeat) {
    const Vec3 p = draw.in_cube(4.0), u = draw.direction(), v = draw.direction();
    EXPECT_LT(length(back.point(map.point(p)) - p), 10 * rounding);
    const Vec3 normal = back.transposed(cross(u, v));
    EXPECT_NEAR(dot(normal, map.direction(u)), 0.0, rounding);
    EXPECT_NEAR(dot(normal, map.direction(v)), 0.0, rounding);
  }
  EXPECT_EQ((map * Affine3{}), map);
}

TEST(Affine3, without_inverse_is_refused) {
  const auto inverted = [](const Affine3& map) { static_cast<void>(map.inverse()); };
  EXPECT_THROW(inverted({{1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {}}), std::invalid_argument);
  EXPECT_THROW(inverted({{NAN, 0, 0}, {0, 1, 0}, {0, 0, 1}, {}}), std::invalid_argument);
  EXPECT_THROW(inverted({{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {}}), std::invalid_argument);
  // Small is not singular.
  EXPECT_NO_THROW(inverted({{1e-9, 0, 0}, {0, 1e-9, 0}, {0, 0, 1e-9}, {}}));
}

TEST(RaySegment, is_never_left_by_a_million_random_paths) {
  Draw draw(16);
  for (int repeat = 0; repeat < 1'000'000; ++repeat) {
    const RayPath path = (repeat & 1) != 0 ? draw.path(5.0, 3.0) : smooth_step(draw);
    const RaySegment segment = enclosing_segment(path);
    for (const double theta : {0.0, 0.1, 0.25, 0.4, 0.5, 0.62, 0.75, 0.93, 1.0}) {
      ASSERT_LE(distance_to_segment(point(path, theta), segment.a, segment.b), segment.radius) << repeat;
    }
  }
}

TEST(RaySegment, is_no_more_than_three_times_too_wide_in_the_median) {
  Draw draw(17);
  std::vector<double> smooth, wild;
  for (int repeat = 0; repeat < 20'001; ++repeat) {
    RayPath path = smooth_step(draw);
    smooth.push_back(slack(path, enclosing_segment(path)));
    path = draw.path(5.0, 3.0);
    if (path.degree > 1) wild.push_back(slack(path, enclosing_segment(path)));
  }
  const auto median = [](std::vector<double>& v) {
    std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
    return v[v.size() / 2];
  };
  EXPECT_LT(median(smooth), 3.0);
  EXPECT_LT(median(wild), 3.0);
  // Nor too narrow: no sample lies outside.
  EXPECT_GE(*std::min_element(smooth.begin(), smooth.end()), 1.0);
  EXPECT_GE(*std::min_element(wild.begin(), wild.end()), 1.0);
}

TEST(RaySegment, of_a_parabola_has_the_radius_of_its_control_point) {
  // y = 4 h theta (1 - theta): the middle control point is at 2 h, the path's top at h.
  RayPath path;
  path.degree = 2;
  path.control = {Vec3{0, 0, 0}, Vec3{1, 0.5, 0}, Vec3{2, 0, 0}};
  const RaySegment segment = enclosing_segment(path, 10.0);
  const double added = 0x1p-47 * 2.0;  // for rounding, of the largest coordinate
  EXPECT_NEAR(segment.radius, 0.5 + added, 1e-16);
  EXPECT_EQ(segment.travelled, 12.0);
  EXPECT_NEAR(slack(path, segment), 2.0, 5 * added);
}

TEST(RaySegment, of_a_step_of_no_length_encloses_it) {
  RayPath path;
  path.degree = 2;
  path.control = {Vec3{1, 1, 1}, Vec3{2, 1, 1}, Vec3{1, 1, 1}};
  EXPECT_GE(enclosing_segment(path).radius, 1.0);
}

}  // namespace
}  // namespace xpr
