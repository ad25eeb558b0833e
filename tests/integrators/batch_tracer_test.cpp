#include "integrators/batch_tracer.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <random>
#include <string>
#include <vector>

#include "metrics/catalogue.hpp"
#include "metrics/fields/field_medium.hpp"
#include "metrics/null_cone.hpp"
#include "metrics/spacetime.hpp"

namespace xpr {
namespace {

/// Rays from everywhere in a chart, both ways in time: near the axis and off the equator, near and far from the centre,
/// on both sheets where there are two, some beyond the stops, one that is no ray.
std::vector<BatchRay> rays_everywhere(const Spacetime& chart) {
  std::mt19937_64 random(20261122);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<BatchRay> rays;
  const auto& coordinates = chart.card().coordinates;
  for (int k = 0; k < 60; ++k) {
    Vec4<double> x{uniform(random), 0.0, 0.0, 0.0};
    Vec4<double> p{-1.0, uniform(random), uniform(random), uniform(random)};
    const double size = k % 3 == 0 ? 1.5 : k % 3 == 1 ? 6.0 : 25.0;
    for (std::size_t i = 1; i < 4; ++i) {
      switch (coordinates[i].kind) {
        case CoordinateKind::polar_angle:
          x[i] = 1.5 + 1.4 * uniform(random);
          p[i] *= size;
          break;
        case CoordinateKind::azimuth:
        case CoordinateKind::latitude:
          x[i] = uniform(random);
          p[i] *= size;
          break;
        default:
          x[i] = size * uniform(random);
      }
    }
    if (k % 7 == 0 && coordinates[1].name == "x") x[1] = x[2] = 1e-9;
    if (!chart.inside_domain(x)) x[1] = 2.0 * size;
    const auto on_cone = null_momentum(chart, x, p, k % 2 == 0 ? 1.0 : -1.0);
    rays.push_back({.start = {x, on_cone.value_or(p)}, .sheet = k % 5 == 0 && chart.proper_distance(x, -1) ? -1 : 1});
    if (k % 4 == 0) rays.back().r_max = 20.0 + k;
  }
  rays[17].start[5] = std::numeric_limits<double>::quiet_NaN();
  return rays;
}

TraceSettings settings_of(const Spacetime& chart, const std::string& method) {
  TraceSettings settings;
  settings.method = method;
  settings.tol = 1e-8;
  settings.step = 0.05;
  settings.r_max = 30.0;
  settings.r_min = chart.default_r_min();
  settings.lambda_max = 60.0;
  settings.max_steps = 700;
  return settings;
}

/// The bits of what a ray's end says; every NaN is the same one.
std::vector<std::uint64_t> bits_of(const RayEnd& end) {
  std::vector<double> numbers{end.lambda,
                              end.null_residual,
                              end.null_residual_max,
                              static_cast<double>(end.steps),
                              static_cast<double>(end.rejected),
                              static_cast<double>(end.windings),
                              static_cast<double>(end.sheet),
                              static_cast<double>(end.status)};
  numbers.insert(numbers.end(), end.y.c.begin(), end.y.c.end());
  std::vector<std::uint64_t> bits;
  for (const double x : numbers) bits.push_back(x == x ? std::bit_cast<std::uint64_t>(x) : 0x7ff8000000000000U);
  return bits;
}

/// Traces all rays at every width; tells the rays that differ from trace_ray's, and counts the statuses.
std::vector<int> compare(const Spacetime& chart, std::span<const BatchRay> rays, const TraceSettings& settings,
                         const std::string& what) {
  std::vector<RayEnd> alone;
  std::vector<int> counts(status_names.size());
  for (const BatchRay& ray : rays) {
    TraceSettings own = settings;
    if (ray.r_max) own.r_max = ray.r_max;
    alone.push_back(trace_ray(chart, ray.start, ray.sheet, own));
    ++counts[static_cast<std::size_t>(alone.back().status)];
  }
  for (const int lanes : lane_widths) {
    std::vector<RayEnd> ends(rays.size());
    trace_rays(chart, rays, settings, lanes, ends);
    for (std::size_t k = 0; k < rays.size(); ++k) {
      EXPECT_EQ(bits_of(ends[k]), bits_of(alone[k]))
          << what << ", " << lanes << " lanes, ray " << k << ": " << to_string(ends[k].status) << " for "
          << to_string(alone[k].status) << ", " << ends[k].steps << " steps for " << alone[k].steps;
      EXPECT_EQ(ends[k].chart == &chart, alone[k].chart == &chart);
    }
  }
  return counts;
}

TEST(BatchTracer, gives_the_bits_of_single_rays_at_every_width_in_every_chart) {
  std::vector<int> counts(status_names.size());
  for (const CatalogueEntry& entry : catalogue()) {
    const auto chart = entry.make({});
    const std::vector<BatchRay> rays = rays_everywhere(*chart);
    for (const std::string method : {"dopri54", "dop853", "rk4"}) {
      const std::string what = std::string(entry.card->metric) + " " + std::string(entry.card->chart) + " " + method;
      const std::vector<int> some = compare(*chart, rays, settings_of(*chart, method), what);
      for (std::size_t s = 0; s < counts.size(); ++s) counts[s] += some[s];
    }
  }
  // The rays meet what there is to meet.
  for (const Status status : {Status::escaped, Status::captured, Status::max_steps, Status::max_affine,
                              Status::not_finite, Status::outside_domain}) {
    EXPECT_GT(counts[static_cast<std::size_t>(status)], 0) << to_string(status);
  }
}

TEST(BatchTracer, gives_them_for_every_explicit_method) {
  const auto kerr = make_spacetime("kerr", "kerr-schild-outgoing");
  const std::vector<BatchRay> rays = rays_everywhere(*kerr);
  for (const MethodCard& method : methods()) {
    const TraceSettings settings = settings_of(*kerr, std::string(method.id));
    const bool explicit_method =
        std::string("euler midpoint heun2 rk4 rkf45 dopri54 dop853").find(method.id) < std::string::npos;
    EXPECT_EQ(!method.separable_only && runs_in_lanes(*kerr, settings), explicit_method) << method.id;
    if (explicit_method) compare(*kerr, rays, settings, std::string(method.id));
  }
}

TEST(BatchTracer, gives_them_with_projection_and_through_throats_and_rims) {
  const auto kerr = make_spacetime("kerr", "kerr-schild");
  for (const Projection projection : {Projection::energy, Projection::momentum, Projection::full}) {
    TraceSettings settings = settings_of(*kerr, "dopri54");
    settings.projection = projection;
    compare(*kerr, rays_everywhere(*kerr), settings, "projected");
  }
  const auto wormhole = make_spacetime("ellis", "isotropic");
  TraceSettings settings = settings_of(*wormhole, "dop853");
  settings.l_min = -12.0;
  EXPECT_GT(
      compare(*wormhole, rays_everywhere(*wormhole), settings, "throat")[static_cast<std::size_t>(Status::crossed)], 0);
}

/// Fields that overlap, one a box, one with a rim at which light bends at once, one with soft edges.
FieldSet overlapping_fields() {
  FieldSource power{.name = "power", .curve = FieldCurve::power, .amplitude = 0.4, .r_outer = 5.0, .a = 1.8};
  power.world_from_local.origin = {2.0, 0.0, 0.0};
  FieldSource box{
      .name = "box", .curve = FieldCurve::linear, .shape = FieldShape::box, .amplitude = 0.2, .r_outer = 3.0};
  box.half_size = {3.0, 2.0, 4.0};
  FieldSource rim{.name = "rim", .curve = FieldCurve::exponential, .amplitude = 0.3, .r_outer = 2.0, .a = 1.0};
  rim.world_from_local.origin = {-4.0, 1.0, 2.0};
  FieldSource soft{.name = "soft", .curve = FieldCurve::gaussian, .amplitude = 0.3, .r_outer = 4.0, .a = 0.5};
  soft.edge_softness = 0.2;
  soft.r_inner = 0.5;
  return {.sources = {power, box, rim, soft}, .gains = {}};
}

TEST(BatchTracer, gives_them_across_the_surfaces_of_fields) {
  const auto fields = make_field_spacetime(overlapping_fields());
  const std::vector<BatchRay> rays = rays_everywhere(*fields);
  for (const std::string method : {"dopri54", "dop853"}) {
    const std::vector<int> counts = compare(*fields, rays, settings_of(*fields, method), "fields " + method);
    EXPECT_GT(counts[static_cast<std::size_t>(Status::escaped)], 30);
  }
}

TEST(BatchTracer, misses_no_field_that_a_long_step_would_jump) {
  // Straight light takes steps as long as its way: the rim of a field that it grazes has to end one.
  FieldSource lens{.name = "lens", .curve = FieldCurve::exponential, .amplitude = 0.9, .r_outer = 5.0, .a = 2.0};
  const auto medium = make_field_spacetime({.sources = {lens}, .gains = {}});
  TraceSettings settings;
  settings.r_max = 2000.0;
  settings.tol = 1e-9;
  for (const double b : {0.5, 3.0, 4.9, 4.999}) {
    const std::vector<BatchRay> rays(1, {.start = {{0.0, -1000.0, b, 0.0}, {-1.0, 1.0, 0.0, 0.0}}});
    for (const int lanes : lane_widths) {
      std::vector<RayEnd> ends(1);
      trace_rays(*medium, rays, settings, lanes, ends);
      EXPECT_NE(ends[0].y[6], 0.0) << "b = " << b;
    }
  }
}

TEST(BatchTracer, refuses_other_widths_and_too_little_room) {
  const auto flat = make_spacetime("minkowski", "cartesian");
  const std::vector<BatchRay> rays(2, {.start = {{0.0, 0.0, 0.0, 0.0}, {-1.0, 1.0, 0.0, 0.0}}});
  std::vector<RayEnd> ends(2);
  TraceSettings settings;
  settings.r_max = 10.0;
  EXPECT_THROW(trace_rays(*flat, rays, settings, 3, ends), std::invalid_argument);
  EXPECT_THROW(trace_rays(*flat, rays, settings, 4, std::span(ends).first(1)), std::invalid_argument);
  // A stop that only some ray knows would be missed by the others, or met late.
  std::vector<BatchRay> own = rays;
  own[1].r_max = 5.0;
  settings.r_max.reset();
  EXPECT_THROW(trace_rays(*flat, own, settings, 4, ends), std::invalid_argument);
  settings.r_max = 10.0;
  settings.tol = -1.0;
  EXPECT_THROW(trace_rays(*flat, rays, settings, 4, ends), std::invalid_argument);
}

}  // namespace
}  // namespace xpr
