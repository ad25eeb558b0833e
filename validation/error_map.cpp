#include "validation/error_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "core/io/errors.hpp"
#include "core/io/hash.hpp"
#include "core/io/ray_table.hpp"
#include "core/workers.hpp"
#include "integrators/batch_tracer.hpp"
#include "metrics/kerr_ray_exact.hpp"
#include "validation/directions.hpp"

namespace xpr {
namespace {

using kerr_exact::Arrival;
using kerr_exact::Fate;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The same rays in closed form.
class ExactCamera {
 public:
  ExactCamera(const CameraScreen& screen, double r_min) : screen_(screen), r_min_(r_min) {}

  /// The end of the ray of a screen point, followed back from the camera. A ray traced back in time is the time reverse
  /// of light that runs the same way in space: only t and phi change sign.
  [[nodiscard]] Arrival end(double alpha, double beta) const {
    const kerr_exact::RayMomentum start{.r = screen_.radius,
                                        .theta = screen_.inclination,
                                        .lambda = screen_.constants(alpha, beta).angular_momentum,
                                        .p_theta = -beta,
                                        .radial_sign = -1};
    return kerr_exact::KerrRay({screen_.mass, screen_.spin}, start).at_end(screen_.radius, r_min_);
  }

  /// How far the end turns for a step of M on the screen: central differences along both axes.
  [[nodiscard]] double condition(double alpha, double beta, Fate fate) const {
    const double step = 1e-7 * screen_.half_width;
    double most = 0.0;
    for (const std::array<double, 2>& axis : {std::array{step, 0.0}, std::array{0.0, step}}) {
      const Arrival ahead = end(alpha + axis[0], beta + axis[1]);
      const Arrival behind = end(alpha - axis[0], beta - axis[1]);
      if (!ahead.reached || !behind.reached || ahead.fate != fate || behind.fate != fate) return nan;
      most = std::max(most, angle_between(ahead.direction(), behind.direction()) * screen_.mass / (2.0 * step));
    }
    return most;
  }

 private:
  const CameraScreen& screen_;
  double r_min_;
};

bool agrees(Status status, Fate fate) {
  return (status == Status::escaped && fate == Fate::escaped) || (status == Status::captured && fate == Fate::captured);
}

class Mapping {
 public:
  explicit Mapping(const ErrorMapSettings& settings)
      : settings_(settings),
        transport_(transport_of(settings)),
        exact_(settings.screen, *transport_.settings().trace.r_min) {
    map_.columns = settings.screen.pixels[0];
    map_.rows = settings.screen.pixels[1];
    const auto pixels = static_cast<std::size_t>(map_.columns) * static_cast<std::size_t>(map_.rows);
    for (auto* column : {&map_.alpha, &map_.beta, &map_.direction_error, &map_.swept_error, &map_.time_error,
                         &map_.truth_error, &map_.condition}) {
      column->assign(pixels, nan);
    }
    for (auto* column :
         {&map_.pixel_class, &map_.status, &map_.status_agrees, &map_.steps, &map_.rejected, &map_.evaluations}) {
      column->assign(pixels, 0);
    }
  }

  ErrorMap run() {
    const std::size_t pixels = map_.alpha.size();
    std::vector<TracedRay> ends(pixels);
    Workers workers(settings_.threads);
    // In pieces, so that progress can be told and Ctrl-C heard from one thread.
    constexpr std::size_t piece = 8192;
    for (std::size_t first = 0; first < pixels; first += piece) {
      const std::size_t last = std::min(pixels, first + piece);
      workers.for_blocks(first, last, 256, [&](std::size_t begin, std::size_t end) {
        if (settings_.interrupted && settings_.interrupted()) throw Interrupted("interrupted");
        do_pixels(begin, end, ends);
      });
      if (settings_.progress) {
        settings_.progress(static_cast<std::int64_t>(last), static_cast<std::int64_t>(pixels));
      }
    }
    CanonicalHash hash;
    add_to_hash(hash, traced_ray_schema(transport_.chart().card()), block_of(ends));
    map_.rays_hash = hash.hex();
    return std::move(map_);
  }

 private:
  static Transport transport_of(const ErrorMapSettings& settings) {
    settings.screen.validate();
    const std::string& metric = settings.transport.metric;
    if (metric != "kerr" && metric != "schwarzschild") {
      throw std::invalid_argument(
          fmt::format("metric '{}' has no closed form for a camera's rays; kerr and schwarzschild have", metric));
    }
    TransportSettings transport = settings.transport;
    transport.chart = metric == "kerr" ? "boyer-lindquist" : "areal";
    transport.trace.r_max = settings.screen.radius;
    return Transport(transport);
  }

  void do_pixels(std::size_t begin, std::size_t end, std::vector<TracedRay>& ends) {
    std::vector<Ray> rays(end - begin);
    std::vector<bool> lit(rays.size());
    for (std::size_t k = begin; k < end; ++k) {
      const auto columns = static_cast<std::size_t>(map_.columns);
      const auto [alpha, beta] = settings_.screen.point(static_cast<int>(k % columns), static_cast<int>(k / columns));
      map_.alpha[k] = alpha;
      map_.beta[k] = beta;
      const std::optional<PhaseState<double>> start = settings_.screen.ray(alpha, beta);
      lit[k - begin] = start.has_value();
      rays[k - begin] = {.id = static_cast<std::int64_t>(k), .start = start.value_or(PhaseState<double>{})};
    }
    const int lanes = settings_.lanes > 0 ? settings_.lanes : best_lanes();
    const std::span<TracedRay> out = std::span(ends).subspan(begin, rays.size());
    transport_.trace(rays, lanes, out);
    for (std::size_t k = begin; k < end; ++k) compare(k, lit[k - begin], ends[k]);
  }

  void compare(std::size_t k, bool lit, const TracedRay& ray) {
    map_.status[k] = static_cast<std::int64_t>(ray.status);
    map_.steps[k] = ray.steps;
    map_.rejected[k] = ray.rejected;
    map_.evaluations[k] = ray.evaluations;
    if (!lit) {
      map_.pixel_class[k] = static_cast<std::int64_t>(PixelClass::no_light);
      return;
    }
    const Arrival exact = exact_.end(map_.alpha[k], map_.beta[k]);
    map_.condition[k] = exact_.condition(map_.alpha[k], map_.beta[k], exact.fate);
    PixelClass kind = exact.fate == Fate::captured ? PixelClass::captured : PixelClass::escaped;
    if (!(map_.condition[k] <= critical_condition)) kind = PixelClass::near_critical;
    map_.pixel_class[k] = static_cast<std::int64_t>(kind);
    map_.status_agrees[k] = agrees(ray.status, exact.fate) ? 1 : 0;
    if (map_.status_agrees[k] == 0 || !exact.reached) return;
    // Where the exact ray has no angular momentum its azimuth may turn by pi either way on the axis.
    const double swept = std::abs(ray.end[3] + exact.phi.value);
    const bool meridional = settings_.screen.constants(map_.alpha[k], map_.beta[k]).angular_momentum == 0.0;
    constexpr double turn = 2.0 * std::numbers::pi;
    map_.swept_error[k] = meridional ? std::abs(std::remainder(swept, turn)) : swept;
    map_.time_error[k] = std::abs(ray.end[0] + exact.time.value);
    const std::array<double, 3> there{exact.direction()[0], -exact.direction()[1], exact.direction()[2]};
    map_.direction_error[k] = angle_between(unit_direction(ray.end[2], ray.end[3]), there);
    map_.truth_error[k] = exact.direction_error;
  }

  const ErrorMapSettings& settings_;
  Transport transport_;
  ExactCamera exact_;
  ErrorMap map_;
};

struct Quantiles {
  double median = nan, p99 = nan, most = nan;
};

/// Of the numbers among the values.
Quantiles quantiles(std::vector<double> values) {
  std::erase_if(values, [](double x) { return !(x == x); });
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  return {values[values.size() / 2], values[values.size() * 99 / 100], values.back()};
}

template <class Belongs>
ErrorSummary summarise(const ErrorMap& map, std::string name, const Belongs& belongs) {
  ErrorSummary out{.name = std::move(name)};
  std::vector<double> direction_errors, swept, scaled;
  for (std::size_t k = 0; k < map.alpha.size(); ++k) {
    if (!belongs(static_cast<PixelClass>(map.pixel_class[k]))) continue;
    ++out.pixels;
    out.wrong_status += 1 - map.status_agrees[k];
    out.steps += static_cast<double>(map.steps[k]);
    out.evaluations += static_cast<double>(map.evaluations[k]);
    direction_errors.push_back(map.direction_error[k]);
    swept.push_back(map.swept_error[k]);
    const double condition = map.condition[k];
    scaled.push_back(condition == condition ? map.direction_error[k] / std::max(1.0, condition) : nan);
  }
  const auto put = [](const Quantiles& q, double& median, double& p99, double& most) {
    median = q.median;
    p99 = q.p99;
    most = q.most;
  };
  put(quantiles(std::move(direction_errors)), out.median, out.p99, out.most);
  put(quantiles(std::move(swept)), out.swept_median, out.swept_p99, out.swept_most);
  put(quantiles(std::move(scaled)), out.scaled_median, out.scaled_p99, out.scaled_most);
  const auto n = static_cast<double>(out.pixels);
  out.steps = out.pixels > 0 ? out.steps / n : nan;
  out.evaluations = out.pixels > 0 ? out.evaluations / n : nan;
  return out;
}

}  // namespace

ErrorMap error_map(const ErrorMapSettings& settings) { return Mapping(settings).run(); }

std::vector<ErrorSummary> summary_of(const ErrorMap& map) {
  std::vector<ErrorSummary> out;
  out.push_back(summarise(map, "all", [](PixelClass c) { return c != PixelClass::no_light; }));
  for (const PixelClass kind : {PixelClass::escaped, PixelClass::captured, PixelClass::near_critical}) {
    out.push_back(summarise(map, std::string(pixel_class_names[static_cast<std::size_t>(kind)]),
                            [kind](PixelClass c) { return c == kind; }));
  }
  return out;
}

}  // namespace xpr
