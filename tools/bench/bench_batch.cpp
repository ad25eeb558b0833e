// A camera's rays through Kerr in lanes: a = 0.9, observer at 1000 M and 60 degrees, the common screen at +-12 M, rays
// traced back in time until they are at 1000 M again or captured.
//
//   bench_batch --benchmark_counters_tabular=true
//
// prints for each tolerance: rays/s on one core, the error in direction at the end against the closed form (median,
// p99, max, over the escaped), rays whose class differs, steps and evaluations a ray. The last four are ratios of least
// times of alternating runs: of widths, of the flow by hand over that by duals, of two threads, and over Boost.Odeint's
// scalar dopri5 on the same flow, at the error that it reaches.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/algebra/array_algebra.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>
#include <ctime>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "core/camera_screen.hpp"
#include "integrators/batch_tracer.hpp"
#include "integrators/flow_stepper.hpp"
#include "integrators/step_control.hpp"
#include "metrics/catalogue.hpp"
#include "metrics/chart_map.hpp"
#include "metrics/kerr_ray_exact.hpp"
#include "metrics/modules.hpp"
#include "metrics/spacetime_of.hpp"

namespace xpr {
namespace {

constexpr double camera_radius = 1000.0;

/// Kerr as someone writes it who leaves the flow to dual numbers.
struct DerivedKerr : KerrSchildOutgoing {
  void flow() const = delete;
};

struct Camera {
  std::unique_ptr<Spacetime> chart = make_spacetime("kerr", "kerr-schild-outgoing", std::array{NamedValue{"a", 0.9}});
  std::unique_ptr<Spacetime> classical = make_spacetime("kerr", "boyer-lindquist", std::array{NamedValue{"a", 0.9}});
  CameraScreen screen;
  std::vector<BatchRay> rays;
  std::vector<kerr_exact::Arrival> truth;

  explicit Camera(int side)
      : screen{.spin = 0.9, .radius = camera_radius, .inclination = std::acos(0.5), .pixels = {side, side}} {
    for (int row = 0; row < side; ++row) {
      for (int column = 0; column < side; ++column) {
        const auto [alpha, beta] = screen.point(column, row);
        rays.push_back({.start = change_chart(*classical, *chart, *screen.ray(alpha, beta), 1).state});
        const kerr_exact::RayMomentum start{.r = camera_radius,
                                            .theta = screen.inclination,
                                            .lambda = screen.constants(alpha, beta).angular_momentum,
                                            .p_theta = -beta,
                                            .radial_sign = -1};
        truth.push_back(kerr_exact::KerrRay({1.0, 0.9}, start).at_end(camera_radius, *chart->default_r_min()));
      }
    }
  }

  [[nodiscard]] TraceSettings settings(const std::string& method, double tol) const {
    TraceSettings out;
    out.method = method;
    out.tol = tol;
    out.r_min = chart->default_r_min();
    out.r_max = camera_radius;
    return out;
  }

  [[nodiscard]] std::vector<RayEnd> trace(const std::string& method, double tol, int lanes) const {
    return trace(*chart, method, tol, lanes);
  }
  [[nodiscard]] std::vector<RayEnd> trace(const Spacetime& in, const std::string& method, double tol, int lanes) const {
    std::vector<RayEnd> ends(rays.size());
    trace_rays(in, rays, settings(method, tol), lanes, ends);
    return ends;
  }
};

const Camera& camera() {
  static const Camera one(64);
  return one;
}

struct Errors {
  double median = 0.0, p99 = 0.0, most = 0.0;
  int wrong_class = 0;
};

/// The direction of an end in Kerr-Schild coordinates, as the closed form gives it.
std::array<double, 3> direction(const PhaseState<double>& y) {
  const PhaseState<double> end = change_chart(*camera().chart, *camera().classical, y, 1).state;
  return {std::sin(end[2]) * std::cos(end[3]), std::sin(end[2]) * std::sin(end[3]), std::cos(end[2])};
}

Errors errors_of(const std::vector<RayEnd>& ends) {
  Errors out;
  std::vector<double> angles;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const kerr_exact::Arrival& truth = camera().truth[k];
    const bool escapes = truth.fate == kerr_exact::Fate::escaped;
    if ((ends[k].status == Status::escaped) != escapes) ++out.wrong_class;
    if (ends[k].status != Status::escaped || !escapes) continue;
    // Traced back in time: phi of the closed form with the other sign.
    const std::array<double, 3> there{truth.direction()[0], -truth.direction()[1], truth.direction()[2]};
    const std::array<double, 3> here = direction(ends[k].y);
    angles.push_back(std::hypot(here[0] - there[0], here[1] - there[1], here[2] - there[2]));
  }
  std::sort(angles.begin(), angles.end());
  out.median = angles[angles.size() / 2];
  out.p99 = angles[angles.size() * 99 / 100];
  out.most = angles.back();
  return out;
}

double clock_of(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// CPU time: the machine may be shared.
template <class F>
double seconds(const F& f, clockid_t clock = CLOCK_PROCESS_CPUTIME_ID) {
  const double begin = clock_of(clock);
  benchmark::DoNotOptimize(f());
  return clock_of(clock) - begin;
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

/// Least times of two tasks that take turns.
template <class F, class G>
std::array<double, 2> alternating(benchmark::State& state, const F& f, const G& g,
                                  clockid_t clock = CLOCK_PROCESS_CPUTIME_ID) {
  std::array<double, 2> least{1e300, 1e300};
  for (auto _ : state) {
    least[0] = std::min(least[0], seconds(f, clock));
    least[1] = std::min(least[1], seconds(g, clock));
  }
  return least;
}

void lanes_over_one(benchmark::State& state) {
  const int lanes = static_cast<int>(state.range(0));
  const auto least = alternating(
      state, [] { return camera().trace("dop853", 1e-8, 1); }, [&] { return camera().trace("dop853", 1e-8, lanes); });
  state.counters["ratio"] = least[0] / least[1];
}
BENCHMARK(lanes_over_one)->Arg(2)->Arg(4)->Arg(8)->MinTime(3.0)->Unit(benchmark::kMillisecond);

void duals_over_hand(benchmark::State& state) {
  DerivedKerr module;
  module.a = 0.9;
  const SpacetimeOf<DerivedKerr> derived(module);
  const auto least = alternating(
      state, [] { return camera().trace("dop853", 1e-8, best_lanes()); },
      [&] { return camera().trace(derived, "dop853", 1e-8, best_lanes()); });
  state.counters["ratio"] = least[0] / least[1];
}
BENCHMARK(duals_over_hand)->MinTime(3.0)->Unit(benchmark::kMillisecond);

/// Wall time, each thread on half of the rays.
void two_threads_over_one(benchmark::State& state) {
  const auto part = [](std::size_t begin, std::size_t end) {
    std::vector<RayEnd> ends(end - begin);
    trace_rays(*camera().chart, std::span(camera().rays).subspan(begin, end - begin), camera().settings("dop853", 1e-8),
               best_lanes(), ends);
  };
  const std::size_t n = camera().rays.size();
  const auto least = alternating(
      state,
      [&] {
        part(0, n);
        return 0;
      },
      [&] {
        // Blocks in turn, so that both threads have as many near-critical rays.
        const auto half = [&](std::size_t first) {
          for (std::size_t begin = first * 256; begin < n; begin += 512) part(begin, std::min(n, begin + 256));
        };
        std::thread other(half, 1);
        half(0);
        other.join();
        return 0;
      },
      CLOCK_MONOTONIC);
  state.counters["ratio"] = least[0] / least[1];
}
BENCHMARK(two_threads_over_one)->MinTime(3.0)->Unit(benchmark::kMillisecond);

/// One ray by Odeint's stepper on the module's own flow, without a virtual call; our controller and norm, and an end on
/// the cubic through the last step.
PhaseState<double> by_odeint(const KerrSchildOutgoing& kerr, const BatchRay& ray, double tol, Status& status) {
  using Array8 = std::array<double, 8>;
  namespace odeint = boost::numeric::odeint;
  odeint::runge_kutta_dopri5<Array8, double, Array8, double, odeint::array_algebra> stepper;
  const auto flow = [&](const PhaseState<double>& y) { return kerr.flow(y); };
  const auto system = [&](const Array8& x, Array8& dxdt, double) {
    PhaseState<double> at;
    at.c = x;
    dxdt = kerr.flow(at).c;
  };
  TraceSettings settings = camera().settings("dopri54", tol);
  const ErrorScale scale = error_scale(*camera().chart, ray.start, settings);
  PhaseState<double> y = ray.start, next, error, rate = kerr.flow(y), next_rate;
  double h = initial_step(flow, scale, y, rate, 5);
  for (int step = 0; step < 100'000; ++step) {
    stepper.do_step(system, y.c, rate.c, 0.0, next.c, next_rate.c, h, error.c);
    const double norm = error_norm(scale, y, next, error);
    const double tried = h;
    h *= step_factor(norm, 5);
    if (!(norm <= 1.0)) continue;
    const double r = kerr.radius(next.x());
    if (r < *settings.r_min) {
      status = Status::captured;
      return next;
    }
    if (r > camera_radius) {
      double inside = 0.0, outside = 1.0;
      for (int halving = 0; halving < 50; ++halving) {
        const double middle = 0.5 * (inside + outside);
        const PhaseState<double> at = hermite_cubic(y, rate, next, next_rate, tried, middle);
        (kerr.radius(at.x()) < camera_radius ? inside : outside) = middle;
      }
      status = Status::escaped;
      return hermite_cubic(y, rate, next, next_rate, tried, inside);
    }
    y = next;
    rate = next_rate;
  }
  status = Status::max_steps;
  return y;
}

std::vector<RayEnd> all_by_odeint(double tol) {
  KerrSchildOutgoing kerr;
  kerr.a = 0.9;
  std::vector<RayEnd> ends(camera().rays.size());
  for (std::size_t k = 0; k < ends.size(); ++k) {
    ends[k].y = by_odeint(kerr, camera().rays[k], tol, ends[k].status);
  }
  return ends;
}

/// Ours at the loosest of a ladder of tolerances that is no worse than Odeint at its own.
void over_odeint(benchmark::State& state) {
  const double tol = std::pow(10.0, -static_cast<double>(state.range(0)));
  const Errors theirs = errors_of(all_by_odeint(tol));
  double own_tol = 1e-3;
  while (errors_of(camera().trace("dop853", own_tol, best_lanes())).median > theirs.median) own_tol *= 0.5;
  const auto least = alternating(
      state, [&] { return all_by_odeint(tol); }, [&] { return camera().trace("dop853", own_tol, best_lanes()); });
  state.counters["median"] = theirs.median;
  state.counters["own_tol"] = own_tol;
  state.counters["odeint_rays/s"] = static_cast<double>(camera().rays.size()) / least[0];
  state.counters["rays/s"] = static_cast<double>(camera().rays.size()) / least[1];
  state.counters["ratio"] = least[0] / least[1];
}
BENCHMARK(over_odeint)->ArgName("digits")->Arg(6)->Arg(8)->Arg(10)->MinTime(3.0)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace xpr

BENCHMARK_MAIN();
