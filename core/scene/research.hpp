// Research Mode: configuration, not another code path. A base, a set of overrides on it, and what comes of both.
//
// A preset is nothing but a named override set. Every field of the configuration can be overridden or left alone; a
// field that is set to its default differs from one that is not set. What counts is the effective configuration: the
// base unchanged where the overrides' master switch is off, else the base with every set field copied over it. The hash
// of the override set goes into every report and into the banner.
//
// Only counts limit work here: a wall-clock budget is refused while Research Mode is on.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/fields/kick_drift.hpp"

namespace xpr {

enum class ResearchTier { preview, error_bounded, invariant_preserving };
enum class TransportModel { grin_optical, metric_null_geodesic, hybrid_research };
enum class ResearchSuite { quick_sanity, full_regression, metric_benchmarks };

/// As files spell them, in the order of the enums.
inline constexpr std::array<std::string_view, 3> transport_model_names{"GRIN_Optical", "Metric_NullGeodesic",
                                                                       "Hybrid_Research"};
inline constexpr std::array<std::string_view, 3> research_suite_names{"QuickSanity", "FullRegression",
                                                                      "MetricBenchmarks"};

/// The kick-drift stepper of tier 0: an id like those of methods().
inline constexpr std::string_view kick_drift_id = "tier0_kick_drift";

/// Column and row of a pixel, (0, 0) at the upper left.
using PixelIndex = std::array<std::int64_t, 2>;

/// All fields with their defaults (the earlier engine's DefaultsPreview, and two of our own at the end). Inert while
/// research_enabled is false.
struct ResearchConfig {
  bool research_enabled = false;
  ResearchTier research_tier = ResearchTier::preview;
  TransportModel transport_model = TransportModel::grin_optical;
  std::string integrator_kind{kick_drift_id};  ///< a method id

  double abs_pos_tol = 1e-3;  ///< length units of the scene
  double rel_tol = 1e-4;
  double dt_min = 1e-4;  ///< steps of tier 0 and of fixed-step methods stay in [dt_min, dt_max]
  double dt_max = 0.1;
  std::int64_t max_steps_per_ray = 2048;

  bool track_null_constraint = false;
  double null_constraint_tol = 1e-3;
  bool enable_constraint_projection = false;
  std::int64_t max_constraint_projection_iters = 2;

  bool deterministic_mode = false;
  std::int64_t fixed_seed = 1;

  double max_work_per_frame_ms = 16.0;  ///< of interactive hosts; never looked at in Research Mode

  bool validation_enabled = false;
  ResearchSuite validation_suite = ResearchSuite::quick_sanity;
  std::string validation_report_path;

  std::int64_t truth_pass_pixels = 0;  ///< how many pixels, drawn by the seed, are rendered by brute force too
  std::vector<PixelIndex> ray_dumps;   ///< pixels whose every step is written out
};

/// Which fields are set, and to what. Without `enabled` the whole set is as if it were not there.
struct ResearchOverrides {
  bool enabled = false;

  std::optional<bool> research_enabled;
  std::optional<ResearchTier> research_tier;
  std::optional<TransportModel> transport_model;
  std::optional<std::string> integrator_kind;
  std::optional<double> abs_pos_tol, rel_tol, dt_min, dt_max;
  std::optional<std::int64_t> max_steps_per_ray;
  std::optional<bool> track_null_constraint;
  std::optional<double> null_constraint_tol;
  std::optional<bool> enable_constraint_projection;
  std::optional<std::int64_t> max_constraint_projection_iters;
  std::optional<bool> deterministic_mode;
  std::optional<std::int64_t> fixed_seed;
  std::optional<double> max_work_per_frame_ms;
  std::optional<bool> validation_enabled;
  std::optional<ResearchSuite> validation_suite;
  std::optional<std::string> validation_report_path;
  std::optional<std::int64_t> truth_pass_pixels;
  std::optional<std::vector<PixelIndex>> ray_dumps;
};

/// Calls visit(name, member of ResearchConfig, member of ResearchOverrides) for every field, in the order above.
template <class Visitor>
void for_each_research_field(Visitor&& visit) {
  using C = ResearchConfig;
  using O = ResearchOverrides;
  visit("research_enabled", &C::research_enabled, &O::research_enabled);
  visit("research_tier", &C::research_tier, &O::research_tier);
  visit("transport_model", &C::transport_model, &O::transport_model);
  visit("integrator_kind", &C::integrator_kind, &O::integrator_kind);
  visit("abs_pos_tol", &C::abs_pos_tol, &O::abs_pos_tol);
  visit("rel_tol", &C::rel_tol, &O::rel_tol);
  visit("dt_min", &C::dt_min, &O::dt_min);
  visit("dt_max", &C::dt_max, &O::dt_max);
  visit("max_steps_per_ray", &C::max_steps_per_ray, &O::max_steps_per_ray);
  visit("track_null_constraint", &C::track_null_constraint, &O::track_null_constraint);
  visit("null_constraint_tol", &C::null_constraint_tol, &O::null_constraint_tol);
  visit("enable_constraint_projection", &C::enable_constraint_projection, &O::enable_constraint_projection);
  visit("max_constraint_projection_iters", &C::max_constraint_projection_iters, &O::max_constraint_projection_iters);
  visit("deterministic_mode", &C::deterministic_mode, &O::deterministic_mode);
  visit("fixed_seed", &C::fixed_seed, &O::fixed_seed);
  visit("max_work_per_frame_ms", &C::max_work_per_frame_ms, &O::max_work_per_frame_ms);
  visit("validation_enabled", &C::validation_enabled, &O::validation_enabled);
  visit("validation_suite", &C::validation_suite, &O::validation_suite);
  visit("validation_report_path", &C::validation_report_path, &O::validation_report_path);
  visit("truth_pass_pixels", &C::truth_pass_pixels, &O::truth_pass_pixels);
  visit("ray_dumps", &C::ray_dumps, &O::ray_dumps);
}

/// off, validate, paper-match, stress-test.
[[nodiscard]] const std::vector<std::string_view>& research_presets();
/// The override set of that name. Throws std::invalid_argument for an unknown one, naming the nearest.
[[nodiscard]] ResearchOverrides preset_overrides(std::string_view preset);

/// `first` with every field that `second` sets copied over it; its master switch is second's.
[[nodiscard]] ResearchOverrides combined(const ResearchOverrides& first, const ResearchOverrides& second);
/// The base unchanged unless overrides.enabled; else the base with every set field copied over it.
[[nodiscard]] ResearchConfig effective_config(const ResearchConfig& base, const ResearchOverrides& overrides);

/// What is wrong with a configuration and the field it is wrong in: numbers out of their range, and a wall-clock budget
/// that the overrides ask for while Research Mode is on.
struct ResearchFault {
  std::string field, what;
};
[[nodiscard]] std::optional<ResearchFault> fault_of(const ResearchConfig& config, const ResearchOverrides& overrides);

/// "Heuristic", "RK45_Embedded" and "Symplectic" as the method ids that stand for them; any method id as it is. Throws
/// std::invalid_argument for anything else, naming the nearest.
[[nodiscard]] std::string method_of_integrator(std::string_view name);

/// One "field = value" a line for every set field, in the order of their names: what the hash is taken over. Empty
/// where the master switch is off.
[[nodiscard]] std::string canonical_text(const ResearchOverrides& overrides);
/// All fields of a configuration.
[[nodiscard]] std::string canonical_text(const ResearchConfig& config);
/// 32 hexadecimal digits, the same on every machine.
[[nodiscard]] std::string hash_of(const ResearchOverrides& overrides);
[[nodiscard]] std::string hash_of(const ResearchConfig& config);

/// Segments that a ray can make at most where geometry sees one for every `every` steps.
[[nodiscard]] constexpr std::int64_t segment_capacity(std::int64_t steps, std::int64_t every) {
  return (steps + every - 1) / every;
}

/// How often each value had to give way.
struct ResearchClamps {
  std::int64_t max_steps = 0, min_step = 0, max_step = 0, step_length = 0;

  [[nodiscard]] std::int64_t total() const { return max_steps + min_step + max_step + step_length; }
};

struct ClampedStepping {
  KickDriftSettings stepping;
  ResearchClamps clamps;
};
/// Steps of tier 0 under Research Mode: max_steps into [1, max_steps_per_ray], min_step up to dt_min, max_step down to
/// max(min_step, dt_max) and not below min_step, step_length between both; no cap on the acceleration, which is no
/// optics. The stepping given stays as it is, so nothing has to be restored after a frame; unchanged where Research
/// Mode is off.
[[nodiscard]] ClampedStepping clamped(const KickDriftSettings& stepping, const ResearchConfig& config);

/// The seed of a frame: fixed_seed + frame in deterministic mode, else the film's own seed + frame.
[[nodiscard]] std::uint64_t frame_seed(const ResearchConfig& config, std::uint64_t film_seed, std::uint64_t frame);

/// One line: tier, transport, integrator, tolerance, range of steps, determinism, and the hash of the override set.
[[nodiscard]] std::string banner_line(const ResearchConfig& config, const ResearchOverrides& overrides);

/// Says the banner once: when Research Mode comes on, and whenever the hash of the configuration changes.
class ResearchBanner {
 public:
  /// The line to print before a frame, if there is one to print.
  [[nodiscard]] std::optional<std::string> next(const ResearchConfig& config, const ResearchOverrides& overrides);

 private:
  bool was_enabled_ = false;
  std::string last_hash_ = hash_of(ResearchConfig{});
};

}  // namespace xpr
