// Fields of authors: curves against their own closed forms written out apart, gradients against duals, lanes against
// doubles, surfaces against distances, and what is refused.
#include "metrics/fields/field_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "metrics/derived.hpp"
#include "metrics/fields/field_medium.hpp"
#include "metrics/fields/grin_exact.hpp"
#include "metrics/scalar/dual.hpp"

namespace xpr {
namespace {

FieldSource source(FieldCurve curve, double a, double b = 0.0, double c = 0.0) {
  return {.name = "lens", .curve = curve, .amplitude = 0.9, .r_inner = 0.0, .r_outer = 5.0, .a = a, .b = b, .c = c};
}

/// One source of every kind, with cores, ramps, a table, a polynomial that runs into its bounds.
std::vector<FieldSource> all_kinds() {
  std::vector<FieldSource> out = {source(FieldCurve::linear, 0.0),
                                  source(FieldCurve::power, 1.8),
                                  source(FieldCurve::power, 3.0),
                                  source(FieldCurve::power, 0.0),
                                  source(FieldCurve::power, -0.4),
                                  source(FieldCurve::polynomial, 1.0, -0.5, -0.4),
                                  source(FieldCurve::polynomial, 1.4, -2.2, 0.1),
                                  source(FieldCurve::exponential, 2.5),
                                  source(FieldCurve::exponential, 0.01),
                                  source(FieldCurve::gaussian, 0.45),
                                  source(FieldCurve::gaussian, 0.08)};
  FieldSource table = source(FieldCurve::custom, 0.0);
  table.table = {1.0, 0.85, 0.9, 0.3, 0.1, 0.0};
  out.push_back(table);
  const std::size_t plain = out.size();
  for (std::size_t k = 0; k < plain; ++k) {
    FieldSource soft = out[k];
    soft.edge_softness = 0.3;
    soft.r_inner = 1.2;
    out.push_back(soft);
    soft.edge_softness = 0.7;  // both ramps overlap
    out.push_back(soft);
    FieldSource core = out[k];
    core.r_inner = 1.2;
    core.invert_sign = true;
    out.push_back(core);
  }
  return out;
}

FieldFrame turned_and_stretched() {
  const double c = std::cos(0.4), s = std::sin(0.4);
  return {{0.7, -0.3, 1.1}, {{{1.5 * c, 1.5 * s, 0.0}, {-0.8 * s, 0.8 * c, 0.0}, {0.0, 0.0, 1.1}}}};
}

FieldSet several() {
  FieldSet set;
  set.sources = {source(FieldCurve::power, 1.8), source(FieldCurve::gaussian, 0.4),
                 source(FieldCurve::exponential, 2.0), source(FieldCurve::linear, 0.0)};
  set.sources[0].world_from_local.origin = {2.0, 0.0, 0.0};
  set.sources[1].world_from_local = turned_and_stretched();
  set.sources[1].r_inner = 0.6;
  set.sources[2].shape = FieldShape::box;
  set.sources[2].half_size = {2.0, 3.0, 1.5};
  set.sources[2].world_from_local = turned_and_stretched();
  set.sources[3].edge_softness = 0.2;
  set.sources[3].invert_sign = true;
  return set;
}

std::vector<FieldVector<double>> points(int n, double size) {
  std::mt19937_64 random(20260105);
  std::vector<FieldVector<double>> out(static_cast<std::size_t>(n));
  for (auto& x : out) {
    for (double& c : x) c = size * (static_cast<double>(random() >> 11) * 0x1p-52 - 1.0);
  }
  return out;
}

TEST(FieldProfile, agrees_with_the_closed_form_that_is_written_apart) {
  for (const FieldSource& field : all_kinds()) {
    SCOPED_TRACE(std::string(field_curve_names[static_cast<std::size_t>(field.curve)]) +
                 " a = " + std::to_string(field.a) + ", softness " + std::to_string(field.edge_softness));
    const FieldModel model({{field}, {}});
    const grin_exact::RadialIndex exact(field, {});
    for (const double r : {1e-3, 0.4, 1.0, 1.3, 2.0, 3.1, 3.9, 4.6, 4.999, 5.0, 5.5}) {
      const IndexAt<double> at = model.evaluate<double>({0.36 * r, -0.48 * r, 0.8 * r});
      // ln n of up to 5: some roundings, and two of r.
      const double slope = static_cast<double>(exact.bending(r));
      EXPECT_NEAR(at.log_index, static_cast<double>(exact.log_index(r)), 8e-15 + 2e-15 * std::abs(slope)) << r;
      // The same of the slope; a negative power's grows without bound at the rim.
      const double tolerance = r > 4.99 ? 1e-10 : 2e-14;
      EXPECT_NEAR(-0.8 * at.gradient[2] + 0.48 * at.gradient[1] - 0.36 * at.gradient[0], slope, tolerance) << r;
    }
  }
}

TEST(FieldModel, has_the_gradient_that_duals_give) {
  FieldMedium medium;
  medium.fields = std::make_shared<const FieldModel>(several());
  int met = 0;
  for (const FieldVector<double>& x : points(400, 6.0)) {
    const PhaseState<double> y({0.0, x[0], x[1], x[2]}, {-1.0, 0.3, -0.2, 0.9});
    const PhaseState<double> by_hand = medium.flow(y), derived = derived_flow(medium, y);
    for (std::size_t k = 0; k < 8; ++k) EXPECT_NEAR(by_hand[k], derived[k], 2e-13 * (1.0 + std::abs(derived[k])));
    met += derived[5] != 0.0 ? 1 : 0;
  }
  EXPECT_GT(met, 150);
}

TEST(FieldModel, gives_every_lane_the_bits_of_a_double) {
  const FieldModel model(several());
  const auto where = points(64, 6.0);
  for (std::size_t begin = 0; begin < where.size(); begin += 4) {
    FieldVector<Pack<4>> x;
    Mask<4> inside;
    for (int i = 0; i < 4; ++i) {
      for (std::size_t k = 0; k < 3; ++k) set_lane(x[k], i, where[begin + static_cast<std::size_t>(i)][k]);
      set_lane(inside, i, i % 2 == 0);
    }
    const IndexAt<Pack<4>> wide = model.evaluate_side(x, inside);
    const Pack<4> distance = model.interface_distance(x);
    for (int i = 0; i < 4; ++i) {
      const FieldVector<double>& one = where[begin + static_cast<std::size_t>(i)];
      const IndexAt<double> narrow = model.evaluate_side(one, i % 2 == 0);
      EXPECT_EQ(lane(wide.log_index, i), narrow.log_index);
      for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(lane(wide.gradient[k], i), narrow.gradient[k]);
      EXPECT_EQ(lane(distance, i), model.interface_distance(one));
    }
  }
}

TEST(FieldModel, never_says_that_a_surface_is_further_than_it_is) {
  // |g(x) - g(y)| <= |x - y|, across surfaces too, where the sign changes.
  const FieldModel model(several());
  const auto where = points(4000, 6.0);
  int changes = 0;
  for (std::size_t k = 0; k + 1 < where.size(); k += 2) {
    FieldVector<double> y = where[k];
    double apart = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      y[i] += 0.05 * where[k + 1][i];
      apart += square(y[i] - where[k][i]);
    }
    const double a = model.interface_distance(where[k]), b = model.interface_distance(y);
    EXPECT_LE(std::abs(a - b), std::sqrt(apart) * (1.0 + 1e-12));
    changes += (a < 0.0) != (b < 0.0) ? 1 : 0;
  }
  EXPECT_GT(changes, 100);
}

TEST(FieldModel, goes_on_smoothly_past_the_surface_that_a_ray_has_not_crossed) {
  // exp(-2 u) does not vanish at the rim: the gradient jumps there, and its continuation does not.
  const FieldModel model({{source(FieldCurve::exponential, 2.0)}, {}});
  const auto slope = [&](double r, bool inside) {
    return model.evaluate_side<double>({r, 0.0, 0.0}, inside).gradient[0];
  };
  EXPECT_NEAR(slope(5.01, true), -0.9 * std::exp(-2.0 * 5.01 / 5.0), 1e-15);
  EXPECT_EQ(slope(5.01, false), 0.0);
  EXPECT_EQ(slope(4.99, false), 0.0);
  EXPECT_NEAR(slope(4.99, true), -0.9 * std::exp(-2.0 * 4.99 / 5.0), 1e-15);
  // A box turns its gradient on the diagonal plane |x|/2 = |y|/3.
  FieldSet box;
  box.sources = {several().sources[2]};
  box.sources[0].world_from_local = {};
  const FieldModel turned(box);
  const FieldVector<double> x = {1.001, 1.5, 0.1};
  const bool here = turned.interface_distance(x) < 0.0;
  EXPECT_NE(turned.evaluate_side(x, here).gradient[0], 0.0);
  EXPECT_EQ(turned.evaluate_side(x, here).gradient[1], 0.0);
  EXPECT_EQ(turned.evaluate_side(x, !here).gradient[0], 0.0);
  EXPECT_NE(turned.evaluate_side(x, !here).gradient[1], 0.0);
}

TEST(FieldModel, has_boxes_for_surfaces_of_equal_index) {
  FieldSource box = source(FieldCurve::power, 2.0);
  box.shape = FieldShape::box;
  box.half_size = {2.0, 3.0, 1.5};
  const FieldModel model({{box}, {}});
  const auto log_index = [&](const FieldVector<double>& x) { return model.evaluate(x).log_index; };
  const double wanted = 0.9 * 5.0 * std::pow(0.4, 3.0) / 3.0;  // u = 0.6 on the box of 0.6 times the size
  for (const FieldVector<double>& x :
       {FieldVector<double>{1.2, 0.3, 0.2}, {-1.2, 1.7, -0.8}, {0.5, 1.8, 0.3}, {0.1, -1.0, -0.9}}) {
    EXPECT_NEAR(log_index(x), wanted, 1e-15);
  }
  EXPECT_EQ(log_index({0.0, 0.0, 1.5}), 0.0);
  EXPECT_GT(log_index({1.99, 2.99, 1.49}), 0.0);
  EXPECT_EQ(log_index({2.01, 0.0, 0.0}), 0.0);
}

TEST(FieldModel, bends_by_the_same_angle_where_a_source_is_scaled_up) {
  FieldSource small = source(FieldCurve::gaussian, 0.4), large = small;
  large.world_from_local.axes = {{{3.0, 0.0, 0.0}, {0.0, 3.0, 0.0}, {0.0, 0.0, 3.0}}};
  const IndexAt<double> one = FieldModel({{small}, {}}).evaluate<double>({1.0, -0.5, 2.0});
  const IndexAt<double> three = FieldModel({{large}, {}}).evaluate<double>({3.0, -1.5, 6.0});
  EXPECT_NEAR(three.log_index, one.log_index, 1e-15);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(3.0 * three.gradient[k], one.gradient[k], 1e-15);
}

TEST(FieldModel, attracts_unless_told_otherwise_and_counts_every_gain) {
  FieldSource field = source(FieldCurve::linear, 0.0);
  field.beta_scale = 0.5;
  EXPECT_EQ(bending_of(field, {.beta = 2.0, .bend_scale = 3.0, .field_strength = 0.25}), 2.0 * 0.5 * 0.9 * 3.0 * 0.25);
  EXPECT_EQ(bending_of(field, {.beta = 0.0}), 0.5 * 0.9);  // no global beta: the scale stands for it
  field.beta_scale.reset();
  EXPECT_EQ(bending_of(field, {.beta = 0.0}), 0.0);
  EXPECT_LT(FieldModel({{field}, {}}).evaluate<double>({1.0, 0.0, 0.0}).gradient[0], 0.0);
  field.invert_sign = true;
  EXPECT_GT(FieldModel({{field}, {}}).evaluate<double>({1.0, 0.0, 0.0}).gradient[0], 0.0);
  EXPECT_EQ(FieldModel({{field}, {}}).evaluate<double>({0.0, 0.0, 0.0}).gradient[0], 0.0);
}

TEST(FieldModel, knows_where_light_ends) {
  FieldSource field = source(FieldCurve::linear, 0.0);
  EXPECT_FALSE(FieldModel({{field}, {}}).absorbs());
  field.absorb = true;
  field.r_inner = 1.0;
  const FieldModel model({{field}, {}});
  EXPECT_NEAR(model.absorber_distance({3.0, 0.0, 0.0}), 2.0, 1e-13);
  EXPECT_NEAR(model.absorber_distance({0.0, 0.5, 0.0}), -0.5, 1e-13);
}

TEST(FieldModel, refuses_what_has_no_meaning) {
  const auto refused = [](const FieldSource& field, const std::string& words) {
    try {
      const FieldModel model({{field}, {}});
      ADD_FAILURE() << "accepted, expected: " << words;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("'lens'"), std::string::npos) << error.what();
    }
  };
  refused(source(FieldCurve::custom, 0.0), "table of 0 values, needs 2 to 256");
  refused(source(FieldCurve::power, -1.0), "needs a > -1");
  refused(source(FieldCurve::gaussian, 0.0), "width a = 0, needs a > 0");
  refused(source(FieldCurve::exponential, -0.5), "needs a >= 0");
  FieldSource field = source(FieldCurve::linear, 0.0);
  field.r_inner = 5.0;
  refused(field, "needs 0 <= r_inner < r_outer");
  field.r_inner = 0.0;
  field.edge_softness = 1.5;
  refused(field, "edge_softness = 1.5");
  field.edge_softness = 0.0;
  field.amplitude = std::nan("");
  refused(field, "needs a finite number");
  field.amplitude = 1.0;
  field.absorb = true;
  refused(field, "needs r_inner > 0");
  field.absorb = false;
  field.world_from_local.axes[2] = field.world_from_local.axes[1];
  refused(field, "needs axes that span space");
  field.world_from_local = {};
  field.shape = FieldShape::box;
  field.half_size = {1.0, 0.0, 1.0};
  refused(field, "half_size[1] = 0");
}

TEST(FieldModel, refuses_absorbers_that_overlap) {
  FieldSource one = source(FieldCurve::linear, 0.0);
  one.absorb = true;
  one.r_inner = 1.0;
  FieldSource other = one;
  other.name = "other";
  other.world_from_local.origin = {1.9, 0.0, 0.0};
  EXPECT_THROW(FieldModel({{one, other}, {}}), std::invalid_argument);
  other.world_from_local.origin = {2.1, 0.0, 0.0};
  EXPECT_NO_THROW(FieldModel({{one, other}, {}}));
}

}  // namespace
}  // namespace xpr
