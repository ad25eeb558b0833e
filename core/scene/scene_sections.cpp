#include "core/scene/scene_sections.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/io/errors.hpp"
#include "core/projection_names.hpp"
#include "core/scene/assign.hpp"

namespace xpr::scene_sections {
namespace {

/// At most one of the keys is given.
void only_one(const TomlSection& section, std::string_view first, std::string_view second) {
  if (section.has(first) && section.has(second)) {
    section.place().fail(second, fmt::format("and {} say the same thing twice; keep one", first));
  }
}

}  // namespace

const Keys header_keys{"name", "about", "chart", "units"};

SceneHeader header_from(const TomlSection& section) {
  SceneHeader header;
  assign(header.name, section.text("name"));
  assign(header.about, section.text("about"));
  assign(header.chart, section.text("chart"));
  assign(header.units, section.text("units"));
  return header;
}

const Keys camera_keys{"model", "position", "look_at", "forward", "up", "fov", "half_width", "time"};

SceneCamera camera_from(const TomlSection& section) {
  SceneCamera camera;
  assign(camera.model, section.choice<CameraModel>("model", camera_model_names));
  assign(camera.position, section.numbers_of<3>("position"));
  only_one(section, "forward", "look_at");
  assign(camera.forward, section.numbers_of<3>("forward"));
  if (const auto target = section.numbers_of<3>("look_at")) camera.forward = vec3(*target) - camera.position;
  assign(camera.up, section.numbers_of<3>("up"));
  if (camera.model == CameraModel::fisheye || camera.model == CameraModel::equirectangular) {
    camera.fov = 3.141592653589793;
  }
  if (section.has("fov") && camera.model == CameraModel::equirectangular) {
    section.place().fail("fov", "is not for an equirectangular camera: it sees all of the sky");
  }
  if (section.has("fov") && camera.model == CameraModel::impact_parameter) {
    section.place().fail("fov", "is not for an impact-parameter camera: its screen has a half_width, a length");
  }
  assign(camera.fov, section.angle("fov"));
  if (section.has("half_width") && camera.model != CameraModel::impact_parameter) {
    section.place().fail("half_width", "is for model = \"impact-parameter\" alone");
  }
  assign(camera.half_width, section.number("half_width"));
  assign(camera.time, section.number("time"));
  return camera;
}

const Keys observer_keys{"kind", "velocity", "prograde"};

SceneObserver observer_from(const TomlSection& section) {
  SceneObserver observer;
  assign(observer.kind, section.choice<ObserverKind>("kind", observer_kind_names));
  assign(observer.velocity, section.numbers_of<3>("velocity"));
  assign(observer.prograde, section.flag("prograde"));
  return observer;
}

const Keys transport_keys{"tier",  "method", "tol",     "step",  "max_steps",
                          "r_min", "r_max",  "project", "chart", "kick_drift"};
const Keys kick_drift_keys{
    "max_steps",     "step_length",         "min_step",         "max_step",     "gain",
    "low_curvature", "low_curvature_boost", "acceleration_cap", "max_distance", "collision_every_n_steps"};

/// [transport.kick_drift]
void read_kick_drift(const TomlSection& section, SceneTransport& transport) {
  KickDriftSettings& steps = transport.preview;
  if (const auto most = section.integer("max_steps")) {
    const bool good = *most >= 1 && *most <= std::numeric_limits<int>::max();
    if (!good)
      section.place().fail("max_steps", fmt::format("is {}, needs 1 to {}", *most, std::numeric_limits<int>::max()));
    steps.max_steps = static_cast<int>(*most);
  }
  for (const auto& [key, to] : {std::pair{"step_length", &steps.step_length},
                                {"min_step", &steps.min_step},
                                {"max_step", &steps.max_step},
                                {"max_distance", &steps.max_distance},
                                {"low_curvature_boost", &steps.low_curvature_boost}}) {
    assign(*to, section.number(key));
    if (!(*to > 0.0)) section.place().fail(key, fmt::format("is {}, needs > 0", *to));
  }
  if (steps.max_step < steps.min_step) {
    section.place().fail("max_step",
                         fmt::format("is {}, needs at least min_step = {}", steps.max_step, steps.min_step));
  }
  assign(steps.gain, section.number("gain"));
  assign(steps.low_curvature, section.number("low_curvature"));
  if (const auto cap = section.number("acceleration_cap")) steps.acceleration_cap = cap;
  assign(transport.collision_every_n_steps, section.integer("collision_every_n_steps"));
  if (transport.collision_every_n_steps < 1) section.place().fail("collision_every_n_steps", "needs 1 or more");
}

SceneTransport transport_from(const TomlSection& section) {
  SceneTransport transport;
  if (const auto tier = section.integer("tier")) {
    transport.tier = *tier >= 0 && *tier <= 2 ? static_cast<int>(*tier) : -1;
    if (transport.tier < 0) section.place().fail("tier", fmt::format("is {}, needs 0, 1 or 2", *tier));
  }
  assign(transport.method, section.text("method"));
  if (const auto tol = section.number("tol")) {
    if (!(*tol > 0.0)) section.place().fail("tol", fmt::format("is {}, needs > 0", *tol));
    transport.tol = *tol;
  }
  assign(transport.step, section.number("step"));
  assign(transport.max_steps, section.integer("max_steps"));
  assign(transport.r_min, section.number("r_min"));
  assign(transport.r_max, section.number("r_max"));
  if (const auto project = section.choice<Projection>("project", projection_names)) transport.project = project;
  assign(transport.chart, section.text("chart"));
  if (const TomlTable* table = section.table("kick_drift")) {
    read_kick_drift(TomlSection(section.place().source, "[transport.kick_drift]",
                                section.place().key_line.at("kick_drift"), *table, kick_drift_keys),
                    transport);
  }
  return transport;
}

const Keys spacetime_keys{"metric", "set"};

SceneSpacetime spacetime_from(const TomlSection& section) {
  SceneSpacetime spacetime;
  section.require("metric");
  assign(spacetime.metric, section.text("metric"));
  if (const TomlTable* set = section.table("set")) {
    Keys names;
    for (const TomlEntry& entry : *set) names.push_back(entry.key);
    const TomlSection parameters(section.place().source, section.place().section + " set",
                                 section.place().key_line.at("set"), *set, names);
    for (const TomlEntry& entry : *set) spacetime.parameters.emplace_back(entry.key, *parameters.number(entry.key));
  }
  return spacetime;
}

const Keys gains_keys{"beta", "bend_scale", "field_strength"};

FieldGains gains_from(const TomlSection& section) {
  FieldGains gains;
  assign(gains.beta, section.number("beta"));
  assign(gains.bend_scale, section.number("bend_scale"));
  assign(gains.field_strength, section.number("field_strength"));
  return gains;
}

const Keys field_keys{"name",   "curve",     "shape",     "amplitude", "r_inner",       "r_outer",    "a",
                      "b",      "c",         "half_size", "table",     "edge_softness", "beta_scale", "invert_sign",
                      "absorb", "translate", "rotate",    "scale",     "matrix"};

FieldSource field_from(const TomlSection& section) {
  FieldSource field;
  section.require("name");
  section.require("r_outer");
  assign(field.name, section.text("name"));
  assign(field.curve, section.choice<FieldCurve>("curve", field_curve_names));
  assign(field.shape, section.choice<FieldShape>("shape", field_shape_names));
  assign(field.amplitude, section.number("amplitude"));
  assign(field.r_inner, section.number("r_inner"));
  assign(field.r_outer, section.number("r_outer"));
  assign(field.a, section.number("a"));
  assign(field.b, section.number("b"));
  assign(field.c, section.number("c"));
  assign(field.half_size, section.numbers_of<3>("half_size"));
  assign(field.table, section.numbers("table"));
  assign(field.edge_softness, section.number("edge_softness"));
  if (const auto beta = section.number("beta_scale")) field.beta_scale = beta;
  assign(field.invert_sign, section.flag("invert_sign"));
  assign(field.absorb, section.flag("absorb"));
  const Affine3 transform = transform_from(section);
  const auto numbers = [](const Vec3& v) { return std::array{v.x, v.y, v.z}; };
  field.world_from_local = {numbers(transform.shift),
                            {numbers(transform.x_axis), numbers(transform.y_axis), numbers(transform.z_axis)}};
  return field;
}

const Keys film_keys{"width", "height", "scale", "samples", "tile", "seed", "aovs"};

SceneFilm film_from(const TomlSection& section) {
  SceneFilm film;
  assign(film.width, section.integer("width"));
  assign(film.height, section.integer("height"));
  assign(film.scale, section.number("scale"));
  assign(film.samples, section.integer("samples"));
  assign(film.tile, section.integer("tile"));
  assign(film.seed, section.integer("seed"));
  if (const auto names = section.texts("aovs")) {
    const Keys known(aov_names.begin(), aov_names.end());
    for (const std::string& name : *names) {
      const auto found = std::find(known.begin(), known.end(), name);
      if (found == known.end()) section.place().fail("aovs", "holds an " + unknown_name("name", name, known));
      film.aovs.push_back(static_cast<Aov>(found - known.begin()));
    }
  }
  return film;
}

}  // namespace xpr::scene_sections
