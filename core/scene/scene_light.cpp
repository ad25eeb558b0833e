// The parts of a scene that say how light goes: spacetime, fields, transport and what Research Mode makes of it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/io/errors.hpp"
#include "core/scene/scene_host.hpp"
#include "integrators/stepper.hpp"
#include "metrics/catalogue.hpp"
#include "metrics/fields/field_model.hpp"

namespace xpr {
namespace {

/// What a tier takes where the scene says nothing.
struct TierDefaults {
  std::string_view method;
  double tol;
  Projection project;
};
constexpr std::array<TierDefaults, 3> tier_defaults{{{kick_drift_id, 1e-3, Projection::none},
                                                     {"dopri54", 1e-8, Projection::none},
                                                     {"dop853", 1e-12, Projection::full}}};

const SourcePlace flag_place{"command line", "flags", 0, {}};

/// What `make` returns; what it refuses is refused at the place.
template <class Make>
auto checked(const SourcePlace& place, std::string_view key, const Make& make) {
  try {
    return make();
  } catch (const std::invalid_argument& error) {
    if (key.empty()) place.fail(error.what());
    place.fail(key, fmt::format("does not do: {}", error.what()));
  }
}

double distance(const FieldFrame& a, const FieldFrame& b) {
  return length(Vec3{a.origin[0] - b.origin[0], a.origin[1] - b.origin[1], a.origin[2] - b.origin[2]});
}

/// Radius of a ball about the origin that holds what `radius` bounds in the source's own frame.
double world_radius(const FieldSource& source, double radius) {
  double most = 0.0;
  for (const auto& axis : source.world_from_local.axes) most = std::max(most, length(Vec3{axis[0], axis[1], axis[2]}));
  return radius * most;
}

bool bends_by_fields(const SceneSnapshot& scene) { return !scene.fields.sources.empty(); }

/// The base that overrides of a scene stand on: the defaults, with what the scene itself says of its transport.
ResearchConfig base_of(const SceneSnapshot& scene) {
  const SceneTransport& transport = scene.transport;
  ResearchConfig base;
  base.research_tier = static_cast<ResearchTier>(transport.tier);
  base.integrator_kind = transport.method;
  base.transport_model = bends_by_fields(scene) || scene.spacetime.metric == SceneSpacetime{}.metric
                             ? TransportModel::grin_optical
                             : TransportModel::metric_null_geodesic;
  base.abs_pos_tol = base.rel_tol = transport.tol;
  base.max_steps_per_ray = transport.tier == 0 ? transport.preview.max_steps : transport.max_steps;
  base.enable_constraint_projection = transport.project == Projection::full;
  return base;
}

void apply(const ResearchConfig& config, SceneSnapshot& scene) {
  SceneTransport& transport = scene.transport;
  transport.tier = static_cast<int>(config.research_tier);
  transport.method = config.integrator_kind;
  transport.tol = std::min(config.abs_pos_tol, config.rel_tol);
  transport.step = std::clamp(transport.step, config.dt_min, config.dt_max);
  transport.max_steps = std::min(transport.max_steps, config.max_steps_per_ray);
  if (config.enable_constraint_projection) {
    transport.project = Projection::full;
  } else if (transport.project == Projection::full) {
    transport.project = Projection::none;
  }
  const ClampedStepping preview = clamped(transport.preview, config);
  transport.preview = preview.stepping;
  scene.research.clamps = preview.clamps;
}

void check_tier(int tier, std::string_view method, const SourcePlace& place, std::string_view key) {
  if ((tier == 0) != (method == kick_drift_id)) {
    place.fail(key, fmt::format("is {}, which tier {} does not take: tier 0 is {}, tiers 1 and 2 are the other methods",
                                method, tier, kick_drift_id));
  }
}

}  // namespace

void SceneBuilder::check_spacetime() const {
  const SceneSpacetime& spacetime = spacetime_.what;
  if (!fields_.empty() && spacetime.metric != SceneSpacetime{}.metric) {
    spacetime_.place.fail("metric", fmt::format("is {} and there are {} [[field]]s: light is bent by a spacetime or by "
                                                "fields, not by both; take one away",
                                                spacetime.metric, fields_.size()));
  }
  std::vector<NamedValue> values;
  for (const auto& [name, value] : spacetime.parameters) values.push_back({name, value});
  const bool known = std::any_of(catalogue().begin(), catalogue().end(),
                                 [&](const CatalogueEntry& entry) { return entry.card->metric == spacetime.metric; });
  checked(spacetime_.place, known ? "set" : "metric", [&] { return make_spacetime(spacetime.metric, "", values); });
}

FieldSet SceneBuilder::finished_fields() const {
  std::vector<const Said<FieldSource>*> sorted;
  for (const auto& field : fields_) sorted.push_back(&field);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto* a, const auto* b) { return a->what.name < b->what.name; });
  FieldSet set{{}, gains_.what};
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    const FieldSource& field = sorted[k]->what;
    if (k > 0 && sorted[k - 1]->what.name == field.name) sorted[k]->place.fail("name", "is taken by another field");
    for (const FieldSource& other : set.sources) {
      if (!field.absorb || !other.absorb) continue;
      const double reach = world_radius(field, field.r_inner) + world_radius(other, other.r_inner);
      if (distance(field.world_from_local, other.world_from_local) < reach) {
        sorted[k]->place.fail("absorb",
                              fmt::format("overlaps the absorber of field '{}': which of both takes the light "
                                          "is not said; move them apart or make r_inner smaller",
                                          other.name));
      }
    }
    checked(sorted[k]->place, "", [&] { return PlacedField(field, set.gains); });
    set.sources.push_back(field);
  }
  return set;
}

SceneTransport SceneBuilder::finished_transport() const {
  SceneTransport transport = transport_.what;
  const SourcePlace& place = transport_.place;
  if (flags_.tier) {
    transport.tier = *flags_.tier;
    transport.method.clear();
    transport.tol = 0.0;
    transport.project.reset();
  }
  if (flags_.method) transport.method = *flags_.method;
  if (flags_.tol) transport.tol = *flags_.tol;
  if (transport.tier < 0 || transport.tier > 2) {
    (flags_.tier ? flag_place : place).fail("tier", fmt::format("is {}, needs 0, 1 or 2", transport.tier));
  }
  const TierDefaults& defaults = tier_defaults[static_cast<std::size_t>(transport.tier)];
  if (transport.method.empty()) transport.method = defaults.method;
  const SourcePlace& method_place = flags_.method ? flag_place : place;
  transport.method = checked(method_place, "method", [&] { return method_of_integrator(transport.method); });
  check_tier(transport.tier, transport.method, method_place, "method");
  if (transport.tol == 0.0) transport.tol = defaults.tol;
  if (!transport.project) transport.project = defaults.project;
  for (const auto& [key, value] : {std::pair{"tol", transport.tol},
                                   {"step", transport.step},
                                   {"r_max", transport.r_max.value_or(1.0)},
                                   {"r_min", transport.r_min.value_or(1.0)}}) {
    if (!(value > 0.0) || !std::isfinite(value)) place.fail(key, fmt::format("is {}, needs > 0", value));
  }
  if (transport.max_steps < 1) place.fail("max_steps", fmt::format("is {}, needs 1 or more", transport.max_steps));
  if (!transport.chart.empty()) {
    checked(place, "chart", [&] { return make_spacetime(spacetime_.what.metric, transport.chart); });
  }
  return transport;
}

void SceneBuilder::finish_research(SceneSnapshot& scene) const {
  SceneResearch research = research_.what;
  const SourcePlace& place = flags_.preset ? flag_place : research_.place;
  if (flags_.preset) {
    research.preset = *flags_.preset;
    research.overrides.enabled = research.preset != "off";
  }
  research.overrides =
      checked(place, "preset", [&] { return combined(preset_overrides(research.preset), research.overrides); });
  ResearchOverrides& overrides = research.overrides;
  if (flags_.tier) overrides.research_tier = static_cast<ResearchTier>(scene.transport.tier);
  if (flags_.method) overrides.integrator_kind = scene.transport.method;
  if (flags_.tol) overrides.abs_pos_tol = overrides.rel_tol = scene.transport.tol;
  if (overrides.integrator_kind) {
    overrides.integrator_kind =
        checked(research_.place, "integrator_kind", [&] { return method_of_integrator(*overrides.integrator_kind); });
  } else if (overrides.research_tier) {
    overrides.integrator_kind = std::string(tier_defaults[static_cast<std::size_t>(*overrides.research_tier)].method);
  }
  const ResearchConfig base = base_of(scene);
  research.config = effective_config(base, overrides);
  if (const auto fault = fault_of(research.config, overrides)) research_.place.fail(fault->field, fault->what);
  scene.research = research;
  if (!research.config.research_enabled) return;
  const ResearchConfig& config = scene.research.config;
  const bool hybrid_as_grin =
      config.transport_model == TransportModel::hybrid_research && base.transport_model == TransportModel::grin_optical;
  const bool flat = !bends_by_fields(scene) && scene.spacetime.metric == SceneSpacetime{}.metric;
  if (config.transport_model != base.transport_model && !hybrid_as_grin && !flat) {
    research_.place.fail("transport_model",
                         fmt::format("is {}, but the scene's light is {}",
                                     transport_model_names[static_cast<std::size_t>(config.transport_model)],
                                     transport_model_names[static_cast<std::size_t>(base.transport_model)]));
  }
  check_tier(static_cast<int>(config.research_tier), config.integrator_kind, research_.place, "integrator_kind");
  const PixelIndex last{scene.film.columns() - 1, scene.film.rows() - 1};
  for (const auto& [column, row] : config.ray_dumps) {
    if (column < 0 || row < 0 || column > last[0] || row > last[1]) {
      research_.place.fail("ray_dumps",
                           fmt::format("has pixel [{}, {}], needs [0, 0] to [{}, {}]", column, row, last[0], last[1]));
    }
  }
  apply(config, scene);
}

}  // namespace xpr
