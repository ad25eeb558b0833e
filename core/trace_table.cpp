#include "core/trace_table.hpp"

#include <fmt/format.h>

#include <vector>

#include "core/io/errors.hpp"
#include "core/io/ray_table.hpp"
#include "core/workers.hpp"
#include "integrators/batch_tracer.hpp"

namespace xpr {
namespace {

// Rays in memory at a time: enough to keep every core busy, two megabytes of starts.
constexpr std::size_t block_rays = 16384;
// Rays a task: enough to keep lanes full to the end, few enough that slow rays do not hold a core up.
constexpr std::size_t grain = 256;

void check_interrupted(const TraceTableSettings& settings) {
  if (settings.interrupted && settings.interrupted()) throw Interrupted("interrupted");
}

// What is wrong with a ray's start, or nothing.
std::string fault_of(const Ray& ray, const Transport& transport, bool renormalise) {
  if (ray.sheet != 1 && ray.sheet != -1) return fmt::format("sheet {}, needs 1 or -1", ray.sheet);
  if (renormalise || !transport.admits(ray)) return {};
  const double off = transport.off_cone(ray);
  if (!(off > largest_off_cone)) return {};
  return fmt::format("off the light cone: null residual {:.3g}, needs {:g} or less; --renormalise solves for p0", off,
                     largest_off_cone);
}

// Names the two rows that share an id: a second look at the file, for the message alone.
[[noreturn]] void fail_for_duplicate(const std::filesystem::path& path, const TableSchema& schema, std::int64_t id) {
  const auto reader = open_table(path, schema);
  std::vector<std::int64_t> places;
  for (TableBlock block = reader->read(block_rays); block.rows > 0; block = reader->read(block_rays)) {
    for (std::size_t row = 0; row < block.rows && places.size() < 2; ++row) {
      if (block.integers(0)[row] == id) places.push_back(block.places[row]);
    }
  }
  throw InputError(fmt::format("{}: {}s {} have the same id {}", path.string(), reader->place_word(),
                               fmt::join(places, " and "), id));
}

}  // namespace

std::int64_t check_rays(const std::filesystem::path& path, const Transport& transport,
                        const TraceTableSettings& settings) {
  const TableSchema schema = ray_schema(transport.chart().card());
  const auto reader = open_table(path, schema);
  IdCheck ids;
  std::int64_t count = 0;
  for (TableBlock block = reader->read(block_rays); block.rows > 0; block = reader->read(block_rays)) {
    check_interrupted(settings);
    const std::vector<Ray> rays = rays_of(block);
    for (std::size_t row = 0; row < rays.size(); ++row) {
      const std::string fault = fault_of(rays[row], transport, settings.renormalise);
      if (!fault.empty()) {
        throw InputError(fmt::format("{}: {} {}, id {}: {}", path.string(), reader->place_word(), block.places[row],
                                     rays[row].id, fault));
      }
      ids.add(rays[row].id);
    }
    count += static_cast<std::int64_t>(rays.size());
  }
  if (const auto id = ids.duplicate()) fail_for_duplicate(path, schema, *id);
  return count;
}

TraceTableResult trace_table(const Transport& transport, TableReader& reader, TableWriter& writer, std::int64_t rays,
                             const TraceTableSettings& settings) {
  const TableSchema schema = traced_ray_schema(transport.chart().card());
  Workers workers(settings.threads);
  const int lanes = settings.lanes > 0 ? settings.lanes : best_lanes();
  CanonicalHash hash;
  TraceTableResult result;
  for (TableBlock block = reader.read(block_rays); block.rows > 0; block = reader.read(block_rays)) {
    std::vector<Ray> starts = rays_of(block);
    if (settings.renormalise) {
      for (Ray& ray : starts) ray = transport.renormalised(ray);
    }
    std::vector<TracedRay> ends(starts.size());
    workers.for_blocks(0, starts.size(), grain, [&](std::size_t first, std::size_t last) {
      check_interrupted(settings);
      transport.trace(std::span(starts).subspan(first, last - first), lanes,
                      std::span(ends).subspan(first, last - first));
    });
    check_interrupted(settings);
    const TableBlock out = block_of(ends);
    writer.write(out);
    add_to_hash(hash, schema, out);
    for (const TracedRay& end : ends) {
      ++result.with_status[static_cast<std::size_t>(end.status)];
      result.steps += end.steps;
      result.evaluations += end.evaluations;
    }
    result.rays += static_cast<std::int64_t>(ends.size());
    if (settings.progress) settings.progress(result.rays, rays);
  }
  result.rays_hash = hash.hex();
  return result;
}

}  // namespace xpr
