#include "integrators/path_watch.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "integrators/batch_tracer.hpp"
#include "integrators/root.hpp"
#include "metrics/catalogue.hpp"
#include "metrics/chart_map.hpp"
#include "metrics/null_cone.hpp"
#include "metrics/schwarzschild_exact.hpp"

namespace xpr {
namespace {

/// The plane x = level, looked for on the dense output; counts how often it was asked.
class Wall final : public PathWatch {
 public:
  explicit Wall(double level) : level_(level) {}

  bool may_meet(const std::array<double, 3>& begin, const std::array<double, 3>& end,
                const std::array<double, 3>& bend) override {
    const double reach = std::sqrt(bend[0] * bend[0] + bend[1] * bend[1] + bend[2] * bend[2]);
    const double low = std::min(begin[0], end[0]) - reach, high = std::max(begin[0], end[0]) + reach;
    return low <= level_ && level_ <= high;
  }
  std::optional<double> first_meeting(std::size_t ray, const StepView& step) override {
    const auto g = [&](double theta) { return step.at(theta)[1] - level_; };
    const double g0 = step.begin[1] - level_, g1 = step.end[1] - level_;
    if (g0 == 0.0 || (g0 < 0.0) == (g1 < 0.0)) return std::nullopt;
    met_.push_back(ray);
    return bracketed_root(g, 0.0, 1.0, g0, g1);
  }
  [[nodiscard]] const std::vector<std::size_t>& met() const { return met_; }

 private:
  double level_;
  std::vector<std::size_t> met_;
};

/// Light in Schwarzschild with impact parameters of about 8 to 16 M, from x = 30 M towards the hole.
std::vector<BatchRay> beam(const Spacetime& chart) {
  std::vector<BatchRay> rays;
  for (int k = 0; k < 9; ++k) {
    const Vec4<double> x{0.0, 30.0, 8.0 + k, 0.0};
    const std::optional<Vec4<double>> p = null_momentum(chart, x, {-1.0, -1.0, 0.0, 0.0}, 1.0);
    rays.push_back({.start = {x, p.value()}});
  }
  return rays;
}

TraceSettings settings_of(const char* method) {
  TraceSettings settings;
  settings.method = method;
  settings.tol = 1e-11;
  settings.step = 0.05;
  settings.r_max = 100.0;
  settings.r_min = 2.02;
  return settings;
}

TEST(PathWatch, ends_rays_on_the_thing_the_same_at_every_width) {
  const auto hole = make_spacetime("schwarzschild", "kerr-schild", {});
  const std::vector<BatchRay> rays = beam(*hole);
  for (const char* method : {"dop853", "dopri54", "rk4", "gl6"}) {
    const TraceSettings settings = settings_of(method);
    std::vector<RayEnd> first(rays.size());
    for (const int lanes : lane_widths) {
      Wall wall(-20.0);
      std::vector<RayEnd> ends(rays.size());
      trace_rays(*hole, rays, settings, lanes, ends, &wall);
      EXPECT_EQ(wall.met().size(), rays.size()) << method;
      for (std::size_t k = 0; k < rays.size(); ++k) {
        EXPECT_EQ(ends[k].status, Status::hit) << method << ", ray " << k;
        // The root is found to rounding of x, of size 20.
        EXPECT_NEAR(ends[k].y[1], -20.0, 1e-13) << method << ", ray " << k;
        if (lanes == 1) first[k] = ends[k];
        for (std::size_t i = 0; i < 8; ++i) {
          EXPECT_EQ(std::bit_cast<std::uint64_t>(ends[k].y[i]), std::bit_cast<std::uint64_t>(first[k].y[i]))
              << method << ", ray " << k << ", " << lanes << " lanes";
        }
        EXPECT_EQ(ends[k].steps, first[k].steps);
      }
    }
  }
}

TEST(PathWatch, a_wall_where_no_light_comes_changes_nothing) {
  const auto hole = make_spacetime("schwarzschild", "kerr-schild", {});
  const std::vector<BatchRay> rays = beam(*hole);
  const TraceSettings settings = settings_of("dop853");
  std::vector<RayEnd> with(rays.size()), without(rays.size());
  Wall wall(-500.0);
  trace_rays(*hole, rays, settings, 4, with, &wall);
  trace_rays(*hole, rays, settings, 4, without);
  EXPECT_TRUE(wall.met().empty());
  for (std::size_t k = 0; k < rays.size(); ++k) {
    EXPECT_EQ(with[k].status, Status::escaped);
    EXPECT_EQ(with[k].y.c, without[k].y.c);
    EXPECT_EQ(with[k].steps, without[k].steps);
  }
}

TEST(PathWatch, a_stop_before_the_thing_comes_first) {
  const auto hole = make_spacetime("schwarzschild", "kerr-schild", {});
  const std::vector<BatchRay> rays = beam(*hole);
  TraceSettings settings = settings_of("dop853");
  settings.r_max = 40.0;
  settings.lambda_max = 45.0;
  Wall wall(-20.0);
  std::vector<RayEnd> ends(rays.size());
  trace_rays(*hole, rays, settings, 4, ends, &wall);
  for (const RayEnd& end : ends) EXPECT_EQ(end.status, Status::max_affine);
  EXPECT_TRUE(wall.met().empty());
}

TEST(PathWatch, a_hit_lies_on_the_exact_orbit) {
  const auto hole = make_spacetime("schwarzschild", "kerr-schild", {});
  const auto areal = make_spacetime("schwarzschild", "areal", {});
  const std::vector<BatchRay> rays = beam(*hole);
  TraceSettings settings = settings_of("dop853");
  settings.tol = 1e-13;
  Wall wall(-20.0);
  std::vector<RayEnd> ends(rays.size());
  trace_rays(*hole, rays, settings, 4, ends, &wall);
  for (std::size_t k = 0; k < rays.size(); ++k) {
    const PhaseState<double> start = change_chart(*hole, *areal, rays[k].start).state;
    const PhaseState<double> end = change_chart(*hole, *areal, ends[k].y).state;
    const double b = start[7] / -start[4];
    const ExactValue swept = schwarzschild_exact::swept_angle(1.0, std::abs(b), start[1], end[1], true);
    const double turned = std::abs(std::remainder(end[3] - start[3], 2.0 * 3.141592653589793));
    const double exact = std::abs(std::remainder(swept.value, 2.0 * 3.141592653589793));
    // Tolerance 1e-13 a step of a dozen, amplified by at most ten for these impact parameters.
    EXPECT_NEAR(turned, exact, 1e-11) << "ray " << k;
  }
}

}  // namespace
}  // namespace xpr
