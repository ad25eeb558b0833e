#include "core/scene/research.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "core/io/hash.hpp"
#include "tests/core/temporary_directory.hpp"

namespace xpr {
namespace {

using testing::message_of;

/// A set with every field set to something that is not its default.
ResearchOverrides everything() {
  ResearchOverrides out;
  out.enabled = true;
  out.research_enabled = true;
  out.research_tier = ResearchTier::invariant_preserving;
  out.transport_model = TransportModel::metric_null_geodesic;
  out.integrator_kind = "gl6";
  out.abs_pos_tol = 1e-9;
  out.rel_tol = 1e-8;
  out.dt_min = 1e-5;
  out.dt_max = 0.2;
  out.max_steps_per_ray = 4096;
  out.track_null_constraint = true;
  out.null_constraint_tol = 1e-7;
  out.enable_constraint_projection = true;
  out.max_constraint_projection_iters = 5;
  out.deterministic_mode = true;
  out.fixed_seed = 9;
  out.max_work_per_frame_ms = 33.0;
  out.validation_enabled = true;
  out.validation_suite = ResearchSuite::metric_benchmarks;
  out.validation_report_path = "report.md";
  out.truth_pass_pixels = 12;
  out.ray_dumps = std::vector<PixelIndex>{{1, 2}};
  return out;
}

TEST(Research, defaults_are_those_of_the_earlier_engine) {
  const ResearchConfig config;
  EXPECT_FALSE(config.research_enabled);
  EXPECT_EQ(config.research_tier, ResearchTier::preview);
  EXPECT_EQ(config.transport_model, TransportModel::grin_optical);
  EXPECT_EQ(config.integrator_kind, "tier0_kick_drift");
  EXPECT_EQ(config.abs_pos_tol, 1e-3);
  EXPECT_EQ(config.rel_tol, 1e-4);
  EXPECT_EQ(config.dt_min, 1e-4);
  EXPECT_EQ(config.dt_max, 0.1);
  EXPECT_EQ(config.max_steps_per_ray, 2048);
  EXPECT_FALSE(config.track_null_constraint);
  EXPECT_EQ(config.null_constraint_tol, 1e-3);
  EXPECT_FALSE(config.enable_constraint_projection);
  EXPECT_EQ(config.max_constraint_projection_iters, 2);
  EXPECT_FALSE(config.deterministic_mode);
  EXPECT_EQ(config.fixed_seed, 1);
  EXPECT_EQ(config.max_work_per_frame_ms, 16.0);
  EXPECT_FALSE(config.validation_enabled);
  EXPECT_EQ(config.validation_suite, ResearchSuite::quick_sanity);
  EXPECT_EQ(config.validation_report_path, "");
  EXPECT_FALSE(fault_of(config, {}));
}

TEST(Research, without_the_master_switch_overrides_change_nothing) {
  ResearchOverrides overrides = everything();
  overrides.enabled = false;
  EXPECT_EQ(canonical_text(effective_config(ResearchConfig{}, overrides)), canonical_text(ResearchConfig{}));
  EXPECT_EQ(hash_of(overrides), hash_of(ResearchOverrides{}));
}

TEST(Research, every_field_that_is_set_is_copied_and_no_other) {
  const ResearchOverrides all = everything();
  const ResearchConfig base;
  int fields = 0;
  for_each_research_field([&](std::string_view name, auto member, auto override_member) {
    ++fields;
    ResearchOverrides one;
    one.enabled = true;
    one.*override_member = all.*override_member;
    const ResearchConfig config = effective_config(base, one);
    EXPECT_NE(base.*member, *(all.*override_member)) << name;
    for_each_research_field([&](std::string_view other, auto other_member, auto) {
      if (other == name) return;
      EXPECT_EQ(config.*other_member, base.*other_member) << name << " changed " << other;
    });
    EXPECT_EQ(config.*member, *(all.*override_member)) << name;
  });
  EXPECT_EQ(fields, 19 + 2);  // the earlier engine's, and the truth pass and ray dumps
}

TEST(Research, set_to_the_default_differs_from_unset) {
  ResearchOverrides set;
  set.enabled = true;
  ResearchOverrides unset = set;
  set.fixed_seed = ResearchConfig{}.fixed_seed;
  EXPECT_EQ(hash_of(effective_config({}, set)), hash_of(effective_config({}, unset)));
  EXPECT_NE(hash_of(set), hash_of(unset));
  // On a base with another seed the one that is set wins, the one that is not does not.
  ResearchConfig base;
  base.fixed_seed = 5;
  EXPECT_EQ(effective_config(base, set).fixed_seed, 1);
  EXPECT_EQ(effective_config(base, unset).fixed_seed, 5);
}

TEST(Research, the_hash_is_taken_over_a_text_that_one_can_read) {
  ResearchOverrides overrides;
  overrides.enabled = true;
  overrides.research_tier = ResearchTier::error_bounded;
  overrides.dt_max = 0.1;
  overrides.integrator_kind = "dopri54";
  overrides.ray_dumps = std::vector<PixelIndex>{{3, 4}, {5, 6}};
  const std::string text =
      "dt_max = 0.1\nintegrator_kind = \"dopri54\"\nray_dumps = [[3, 4], [5, 6]]\nresearch_tier = 1\n";
  EXPECT_EQ(canonical_text(overrides), text);
  CanonicalHash hash;
  hash.dataset("research").add(std::string_view(text));
  EXPECT_EQ(hash_of(overrides), hash.hex());
  overrides.dt_max = 0.10000000000000002;  // the next double
  EXPECT_NE(hash_of(overrides), hash.hex());
}

TEST(Research, presets_are_named_override_sets) {
  EXPECT_EQ(research_presets(), (std::vector<std::string_view>{"off", "validate", "paper-match", "stress-test"}));
  EXPECT_FALSE(preset_overrides("off").enabled);
  std::vector<std::string> hashes;
  for (const std::string_view name : research_presets()) {
    const ResearchOverrides preset = preset_overrides(name);
    const ResearchConfig config = effective_config({}, preset);
    EXPECT_EQ(config.research_enabled, name != "off") << name;
    EXPECT_EQ(config.deterministic_mode, name != "off") << name;
    EXPECT_FALSE(fault_of(config, preset)) << name;
    EXPECT_EQ(method_of_integrator(config.integrator_kind), config.integrator_kind) << name;
    hashes.push_back(hash_of(preset));
  }
  std::sort(hashes.begin(), hashes.end());
  EXPECT_EQ(std::unique(hashes.begin(), hashes.end()), hashes.end());
  EXPECT_EQ(message_of<std::invalid_argument>([] { (void)preset_overrides("validat"); }),
            "unknown preset 'validat'; did you mean 'validate'?");
}

TEST(Research, what_a_scene_sets_goes_over_the_preset) {
  ResearchOverrides own;
  own.enabled = true;
  own.fixed_seed = 77;
  const ResearchOverrides both = combined(preset_overrides("validate"), own);
  EXPECT_EQ(both.fixed_seed, 77);
  EXPECT_EQ(both.integrator_kind, "dopri54");
  own.enabled = false;  // the master switch is the later one's
  EXPECT_EQ(hash_of(combined(preset_overrides("validate"), own)), hash_of(ResearchOverrides{}));
}

TEST(Research, names_of_integrators_map_to_method_ids) {
  EXPECT_EQ(method_of_integrator("Heuristic"), "tier0_kick_drift");
  EXPECT_EQ(method_of_integrator("RK45_Embedded"), "dopri54");
  EXPECT_EQ(method_of_integrator("Symplectic"), "gl4");
  EXPECT_EQ(method_of_integrator("odeint:dopri5"), "odeint:dopri5");
  EXPECT_NE(message_of<std::invalid_argument>([] { (void)method_of_integrator("dop835"); }).find("dop853"),
            std::string::npos);
}

// The words of the clamps: StepsPerRay := max(1, min(StepsPerRay, MaxStepsPerRay)), MinStep := max(MinStep, DtMin),
// MaxStep := min(MaxStep, max(MinStep, DtMax)), ordered, StepLength clamped into the range.
TEST(Research, steps_are_clamped_and_every_clamp_is_counted) {
  ResearchConfig config;
  config.research_enabled = true;
  const auto steps = [](int most, double length, double min_step, double max_step) {
    KickDriftSettings out;
    out.max_steps = most;
    out.step_length = length;
    out.min_step = min_step;
    out.max_step = max_step;
    return out;
  };
  const KickDriftSettings wide = steps(4096, 0.25, 5e-5, 0.5);
  const ClampedStepping narrow = clamped(wide, config);
  EXPECT_EQ(narrow.stepping.max_steps, 2048);
  EXPECT_EQ(narrow.stepping.min_step, 1e-4);
  EXPECT_EQ(narrow.stepping.max_step, 0.1);
  EXPECT_EQ(narrow.stepping.step_length, 0.1);
  EXPECT_EQ(narrow.clamps.total(), 4);
  EXPECT_FALSE(narrow.stepping.acceleration_cap);
  EXPECT_EQ(wide.max_steps, 4096);  // nothing to restore after the frame

  // A largest step below dt_min gives way: both ends meet there.
  const ClampedStepping tiny = clamped(steps(64, 1e-6, 1e-7, 1e-5), config);
  EXPECT_EQ(tiny.stepping.min_step, 1e-4);
  EXPECT_EQ(tiny.stepping.max_step, 1e-4);
  EXPECT_EQ(tiny.stepping.step_length, 1e-4);
  EXPECT_EQ(tiny.clamps.max_steps, 0);

  // A smallest step above dt_max stays: max_step goes down to it, no further.
  const ClampedStepping coarse = clamped(steps(64, 0.4, 0.3, 0.5), config);
  EXPECT_EQ(coarse.stepping.min_step, 0.3);
  EXPECT_EQ(coarse.stepping.max_step, 0.3);
  EXPECT_EQ(coarse.clamps.total(), 2);

  config.research_enabled = false;  // inert
  EXPECT_EQ(clamped(wide, config).clamps.total(), 0);
  EXPECT_EQ(clamped(wide, config).stepping.max_step, 0.5);
  EXPECT_TRUE(clamped(wide, config).stepping.acceleration_cap);
}

TEST(Research, segment_capacity_follows_from_the_clamped_steps) {
  ResearchConfig config;
  config.research_enabled = true;
  config.max_steps_per_ray = 100;
  KickDriftSettings stepping;
  stepping.max_steps = 350;
  EXPECT_EQ(segment_capacity(stepping.max_steps, 3), 117);  // 350 / 3, rounded up
  EXPECT_EQ(segment_capacity(clamped(stepping, config).stepping.max_steps, 3), 34);
}

TEST(Research, seeds_are_the_fixed_one_plus_the_frame_in_deterministic_mode) {
  ResearchConfig config;
  config.fixed_seed = 40;
  EXPECT_EQ(frame_seed(config, 7, 2), 9U);
  config.deterministic_mode = true;
  EXPECT_EQ(frame_seed(config, 7, 2), 9U);  // inert: Research Mode is off
  config.research_enabled = true;
  EXPECT_EQ(frame_seed(config, 7, 2), 42U);
}

TEST(Research, a_wall_clock_budget_is_refused_while_it_is_on) {
  ResearchOverrides overrides = preset_overrides("validate");
  overrides.max_work_per_frame_ms = 16.0;  // asked for, if only by its default
  const auto fault = fault_of(effective_config({}, overrides), overrides);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->field, "max_work_per_frame_ms");
  overrides.research_enabled = false;
  EXPECT_FALSE(fault_of(effective_config({}, overrides), overrides));
}

TEST(Research, numbers_out_of_range_name_their_field) {
  const auto field_at_fault = [](auto set) {
    ResearchConfig config;
    set(config);
    const auto fault = fault_of(config, {});
    return fault ? fault->field : std::string("none");
  };
  EXPECT_EQ(field_at_fault([](ResearchConfig& c) { c.abs_pos_tol = 0.0; }), "abs_pos_tol");
  EXPECT_EQ(field_at_fault([](ResearchConfig& c) { c.rel_tol = -1.0; }), "rel_tol");
  EXPECT_EQ(field_at_fault([](ResearchConfig& c) { c.dt_min = 0.2; }), "dt_max");
  EXPECT_EQ(field_at_fault([](ResearchConfig& c) { c.max_steps_per_ray = 0; }), "max_steps_per_ray");
  EXPECT_EQ(field_at_fault([](ResearchConfig& c) { c.fixed_seed = -1; }), "fixed_seed");
  EXPECT_EQ(field_at_fault([](ResearchConfig&) {}), "none");
}

TEST(Research, the_banner_is_said_once_and_again_when_the_configuration_changes) {
  ResearchBanner banner;
  const ResearchConfig off;
  EXPECT_FALSE(banner.next(off, {}));
  const ResearchOverrides validate = preset_overrides("validate");
  ResearchConfig on = effective_config(off, validate);
  const auto first = banner.next(on, validate);
  ASSERT_TRUE(first);
  EXPECT_EQ(*first,
            "Research Mode on: tier 1, transport GRIN_Optical, integrator dopri54, abs_pos_tol 1e-10, steps 0.0001 to "
            "0.1, deterministic true, overrides " +
                hash_of(validate));
  EXPECT_FALSE(banner.next(on, validate));
  on.fixed_seed = 2;
  EXPECT_TRUE(banner.next(on, validate));
  EXPECT_FALSE(banner.next(on, validate));
  EXPECT_TRUE(banner.next(off, {}));  // gone off is a change too
}

}  // namespace
}  // namespace xpr
