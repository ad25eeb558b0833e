// What is built over fields: the older stepper as it was, bounds that are bounds, the tree, the lattice.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/fields/field_bounds.hpp"
#include "core/fields/kick_drift.hpp"

namespace xpr {
namespace {

FieldSource lens(FieldCurve curve, double a, const std::array<double, 3>& origin) {
  FieldSource out{.name = "lens", .curve = curve, .amplitude = 0.9, .r_outer = 5.0, .a = a};
  out.world_from_local.origin = origin;
  return out;
}

FieldSet many(std::size_t n) {
  std::mt19937_64 random(20260106);
  const auto number = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  FieldSet set{.sources = {}, .gains = {.beta = 0.7, .bend_scale = 1.3, .field_strength = 2.0}};
  for (std::size_t k = 0; k < n; ++k) {
    FieldSource field = lens(static_cast<FieldCurve>(k % 5), 0.5 + 2.0 * number(),
                             {20.0 * number() - 10.0, 20.0 * number() - 10.0, 20.0 * number() - 10.0});
    if (field.curve == FieldCurve::polynomial) field.a = 0.2, field.b = 2.4, field.c = -2.5;  // largest inside
    field.r_outer = 1.0 + 3.0 * number();
    field.r_inner = k % 3 == 0 ? 0.4 : 0.0;
    field.edge_softness = k % 4 == 0 ? 0.2 : 0.0;
    field.shape = k % 2 == 0 ? FieldShape::sphere : FieldShape::box;
    field.half_size = {0.5 + 2.0 * number(), 1.0, 0.5 + 2.0 * number()};
    const double c = std::cos(number()), s = std::sin(number());
    field.world_from_local.axes = {{{c, s, 0.0}, {-0.8 * s, 0.8 * c, 0.0}, {0.0, 0.1, 1.1}}};
    field.invert_sign = k % 5 == 2;
    set.sources.push_back(field);
  }
  return set;
}

struct Numbers {
  std::mt19937_64 random{20260107};
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  }
  Vec3 point(double size) { return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)}; }
};

double bending_at(const FieldModel& fields, const Vec3& x) {
  const FieldVector<double> a = fields.evaluate<double>({x.x, x.y, x.z}).gradient;
  return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

TEST(KickDrift, takes_the_steps_that_it_took) {
  // |a| = 0.9 (1 - 3/5) = 0.36 across: h = 0.25/(1 + 0.05 * 0.36), then the kick, then the drift.
  const FieldModel fields({{lens(FieldCurve::linear, 0.0, {0.0, 0.0, 0.0})}, {}});
  const KickDriftState next = kick_drift_step(fields, {}, {{0.0, 3.0, 0.0}, {1.0, 0.0, 0.0}});
  const double h = 0.25 / 1.018, tilt = 0.36 * h, norm = std::sqrt(1.0 + tilt * tilt);
  EXPECT_NEAR(next.travelled, h, 1e-15);
  EXPECT_NEAR(next.direction.y, -tilt / norm, 1e-15);
  EXPECT_NEAR(next.position.x, h / norm, 1e-15);
  EXPECT_NEAR(next.position.y, 3.0 - h * tilt / norm, 1e-15);
  // Away from the field steps are boosted; the cap holds |a|.
  EXPECT_EQ(kick_drift_step(fields, {}, {{9.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}).travelled, 0.5);
  KickDriftSettings capped;
  capped.acceleration_cap = 0.1;
  EXPECT_NEAR(kick_drift_step(fields, capped, {{0.0, 3.0, 0.0}, {1.0, 0.0, 0.0}}).travelled, 0.25 / 1.005, 1e-15);
}

TEST(KickDrift, is_of_first_order_in_end_position_at_fixed_arc_length) {
  const FieldModel fields({{lens(FieldCurve::power, 1.8, {0.0, 0.0, 0.0})}, {}});
  const auto end = [&](double h) {
    const KickDriftSettings settings{.max_steps = 1'000'000,
                                     .step_length = h,
                                     .min_step = h,
                                     .max_step = h,
                                     .acceleration_cap = std::nullopt,
                                     .max_distance = 8.0};
    return trace_kick_drift(fields, {-4.0, 1.5, 0.2}, {1.0, 0.0, 0.0}, settings).state.position;
  };
  const double coarse = length(end(1.0 / 64) - end(1.0 / 128)), fine = length(end(1.0 / 128) - end(1.0 / 256));
  EXPECT_NEAR(std::log2(coarse / fine), 1.0, 0.02);  // the next order is h = 1/128 of it
}

TEST(KickDrift, says_how_a_ray_ended) {
  FieldSource core = lens(FieldCurve::linear, 0.0, {0.0, 0.0, 0.0});
  core.absorb = true;
  core.r_inner = 1.0;
  const FieldModel fields({{core}, {}});
  const auto status = [&](const Vec3& from, const KickDriftSettings& settings) {
    return trace_kick_drift(fields, from, {1.0, 0.0, 0.0}, settings).status;
  };
  EXPECT_EQ(status({-4.0, 0.0, 0.0}, {}), Status::captured);
  EXPECT_EQ(status({-40.0, 0.0, 0.0}, {}), Status::max_steps);
  EXPECT_EQ(status({-40.0, 0.0, 0.0}, {.max_distance = 3.0}), Status::max_affine);
  EXPECT_EQ(status({std::nan(""), 0.0, 0.0}, {}), Status::not_finite);
  const KickDriftEnd end =
      trace_kick_drift(fields, {-40.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {},
                       [](const auto&, const KickDriftState& to) { return to.position.x < -38.0; });
  EXPECT_EQ(end.status, Status::hit);
  EXPECT_THROW((void)status({}, {.min_step = 0.0}), std::invalid_argument);
}

TEST(CurvatureBound, is_never_below_the_bending_of_any_point_of_the_box) {
  const FieldModel fields(many(24));
  Numbers number;
  std::vector<double> slack;
  for (int trial = 0; trial < 3000; ++trial) {
    const Vec3 low = number.point(11.0);
    const double size = number(0.01, 2.0);
    const FieldBox box{low, low + Vec3{size, 0.5 * size, size}};
    const double bound = curvature_bound(fields, box);
    for (int k = 0; k < 12; ++k) {
      const Vec3 x{number(box.low.x, box.high.x), number(box.low.y, box.high.y), number(box.low.z, box.high.z)};
      const double bending = bending_at(fields, x);
      ASSERT_LE(bending, bound) << x.x << ' ' << x.y << ' ' << x.z;
      if (bending > 0.0 && size < 0.2) slack.push_back(bound / bending);
    }
  }
  ASSERT_GT(slack.size(), 100U);
  std::nth_element(slack.begin(), slack.begin() + static_cast<std::ptrdiff_t>(slack.size() / 2), slack.end());
  EXPECT_LT(slack[slack.size() / 2], 3.0);  // fields of opposite sign cancel in the bending, not in the bound
}

TEST(CurvatureBound, holds_from_a_grid_too_and_outside_it) {
  const auto fields = std::make_shared<const FieldModel>(many(24));
  const CurvatureBoundGrid grid(fields, {{-5.0, -5.0, -5.0}, {5.0, 5.0, 5.0}}, {8, 8, 8});
  Numbers number;
  for (int trial = 0; trial < 20000; ++trial) {
    const Vec3 x = number.point(11.0);
    ASSERT_LE(bending_at(*fields, x), grid.at(x));
  }
  EXPECT_GT(grid.at({100.0, 0.0, 0.0}), 0.0);
  EXPECT_EQ(curvature_bound(*fields, {{100.0, 0.0, 0.0}, {101.0, 1.0, 1.0}}), 0.0);
}

TEST(CurvatureBound, sees_a_polynomial_that_is_largest_inside) {
  FieldSource hump = lens(FieldCurve::polynomial, 0.0, {0.0, 0.0, 0.0});
  hump.b = 4.0, hump.c = -4.0;  // 0 at both ends, 1 in the middle
  const FieldModel fields({{hump}, {}});
  const double bound = curvature_bound(fields, {{2.4, -0.1, -0.1}, {2.6, 0.1, 0.1}});
  EXPECT_GE(bound, 0.9);
  EXPECT_LT(bound, 0.91);
}

TEST(CurvatureBound, gives_envelopes_and_steps) {
  // A circle of radius 2 stands 2 - sqrt(3) off its chord of length 2.
  EXPECT_NEAR(sagitta_bound(0.5, 2.0), 2.0 - std::sqrt(3.0), 1e-12);
  EXPECT_GE(sagitta_bound(0.5, 2.0), 2.0 - std::sqrt(3.0));
  EXPECT_NEAR(sagitta_bound(1e-3, 0.1), 1e-3 * 0.01 / 8.0, 1e-15);
  EXPECT_EQ(sagitta_bound(0.0, 5.0), 0.0);
  EXPECT_TRUE(std::isinf(sagitta_bound(1.0, 2.5)));
  EXPECT_EQ(step_for_curvature(0.02, 1e-4, 1e-3, 1.0), 0.1);
  EXPECT_EQ(step_for_curvature(0.0, 1e-4, 1e-3, 1.0), 1.0);
  EXPECT_EQ(step_for_curvature(1e9, 1e-4, 1e-3, 1.0), 1e-3);
}

TEST(FieldTlas, finds_what_looking_at_every_field_finds) {
  for (const std::size_t n : {std::size_t{0}, std::size_t{1}, std::size_t{5}, std::size_t{200}}) {
    const FieldModel fields(many(n));
    const FieldTlas tree(fields);
    Numbers number;
    std::vector<std::uint32_t> found;
    for (int trial = 0; trial < 300; ++trial) {
      const Vec3 x = number.point(12.0);
      const Vec3 y = trial % 2 == 0 ? x : x + Vec3{number(0.0, 3.0), number(0.0, 3.0), number(0.0, 3.0)};
      std::vector<std::uint32_t> expected;
      for (std::uint32_t k = 0; k < fields.fields().size(); ++k) {
        const auto& bounds = fields.fields()[k].bounds();
        bool meets = true;
        for (std::size_t i = 0; i < 3; ++i) meets = meets && x[i] <= bounds[i][1] && y[i] >= bounds[i][0];
        if (meets) expected.push_back(k);
      }
      if (trial % 2 == 0) {
        tree.query_point(x, found);
      } else {
        tree.query_box({x, y}, found);
      }
      EXPECT_EQ(found, expected);
    }
  }
}

TEST(FieldTlas, holds_all_that_bends) {
  const FieldModel fields(many(40));
  const FieldTlas tree(fields);
  Numbers number;
  std::vector<std::uint32_t> found;
  for (int trial = 0; trial < 5000; ++trial) {
    const Vec3 x = number.point(12.0);
    tree.query_point(x, found);
    if (!found.empty()) continue;
    EXPECT_EQ(bending_at(fields, x), 0.0);
  }
}

TEST(FieldGrid, is_exact_on_its_points_second_order_between_and_silent_outside) {
  FieldSource field = lens(FieldCurve::gaussian, 0.5, {0.1, -0.2, 0.3});
  field.r_inner = 0.5;  // smooth in the box below
  const FieldModel fields({{field}, {}});
  const FieldBox box{{0.8, 0.6, 0.7}, {2.0, 2.1, 1.9}};
  const auto worst = [&](std::size_t n) {
    const FieldGrid grid(fields, box, {n, n, n});
    for (const std::size_t i : {std::size_t{0}, n / 2, n - 1}) {
      const Vec3 x = grid.point(i, n - 1 - i, i);
      const FieldVector<double> a = fields.evaluate<double>({x.x, x.y, x.z}).gradient;
      EXPECT_LE(length(grid.at(x).value() - Vec3{a[0], a[1], a[2]}), 1e-15);
    }
    Numbers number;
    double largest = 0.0;
    for (int trial = 0; trial < 2000; ++trial) {
      const Vec3 x{number(box.low.x, box.high.x), number(box.low.y, box.high.y), number(box.low.z, box.high.z)};
      const FieldVector<double> a = fields.evaluate<double>({x.x, x.y, x.z}).gradient;
      largest = std::max(largest, length(grid.at(x).value() - Vec3{a[0], a[1], a[2]}));
    }
    return largest;
  };
  EXPECT_NEAR(std::log2(worst(17) / worst(33)), 2.0, 0.15);
  const FieldGrid grid(fields, box, {4, 4, 4});
  EXPECT_FALSE(grid.at({0.79, 1.0, 1.0}).has_value());
  EXPECT_FALSE(grid.at({1.0, 1.0, 1.91}).has_value());
  EXPECT_FALSE(grid.at({std::nan(""), 1.0, 1.0}).has_value());
  EXPECT_THROW(FieldGrid(fields, box, {4, 1, 4}), std::invalid_argument);
}

}  // namespace
}  // namespace xpr
