// Kerr rays in closed form on the common screen: a = 0.9, observer at 1000 M, inclination 60 degrees, screen out to 12
// M, until they are back at 1000 M or captured at 1.45 M. One core.
//
//   bench_kerr_exact
//
// items_per_second is rays a second: `rays` for all of the screen, phi, t, affine length and error estimates included;
// `escaping` and `captured` for the parts; `classes` for roots and class alone. `ratio` prints closed_over_traced, the
// time of the closed form over that of trace_ray (dop853 at 1e-10, one ray after the other) for the same rays, each the
// least of many alternating runs, and apart_median, the angle between their ends.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/transport.hpp"
#include "metrics/kerr_potentials.hpp"
#include "metrics/kerr_ray_exact.hpp"

namespace xpr {
namespace {

using kerr_exact::Arrival;
using kerr_exact::Fate;
using kerr_exact::KerrRay;
using kerr_exact::RayHole;
using kerr_exact::RayStart;

constexpr double spin = 0.9, r_observer = 1000.0, r_captured = 1.45, inclination = std::numbers::pi / 3;

/// The screen's pixel centres, `pixels` a side.
std::vector<RayStart> screen(int pixels) {
  std::vector<RayStart> starts;
  const auto place = [&](int i) { return 12.0 * (2.0 * (i + 0.5) / pixels - 1.0); };
  for (int i = 0; i < pixels; ++i) {
    for (int j = 0; j < pixels; ++j) {
      const double alpha = place(i), beta = place(j), cosine = std::cos(inclination);
      starts.push_back({.r = r_observer,
                        .theta = inclination,
                        .lambda = -alpha * std::sin(inclination),
                        .eta = (alpha * alpha - spin * spin) * cosine * cosine + beta * beta,
                        .radial_sign = -1,
                        .polar_sign = beta > 0.0 ? -1 : 1});
    }
  }
  return starts;
}

std::vector<RayStart> screen_of(int pixels, Fate fate) {
  std::vector<RayStart> starts = screen(pixels);
  std::erase_if(starts, [&](const RayStart& s) { return KerrRay(RayHole{1.0, spin}, s).fate() != fate; });
  return starts;
}

Arrival in_closed_form(const RayStart& start) {
  return KerrRay(RayHole{1.0, spin}, start).at_end(r_observer, r_captured);
}

void over(benchmark::State& state, const std::vector<RayStart>& starts) {
  for (auto _ : state) {
    for (const RayStart& start : starts) benchmark::DoNotOptimize(in_closed_form(start));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(starts.size()));
}

void rays(benchmark::State& state) { over(state, screen(64)); }
BENCHMARK(rays)->Unit(benchmark::kMillisecond);

void escaping(benchmark::State& state) { over(state, screen_of(64, Fate::escaped)); }
BENCHMARK(escaping)->Unit(benchmark::kMillisecond);

void captured(benchmark::State& state) { over(state, screen_of(64, Fate::captured)); }
BENCHMARK(captured)->Unit(benchmark::kMillisecond);

void classes(benchmark::State& state) {
  const std::vector<RayStart> starts = screen(64);
  for (auto _ : state) {
    for (const RayStart& start : starts) benchmark::DoNotOptimize(KerrRay(RayHole{1.0, spin}, start).fate());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(starts.size()));
}
BENCHMARK(classes)->Unit(benchmark::kMillisecond);

/// The same start for the tracer: Boyer-Lindquist, p_t = -1.
Ray to_trace(const RayStart& start) {
  const kerr_exact::RayConstants<double> constants{1.0, start.lambda, start.eta};
  const double R = kerr_exact::radial_potential(1.0, spin, constants, start.r);
  const double cosine = std::cos(start.theta);
  const double Theta = std::max(0.0, kerr_exact::polar_potential(spin, constants, cosine * cosine));
  const double delta = start.r * (start.r - 2.0) + spin * spin;
  Ray ray;
  ray.start = {{0.0, start.r, start.theta, 0.0},
               {-1.0, start.radial_sign * std::sqrt(R) / delta, start.polar_sign * std::sqrt(Theta), start.lambda}};
  return ray;
}

template <class F>
double seconds(const F& f) {
  const auto begin = std::chrono::steady_clock::now();
  f();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void ratio(benchmark::State& state) {
  const std::vector<RayStart> starts = screen(12);
  TransportSettings settings;
  settings.metric = "kerr";
  settings.parameters = {{"M", 1.0}, {"a", spin}};
  settings.chart = "boyer-lindquist";
  settings.trace.method = "dop853";
  settings.trace.tol = 1e-10;
  settings.trace.r_max = r_observer;
  settings.trace.r_min = r_captured;
  const Transport transport(settings);
  std::vector<double> apart;
  double other_class = 0.0;
  for (const RayStart& start : starts) {
    const Arrival exact = in_closed_form(start);
    const TracedRay traced = transport.trace(to_trace(start));
    if ((traced.status == Status::captured) != (exact.fate == Fate::captured)) other_class += 1.0;
    const double theta = traced.end[2] - exact.theta.value, phi = traced.end[3] - exact.phi.value;
    apart.push_back(std::hypot(theta, exact.sin_theta * phi));
  }
  std::sort(apart.begin(), apart.end());
  double closed = std::numeric_limits<double>::infinity(), traced = closed;
  for (auto _ : state) {
    closed = std::min(closed, seconds([&] {
                        for (const RayStart& start : starts) benchmark::DoNotOptimize(in_closed_form(start));
                      }));
    traced = std::min(traced, seconds([&] {
                        for (const RayStart& start : starts) benchmark::DoNotOptimize(transport.trace(to_trace(start)));
                      }));
  }
  const auto count = static_cast<double>(starts.size());
  state.counters["closed_rays_per_s"] = count / closed;
  state.counters["traced_rays_per_s"] = count / traced;
  state.counters["closed_over_traced"] = closed / traced;
  state.counters["apart_median"] = apart[apart.size() / 2];
  state.counters["other_class"] = other_class;
}
BENCHMARK(ratio)->MinTime(2.0)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace xpr

BENCHMARK_MAIN();
