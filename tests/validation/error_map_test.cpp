#include "validation/error_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace xpr {
namespace {

ErrorMapSettings settings_of(const std::string& metric, const std::string& method, double tol) {
  ErrorMapSettings settings;
  settings.screen = {.radius = 1000.0, .inclination = 1.0471975511965976, .half_width = 12.0, .pixels = {24, 24}};
  settings.transport.metric = metric;
  settings.transport.trace.method = method;
  settings.transport.trace.tol = tol;
  if (metric == "kerr") {
    settings.screen.spin = 0.9;
    settings.transport.parameters = {{"a", 0.9}};
  }
  return settings;
}

TEST(ErrorMap, finds_every_class_right_and_errors_that_follow_the_tolerance) {
  for (const std::string metric : {"kerr", "schwarzschild"}) {
    const std::vector<ErrorSummary> loose = summary_of(error_map(settings_of(metric, "dop853", 1e-6)));
    const std::vector<ErrorSummary> tight = summary_of(error_map(settings_of(metric, "dop853", 1e-10)));
    EXPECT_EQ(loose[0].pixels, 576);
    EXPECT_EQ(loose[0].wrong_status, 0) << metric;
    EXPECT_EQ(tight[0].wrong_status, 0) << metric;
    // A pixel is one M^2; the shadow's area is 27 pi, of Kerr 78.559 at 60 degrees. Its edge crosses some 33 pixels, of
    // which a quarter more or less may count, near-critical ones among them.
    const double area = metric == "kerr" ? 78.559 : 84.823;
    EXPECT_NEAR(static_cast<double>(tight[2].pixels), area, 8.0) << metric;
    // Local extrapolation: the error is proportional to the tolerance, over four decades within what the number of
    // steps (two and a half times as many) and the shape of the estimate at long steps change.
    EXPECT_GT(loose[0].median / tight[0].median, 1e4 / 5.0) << metric;
    EXPECT_LT(loose[0].median / tight[0].median, 1e4 * 5.0) << metric;
    // Each step errs by up to the tolerance, all to one side at the worst; in the middle of the rays they do not add
    // up.
    const double worst = 1e-10 * tight[0].steps;
    EXPECT_LT(tight[0].median, 1e-10) << metric;
    EXPECT_LT(tight[0].swept_median, worst) << metric;
    // Near-critical rays make the tail; over their condition they are as good as the others.
    EXPECT_LT(tight[0].scaled_p99, worst) << metric;
  }
}

TEST(ErrorMap, sees_a_hole_that_turns_the_other_way) {
  ErrorMapSettings settings = settings_of("kerr", "dop853", 1e-8);
  settings.transport.parameters = {{"a", -0.9}};
  const std::vector<ErrorSummary> summary = summary_of(error_map(settings));
  // Frame dragging bends rays at 10 M by 4 a / b^2 = 0.04 rad; of the other sign, they are 0.08 rad off.
  EXPECT_GT(summary[0].median, 1e-2);
  EXPECT_GT(summary[0].wrong_status, 0);
}

TEST(ErrorMap, does_not_depend_on_threads_or_lanes) {
  ErrorMapSettings settings = settings_of("kerr", "dopri54", 1e-7);
  settings.threads = 1;
  settings.lanes = 1;
  const ErrorMap one = error_map(settings);
  settings.threads = 2;
  settings.lanes = 8;
  const ErrorMap two = error_map(settings);
  EXPECT_EQ(one.rays_hash, two.rays_hash);
  EXPECT_EQ(one.direction_error, two.direction_error);
}

TEST(ErrorMap, refuses_spacetimes_without_a_closed_form) {
  EXPECT_THROW((void)error_map(settings_of("ellis", "dop853", 1e-8)), std::invalid_argument);
}

}  // namespace
}  // namespace xpr
