#include "core/scene/research.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "core/io/csv.hpp"
#include "core/io/hash.hpp"
#include "core/io/names.hpp"
#include "integrators/stepper.hpp"

namespace xpr {
namespace {

std::string text_of(bool value) { return value ? "true" : "false"; }
std::string text_of(double value) { return number_text(value); }
std::string text_of(std::int64_t value) { return std::to_string(value); }
std::string text_of(const std::string& value) { return '"' + value + '"'; }
std::string text_of(ResearchTier tier) { return std::to_string(static_cast<int>(tier)); }
std::string text_of(TransportModel model) {
  return std::string(transport_model_names[static_cast<std::size_t>(model)]);
}
std::string text_of(ResearchSuite suite) { return std::string(research_suite_names[static_cast<std::size_t>(suite)]); }
std::string text_of(const std::vector<PixelIndex>& pixels) {
  std::string out = "[";
  for (const auto& [column, row] : pixels) out += fmt::format("{}[{}, {}]", out.size() > 1 ? ", " : "", column, row);
  return out + "]";
}

std::string joined(const std::map<std::string, std::string>& lines) {
  std::string out;
  for (const auto& [field, value] : lines) out += field + " = " + value + "\n";
  return out;
}

std::string hash_of_text(const std::string& text) {
  CanonicalHash hash;
  hash.dataset("research").add(std::string_view(text));
  return hash.hex();
}

/// Presets grade errors: they want an error-bounded method, a seed and the null constraint watched. Tolerances are a
/// decade or more above the round-off of a path of ten thousand steps, 1e4 * 1e-16.
ResearchOverrides validate_preset() {
  ResearchOverrides out;
  out.enabled = true;
  out.research_enabled = true;
  out.research_tier = ResearchTier::error_bounded;
  out.integrator_kind = "dopri54";
  out.abs_pos_tol = 1e-10;
  out.rel_tol = 1e-10;
  out.max_steps_per_ray = 1'000'000;
  out.track_null_constraint = true;
  out.null_constraint_tol = 1e-8;
  out.deterministic_mode = true;
  out.validation_enabled = true;
  out.validation_suite = ResearchSuite::quick_sanity;
  out.truth_pass_pixels = 256;
  return out;
}

/// What a printed number is compared with: the invariant-preserving tier.
ResearchOverrides paper_match_preset() {
  ResearchOverrides out = validate_preset();
  out.research_tier = ResearchTier::invariant_preserving;
  out.integrator_kind = "dop853";
  out.abs_pos_tol = 1e-12;
  out.rel_tol = 1e-12;
  out.null_constraint_tol = 1e-11;
  out.enable_constraint_projection = true;
  out.validation_suite = ResearchSuite::metric_benchmarks;
  return out;
}

/// The same with a large truth pass, whatever time it takes.
ResearchOverrides stress_test_preset() {
  ResearchOverrides out = paper_match_preset();
  out.max_steps_per_ray = 10'000'000;
  out.validation_suite = ResearchSuite::full_regression;
  out.truth_pass_pixels = 4096;
  return out;
}

}  // namespace

const std::vector<std::string_view>& research_presets() {
  static const std::vector<std::string_view> names{"off", "validate", "paper-match", "stress-test"};
  return names;
}

ResearchOverrides preset_overrides(std::string_view preset) {
  if (preset == "off") return {};
  if (preset == "validate") return validate_preset();
  if (preset == "paper-match") return paper_match_preset();
  if (preset == "stress-test") return stress_test_preset();
  throw std::invalid_argument(unknown_name("preset", preset, research_presets()));
}

ResearchOverrides combined(const ResearchOverrides& first, const ResearchOverrides& second) {
  ResearchOverrides out = first;
  out.enabled = second.enabled;
  for_each_research_field([&](std::string_view, auto, auto override_member) {
    if (second.*override_member) out.*override_member = second.*override_member;
  });
  return out;
}

ResearchConfig effective_config(const ResearchConfig& base, const ResearchOverrides& overrides) {
  ResearchConfig out = base;
  if (!overrides.enabled) return out;
  for_each_research_field([&](std::string_view, auto member, auto override_member) {
    if (overrides.*override_member) out.*member = *(overrides.*override_member);
  });
  return out;
}

std::optional<ResearchFault> fault_of(const ResearchConfig& config, const ResearchOverrides& overrides) {
  for (const auto& [name, value] : {std::pair{"abs_pos_tol", config.abs_pos_tol},
                                    {"rel_tol", config.rel_tol},
                                    {"dt_min", config.dt_min},
                                    {"dt_max", config.dt_max},
                                    {"null_constraint_tol", config.null_constraint_tol}}) {
    if (!(value > 0.0) || !std::isfinite(value)) return ResearchFault{name, fmt::format("is {}, needs > 0", value)};
  }
  if (config.dt_max < config.dt_min) {
    return ResearchFault{"dt_max", fmt::format("is {}, needs at least dt_min = {}", config.dt_max, config.dt_min)};
  }
  for (const auto& [name, value, least] :
       {std::tuple{"max_steps_per_ray", config.max_steps_per_ray, std::int64_t{1}},
        {"max_constraint_projection_iters", config.max_constraint_projection_iters, std::int64_t{1}},
        {"fixed_seed", config.fixed_seed, std::int64_t{0}},
        {"truth_pass_pixels", config.truth_pass_pixels, std::int64_t{0}}}) {
    if (value < least) return ResearchFault{name, fmt::format("is {}, needs at least {}", value, least)};
  }
  if (config.research_enabled && overrides.enabled && overrides.max_work_per_frame_ms) {
    return ResearchFault{
        "max_work_per_frame_ms",
        "is a wall-clock budget, refused in Research Mode: only counts limit work (max_steps_per_ray)"};
  }
  return std::nullopt;
}

std::string method_of_integrator(std::string_view name) {
  if (name == "Heuristic" || name == kick_drift_id) return std::string(kick_drift_id);
  if (name == "RK45_Embedded") return "dopri54";
  if (name == "Symplectic") return "gl4";
  return std::string(method_card(name).id);
}

std::string canonical_text(const ResearchOverrides& overrides) {
  std::map<std::string, std::string> lines;
  if (overrides.enabled) {
    for_each_research_field([&](std::string_view name, auto, auto override_member) {
      const auto& value = overrides.*override_member;
      if (value) lines[std::string(name)] = text_of(*value);
    });
  }
  return joined(lines);
}

std::string canonical_text(const ResearchConfig& config) {
  std::map<std::string, std::string> lines;
  for_each_research_field(
      [&](std::string_view name, auto member, auto) { lines[std::string(name)] = text_of(config.*member); });
  return joined(lines);
}

std::string hash_of(const ResearchOverrides& overrides) { return hash_of_text(canonical_text(overrides)); }
std::string hash_of(const ResearchConfig& config) { return hash_of_text(canonical_text(config)); }

ClampedStepping clamped(const KickDriftSettings& stepping, const ResearchConfig& config) {
  ClampedStepping out{stepping, {}};
  if (!config.research_enabled) return out;
  KickDriftSettings& now = out.stepping;
  now.max_steps =
      static_cast<int>(std::max<std::int64_t>(1, std::min<std::int64_t>(stepping.max_steps, config.max_steps_per_ray)));
  now.min_step = std::max(stepping.min_step, config.dt_min);
  now.max_step = std::max(now.min_step, std::min(stepping.max_step, std::max(now.min_step, config.dt_max)));
  now.step_length = std::clamp(stepping.step_length, now.min_step, now.max_step);
  now.acceleration_cap.reset();
  out.clamps = {now.max_steps != stepping.max_steps, now.min_step != stepping.min_step,
                now.max_step != stepping.max_step, now.step_length != stepping.step_length};
  return out;
}

std::uint64_t frame_seed(const ResearchConfig& config, std::uint64_t film_seed, std::uint64_t frame) {
  const bool fixed = config.research_enabled && config.deterministic_mode;
  return (fixed ? static_cast<std::uint64_t>(config.fixed_seed) : film_seed) + frame;
}

std::string banner_line(const ResearchConfig& config, const ResearchOverrides& overrides) {
  return fmt::format(
      "Research Mode {}: tier {}, transport {}, integrator {}, abs_pos_tol {:g}, steps {:g} to {:g}, "
      "deterministic {}, overrides {}",
      config.research_enabled ? "on" : "off", text_of(config.research_tier), text_of(config.transport_model),
      config.integrator_kind, config.abs_pos_tol, config.dt_min, config.dt_max, config.deterministic_mode,
      hash_of(overrides));
}

std::optional<std::string> ResearchBanner::next(const ResearchConfig& config, const ResearchOverrides& overrides) {
  const std::string hash = hash_of(config);
  const bool say = (config.research_enabled && !was_enabled_) || hash != last_hash_;
  was_enabled_ = config.research_enabled;
  last_hash_ = hash;
  if (!say) return std::nullopt;
  return banner_line(config, overrides);
}

}  // namespace xpr
