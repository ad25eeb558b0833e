// Sweeps: the error of several methods over a ladder of tolerances or step sizes, against the truth, with what it cost.
//
// Fixed-step methods halve their step, adaptive ones tighten their tolerance. Every setting is measured on the same
// seeded bundle of rays.
//
// | metric | what is measured | truth |
// | --- | --- | --- |
// | schwarzschild, kerr, ellis | angle swept in the equatorial plane, to the hole and back | closed form |
// | kerr | end state of rays off the equator | self-convergence |
// | luneburg | end state of parallel light at the focus | closed form |
// | maxwell-fisheye | end state after 0.45 turns | closed form |
// | ellipsoid | point of arrival of geodesics, over the poles too | GeographicLib's exact geodesics |
// | minkowski | end state of straight rays | closed form |
#pragma once

#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "validation/case.hpp"
#include "validation/result.hpp"

namespace xpr {

/// A parameter of the metric by name.
struct SweepParameter {
  std::string name;
  double value = 0.0;
};

struct SweepRequest {
  std::string metric = "kerr";
  std::vector<SweepParameter> parameters = {};
  std::string chart = {};  ///< to trace in; empty: the metric's transport chart
  std::vector<std::string> methods = {"rk4", "dopri54", "dop853", "gl6"};
  Projection projection = Projection::none;
  double from = 1e-4;  ///< loosest tolerance
  double to = 1e-12;   ///< tightest tolerance
  int points_per_decade = 1;
  double step_from = 1.0;  ///< longest step of fixed-step methods, in the length unit at |p_t| = 1
  double step_to = 1.0 / 64.0;
  int rays = 32;
};

struct SweepOptions {
  int threads = 0;  ///< 0: as many as the machine has; no number but the times depends on it
  std::function<void(std::int64_t done, std::int64_t total)> progress = {};  ///< called from any thread, one at a time
  std::stop_token stop = {};  ///< when requested, points not yet begun are left out
};

/// Metrics that a sweep has rays and a truth for.
[[nodiscard]] const std::vector<std::string_view>& sweep_metrics();

/// One sweep for each quantity that is measured in the metric. Throws std::invalid_argument for unknown names (with the
/// nearest known one), empty ladders and settings outside their ranges.
[[nodiscard]] std::vector<Sweep> run_sweep(const SweepRequest& request, const SweepOptions& options = {});

/// The sweeps that belong to a suite's report.
[[nodiscard]] std::vector<Sweep> default_sweeps(SuiteSize size, const SweepOptions& options = {});

}  // namespace xpr
