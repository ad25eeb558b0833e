// Sweeps: orders and slopes come out, nothing but the times depends on threads, and senseless requests are refused.
#include <gtest/gtest.h>

#include <cmath>

#include "validation/sweep.hpp"

namespace xpr {
namespace {

SweepRequest small(std::string metric, std::vector<std::string> methods) {
  SweepRequest request;
  request.metric = std::move(metric);
  request.methods = std::move(methods);
  request.rays = 6;
  request.from = 1e-6;
  request.to = 1e-9;
  request.step_from = 0.25;
  request.step_to = 0.0625;
  return request;
}

std::vector<SweepPoint> curve(const Sweep& sweep, std::string_view method) {
  std::vector<SweepPoint> out;
  for (const SweepPoint& point : sweep.points) {
    if (point.method == method) out.push_back(point);
  }
  return out;
}

TEST(Sweep, halving_the_step_of_rk4_divides_its_error_by_sixteen) {
  for (const char* metric : {"schwarzschild", "kerr", "ellis"}) {
    const std::vector<Sweep> sweeps = run_sweep(small(metric, {"rk4"}));
    ASSERT_FALSE(sweeps.empty());
    EXPECT_EQ(sweeps[0].rank, TruthRank::closed_form);
    const std::vector<SweepPoint> points = curve(sweeps[0], "rk4");
    ASSERT_EQ(points.size(), 3U);
    EXPECT_FALSE(points.back().adaptive);
    // To 0.2 at steps that are not yet small near the hole: the next error term makes up to 15 % (2^0.2 = 1.15).
    EXPECT_NEAR(points.back().observed_order, 4.0, 0.2) << metric;
    EXPECT_EQ(points.back().convergence, "monotone");
    // Richardson's estimate knows no truth and must bound the error within its factor of 1.25 and the term left out.
    EXPECT_GT(points.back().richardson_error, points.back().error_norm);
    EXPECT_LT(points.back().richardson_error, 2.0 * points.back().error_norm);
  }
}

TEST(Sweep, tolerances_are_met_in_proportion) {
  const std::vector<Sweep> sweeps = run_sweep(small("schwarzschild", {"dopri54", "dop853"}));
  for (const char* method : {"dopri54", "dop853"}) {
    const std::vector<SweepPoint> points = curve(sweeps.at(0), method);
    ASSERT_EQ(points.size(), 4U);
    EXPECT_EQ(points.front().setting, 1e-6);
    EXPECT_EQ(points.back().setting, 1e-9);
    EXPECT_LT(points.back().error_max, 1e-7);  // a hundred tolerances: some 100 steps, each within one
    EXPECT_LE(points.back().error_median, points.back().error_p99);
    EXPECT_LE(points.back().error_p99, points.back().error_max);
    EXPECT_GT(points.back().evaluations_per_ray, points.front().evaluations_per_ray);
    EXPECT_LT(points.back().null_drift_max, points.front().null_drift_max);
    EXPECT_TRUE(std::isnan(points.front().observed_order));
  }
}

TEST(Sweep, orders_come_out_through_the_rim_of_a_lens_and_over_the_poles_of_an_ellipsoid) {
  for (const char* metric : {"luneburg", "ellipsoid"}) {
    SweepRequest request = small(metric, {"rk4", "dop853"});
    request.step_from /= 4.0;  // near its poles the ellipsoid's chart needs short steps
    request.step_to /= 4.0;
    const std::vector<Sweep> sweeps = run_sweep(request);
    ASSERT_EQ(sweeps.size(), 1U);
    const std::vector<SweepPoint> fixed = curve(sweeps[0], "rk4");
    ASSERT_EQ(fixed.size(), 3U);
    EXPECT_NEAR(fixed.back().observed_order, 4.0, 0.2) << metric;
    EXPECT_LT(curve(sweeps[0], "dop853").back().error_max, 1e-7) << metric;  // a hundred tolerances of some 100 steps
  }
  EXPECT_EQ(run_sweep(small("luneburg", {"rk4"}))[0].rank, TruthRank::closed_form);
  EXPECT_EQ(run_sweep(small("ellipsoid", {"rk4"}))[0].rank, TruthRank::high_precision);
}

TEST(Sweep, parameters_and_charts_that_are_asked_for_are_used) {
  // In units of R nothing depends on R but round-off; the same straight ray has larger errors in the spherical chart.
  for (const char* metric : {"luneburg", "maxwell-fisheye"}) {
    SweepRequest large = small(metric, {"rk4"});
    large.parameters = {{"R", 7.0}};
    const SweepPoint one = run_sweep(small(metric, {"rk4"}))[0].points.back();
    const SweepPoint seven = run_sweep(large)[0].points.back();
    EXPECT_NEAR(seven.setting, 7.0 * one.setting, 1e-12);
    EXPECT_NEAR(seven.error_norm / one.error_norm, 1.0, 1e-6) << metric;
  }
  SweepRequest spherical = small("minkowski", {"rk4"});
  spherical.chart = "spherical";
  EXPECT_LT(run_sweep(small("minkowski", {"rk4"}))[0].points.back().error_max, 1e-13);
  EXPECT_GT(run_sweep(spherical)[0].points.back().error_max, 1e-10);
  EXPECT_EQ(run_sweep(spherical)[0].points.back().chart, "spherical");
}

TEST(Sweep, off_the_equator_the_truth_is_said_to_be_self_convergence) {
  const std::vector<Sweep> sweeps = run_sweep(small("kerr", {"gl6"}));
  ASSERT_EQ(sweeps.size(), 2U);
  EXPECT_EQ(sweeps[1].rank, TruthRank::self_convergence);
  EXPECT_NEAR(curve(sweeps[1], "gl6").at(1).observed_order, 6.0, 0.2);
}

TEST(Sweep, numbers_do_not_depend_on_threads) {
  const auto run = [](int threads) {
    SweepOptions options;
    options.threads = threads;
    return run_sweep(small("kerr", {"dopri54", "rk4"}), options);
  };
  const std::vector<Sweep> one = run(1), two = run(2);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t s = 0; s < one.size(); ++s) {
    ASSERT_EQ(one[s].points.size(), two[s].points.size());
    for (std::size_t k = 0; k < one[s].points.size(); ++k) {
      EXPECT_EQ(one[s].points[k].method, two[s].points[k].method);
      EXPECT_EQ(one[s].points[k].error_norm, two[s].points[k].error_norm);
      EXPECT_EQ(one[s].points[k].null_drift_max, two[s].points[k].null_drift_max);
    }
  }
}

TEST(Sweep, a_ray_that_a_coarse_step_loses_is_not_dropped) {
  SweepRequest request = small("schwarzschild", {"euler"});
  request.step_from = 20.0;
  request.step_to = 20.0;
  const SweepPoint point = run_sweep(request).at(0).points.at(0);
  EXPECT_TRUE(std::isnan(point.error_norm) || point.error_max > 0.1);
}

TEST(Sweep, refuses_what_makes_no_sense_and_names_what_would) {
  const auto message = [](const SweepRequest& request) -> std::string {
    try {
      (void)run_sweep(request);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message(small("kerrr", {"rk4"})).find("'kerr'"), std::string::npos);
  EXPECT_NE(message(small("medium-uniform", {"rk4"})).find("maxwell-fisheye"), std::string::npos);
  EXPECT_NE(message(small("kerr", {"dopri45"})).find("'dopri54'"), std::string::npos);
  EXPECT_NE(message(small("kerr", {"verlet"})).find("does not separate"), std::string::npos);
  EXPECT_NE(message(small("kerr", {})).find("no method"), std::string::npos);
  SweepRequest upside_down = small("kerr", {"dopri54"});
  std::swap(upside_down.from, upside_down.to);
  EXPECT_NE(message(upside_down).find("tolerances from 1e-09 to 1e-06"), std::string::npos);
  SweepRequest fast = small("kerr", {"dopri54"});
  fast.parameters = {{"a", 1.2}};
  EXPECT_NE(message(fast).find("1.2"), std::string::npos);
}

}  // namespace
}  // namespace xpr
