// Sections of a scene file that say what there is to see: meshes, materials, instances, the sky.
#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "core/geometry/mesh_shapes.hpp"
#include "core/io/errors.hpp"
#include "core/io/mesh_file.hpp"
#include "core/scene/assign.hpp"
#include "core/scene/rotation.hpp"
#include "core/scene/scene_sections.hpp"
#include "core/scene/sky_image.hpp"

namespace xpr::scene_sections {
namespace {

Affine3 rotation_from(const TomlSection& section, const TomlTable& table) {
  const TomlSection rotate(section.place().source, section.place().section + " rotate",
                           section.place().key_line.at("rotate"), table, {"axis", "angle"});
  rotate.require("axis");
  rotate.require("angle");
  const Vec3 axis = vec3(*rotate.numbers_of<3>("axis"));
  if (!(length(axis) > 0.0)) rotate.place().fail("axis", "is zero, needs a direction");
  return rotation(normalized(axis), *rotate.angle("angle"));
}

/// What `read` makes of the file that a key names; what is wrong with the file is said with the place.
template <class Read>
auto file_of(const TomlSection& section, std::string_view key, const std::filesystem::path& directory,
             const Read& read) {
  const std::filesystem::path path = directory / *section.text(key);
  try {
    return read(path);
  } catch (const InputError& error) {
    section.place().fail(key, fmt::format("does not do: {}", error.what()));
  }
}

TriangleMesh shape_from(const TomlSection& section) {
  std::vector<NamedValue> values;
  Keys names;
  const TomlTable* set = section.table("set");
  const TomlTable empty;
  for (const TomlEntry& entry : set == nullptr ? empty : *set) names.push_back(entry.key);
  if (set != nullptr) {
    const TomlSection parameters(section.place().source, section.place().section + " set",
                                 section.place().key_line.at("set"), *set, names);
    for (const TomlEntry& entry : *set) values.push_back({entry.key, *parameters.number(entry.key)});
  }
  try {
    return generate_mesh(*section.text("shape"), values);
  } catch (const std::invalid_argument& error) {
    section.place().fail(set == nullptr ? "shape" : "set", fmt::format("does not do: {}", error.what()));
  }
}

}  // namespace

const Keys mesh_keys{"name", "file", "shape", "set"};

MeshDescription mesh_from(const TomlSection& section, const std::filesystem::path& directory,
                          std::vector<std::string>& warnings) {
  MeshDescription mesh;
  section.require("name");
  assign(mesh.name, section.text("name"));
  if (section.has("file") == section.has("shape")) {
    section.place().fail(section.has("file") ? "shape" : "file",
                         section.has("file") ? "and file exclude each other; keep one" : "or shape is needed");
  }
  if (section.has("shape")) {
    mesh.source = *section.text("shape");
    mesh.mesh = std::make_shared<const TriangleMesh>(shape_from(section));
    return mesh;
  }
  if (section.has("set")) section.place().fail("set", "is for a shape alone");
  mesh.source = *section.text("file");
  MeshFile read = file_of(section, "file", directory, [](const auto& path) { return read_mesh(path); });
  if (read.defects.any()) warnings.push_back(read.defects.text(mesh.source));
  mesh.mesh = std::make_shared<const TriangleMesh>(std::move(read.mesh));
  return mesh;
}

const Keys material_keys{"name", "kind", "colour_a", "colour_b", "squares"};

MaterialDescription material_from(const TomlSection& section) {
  MaterialDescription material;
  section.require("name");
  assign(material.name, section.text("name"));
  assign(material.kind, section.choice<MaterialKind>("kind", material_kind_names));
  assign(material.colour_a, section.numbers_of<3>("colour_a"));
  assign(material.colour_b, section.numbers_of<3>("colour_b"));
  if (const auto squares = section.numbers_of<2>("squares")) {
    for (std::size_t k = 0; k < 2; ++k) {
      // What is no whole number is out of the builder's range.
      const double n = (*squares)[k];
      material.squares[k] = n >= 1.0 && n <= 1e6 && n == std::floor(n) ? static_cast<std::int64_t>(n) : 0;
    }
  }
  return material;
}

const Keys instance_keys{"path", "parent", "mesh", "material", "solid", "translate", "rotate", "scale", "matrix"};

InstanceDescription instance_from(const TomlSection& section) {
  InstanceDescription instance;
  section.require("path");
  assign(instance.path, section.text("path"));
  assign(instance.parent, section.text("parent"));
  assign(instance.mesh, section.text("mesh"));
  assign(instance.material, section.text("material"));
  assign(instance.solid, section.flag("solid"));
  instance.transform = transform_from(section);
  return instance;
}

const Keys sky_keys{"kind", "colour_a", "colour_b", "squares", "line_width", "file"};

SceneSky sky_from(const TomlSection& section, const std::filesystem::path& directory) {
  SceneSky sky;
  section.require("kind");
  assign(sky.kind, section.choice<SkyKind>("kind", sky_kind_names));
  assign(sky.colour_a, section.numbers_of<3>("colour_a"));
  assign(sky.colour_b, section.numbers_of<3>("colour_b"));
  assign(sky.squares, section.integer("squares"));
  assign(sky.line_width, section.angle("line_width"));
  assign(sky.file, section.text("file"));
  if (sky.kind == SkyKind::image && section.has("file")) {
    sky.image = std::make_shared<const SkyImage>(
        file_of(section, "file", directory, [](const auto& path) { return read_sky_image(path); }));
  }
  return sky;
}

Affine3 transform_from(const TomlSection& section) {
  Affine3 out;
  if (const auto m = section.numbers_of<12>("matrix")) {
    for (const std::string_view key : {"translate", "rotate", "scale"}) {
      if (section.has(key)) section.place().fail(key, "and matrix exclude each other; keep one");
    }
    const auto column = [&](std::size_t k) { return Vec3{(*m)[k], (*m)[k + 4], (*m)[k + 8]}; };
    out = {column(0), column(1), column(2), column(3)};
  } else {
    if (const TomlValue* scale = section.find("scale")) {
      const std::array<double, 3> s = scale->as<TomlArray>() != nullptr ? *section.numbers_of<3>("scale") : [&] {
        const double same = *section.number("scale");
        return std::array{same, same, same};
      }();
      out = {{s[0], 0.0, 0.0}, {0.0, s[1], 0.0}, {0.0, 0.0, s[2]}, {}};
    }
    if (const TomlTable* rotate = section.table("rotate")) out = rotation_from(section, *rotate) * out;
    assign(out.shift, section.numbers_of<3>("translate"));
  }
  if (out.determinant() == 0.0) {
    section.place().fail(section.has("matrix") ? "matrix" : "scale", "flattens space: it cannot be undone");
  }
  return out;
}

}  // namespace xpr::scene_sections
