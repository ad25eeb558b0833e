#include "validation/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "core/workers.hpp"
#include "metrics/scalar/elementary.hpp"
#include "validation/convergence.hpp"
#include "validation/kit.hpp"
#include "validation/sweep_subjects.hpp"

namespace xpr {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double epsilon = std::numeric_limits<double>::epsilon();

std::vector<double> ladder(double from, double to, double ratio) {
  std::vector<double> settings;
  // Powers of the ratio rather than a running product: the same settings whatever the range.
  for (int k = 0; settings.size() < 1000; ++k) {
    const double setting = from * pow(ratio, static_cast<double>(-k));
    if (setting < to * 0.999) break;
    settings.push_back(setting);
  }
  return settings;
}

/// 1e-4, 1e-5, ... exactly as they are typed, where there is one point for each decade.
std::vector<double> tolerances(const SweepRequest& request) {
  std::vector<double> out = ladder(request.from, request.to, pow(10.0, 1.0 / request.points_per_decade));
  for (double& tol : out) tol = std::stod(fmt::format("{:.3g}", tol));
  return out;
}

void check(const SweepRequest& request) {
  if (request.methods.empty()) throw std::invalid_argument("sweep: no method is named");
  for (const std::string& method : request.methods) (void)method_card(method);
  if (!(request.from > 0.0 && request.from < 1.0 && request.to > 0.0 && request.to <= request.from)) {
    throw std::invalid_argument(
        fmt::format("sweep: tolerances from {:g} to {:g}, needs 1 > from >= to > 0", request.from, request.to));
  }
  if (!(request.step_from > 0.0 && std::isfinite(request.step_from) && request.step_to > 0.0 &&
        request.step_to <= request.step_from)) {
    throw std::invalid_argument(
        fmt::format("sweep: steps from {:g} to {:g}, needs from >= to > 0", request.step_from, request.step_to));
  }
  if (request.points_per_decade < 1 || request.points_per_decade > 100) {
    throw std::invalid_argument(fmt::format("sweep: {} points per decade, needs 1 to 100", request.points_per_decade));
  }
  if (request.rays < 1 || request.rays > 100000) {
    throw std::invalid_argument(fmt::format("sweep: {} rays, needs 1 to 100000", request.rays));
  }
}

/// One point still to be measured, and what is needed to judge its convergence afterwards.
struct Job {
  const Subject* subject;
  MethodAt method;
  SweepPoint point;
  Rung rung;
  bool done = false;
};

void measure(Job& job) {
  const Subject& subject = *job.subject;
  SweepPoint& point = job.point;
  const MethodCard& card = method_card(job.method.method);
  point.metric = subject.chart->card().metric;
  point.chart = subject.chart->card().chart;
  point.method = method_label(job.method);
  point.adaptive = card.adaptive;
  point.setting = job.method.setting;
  point.rays = subject.rays;
  std::vector<double> sizes;
  std::int64_t evaluations = 0, steps = 0;
  double seconds = 0.0;
  for (int i = 0; i < subject.rays; ++i) {
    const Measured ray = subject.measure(static_cast<std::size_t>(i), trace_settings(job.method, subject.length_unit));
    double largest = 0.0;
    for (const double error : ray.error) {
      job.rung.values.push_back(error);
      if (!(std::abs(error) <= largest)) largest = std::abs(error);  // a NaN stays
    }
    sizes.push_back(largest);
    evaluations += ray.end.evaluations;
    steps += ray.end.steps;
    seconds += ray.seconds;
    point.truth_error = std::max(point.truth_error, ray.truth_error);
    if (!(ray.end.null_residual_max <= point.null_drift_max)) point.null_drift_max = ray.end.null_residual_max;
  }
  const double rays = static_cast<double>(subject.rays);
  point.seconds_per_ray = seconds / rays;
  point.evaluations_per_ray = static_cast<double>(evaluations) / rays;
  point.steps_per_ray = static_cast<double>(steps) / rays;
  point.error_norm = root_mean_square(job.rung.values);
  const bool all_numbers = std::isfinite(point.error_norm);
  point.error_median = all_numbers ? quantile(sizes, 0.5) : nan;
  point.error_p99 = all_numbers ? quantile(sizes, 0.99) : nan;
  point.error_max = all_numbers ? quantile(sizes, 1.0) : nan;
  job.rung.setting = job.method.setting;
  job.done = true;
}

/// Orders, Richardson's estimate and the class of the points of one method, coarsest first.
void judge_convergence(std::span<Job> jobs) {
  std::vector<Rung> rungs;
  for (const Job& job : jobs) rungs.push_back(job.rung);
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    SweepPoint& point = jobs[k].point;
    const MethodCard& card = method_card(jobs[k].method.method);
    // Fixed-step errors go as h^p; adaptive ones as the tolerance itself.
    const double expected = card.adaptive ? 1.0 : card.order;
    const double round_off =
        point.truth_error + 4.0 * epsilon * jobs[k].subject->size * std::sqrt(std::max(1.0, point.steps_per_ray));
    point.observed_order =
        k == 0 ? nan
               : order_between(rungs[k - 1].setting, jobs[k - 1].point.error_norm, rungs[k].setting, point.error_norm);
    point.richardson_error = richardson_error(rungs, k, expected);
    point.convergence = to_string(convergence_class(rungs, k, round_off));
  }
}

}  // namespace

std::vector<Sweep> run_sweep(const SweepRequest& request, const SweepOptions& options) {
  check(request);
  const std::vector<Subject> all = sweep_subjects(request);
  std::vector<Job> jobs;
  std::vector<std::pair<std::size_t, std::size_t>> curves;  // of each subject and method: first job and past the last
  for (const Subject& subject : all) {
    for (const std::string& method : request.methods) {
      const MethodCard& card = method_card(method);
      if (card.separable_only && !subject.chart->separable()) {
        throw std::invalid_argument(fmt::format("method '{}' needs H = T(p) + V(x); that of {} ({}) does not separate",
                                                method, subject.chart->card().metric, subject.chart->card().chart));
      }
      const std::vector<double> settings =
          card.adaptive ? tolerances(request)
                        : ladder(request.step_from * subject.length_unit, request.step_to * subject.length_unit, 2.0);
      curves.emplace_back(jobs.size(), jobs.size() + settings.size());
      for (const double setting : settings) jobs.push_back({&subject, {method, setting, request.projection}, {}, {}});
    }
  }
  std::mutex reporting;
  std::int64_t done = 0;
  Workers(options.threads).for_blocks(0, jobs.size(), 1, [&](std::size_t first, std::size_t last) {
    // The finest points cost most: begun first, so that none is left alone at the end.
    for (std::size_t i = first; i < last; ++i) {
      if (options.stop.stop_requested()) return;
      measure(jobs[jobs.size() - 1 - i]);
      const std::scoped_lock lock(reporting);
      if (options.progress) options.progress(++done, static_cast<std::int64_t>(jobs.size()));
    }
  });
  std::vector<Sweep> sweeps;
  for (const auto& [begin, end] : curves) {
    const std::span<Job> curve(jobs.data() + begin, end - begin);
    if (!std::all_of(curve.begin(), curve.end(), [](const Job& job) { return job.done; })) continue;
    judge_convergence(curve);
    const Subject& subject = *curve.front().subject;
    if (sweeps.empty() || sweeps.back().quantity != subject.quantity) {
      sweeps.push_back({subject.quantity, subject.unit, subject.rank, {}});
    }
    for (const Job& job : curve) sweeps.back().points.push_back(job.point);
  }
  return sweeps;
}

std::vector<Sweep> default_sweeps(SuiteSize size, const SweepOptions& options) {
  const bool full = size == SuiteSize::full;
  std::vector<SweepRequest> requests = {{.metric = "kerr",
                                         .parameters = {{"a", 0.9}},
                                         .methods = {"rk4", "dopri54", "dop853", "gl6"},
                                         .rays = full ? 32 : 8}};
  if (full) {
    for (const char* metric : {"schwarzschild", "ellis"}) {
      requests.push_back({.metric = metric, .methods = {"rk4", "rkf45", "dopri54", "dop853", "gl4", "odeint:rkf78"}});
    }
    requests.push_back(
        {.metric = "maxwell-fisheye",
         .methods = {"euler", "midpoint", "heun2", "rk4", "rkf45", "dopri54", "dop853", "verlet", "implicit-midpoint",
                     "gl4", "gl6", "tao2", "tao4", "odeint:dopri5", "odeint:rkf78", "odeint:bulirsch-stoer"},
         .step_from = 1.0 / 16.0,
         .step_to = 1.0 / 1024.0});
  }
  std::vector<Sweep> sweeps;
  for (const SweepRequest& request : requests) {
    for (Sweep& sweep : run_sweep(request, options)) sweeps.push_back(std::move(sweep));
  }
  return sweeps;
}

}  // namespace xpr
