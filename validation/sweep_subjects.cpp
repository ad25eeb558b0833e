#include "validation/sweep_subjects.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "metrics/catalogue.hpp"
#include "metrics/chart_map.hpp"
#include "metrics/ellis_exact.hpp"
#include "metrics/kerr_exact.hpp"
#include "metrics/scalar/elementary.hpp"
#include "metrics/schwarzschild_exact.hpp"
#include "validation/bundle.hpp"
#include "validation/convergence.hpp"
#include "validation/kit.hpp"
#include "validation/surface_rays.hpp"

namespace xpr {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double epsilon = std::numeric_limits<double>::epsilon();

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

std::vector<NamedValue> named_values(const SweepRequest& request) {
  std::vector<NamedValue> values;
  for (const SweepParameter& parameter : request.parameters) values.push_back({parameter.name, parameter.value});
  return values;
}

/// The chart that is asked for, else the one that is regular where the rays go.
std::string chart_of(const SweepRequest& request) {
  return request.chart.empty() ? std::string(transport_chart(request.metric, true)) : request.chart;
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
  auto bundle = std::make_shared<SweptBundle>();
  bundle->classical = make_spacetime(request.metric, physics.classical, values);
  bundle->transport = make_spacetime(request.metric, chart_of(request), values);
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

/// End states of a bundle that has its truth, compared in the bundle's chart wherever they are traced.
Subject end_state(Bundle made, std::shared_ptr<const Spacetime> transport, std::string quantity, TruthRank rank) {
  auto bundle = std::make_shared<Bundle>(std::move(made));
  Subject subject{.quantity = std::move(quantity), .rank = rank};
  subject.chart = transport;
  subject.rays = static_cast<int>(bundle->starts.size());
  subject.length_unit = bundle->length_unit;
  subject.size = root_mean_square(spatial_components(bundle->ends));
  subject.measure = [bundle, transport](std::size_t ray, TraceSettings settings) {
    settings.lambda_max = bundle->spans[ray];
    const PhaseState<double> start = change_chart(*bundle->chart, *transport, bundle->starts[ray]).state;
    const Stopwatch watch;
    Measured out;
    out.end = trace_ray(*transport, start, 1, settings);
    out.seconds = watch.seconds();
    const bool there = out.end.status == Status::max_affine;
    const PhaseState<double> end = change_chart(*transport, *bundle->chart, out.end.y).state;
    for (const std::size_t k : {1U, 2U, 3U, 5U, 6U, 7U}) {
      // Lengths in their unit, momenta as they are (E = 1).
      const double unit = k < 4 ? bundle->length_unit : 1.0;
      out.error.push_back(there ? (end[k] - bundle->ends[ray][k]) / unit : nan);
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

/// Geodesics of an ellipsoid of revolution, over its poles too, and where they arrive.
struct SurfaceBundle {
  std::shared_ptr<const Spacetime> geographic, transport;
  Spheroid body;
  std::vector<PhaseState<double>> starts;
  std::vector<double> lengths;
  std::vector<std::array<double, 3>> arrivals;

  [[nodiscard]] Measured measure(std::size_t ray, TraceSettings settings) const {
    settings.lambda_max = lengths[ray];
    const Stopwatch watch;
    Measured out;
    out.end = trace_ray(*transport, starts[ray], 1, settings);
    out.seconds = watch.seconds();
    const bool there = out.end.status == Status::max_affine;
    const PhaseState<double> y = change_chart(*out.end.chart, *geographic, out.end.y, out.end.sheet).state;
    const std::array<double, 3> point = point_on_surface(body, y[1], y[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      out.error.push_back(there ? (point[k] - arrivals[ray][k]) / body.a_axis : nan);
    }
    // The oracle's own, and round-off of angles in degrees and radians.
    out.truth_error = surface_oracle_error + 8.0 * epsilon;
    return out;
  }
};

Subject surface_arrivals(const SweepRequest& request) {
  auto bundle = std::make_shared<SurfaceBundle>();
  bundle->geographic = make_spacetime(request.metric, "geographic", named_values(request));
  bundle->transport = make_spacetime(request.metric, chart_of(request), named_values(request));
  bundle->body = {parameter_value(*bundle->transport, "a_axis"), parameter_value(*bundle->transport, "f")};
  SeededNumbers seeded(0x1825);  // the year of Bessel's geodesics
  for (int i = 0; i < request.rays; ++i) {
    const double latitude = seeded.uniform(-60.0, 60.0), azimuth = seeded.uniform(0.0, 360.0);
    const double length = bundle->body.a_axis * seeded.uniform(1.0, 3.0);
    const PhaseState<double> start = surface_light(bundle->body, latitude, azimuth);
    bundle->starts.push_back(change_chart(*bundle->geographic, *bundle->transport, start).state);
    bundle->lengths.push_back(length);
    bundle->arrivals.push_back(surface_arrival(bundle->body, latitude, azimuth, length));
  }
  return {.quantity = "point of arrival",
          .unit = "a_axis",
          .rank = TruthRank::high_precision,
          .chart = bundle->transport,
          .rays = request.rays,
          .length_unit = bundle->body.a_axis,
          .measure = [bundle](std::size_t ray, TraceSettings settings) { return bundle->measure(ray, settings); }};
}

}  // namespace

const std::vector<std::string_view>& sweep_metrics() {
  static const std::vector<std::string_view> known = {"minkowski", "schwarzschild",   "kerr",     "ellis",
                                                      "luneburg",  "maxwell-fisheye", "ellipsoid"};
  return known;
}

std::vector<Subject> sweep_subjects(const SweepRequest& request) {
  const std::vector<std::string_view>& known = sweep_metrics();
  if (std::find(known.begin(), known.end(), request.metric) == known.end()) {
    (void)transport_chart(request.metric, true);  // names the nearest metric where there is none of that name
    throw std::invalid_argument(fmt::format("sweep has no rays and no truth for metric '{}'; it has for {}",
                                            request.metric, fmt::join(known, ", ")));
  }
  const std::shared_ptr<const Spacetime> chart =
      make_spacetime(request.metric, chart_of(request), named_values(request));
  const Lab lab(SuiteSize::full);
  const double R = parameter_value(*chart, "R");
  const auto exact_end_state = [&](Bundle bundle, std::string quantity) {
    return std::vector<Subject>{end_state(std::move(bundle), chart, std::move(quantity), TruthRank::closed_form)};
  };
  if (request.metric == "minkowski") return exact_end_state(straight_rays(request.rays), "end state");
  if (request.metric == "maxwell-fisheye") {
    return exact_end_state(fisheye_orbits(lab, request.rays, FisheyePath::arc, R), "end state");
  }
  if (request.metric == "luneburg") {
    return exact_end_state(luneburg_rays(lab, request.rays, R), "state at the focus");
  }
  if (request.metric == "ellipsoid") return {surface_arrivals(request)};
  std::vector<Subject> out = {swept_angle(request)};
  if (request.metric == "kerr" && (request.chart.empty() || request.chart == "kerr-schild")) {
    const KerrHole hole{parameter_value(*chart, "M"), parameter_value(*chart, "a")};
    out.push_back(end_state(kerr_scattering(lab, request.rays, hole), chart, "off-equatorial end state",
                            TruthRank::self_convergence));
  }
  return out;
}

}  // namespace xpr
