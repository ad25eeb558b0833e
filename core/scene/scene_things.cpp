// The parts of a scene that stand in it: meshes, materials, instances.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/io/errors.hpp"
#include "core/io/names.hpp"
#include "core/scene/colour_check.hpp"
#include "core/scene/scene_host.hpp"

namespace xpr {
namespace {

constexpr const char* default_material = "default";

/// The places of `said` in the order of a member of theirs; two of one name are refused.
template <class Said, class Member>
std::vector<const Said*> sorted_by(const std::vector<Said>& said, std::string_view key, Member member) {
  std::vector<const Said*> out;
  for (const Said& one : said) out.push_back(&one);
  std::stable_sort(out.begin(), out.end(),
                   [&](const Said* a, const Said* b) { return a->what.*member < b->what.*member; });
  for (std::size_t k = 0; k < out.size(); ++k) {
    if ((out[k]->what.*member).empty()) out[k]->place.fail(key, "is missing");
    if (k > 0 && out[k]->what.*member == out[k - 1]->what.*member) {
      out[k]->place.fail(key, fmt::format("'{}' is taken by another one", out[k]->what.*member));
    }
  }
  return out;
}

std::optional<std::uint32_t> index_in(const std::vector<std::string>& names, std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::uint32_t>(found - names.begin());
}

[[noreturn]] void unknown(const SourcePlace& place, std::string_view key, std::string_view what, std::string_view name,
                          const std::vector<std::string>& names) {
  if (names.empty()) place.fail(key, fmt::format("is '{}', but there is no [[{}]]", name, what));
  place.fail(key, "is an " + unknown_name(what, name, {names.begin(), names.end()}));
}

bool can_be_undone(const Affine3& map) {
  const double volume = map.determinant();
  return std::isfinite(volume) && volume != 0.0 && is_finite(map.shift);
}

}  // namespace

SceneMaterials SceneBuilder::finished_materials() const {
  std::vector<Said<MaterialDescription>> all = materials_;
  const bool named = std::any_of(all.begin(), all.end(), [](const auto& m) { return m.what.name == default_material; });
  if (!named) {
    all.emplace_back();
    all.back().what.name = default_material;
  }
  SceneMaterials out;
  for (const auto* said : sorted_by(all, "name", &MaterialDescription::name)) {
    const MaterialDescription& material = said->what;
    check_colour(material.colour_a, said->place, "colour_a");
    check_colour(material.colour_b, said->place, "colour_b");
    for (const std::int64_t squares : material.squares) {
      if (squares < 1 || squares > 1'000'000) {
        said->place.fail("squares", fmt::format("has {}, needs 1 to 1000000", squares));
      }
    }
    out.name.push_back(material.name);
    out.kind.push_back(material.kind);
    out.colour_a.push_back(material.colour_a);
    out.colour_b.push_back(material.colour_b);
    out.squares.push_back(material.squares);
  }
  return out;
}

std::shared_ptr<const TriangleMesh> SceneBuilder::with_scene_materials(const Said<MeshDescription>& mesh,
                                                                       const SceneMaterials& materials) const {
  const TriangleMesh& own = *mesh.what.mesh;
  if (own.materials.empty()) return mesh.what.mesh;
  std::vector<std::uint32_t> index_of;
  for (const std::string& name : own.material_names) {
    const auto index = index_in(materials.name, name);
    if (!index) {
      mesh.place.fail("name",
                      fmt::format("'{}' has triangles of material '{}', but there is no [[material]] of that name; "
                                  "write one, or give its instances a material",
                                  mesh.what.name, name));
    }
    index_of.push_back(*index);
  }
  auto out = std::make_shared<TriangleMesh>(own);
  for (std::uint32_t& material : out->materials) material = index_of[material];
  out->material_names = materials.name;
  return out;
}

Affine3 SceneBuilder::to_world(const Said<InstanceDescription>& instance) const {
  Affine3 out = instance.what.transform;
  std::string chain = instance.what.path;
  const Said<InstanceDescription>* at = &instance;
  for (std::size_t depth = 0; !at->what.parent.empty(); ++depth) {
    chain += " -> " + at->what.parent;
    const auto parent = std::find_if(instances_.begin(), instances_.end(),
                                     [&](const auto& other) { return other.what.path == at->what.parent; });
    if (parent == instances_.end()) {
      std::vector<std::string> paths;
      for (const auto& other : instances_) paths.push_back(other.what.path);
      unknown(at->place, "parent", "instance", at->what.parent, paths);
    }
    at = &*parent;
    if (at == &instance || depth > instances_.size()) {
      instance.place.fail("parent", "goes round in a cycle: " + chain);
    }
    out = at->what.transform * out;
  }
  if (!can_be_undone(out)) instance.place.fail("with its parents' transforms flattens space: it cannot be undone");
  return out;
}

void SceneBuilder::finish_instances(SceneSnapshot& scene) const {
  // A mesh whose triangles name materials needs them only where an instance leaves the choice to it.
  std::vector<const Said<MeshDescription>*> meshes = sorted_by(meshes_, "name", &MeshDescription::name);
  for (const auto* mesh : meshes) {
    const auto leaves_choice = [&](const auto& i) { return i.what.mesh == mesh->what.name && i.what.material.empty(); };
    scene.meshes.name.push_back(mesh->what.name);
    scene.meshes.source.push_back(mesh->what.source);
    scene.meshes.mesh.push_back(std::any_of(instances_.begin(), instances_.end(), leaves_choice)
                                    ? with_scene_materials(*mesh, scene.materials)
                                    : mesh->what.mesh);
  }
  SceneInstances& out = scene.instances;
  for (const auto* said : sorted_by(instances_, "path", &InstanceDescription::path)) {
    const InstanceDescription& instance = said->what;
    const Affine3 place = to_world(*said);
    if (instance.mesh.empty()) continue;
    const auto mesh = index_in(scene.meshes.name, instance.mesh);
    if (!mesh) unknown(said->place, "mesh", "mesh", instance.mesh, scene.meshes.name);
    const bool own_materials = !scene.meshes.mesh[*mesh]->materials.empty();
    std::optional<std::uint32_t> material;
    if (!instance.material.empty() || !own_materials) {
      const std::string name = instance.material.empty() ? default_material : instance.material;
      material = index_in(scene.materials.name, name);
      if (!material) unknown(said->place, "material", "material", name, scene.materials.name);
    }
    out.path.push_back(instance.path);
    out.mesh.push_back(*mesh);
    out.to_world.push_back(place);
    out.material.push_back(material);
    out.solid.push_back(instance.solid ? 1 : 0);
  }
}

GeometryModel geometry_model(const SceneSnapshot& scene) {
  GeometryModel model{scene.meshes.mesh, {}};
  for (std::size_t k = 0; k < scene.instances.size(); ++k) {
    model.instances.push_back({scene.instances.mesh[k], scene.instances.to_world[k], static_cast<std::uint32_t>(k),
                               scene.instances.material[k], scene.instances.solid[k] != 0});
  }
  return model;
}

}  // namespace xpr
