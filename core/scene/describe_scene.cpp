#include "core/scene/describe_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numbers>

#include "core/io/hash.hpp"
#include "core/projection_names.hpp"

namespace xpr {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

template <class Enum, std::size_t N>
std::string name_in(const std::array<std::string_view, N>& names, Enum value) {
  return std::string(names[static_cast<std::size_t>(value)]);
}

template <class Numbers>
Json numbers_json(const Numbers& numbers) {
  Json out = Json::array();
  for (const double number : numbers) out.push_back(json_number(number));
  return out;
}
Json vector_json(const Vec3& v) { return numbers_json(std::array{v.x, v.y, v.z}); }
std::string vector_text(const Vec3& v) { return fmt::format("({:g}, {:g}, {:g})", v.x, v.y, v.z); }

Json camera_json(const SceneCamera& camera) {
  Json out{{"model", name_in(camera_model_names, camera.model)},
           {"position", vector_json(camera.position)},
           {"right", vector_json(camera.right)},
           {"up", vector_json(camera.up)},
           {"forward", vector_json(camera.forward)},
           {"time", json_number(camera.time)}};
  if (camera.model == CameraModel::impact_parameter) {
    out["half_width"] = json_number(camera.half_width);
  } else {
    out["fov"] = json_number(camera.fov);
  }
  return out;
}

Json observer_json(const SceneObserver& observer) {
  Json out{{"kind", name_in(observer_kind_names, observer.kind)}};
  if (observer.kind == ObserverKind::boosted) out["velocity"] = vector_json(observer.velocity);
  if (observer.kind == ObserverKind::circular_orbit) out["prograde"] = observer.prograde;
  return out;
}

Json preview_json(const SceneTransport& transport) {
  const KickDriftSettings& steps = transport.preview;
  return {{"max_steps", steps.max_steps},
          {"step_length", json_number(steps.step_length)},
          {"min_step", json_number(steps.min_step)},
          {"max_step", json_number(steps.max_step)},
          {"gain", json_number(steps.gain)},
          {"low_curvature", json_number(steps.low_curvature)},
          {"low_curvature_boost", json_number(steps.low_curvature_boost)},
          {"acceleration_cap", steps.acceleration_cap ? json_number(*steps.acceleration_cap) : Json(nullptr)},
          {"max_distance", json_number(steps.max_distance)},
          {"collision_every_n_steps", transport.collision_every_n_steps},
          {"segment_capacity", segment_capacity(steps.max_steps, transport.collision_every_n_steps)}};
}

Json transport_json(const SceneTransport& transport) {
  Json out{{"tier", transport.tier},
           {"method", transport.method},
           {"tol", json_number(transport.tol)},
           {"step", json_number(transport.step)},
           {"max_steps", transport.max_steps},
           {"project", std::string(name_of(*transport.project))}};
  out["r_min"] = transport.r_min ? json_number(*transport.r_min) : Json(nullptr);
  out["r_max"] = transport.r_max ? json_number(*transport.r_max) : Json(nullptr);
  out["chart"] = transport.chart;
  if (transport.tier == 0) out["kick_drift"] = preview_json(transport);
  return out;
}

Json field_json(const FieldSource& field) {
  Json out{{"name", field.name},
           {"curve", name_in(field_curve_names, field.curve)},
           {"shape", name_in(field_shape_names, field.shape)},
           {"amplitude", json_number(field.amplitude)},
           {"r_inner", json_number(field.r_inner)},
           {"r_outer", json_number(field.r_outer)},
           {"a", json_number(field.a)},
           {"b", json_number(field.b)},
           {"c", json_number(field.c)},
           {"edge_softness", json_number(field.edge_softness)},
           {"invert_sign", field.invert_sign},
           {"absorb", field.absorb},
           {"origin", numbers_json(field.world_from_local.origin)}};
  for (const auto& axis : field.world_from_local.axes) out["axes"].push_back(numbers_json(axis));
  out["beta_scale"] = field.beta_scale ? json_number(*field.beta_scale) : Json(nullptr);
  if (field.shape == FieldShape::box) out["half_size"] = numbers_json(field.half_size);
  if (field.curve == FieldCurve::custom) out["table"] = numbers_json(field.table);
  return out;
}

Json fields_json(const FieldSet& fields) {
  Json out{{"beta", json_number(fields.gains.beta)},
           {"bend_scale", json_number(fields.gains.bend_scale)},
           {"field_strength", json_number(fields.gains.field_strength)},
           {"sources", Json::array()}};
  for (const FieldSource& field : fields.sources) out["sources"].push_back(field_json(field));
  return out;
}

/// Over the places of the corners, triangle by triangle.
std::string mesh_hash(const TriangleMesh& mesh) {
  CanonicalHash hash;
  DatasetHash& corners = hash.dataset("corners");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const Vec3& corner : mesh.corners(t)) {
      for (std::size_t k = 0; k < 3; ++k) corners.add(corner[k]);
    }
  }
  return hash.hex();
}

Json things_json(const SceneSnapshot& scene) {
  Json meshes = Json::array(), materials = Json::array(), instances = Json::array();
  for (std::size_t k = 0; k < scene.meshes.size(); ++k) {
    const TriangleMesh& mesh = *scene.meshes.mesh[k];
    meshes.push_back({{"name", scene.meshes.name[k]},
                      {"source", scene.meshes.source[k]},
                      {"vertices", mesh.vertices.size()},
                      {"triangles", mesh.triangles.size()},
                      {"hash", mesh_hash(mesh)}});
  }
  const SceneMaterials& m = scene.materials;
  for (std::size_t k = 0; k < m.size(); ++k) {
    materials.push_back({{"name", m.name[k]},
                         {"kind", name_in(material_kind_names, m.kind[k])},
                         {"colour_a", numbers_json(m.colour_a[k])}});
    if (m.kind[k] != MaterialKind::checker) continue;
    materials.back()["colour_b"] = numbers_json(m.colour_b[k]);
    materials.back()["squares"] = m.squares[k];
  }
  const SceneInstances& i = scene.instances;
  for (std::size_t k = 0; k < i.size(); ++k) {
    const Affine3& to_world = i.to_world[k];
    instances.push_back({{"path", i.path[k]},
                         {"mesh", scene.meshes.name[i.mesh[k]]},
                         {"material", i.material[k] ? Json(m.name[*i.material[k]]) : Json(nullptr)},
                         {"x_axis", vector_json(to_world.x_axis)},
                         {"y_axis", vector_json(to_world.y_axis)},
                         {"z_axis", vector_json(to_world.z_axis)},
                         {"shift", vector_json(to_world.shift)},
                         {"solid", i.solid[k] != 0}});
  }
  return {{"meshes", meshes}, {"materials", materials}, {"instances", instances}};
}

Json spacetime_json(const SceneSpacetime& spacetime) {
  Json set = Json::object();
  for (const auto& [name, value] : spacetime.parameters) set[name] = json_number(value);
  return {{"metric", spacetime.metric}, {"set", set}};
}

Json sky_json(const SceneSky& sky) {
  Json out{{"kind", name_in(sky_kind_names, sky.kind)}};
  if (sky.kind == SkyKind::image) out["file"] = sky.file;
  if (sky.kind == SkyKind::checker || sky.kind == SkyKind::graticule) {
    out["colour_a"] = numbers_json(sky.colour_a);
    out["colour_b"] = numbers_json(sky.colour_b);
    out["squares"] = sky.squares;
  }
  if (sky.kind == SkyKind::graticule) out["line_width"] = json_number(sky.line_width);
  return out;
}

Json film_json(const SceneFilm& film) {
  Json aovs = Json::array();
  for (const Aov aov : film.aovs) aovs.push_back(name_in(aov_names, aov));
  return {{"width", film.width},       {"height", film.height}, {"scale", json_number(film.scale)},
          {"columns", film.columns()}, {"rows", film.rows()},   {"samples", film.samples},
          {"tile", film.tile},         {"seed", film.seed},     {"aovs", aovs}};
}

Json field_value(bool value) { return value; }
Json field_value(double value) { return json_number(value); }
Json field_value(std::int64_t value) { return value; }
Json field_value(const std::string& value) { return value; }
Json field_value(ResearchTier tier) { return static_cast<int>(tier); }
Json field_value(TransportModel model) { return name_in(transport_model_names, model); }
Json field_value(ResearchSuite suite) { return name_in(research_suite_names, suite); }
Json field_value(const std::vector<PixelIndex>& pixels) {
  Json out = Json::array();
  for (const auto& [column, row] : pixels) out.push_back(Json::array({column, row}));
  return out;
}

Json research_json(const SceneResearch& research) {
  Json set = Json::object(), config = Json::object();
  for_each_research_field([&](std::string_view name, auto member, auto override_member) {
    const auto& value = research.overrides.*override_member;
    if (research.overrides.enabled && value) set[std::string(name)] = field_value(*value);
    config[std::string(name)] = field_value(research.config.*member);
  });
  const ResearchClamps& clamps = research.clamps;
  return {{"preset", research.preset},
          {"overrides", set},
          {"overrides_hash", hash_of(research.overrides)},
          {"config", config},
          {"config_hash", hash_of(research.config)},
          {"clamps",
           {{"max_steps", clamps.max_steps},
            {"min_step", clamps.min_step},
            {"max_step", clamps.max_step},
            {"step_length", clamps.step_length}}}};
}

std::string light_text(const SceneSnapshot& scene) {
  if (!scene.fields.sources.empty()) return fmt::format("bent by {} field(s)", scene.fields.sources.size());
  std::string out = scene.spacetime.metric;
  for (const auto& [name, value] : scene.spacetime.parameters) out += fmt::format(" {} = {:g}", name, value);
  return out;
}

std::string lens_text(const SceneCamera& camera) {
  if (camera.model == CameraModel::equirectangular) return "all of the sky";
  if (camera.model == CameraModel::impact_parameter) return fmt::format("half width {:g}", camera.half_width);
  return fmt::format("fov {:g} degrees", camera.fov / degree);
}

}  // namespace

Json scene_json(const SceneSnapshot& scene) {
  return {{"scene",
           {{"name", scene.header.name},
            {"about", scene.header.about},
            {"chart", scene.header.chart},
            {"units", scene.header.units}}},
          {"camera", camera_json(scene.camera)},
          {"observer", observer_json(scene.observer)},
          {"transport", transport_json(scene.transport)},
          {"spacetime", spacetime_json(scene.spacetime)},
          {"fields", fields_json(scene.fields)},
          {"things", things_json(scene)},
          {"sky", sky_json(scene.sky)},
          {"film", film_json(scene.film)},
          {"research", research_json(scene.research)},
          {"warnings", scene.warnings}};
}

std::string scene_text(const SceneSnapshot& scene) {
  const SceneCamera& camera = scene.camera;
  const SceneTransport& transport = scene.transport;
  const SceneFilm& film = scene.film;
  std::string out =
      fmt::format("scene      {}{}\n", scene.header.name, scene.header.about.empty() ? "" : ": " + scene.header.about);
  out += fmt::format("light      {}, chart {}, lengths in {}\n", light_text(scene), scene.header.chart,
                     scene.header.units);
  out += fmt::format("camera     {} at {} towards {}, {}, observer {}\n", name_in(camera_model_names, camera.model),
                     vector_text(camera.position), vector_text(camera.forward), lens_text(camera),
                     name_in(observer_kind_names, scene.observer.kind));
  out += fmt::format("transport  tier {}, {}, tol {:g}, project {}, at most {} steps\n", transport.tier,
                     transport.method, transport.tol, name_of(*transport.project),
                     transport.tier == 0 ? transport.preview.max_steps : transport.max_steps);
  std::size_t triangles = 0;
  for (const std::uint32_t mesh : scene.instances.mesh) triangles += scene.meshes.mesh[mesh]->triangles.size();
  out += fmt::format("things     {} instance(s) of {} mesh(es), {} triangles\n", scene.instances.size(),
                     scene.meshes.size(), triangles);
  out += fmt::format("sky        {}\n", name_in(sky_kind_names, scene.sky.kind));
  out += fmt::format("film       {} x {} pixels, {} ray(s) a pixel, seed {}\n", film.columns(), film.rows(),
                     film.samples, film.seed);
  out += fmt::format("research   preset {}, overrides {}\n", scene.research.preset, hash_of(scene.research.overrides));
  for (const std::string& warning : scene.warnings) out += "warning    " + warning + "\n";
  return out;
}

}  // namespace xpr
