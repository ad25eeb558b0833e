// A table of rays in, a table of traced rays out: what `xprimeray trace` does.
//
// Rays are read, traced in parallel and written in blocks, so memory does not grow with the table (but for eight bytes
// a ray while ids are checked); rows come out in the order in which they went in, whatever the number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <utility>

#include "core/io/table.hpp"
#include "core/transport.hpp"

namespace xpr {

/// How far off the light cone (null residual) a start may be: what is typed or printed with ten digits is on it.
inline constexpr double largest_off_cone = 1e-9;

struct TraceTableSettings {
  bool renormalise = false;  ///< put rays onto the light cone instead of refusing those that are off it
  int threads = 0;           ///< 0: one for each core
  int lanes = 0;             ///< rays side by side, 1, 2, 4 or 8; 0: what this machine does best
  /// Called now and then from the calling thread, with rays done and in all.
  std::function<void(std::int64_t done, std::int64_t rays)> progress = {};
  /// Asked now and then from any thread; true ends the work with Interrupted.
  std::function<bool()> interrupted = {};
};

struct TraceTableResult {
  std::int64_t rays = 0;
  std::array<std::int64_t, status_names.size()> with_status{};
  std::int64_t steps = 0;
  std::int64_t evaluations = 0;
  std::string rays_hash;  ///< over the columns of the table that was written
};

/// Reads the whole table and checks it: its form, unique ids, sheets, rays on the light cone. Returns their number.
/// Throws InputError.
[[nodiscard]] std::int64_t check_rays(const std::filesystem::path& path, const Transport& transport,
                                      const TraceTableSettings& settings);

/// Traces a table that check_rays has passed. Throws as readers and writers do, and Interrupted.
[[nodiscard]] TraceTableResult trace_table(const Transport& transport, TableReader& reader, TableWriter& writer,
                                           std::int64_t rays, const TraceTableSettings& settings);

}  // namespace xpr
