#include "core/repro.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "core/io/errors.hpp"
#include "core/io/hash.hpp"
#include "core/io/ray_table.hpp"
#include "core/transport.hpp"
#include "core/workers.hpp"

namespace xpr {
namespace {

struct Subject {
  const char* metric;
  std::vector<NamedValue> parameters;
  const char* method;
  double setting;  ///< tolerance or step
  Projection projection = Projection::none;
};

/// Every spacetime, hand-written and derived flows, every kernel, projection, an interface, a throat, a scalar method.
const std::vector<Subject>& subjects() {
  static const std::vector<Subject> all{
      {"minkowski", {}, "dopri54", 1e-8},
      {"schwarzschild", {}, "dop853", 1e-10},
      {"schwarzschild", {}, "rk4", 0.2},
      {"kerr", {{"a", 0.9}}, "dop853", 1e-10},
      {"kerr", {{"a", 0.9}}, "dopri54", 1e-8},
      {"kerr", {{"a", -0.998}}, "rkf45", 1e-7},
      {"kerr", {{"a", 1.0}}, "dop853", 1e-8, Projection::full},
      {"ellis", {}, "dop853", 1e-9},
      {"luneburg", {{"R", 8.0}}, "dopri54", 1e-9},
      {"maxwell-fisheye", {{"R", 5.0}}, "gl6", 0.2},
      {"ellipsoid", {{"f", 0.3}}, "dop853", 1e-9},
  };
  return all;
}

Transport transport_of(const Subject& subject) {
  TransportSettings settings{.metric = subject.metric, .parameters = subject.parameters};
  settings.trace.method = subject.method;
  settings.trace.tol = subject.setting;
  settings.trace.step = subject.setting;
  settings.trace.projection = subject.projection;
  settings.trace.r_max = 30.0;
  settings.trace.lambda_max = 80.0;
  settings.trace.max_steps = 2000;
  return Transport(settings);
}

/// A fraction in [0, 1) for each ray and purpose, without any arithmetic that could differ: Weyl's sequence in
/// integers.
double fraction(std::int64_t ray, std::uint64_t purpose) {
  const std::uint64_t mixed =
      static_cast<std::uint64_t>(ray + 1) * (0x9e3779b97f4a7c15U + 2 * purpose * 0xbf58476d1ce4e5U);
  return static_cast<double>(mixed >> 11U) * 0x1p-53;
}

/// Rays from everywhere, forwards and backwards in time; some end where they begin, as tables' rays may.
std::vector<Ray> rays_of(const Transport& transport, int count) {
  std::vector<Ray> rays;
  for (std::int64_t k = 0; k < count; ++k) {
    Ray ray{.id = k};
    ray.start[4] = k % 2 == 0 ? -1.0 : 1.0;
    for (std::size_t mu = 1; mu < 4; ++mu) {
      const double where = 2.0 * fraction(k, mu) - 1.0;
      const bool angle = transport.chart().card().coordinates[mu].kind != CoordinateKind::length;
      ray.start[mu] = angle ? 1.5 + 1.2 * where : 12.0 * where;
      ray.start[4 + mu] = (2.0 * fraction(k, 4 + mu) - 1.0) * (angle ? 12.0 : 1.0);
    }
    rays.push_back(transport.renormalised(ray));
  }
  return rays;
}

void trace_subject(const Subject& subject, int count, Workers& workers, int lanes, CanonicalHash& hash) {
  const Transport transport = transport_of(subject);
  const std::vector<Ray> rays = rays_of(transport, count);
  std::vector<TracedRay> ends(rays.size());
  workers.for_blocks(0, rays.size(), 64, [&](std::size_t first, std::size_t last) {
    transport.trace(std::span(rays).subspan(first, last - first), lanes, std::span(ends).subspan(first, last - first));
  });
  add_to_hash(hash, traced_ray_schema(transport.chart().card()), block_of(ends));
}

}  // namespace

std::vector<std::string> repro_subjects() {
  std::vector<std::string> out;
  for (const Subject& subject : subjects()) {
    std::string line = subject.metric;
    for (const NamedValue& p : subject.parameters) line += fmt::format(" {}={:g}", p.name, p.value);
    out.push_back(fmt::format("{}, {} {:g}{}", line, subject.method, subject.setting,
                              subject.projection == Projection::full ? ", projected" : ""));
  }
  return out;
}

std::vector<ReproRun> run_repro(const ReproSettings& settings) {
  std::vector<ReproRun> runs;
  const auto all = static_cast<std::int64_t>(settings.threads.size() * settings.lanes.size() * subjects().size());
  std::int64_t done = 0;
  for (const int threads : settings.threads) {
    Workers workers(threads);
    for (const int lanes : settings.lanes) {
      const auto begin = std::chrono::steady_clock::now();
      CanonicalHash hash;
      for (const Subject& subject : subjects()) {
        if (settings.interrupted && settings.interrupted()) throw Interrupted("interrupted");
        trace_subject(subject, settings.rays, workers, lanes, hash);
        if (settings.progress) settings.progress(++done, all);
      }
      const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
      runs.push_back({threads, lanes, hash.hex(), seconds.count()});
    }
  }
  return runs;
}

bool reproduced(const std::vector<ReproRun>& runs) {
  return std::all_of(runs.begin(), runs.end(),
                     [&](const ReproRun& run) { return run.rays_hash == runs.front().rays_hash; });
}

}  // namespace xpr
