// A camera's rays through Kerr in lanes: a = 0.9, observer at 1000 M and 60 degrees, the common screen at +-12 M, rays
// traced back in time until they are at 1000 M again or captured.
//
//   bench_batch --benchmark_counters_tabular=true
//
// prints for each tolerance: rays/s on one core, the error in direction at the end against the same rays at 1e-13
// (median, p99, max, over the escaped), rays whose class differs, steps and evaluations a ray. `lanes` gives each
// width's rate over that of width 1, `odeint` the rate over that of Boost.Odeint's dopri5 on the same flow at the same
// error, both in one run.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <vector>

#include "core/camera_screen.hpp"
#include "integrators/batch_tracer.hpp"
#include "integrators/step_control.hpp"
#include "metrics/catalogue.hpp"
#include "metrics/chart_map.hpp"

namespace xpr {
namespace {

constexpr double camera_radius = 1000.0;

struct Camera {
  std::unique_ptr<Spacetime> chart = make_spacetime("kerr", "kerr-schild-outgoing", std::array{NamedValue{"a", 0.9}});
  std::vector<BatchRay> rays;

  explicit Camera(int side) {
    const auto classical = make_spacetime("kerr", "boyer-lindquist", std::array{NamedValue{"a", 0.9}});
    const CameraScreen screen{
        .spin = 0.9, .radius = camera_radius, .inclination = std::acos(0.5), .pixels = {side, side}};
    for (int row = 0; row < side; ++row) {
      for (int column = 0; column < side; ++column) {
        const auto [alpha, beta] = screen.point(column, row);
        rays.push_back({.start = change_chart(*classical, *chart, *screen.ray(alpha, beta), 1).state});
      }
    }
  }

  [[nodiscard]] TraceSettings settings(const char* method, double tol) const {
    TraceSettings out;
    out.method = method;
    out.tol = tol;
    out.r_min = chart->default_r_min();
    out.r_max = camera_radius;
    return out;
  }

  [[nodiscard]] std::vector<RayEnd> trace(const char* method, double tol, int lanes) const {
    std::vector<RayEnd> ends(rays.size());
    trace_rays(*chart, rays, settings(method, tol), lanes, ends);
    return ends;
  }
};

const Camera& camera() {
  static const Camera one(64);
  return one;
}

const std::vector<RayEnd>& reference() {
  static const std::vector<RayEnd> ends = camera().trace("dop853", 1e-13, best_lanes());
  return ends;
}

struct Errors {
  double median = 0.0, p99 = 0.0, most = 0.0;
  int wrong_class = 0;
};

Errors errors_of(const std::vector<RayEnd>& ends) {
  Errors out;
  std::vector<double> angles;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const RayEnd& truth = reference()[k];
    if (ends[k].status != truth.status) ++out.wrong_class;
    if (ends[k].status != Status::escaped || truth.status != Status::escaped) continue;
    double apart = 0.0, size = 0.0;
    for (std::size_t i = 1; i < 4; ++i) {
      apart += std::pow(ends[k].y[i] - truth.y[i], 2);
      size += std::pow(truth.y[i], 2);
    }
    angles.push_back(std::sqrt(apart / size));
  }
  std::sort(angles.begin(), angles.end());
  out.median = angles[angles.size() / 2];
  out.p99 = angles[angles.size() * 99 / 100];
  out.most = angles.back();
  return out;
}

template <class F>
double seconds(const F& f) {
  const auto begin = std::chrono::steady_clock::now();
  benchmark::DoNotOptimize(f());
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void count(benchmark::State& state, const std::vector<RayEnd>& ends) {
  const Errors errors = errors_of(ends);
  double steps = 0.0, rejected = 0.0, evaluations = 0.0;
  for (const RayEnd& end : ends) {
    steps += static_cast<double>(end.steps);
    rejected += static_cast<double>(end.rejected);
    evaluations += static_cast<double>(end.evaluations);
  }
  const auto n = static_cast<double>(ends.size());
  state.counters["steps"] = steps / n;
  state.counters["rejected"] = rejected / n;
  state.counters["evals"] = evaluations / n;
  state.counters["median"] = errors.median;
  state.counters["p99"] = errors.p99;
  state.counters["max"] = errors.most;
  state.counters["wrong"] = errors.wrong_class;
}

void batch(benchmark::State& state, const char* method) {
  const double tol = std::pow(10.0, -static_cast<double>(state.range(0)));
  const int lanes = static_cast<int>(state.range(1));
  const std::vector<RayEnd> ends = camera().trace(method, tol, lanes);
  double least = 1e300;
  for (auto _ : state) least = std::min(least, seconds([&] { return camera().trace(method, tol, lanes); }));
  count(state, ends);
  state.counters["rays/s"] = static_cast<double>(ends.size()) / least;
}
BENCHMARK_CAPTURE(batch, dop853, "dop853")
    ->ArgNames({"digits", "lanes"})
    ->ArgsProduct({{5, 6, 7, 8, 9, 10, 11}, {4, 8}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(batch, dopri54, "dopri54")
    ->ArgNames({"digits", "lanes"})
    ->ArgsProduct({{6, 8, 10}, {4, 8}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace xpr

BENCHMARK_MAIN();
