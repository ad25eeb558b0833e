#include "core/geometry/triangle_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/geometry/path_envelope.hpp"
#include "tests/core/geometry_kit.hpp"

namespace xpr {
namespace {

using testing::Draw;
using testing::straight_path;
using Triangle = std::array<Vec3, 3>;

constexpr Triangle floor_triangle{Vec3{-1, -1, 0}, Vec3{3, -1, 0}, Vec3{-1, 3, 0}};

std::optional<PathContact> contact(const RayPath& path, const Triangle& corners) {
  Box3 box;
  for (const Vec3& p : corners) box.add(p);
  return first_contact(path, corners, contact_rounding(control_box(path).magnitude(), box.magnitude()));
}

/// A path over x = x0 + theta dx, y = 0 with the height z(theta) = scale (theta - r1)(theta - r2)(theta - r3), by its
/// Bernstein coefficients: those of a product of linear factors are sums over which factors are taken at 1.
RayPath with_roots(double x0, double dx, double scale, double r1, double r2, double r3) {
  const double a[3] = {-r1, -r2, -r3}, b[3] = {1 - r1, 1 - r2, 1 - r3};
  RayPath path;
  path.degree = 3;
  const double z[4] = {a[0] * a[1] * a[2], (b[0] * a[1] * a[2] + a[0] * b[1] * a[2] + a[0] * a[1] * b[2]) / 3,
                       (b[0] * b[1] * a[2] + b[0] * a[1] * b[2] + a[0] * b[1] * b[2]) / 3, b[0] * b[1] * b[2]};
  for (std::size_t k = 0; k < 4; ++k) path.control[k] = {x0 + static_cast<double>(k) / 3 * dx, 0.0, scale * z[k]};
  return path;
}

TEST(TriangleContact, of_a_straight_path_is_where_the_line_meets_the_plane) {
  const auto hit = contact(straight_path({0.1, 0.2, 3.0}, {0.1, 0.2, -1.0}), floor_triangle);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->theta, 0.75, 1e-15);
  EXPECT_EQ(hit->kind, Contact::crossing);
  EXPECT_FALSE(contact(straight_path({2.1, 2.2, 3.0}, {2.1, 2.2, -1.0}), floor_triangle));
  EXPECT_FALSE(contact(straight_path({0.1, 0.2, 3.0}, {0.1, 0.2, 0.5}), floor_triangle));
}

TEST(TriangleContact, is_the_first_of_several_roots) {
  const auto hit = contact(with_roots(0, 1, 1, 0.25, 0.5, 0.875), floor_triangle);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->theta, 0.25, 4e-15);  // rounding of the coefficients over the slope there
}

TEST(TriangleContact, passes_over_roots_outside_of_the_triangle) {
  // x = 6 theta: only theta < 0.5 is inside (x + y < 2 - eps ... the edge x = 2 - y at y = 0 is x = 2).
  const Triangle far{Vec3{4, -1, 0}, Vec3{8, -1, 0}, Vec3{4, 3, 0}};
  auto hit = contact(with_roots(0, 6, 1, 0.25, 0.5, 0.875), far);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->theta, 0.875, 1e-14);
  const Triangle middle{Vec3{2.5, -1, 0}, Vec3{3.5, -1, 0}, Vec3{3, 3, 0}};
  hit = contact(with_roots(0, 6, 1, 0.25, 0.5, 0.875), middle);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->theta, 0.5, 1e-14);
  const Triangle nowhere{Vec3{3.6, -1, 0}, Vec3{4.5, -1, 0}, Vec3{4, 3, 0}};
  EXPECT_FALSE(contact(with_roots(0, 6, 1, 0.25, 0.5, 0.875), nowhere));
}

TEST(TriangleContact, tells_roots_that_are_close) {
  const double gap = 1e-4;
  const auto hit = contact(with_roots(0, 1, 1, 0.5, 0.5 + gap, 0.875), floor_triangle);
  ASSERT_TRUE(hit);
  // Rounding of 3e-16 over a slope of 0.375 gap.
  EXPECT_NEAR(hit->theta, 0.5, 1e-11);
  EXPECT_EQ(hit->kind, Contact::crossing);
}

TEST(TriangleContact, of_a_path_that_only_touches_the_plane_is_called_so) {
  // z = (theta - 1/2)^2 (theta + 1): a double root.
  const auto hit = contact(with_roots(0, 1, 1, 0.5, 0.5, -1.0), floor_triangle);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->kind, Contact::touching);
  // Within the band of 3e-14 x the sides' product, z is below 1e-12 for |theta - 1/2| < 1e-6.
  EXPECT_NEAR(hit->theta, 0.5, 1e-6);
  RayPath above = with_roots(0, 1, 1, 0.5, 0.5, -1.0), below = above;
  for (Vec3& c : above.control) c.z += 1e-9;
  for (Vec3& c : below.control) c.z -= 1e-9;
  EXPECT_FALSE(contact(above, floor_triangle));
  const auto dips = contact(below, floor_triangle);
  ASSERT_TRUE(dips);
  EXPECT_EQ(dips->kind, Contact::crossing);
  // (theta - 1/2)^2 1.5 = 1e-9.
  EXPECT_NEAR(dips->theta, 0.5 - std::sqrt(1e-9 / 1.5), 1e-9);
}

TEST(TriangleContact, of_a_path_that_goes_through_with_a_triple_root_is_a_crossing) {
  const auto hit = contact(with_roots(0, 1, 1, 0.5, 0.5, 0.5), floor_triangle);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->kind, Contact::crossing);
  EXPECT_NEAR(hit->theta, 0.5, 2e-4);  // the cube root of the band
}

TEST(TriangleContact, of_a_path_in_the_plane_is_where_it_enters) {
  const auto enters = contact(straight_path({-3, 0, 0}, {1, 0, 0}), floor_triangle);
  ASSERT_TRUE(enters);
  EXPECT_EQ(enters->kind, Contact::in_plane);
  EXPECT_NEAR(enters->theta, 0.5, 1e-12);  // x = -1; edges are widened by 3e-14 of the coordinates
  const auto begins_inside = contact(straight_path({0, 0, 0}, {5, 0, 0}), floor_triangle);
  ASSERT_TRUE(begins_inside);
  EXPECT_EQ(begins_inside->theta, 0.0);
  EXPECT_FALSE(contact(straight_path({-3, -2, 0}, {5, -2, 0}), floor_triangle));
  // Curved within the plane: y = 8 (theta - 1/2)^2 - 3/2 comes below -1 at theta = 1/4 + ..., enters from above at x.
  RayPath curved;
  curved.degree = 2;
  curved.control = {Vec3{-2, 4, 0}, Vec3{0, -4, 0}, Vec3{2, 4, 0}};
  const auto hit = contact(curved, floor_triangle);
  ASSERT_TRUE(hit);
  // x = 4 theta - 2 = -1 at theta = 1/4, where y = 16 (theta - 1/2)^2 = 1 lies between the corners -1 and 3.
  EXPECT_NEAR(hit->theta, 0.25, 1e-12);
}

TEST(TriangleContact, counts_both_ends_of_the_path) {
  EXPECT_EQ(contact(straight_path({0, 0, 0}, {0, 0, 1}), floor_triangle)->theta, 0.0);
  EXPECT_NEAR(contact(straight_path({0, 0, 1}, {0, 0, 0}), floor_triangle)->theta, 1.0, 1e-12);
  EXPECT_FALSE(contact(straight_path({0, 0, 1}, {0, 0, 1e-9}), floor_triangle));
}

TEST(TriangleContact, takes_edges_and_corners_as_inside) {
  for (const Vec3& p :
       {Vec3{-1, -1, 0}, Vec3{3, -1, 0}, Vec3{-1, 3, 0}, Vec3{1, 1, 0}, Vec3{-1, 0, 0}, Vec3{0, -1, 0}}) {
    EXPECT_TRUE(contact(straight_path(p + Vec3{0.3, 0.1, 1}, p - Vec3{0.3, 0.1, 1}), floor_triangle)) << p.x << p.y;
  }
  EXPECT_FALSE(contact(straight_path({-1 - 1e-9, 0, 1}, {-1 - 1e-9, 0, -1}), floor_triangle));
}

TEST(TriangleContact, lies_on_the_plane_to_rounding) {
  Draw draw(21);
  int hits = 0;
  for (int repeat = 0; repeat < 100'000; ++repeat) {
    const RayPath path = draw.path(1.0, 3.0);
    const Triangle corners{draw.in_cube(2.0), draw.in_cube(2.0), draw.in_cube(2.0)};
    const Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    if (length(normal) < 0.1) continue;
    const auto hit = contact(path, corners);
    if (!hit) continue;
    ++hits;
    // Half a unit in the last place of theta, 1e-16, moves a path of speed 20 by 2e-15; evaluation adds as much.
    EXPECT_NEAR(dot(normalized(normal), point(path, hit->theta) - corners[0]), 0.0, 2e-13) << repeat;
  }
  EXPECT_GT(hits, 5'000);
}

/// The unit circle's arc from phi to phi + h, as the Hermite interpolant of its ends with one or two derivatives: what
/// dense output is like, of local order 4 or 6.
RayPath arc(double phi, double h, bool quintic) {
  const auto at = [](double p) { return Vec3{std::cos(p), std::sin(p), 0.0}; };
  const auto slope = [](double p) { return Vec3{-std::sin(p), std::cos(p), 0.0}; };
  const Vec3 a = at(phi), b = at(phi + h), da = h * slope(phi), db = h * slope(phi + h);
  RayPath path;
  if (!quintic) {
    path.degree = 3;
    path.control = {a, a + (1.0 / 3) * da, b - (1.0 / 3) * db, b};
    return path;
  }
  const Vec3 dda = (-h * h) * a, ddb = (-h * h) * b;
  path.degree = 5;
  path.control = {a, a + 0.2 * da, a + 0.4 * da + 0.05 * dda, b - 0.4 * db + 0.05 * ddb, b - 0.2 * db, b};
  return path;
}

/// The largest error of the point where arcs of length h meet the plane x + y = 1.2, over ten places in the step.
double hit_error(double h, bool quintic, bool chord) {
  const double angle = std::acos(1.2 / std::sqrt(2.0)) + 0.25 * 3.141592653589793;  // cos(phi - pi/4) = 1.2 / sqrt 2
  const Vec3 exact{std::cos(angle), std::sin(angle), 0.0};
  const Triangle wall{Vec3{3.2, -2, -3}, Vec3{-1.8, 3, -3}, Vec3{0.6, 0.6, 9}};
  double worst = 0.0;
  for (int place = 0; place < 10; ++place) {
    RayPath path = arc(angle - h * (0.3 + 0.04 * place), h, quintic);
    if (chord) path = straight_path(path.control[0], path.control[static_cast<std::size_t>(path.degree)]);
    const auto hit = contact(path, wall);
    EXPECT_TRUE(hit);
    if (hit) worst = std::max(worst, length(point(path, hit->theta) - exact));
  }
  return worst;
}

TEST(TriangleContact, error_falls_at_the_order_of_the_dense_output_and_not_of_its_chord) {
  const auto slope = [](bool quintic, bool chord) {
    return std::log2(hit_error(0.4, quintic, chord) / hit_error(0.2, quintic, chord));
  };
  EXPECT_NEAR(slope(false, false), 4.0, 0.3);
  EXPECT_NEAR(slope(true, false), 6.0, 0.4);
  EXPECT_NEAR(slope(true, true), 2.0, 0.3);
  // Down to rounding of a tilted plane.
  EXPECT_LT(hit_error(0.005, true, false), 2e-15);
}

TEST(TriangleContact, finds_all_paths_that_go_from_one_side_to_the_other_through_two_neighbours) {
  // Two triangles with a common edge and every fold between them; a path bends through a point of the edge, at any
  // angle, grazing too.
  Draw draw(22);
  int crossed = 0;
  for (int repeat = 0; repeat < 100'000; ++repeat) {
    const Vec3 a = draw.in_cube(1.0), b = draw.in_cube(1.0);
    const Triangle left{a, b, draw.in_cube(3.0)}, right{b, a, draw.in_cube(3.0)};
    const Vec3 on_edge = a + draw.uniform(0.1, 0.9) * (b - a);
    RayPath path = draw.path(1.0, draw.whole(0, 1) != 0 ? 1.0 : 0.01);
    const Vec3 shift = on_edge - point(path, 0.5);
    for (Vec3& c : path.control) c = c + shift;
    if (length(b - a) < 0.1) continue;
    ++crossed;
    EXPECT_TRUE(contact(path, left) || contact(path, right)) << repeat;
  }
  EXPECT_GT(crossed, 90'000);
}

TEST(TriangleContact, has_barycentric_coordinates_of_its_point) {
  Draw draw(23);
  for (int repeat = 0; repeat < 1000; ++repeat) {
    const Triangle corners{draw.in_cube(2.0), draw.in_cube(2.0), draw.in_cube(2.0)};
    const double u = draw.uniform(0.0, 0.5), v = draw.uniform(0.0, 0.5), w = 1.0 - u - v;
    const std::array<double, 3> b = barycentric_at(corners, u * corners[0] + v * corners[1] + w * corners[2]);
    const double area = length(cross(corners[1] - corners[0], corners[2] - corners[0]));
    // Products of differences up to 4, rounded, over the area.
    EXPECT_NEAR(b[0], u, 3e-14 / area);
    EXPECT_NEAR(b[1], v, 3e-14 / area);
    EXPECT_NEAR(b[2], w, 3e-14 / area);
  }
}

}  // namespace
}  // namespace xpr
