#include "validation/sweep.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "metrics/catalogue.hpp"
#include "metrics/ellis_exact.hpp"
#include "metrics/kerr_exact.hpp"
#include "metrics/scalar/elementary.hpp"
#include "metrics/schwarzschild_exact.hpp"
#include "validation/bundle.hpp"
#include "validation/convergence.hpp"
#include "validation/kit.hpp"

namespace xpr {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// What came of one ray.
struct Measured {
  std::vector<double> error;  ///< signed, one for each component measured; NaN where the ray ended elsewhere
  double truth_error = 0.0;
  RayEnd end = {};
  double seconds = 0.0;  ///< of the tracing alone
};

/// Processor time of this thread since it was made: other work on the machine does not count.
class Stopwatch {
 public:
  [[nodiscard]] double seconds() const { return now() - begin_; }

 private:
  [[nodiscard]] static double now() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }
  double begin_ = now();
};

/// Rays, what is measured on them, and against what.
struct Subject {
  std::string quantity;
  std::string unit = "1";
  TruthRank rank = TruthRank::closed_form;
  std::shared_ptr<const Spacetime> chart = {};
  int rays = 0;
  double length_unit = 1.0;
  double size = 1.0;  ///< of the quantity: its round-off is epsilon times that, a step
  std::function<Measured(std::size_t ray, TraceSettings settings)> measure = {};
};

std::vector<NamedValue> named_values(const SweepRequest& request) {
  std::vector<NamedValue> values;
  for (const SweepParameter& parameter : request.parameters) values.push_back({parameter.name, parameter.value});
  return values;
}

double parameter_value(const Spacetime& spacetime, std::string_view name) {
  for (const NamedValue& parameter : spacetime.parameters()) {
    if (parameter.name == name) return parameter.value;
  }
  return 0.0;
}

/// Equatorial light that comes in from 50 length units, passes its turning point and goes out again.
struct SweptBundle {
  std::shared_ptr<const Spacetime> classical, transport;
  std::vector<ChartState> starts;
  double radius = 50.0;
  std::function<ExactValue(double b, double r1, double r2)> truth;  ///< |Delta phi|

  [[nodiscard]] Measured measure(std::size_t ray, TraceSettings settings) const {
    const Lab lab(SuiteSize::full);
    settings.r_max = radius;
    settings.r_min = transport->default_r_min();
    if (transport->proper_distance(starts[ray].state.x(), starts[ray].sheet)) settings.l_min = 0.0;
    settings.lambda_max = 20.0 * radius;  // a ray that a coarse step has bound to the hole must end
    const Stopwatch watch;
    const SweptRay swept = trace_swept(lab, *classical, *transport, starts[ray], settings);
    Measured out{.error = {nan}, .end = swept.end, .seconds = watch.seconds()};
    if (swept.end.status != Status::escaped) return out;
    const double b = impact_parameter(*classical, swept.start_classical);
    const ExactValue exact = truth(b, swept.start_classical[1], swept.end_classical[1]);
    out.error = {std::abs(swept.azimuth()) - std::abs(exact.value)};
    out.truth_error = exact.error;
    return out;
  }
};

/// b_c on the side that b lies, the truth, the classical chart and the length unit of a metric with closed forms.
struct SweptPhysics {
  std::string_view classical;
  double length_unit;
  std::function<double(bool prograde)> critical;
  std::function<ExactValue(double b, double r1, double r2)> truth;
};

SweptPhysics swept_physics(const SweepRequest& request) {
  const std::vector<NamedValue> values = named_values(request);
  const std::unique_ptr<Spacetime> any = make_spacetime(request.metric, "", values);
  if (request.metric == "ellis") {
    const double b0 = parameter_value(*any, "b0");
    return {"proper-distance", b0, [b0](bool) { return b0; },
            [b0](double b, double l1, double l2) { return ellis_exact::swept_angle(b0, std::abs(b), l1, l2, true); }};
  }
  const double M = parameter_value(*any, "M");
  if (request.metric == "schwarzschild") {
    return {
        "areal", M, [M](bool) { return schwarzschild_exact::critical_impact_parameter(M).value; },
        [M](double b, double r1, double r2) { return schwarzschild_exact::swept_angle(M, std::abs(b), r1, r2, true); }};
  }
  const double a = parameter_value(*any, "a");
  return {"boyer-lindquist", M,
          [M, a](bool prograde) {
            const auto sense = prograde ? kerr_exact::Sense::prograde : kerr_exact::Sense::retrograde;
            return std::abs(kerr_exact::critical_impact_parameter(M, a, sense).value);
          },
          [M, a](double b, double r1, double r2) { return kerr_exact::equatorial_swept_angle(M, a, b, r1, r2, true); }};
}

/// b from 1.05 b_c to 4 b_c, of both signs.
Subject swept_angle(const SweepRequest& request) {
  const SweptPhysics physics = swept_physics(request);
  const std::vector<NamedValue> values = named_values(request);
  const std::string chart = request.chart.empty() ? std::string(transport_chart(request.metric, true)) : request.chart;
  auto bundle = std::make_shared<SweptBundle>();
  bundle->classical = make_spacetime(request.metric, physics.classical, values);
  bundle->transport = make_spacetime(request.metric, chart, values);
  bundle->radius = 50.0 * physics.length_unit;
  bundle->truth = physics.truth;
  SeededNumbers seeded(0x1959);  // the year of Darwin's deflection
  for (int i = 0; i < request.rays; ++i) {
    const bool positive = i % 2 == 0;
    const double a = parameter_value(*bundle->classical, "a");
    const double b = physics.critical(positive == (a >= 0.0)) * seeded.uniform(1.05, 4.0) * (positive ? 1.0 : -1.0);
    // Radii of Ellis's hub are l, its stops refer to the areal r: both are near 50 b0 there.
    bundle->starts.push_back(equatorial_light(*bundle->classical, *bundle->transport, bundle->radius, b));
  }
  return {.quantity = "equatorial swept angle",
          .unit = "rad",
          .chart = bundle->transport,
          .rays = request.rays,
          .length_unit = physics.length_unit,
          .size = pi<double>(),
          .measure = [bundle](std::size_t ray, TraceSettings settings) { return bundle->measure(ray, settings); }};
}

/// End states of a bundle that has its truth.
Subject end_state(Bundle made, std::string quantity, TruthRank rank) {
  auto bundle = std::make_shared<Bundle>(std::move(made));
  Subject subject{.quantity = std::move(quantity), .rank = rank};
  subject.chart = std::shared_ptr<const Spacetime>(bundle, bundle->chart.get());
  subject.rays = static_cast<int>(bundle->starts.size());
  subject.length_unit = bundle->length_unit;
  subject.size = root_mean_square(spatial_components(bundle->ends));
  subject.measure = [bundle](std::size_t ray, TraceSettings settings) {
    settings.lambda_max = bundle->spans[ray];
    const Stopwatch watch;
    Measured out;
    out.end = trace_ray(*bundle->chart, bundle->starts[ray], 1, settings);
    out.seconds = watch.seconds();
    const bool there = out.end.status == Status::max_affine;
    for (const std::size_t k : {1U, 2U, 3U, 5U, 6U, 7U}) {
      // Lengths in their unit, momenta as they are (E = 1).
      const double unit = k < 4 ? bundle->length_unit : 1.0;
      out.error.push_back(there ? (out.end.y[k] - bundle->ends[ray][k]) / unit : nan);
    }
    out.truth_error = bundle->truth_error;
    return out;
  };
  return subject;
}

/// Straight light in flat space.
Bundle straight_rays(int rays) {
  Bundle bundle;
  bundle.chart = make_spacetime("minkowski", "cartesian");
  SeededNumbers seeded(0x1908);  // the year of Minkowski's space and time
  for (int i = 0; i < rays; ++i) {
    const std::array<double, 3> x = seeded.direction(), p = seeded.direction();
    const PhaseState<double> start({0.0, x[0], x[1], x[2]}, {-1.0, p[0], p[1], p[2]});
    PhaseState<double> end = start;
    for (std::size_t k = 0; k < 3; ++k) end[1 + k] += 10.0 * p[k];
    bundle.starts.push_back(start);
    bundle.spans.push_back(10.0);
    bundle.ends.push_back(end);
  }
  bundle.truth_error = 10.0 * epsilon;
  return bundle;
}

std::vector<Subject> subjects(const SweepRequest& request) {
  const std::vector<std::string_view>& known = sweep_metrics();
  if (std::find(known.begin(), known.end(), request.metric) == known.end()) {
    (void)transport_chart(request.metric, true);  // names the nearest metric where there is none of that name
    throw std::invalid_argument(fmt::format("sweep has no rays and no truth for metric '{}'; it has for {}",
                                            request.metric, fmt::join(known, ", ")));
  }
  const std::unique_ptr<Spacetime> any = make_spacetime(request.metric, request.chart, named_values(request));
  const Lab lab(SuiteSize::full);
  if (request.metric == "minkowski") {
    return {end_state(straight_rays(request.rays), "end state", TruthRank::closed_form)};
  }
  if (request.metric == "maxwell-fisheye") {
    return {end_state(fisheye_orbits(lab, request.rays, FisheyePath::arc), "end state", TruthRank::closed_form)};
  }
  std::vector<Subject> out = {swept_angle(request)};
  if (request.metric == "kerr" && (request.chart.empty() || request.chart == "kerr-schild")) {
    const KerrHole hole{parameter_value(*any, "M"), parameter_value(*any, "a")};
    out.push_back(
        end_state(kerr_scattering(lab, request.rays, hole), "off-equatorial end state", TruthRank::self_convergence));
  }
  return out;
}

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

const std::vector<std::string_view>& sweep_metrics() {
  static const std::vector<std::string_view> known = {"minkowski", "schwarzschild", "kerr", "ellis", "maxwell-fisheye"};
  return known;
}

std::vector<Sweep> run_sweep(const SweepRequest& request, const SweepOptions& options) {
  check(request);
  const std::vector<Subject> all = subjects(request);
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
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  arena.execute([&] {
    // The finest points cost most: begun first, so that none is left alone at the end.
    tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t i) {
      if (options.stop.stop_requested()) return;
      measure(jobs[jobs.size() - 1 - i]);
      const std::scoped_lock lock(reporting);
      if (options.progress) options.progress(++done, static_cast<std::int64_t>(jobs.size()));
    });
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
