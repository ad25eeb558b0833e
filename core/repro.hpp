// Reproducibility, shown: the same rays by every number of threads and every width of lanes, hashed.
//
// rays_hash is equal for all of them, for every compiler, optimisation level and x86-64 level (DESIGN section 6);
// tools/repro compares builds.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace xpr {

struct ReproRun {
  int threads = 1;
  int lanes = 1;
  std::string rays_hash;
  double seconds = 0.0;
};

struct ReproSettings {
  int rays = 512;  ///< of each spacetime and method
  std::vector<int> threads{1, 2};
  std::vector<int> lanes{1, 2, 4, 8};
  std::function<void(std::int64_t done, std::int64_t runs)> progress = {};
  std::function<bool()> interrupted = {};
};

/// What is traced, a line each: spacetime, parameters, method.
[[nodiscard]] std::vector<std::string> repro_subjects();

/// Traces all subjects once for every pair of threads and lanes. Throws Interrupted.
[[nodiscard]] std::vector<ReproRun> run_repro(const ReproSettings& settings);

/// Whether all hashes are one.
[[nodiscard]] bool reproduced(const std::vector<ReproRun>& runs);

}  // namespace xpr
