// Kerr light by first integrals on the common screen: a = 0.9, observer at 1000 M, inclination 60 degrees, screen out
// to 12 M, traced back in time until it is at 1000 M again or captured. One core.
//
//   bench_first_integrals
//
// `screen/LANES/TOL_EXPONENT/TIMED` gives items_per_second (rays a second) with median, p99 and max of the angle
// between a ray's end and the closed form's, the worst error of the swept azimuth, wrong_class (captured or escaped)
// and steps a ray. `widths/TOL_EXPONENT` times widths 1, 2, 4 and 8 in turn, block by block, each the least of many
// runs: rays a second and how many times width 1. `over_tracer/TOL_EXPONENT` does so against trace_ray (dop853, one ray
// after the other) and gives its median error too.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "integrators/first_integrals.hpp"
#include "integrators/tracer.hpp"
#include "metrics/catalogue.hpp"
#include "metrics/kerr_ray_exact.hpp"
#include "metrics/separable_charts.hpp"

namespace xpr {
namespace {

using kerr_exact::Arrival;
using kerr_exact::Fate;
using kerr_exact::KerrRay;

constexpr double spin = 0.9, r_observer = 1000.0, inclination = std::numbers::pi / 3;
constexpr int pixels = 128;

/// The rays, and where they end.
struct Screen {
  std::unique_ptr<Spacetime> kerr = make_spacetime("kerr", "kerr-schild-outgoing", std::array{NamedValue{"a", spin}});
  SeparatedChart chart = *separated_chart(*kerr);
  double r_min = *kerr->default_r_min();
  std::vector<SeparatedState> rays;
  std::vector<Arrival> truth;

  Screen() {
    const auto place = [](int i) { return 12.0 * (2.0 * (i + 0.5) / pixels - 1.0); };
    for (int i = 0; i < pixels; ++i) {
      for (int j = 0; j < pixels; ++j) add(place(i), place(j));
    }
  }

  void add(double alpha, double beta) {
    const double cosine = std::cos(inclination);
    const double lambda = -alpha * std::sin(inclination);
    const double eta = (alpha * alpha - spin * spin) * cosine * cosine + beta * beta;
    rays.push_back(
        separated_start(chart.light, lambda, eta, -1.0, 1.0 / r_observer, inclination, false, !(beta > 0.0)));
    truth.push_back(KerrRay({1.0, spin}, {.r = r_observer,
                                          .theta = inclination,
                                          .lambda = lambda,
                                          .eta = eta,
                                          .radial_sign = -1,
                                          .polar_sign = beta > 0.0 ? -1 : 1})
                        .at_end(r_observer, r_min));
  }

  [[nodiscard]] FirstIntegralSettings settings(double tol, int lanes, bool timed) const {
    return {.tol = tol, .r_min = r_min, .r_max = r_observer, .timed = timed, .lanes = lanes};
  }
};

const Screen& screen() {
  static const Screen common;
  return common;
}

/// The angle between two directions.
double apart(const std::array<double, 3>& v, const std::array<double, 3>& w) {
  const std::array cross{v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]};
  return std::atan2(std::hypot(cross[0], cross[1], cross[2]), v[0] * w[0] + v[1] * w[1] + v[2] * w[2]);
}

/// What was wrong with a set of ends; rays every `stride` of the screen.
struct Errors {
  std::vector<double> angle;
  double azimuth = 0.0;
  int wrong_class = 0;

  void add(const std::array<double, 3>& direction, double swept, Status status, const Arrival& truth) {
    // The closed form goes forward in time: its azimuth is the mirror image.
    const std::array<double, 3> mirrored = truth.direction();
    angle.push_back(apart(direction, {mirrored[0], -mirrored[1], mirrored[2]}));
    if (std::isfinite(swept)) azimuth = std::max(azimuth, std::abs(swept + truth.phi.value));
    const bool right =
        status == (truth.fate == Fate::escaped ? Status::escaped : Status::captured) && truth.fate != Fate::asymptotic;
    wrong_class += right ? 0 : 1;
  }

  void report(benchmark::State& state) {
    std::sort(angle.begin(), angle.end());
    state.counters["median"] = angle[angle.size() / 2];
    state.counters["p99"] = angle[angle.size() * 99 / 100];
    state.counters["max"] = angle.back();
    state.counters["wrong_class"] = wrong_class;
  }
};

Errors errors_of(const std::vector<FirstIntegralEnd>& ends) {
  Errors errors;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    errors.add(ends[i].state.n, ends[i].swept_azimuth, ends[i].status, screen().truth[i]);
  }
  return errors;
}

void whole_screen(benchmark::State& state) {
  const FirstIntegralSettings settings = screen().settings(std::pow(10.0, static_cast<double>(-state.range(1))),
                                                           static_cast<int>(state.range(0)), state.range(2) != 0);
  std::vector<FirstIntegralEnd> ends(screen().rays.size());
  for (auto _ : state) trace_first_integrals(screen().chart.light, screen().rays, ends, settings);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(ends.size()));
  Errors errors = errors_of(ends);
  errors.report(state);
  state.counters["azimuth_max"] = errors.azimuth;
  double steps = 0.0;
  for (const FirstIntegralEnd& end : ends) steps += static_cast<double>(end.steps);
  state.counters["steps"] = steps / static_cast<double>(ends.size());
}
BENCHMARK(whole_screen)->Name("screen")->ArgsProduct({{1, 4, 8}, {8, 11}, {0, 1}})->Unit(benchmark::kMillisecond);

template <class F>
double seconds(const F& f) {
  const auto begin = std::chrono::steady_clock::now();
  f();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Blocks short enough that some of their runs are not disturbed by other work on the machine.
constexpr std::size_t block = 1024;

void widths(benchmark::State& state) {
  const double tol = std::pow(10.0, static_cast<double>(-state.range(0)));
  constexpr std::array<int, 4> lanes{1, 2, 4, 8};
  const std::size_t blocks = screen().rays.size() / block;
  std::vector<FirstIntegralEnd> ends(screen().rays.size());
  std::array<std::vector<double>, 4> least;
  least.fill(std::vector<double>(blocks, std::numeric_limits<double>::infinity()));
  for (auto _ : state) {
    for (std::size_t b = 0; b < blocks; ++b) {
      for (std::size_t w = 0; w < lanes.size(); ++w) {
        const FirstIntegralSettings settings = screen().settings(tol, lanes[w], false);
        const double time = seconds([&] {
          trace_first_integrals(screen().chart.light, std::span(screen().rays).subspan(b * block, block),
                                std::span(ends).subspan(b * block, block), settings);
        });
        least[w][b] = std::min(least[w][b], time);
      }
    }
  }
  errors_of(ends).report(state);
  std::array<double, 4> total{};
  for (std::size_t w = 0; w < lanes.size(); ++w) {
    for (const double time : least[w]) total[w] += time;
    const std::string name = std::to_string(lanes[w]);
    state.counters["rays/s_" + name] = static_cast<double>(ends.size()) / total[w];
    state.counters["gain_" + name] = total[0] / total[w];
  }
}
BENCHMARK(widths)->Arg(8)->Arg(11)->MinTime(2.0)->Unit(benchmark::kMillisecond);

/// Every 67th ray of the screen: trace_ray is slow.
constexpr std::size_t stride = 67;

void over_tracer(benchmark::State& state) {
  const double tol = std::pow(10.0, static_cast<double>(-state.range(0)));
  const Screen& s = screen();
  TraceSettings trace;
  trace.method = "dop853";
  trace.tol = tol;
  trace.r_min = s.r_min;
  trace.r_max = r_observer;
  std::vector<SeparatedState> rays;
  std::vector<const Arrival*> truth;
  for (std::size_t i = 0; i < s.rays.size(); i += stride) {
    rays.push_back(s.rays[i]);
    truth.push_back(&s.truth[i]);
  }
  std::vector<PhaseState<double>> starts;
  for (const SeparatedState& ray : rays) starts.push_back(phase_state(s.chart, ray));
  std::vector<FirstIntegralEnd> ends(rays.size());
  std::vector<double> least_traced(rays.size(), std::numeric_limits<double>::infinity());
  std::vector<RayEnd> traced(rays.size());
  double least = std::numeric_limits<double>::infinity();
  const FirstIntegralSettings settings = s.settings(tol, 4, false);
  for (auto _ : state) {
    least = std::min(least, seconds([&] { trace_first_integrals(s.chart.light, rays, ends, settings); }));
    for (std::size_t i = 0; i < rays.size(); ++i) {
      least_traced[i] =
          std::min(least_traced[i], seconds([&] { traced[i] = trace_ray(*s.kerr, starts[i], 1, trace); }));
    }
  }
  Errors errors;
  double total = 0.0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    errors.add(separated_state(s.chart, traced[i].y).n, std::nan(""), traced[i].status, *truth[i]);
    total += least_traced[i];
  }
  errors.report(state);
  state.counters["tracer_rays/s"] = static_cast<double>(rays.size()) / total;
  state.counters["times_faster"] = total / least;
}
BENCHMARK(over_tracer)->Arg(8)->Arg(11)->MinTime(2.0)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace xpr

BENCHMARK_MAIN();
