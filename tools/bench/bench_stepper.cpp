// One Kerr ray by our Dormand-Prince 5(4) and by Boost.Odeint's dopri5: the same right-hand side behind the same
// function object, the same tolerance and norm, the same step controller, the same span of lambda. Only the stepper
// differs.
//
//   bench_stepper --benchmark_filter=ratio
//
// prints own_over_odeint: the time of ours over the time of theirs, each the least of many alternating runs. Ours
// should be at or below 1.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/algebra/array_algebra.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>

#include "integrators/explicit_rk.hpp"
#include "integrators/step_control.hpp"
#include "integrators/tracer.hpp"
#include "metrics/catalogue.hpp"

namespace xpr {
namespace {

/// A ray that comes from 1000 M, turns near the hole and leaves.
struct KerrRay {
  std::unique_ptr<Spacetime> kerr = make_spacetime("kerr", "kerr-schild", std::array{NamedValue{"a", 0.9}});
  PhaseState<double> start{{0.0, 1000.0, 6.5, 3.0}, {-1.0, -1.0, 0.0, 0.0}};
  double lambda_max = 2000.0;
  Flow flow;
  ErrorScale scale;

  explicit KerrRay(double tol) {
    flow = [chart = kerr.get()](const PhaseState<double>& y) { return chart->flow(y); };
    TraceSettings settings;
    settings.tol = tol;
    scale = error_scale(*kerr, start, settings);
  }
};

/// Steps from start to lambda_max under the tracer's controller. `try_step(y, h, y_next)` returns the error norm; what
/// it keeps for the next step is its own business, told by `accepted`.
template <class TryStep, class Accepted>
PhaseState<double> integrate(const KerrRay& ray, const TryStep& try_step, const Accepted& accepted) {
  PhaseState<double> y = ray.start;
  double h = initial_step(ray.flow, ray.scale, y, ray.flow(y), 5);
  for (double lambda = 0.0; lambda < ray.lambda_max;) {
    const double step = std::min(h, ray.lambda_max - lambda);
    PhaseState<double> next;
    const double error = try_step(y, step, next);
    h = step * step_factor(error, 5);
    if (!(error <= 1.0)) continue;
    lambda += step;
    y = next;
    accepted();
  }
  return y;
}

PhaseState<double> by_ours(const KerrRay& ray) {
  StepperSettings settings;
  settings.error_scale = ray.scale;
  const auto stepper = make_stepper("dopri54", ray.flow, settings);
  return integrate(
      ray,
      [&](const PhaseState<double>& y, double h, PhaseState<double>& next) {
        const StepOutcome outcome = stepper->step(y, h);
        next = outcome.y;
        return outcome.error_norm;
      },
      [] {});
}

PhaseState<double> by_odeint(const KerrRay& ray) {
  using Array8 = std::array<double, 8>;
  namespace odeint = boost::numeric::odeint;
  odeint::runge_kutta_dopri5<Array8, double, Array8, double, odeint::array_algebra> stepper;
  const auto system = [&](const Array8& x, Array8& dxdt, double) {
    PhaseState<double> y;
    y.c = x;
    dxdt = ray.flow(y).c;
  };
  Array8 rate = ray.flow(ray.start).c;
  Array8 next_rate{};
  return integrate(
      ray,
      [&](const PhaseState<double>& y, double h, PhaseState<double>& next) {
        PhaseState<double> error;
        stepper.do_step(system, y.c, rate, 0.0, next.c, next_rate, h, error.c);
        return error_norm(ray.scale, y, next, error);
      },
      [&] { rate = next_rate; });
}

void own(benchmark::State& state) {
  const KerrRay ray(1e-10);
  for (auto _ : state) benchmark::DoNotOptimize(by_ours(ray));
}
BENCHMARK(own)->Unit(benchmark::kMicrosecond);

void odeint(benchmark::State& state) {
  const KerrRay ray(1e-10);
  for (auto _ : state) benchmark::DoNotOptimize(by_odeint(ray));
}
BENCHMARK(odeint)->Unit(benchmark::kMicrosecond);

template <class F>
double seconds(const F& f) {
  const auto begin = std::chrono::steady_clock::now();
  benchmark::DoNotOptimize(f());
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void ratio(benchmark::State& state) {
  const KerrRay ray(1e-10);
  const PhaseState<double> ours = by_ours(ray);
  const PhaseState<double> theirs = by_odeint(ray);
  double apart = 0.0;
  for (std::size_t i = 0; i < 8; ++i) apart = std::max(apart, std::abs(ours[i] - theirs[i]));
  double least_own = std::numeric_limits<double>::infinity();
  double least_odeint = least_own;
  for (auto _ : state) {
    least_own = std::min(least_own, seconds([&] { return by_ours(ray); }));
    least_odeint = std::min(least_odeint, seconds([&] { return by_odeint(ray); }));
  }
  state.counters["own_us"] = 1e6 * least_own;
  state.counters["odeint_us"] = 1e6 * least_odeint;
  state.counters["own_over_odeint"] = least_own / least_odeint;
  state.counters["ends_apart"] = apart;
}
BENCHMARK(ratio)->MinTime(2.0);

}  // namespace
}  // namespace xpr

BENCHMARK_MAIN();
