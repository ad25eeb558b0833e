#include "core/scene/scene_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/io/errors.hpp"
#include "core/io/names.hpp"
#include "core/io/toml_section.hpp"
#include "core/scene/scene_sections.hpp"

namespace xpr {
namespace {

using scene_sections::Keys;

/// Sections that stand once, and those that may stand often.
const Keys single{"scene", "camera", "observer", "transport", "spacetime", "fields", "sky", "film", "research"};
const Keys repeated{"field", "mesh", "material", "instance"};

class SceneReader {
 public:
  SceneReader(const std::string& name, const TomlTable& root) : name_(name), root_(root) {
    Keys known = single;
    known.insert(known.end(), repeated.begin(), repeated.end());
    for (const TomlEntry& entry : root_) {
      const bool known_section = std::find(known.begin(), known.end(), entry.key) != known.end();
      if (!known_section) fail(entry.value.line, unknown_name("section", entry.key, known));
    }
  }

  /// Hands [key] to the builder as `from` understands it; nothing where the file has none.
  template <class From>
  void read(SceneBuilder& builder, const std::string& key, const Keys& known, const From& from) const {
    const TomlValue* value = find(key);
    if (value == nullptr) return;
    const auto* table = value->as<TomlTable>();
    if (table == nullptr) fail(value->line, fmt::format("{} needs to be one section, [{}]", key, key));
    const TomlSection section(name_, "[" + key + "]", value->line, *table, known);
    builder.set(from(section), section.place());
  }

  /// The same for every [[key]], in the order of the file.
  template <class From>
  void read_all(SceneBuilder& builder, const std::string& key, const Keys& known, const From& from) const {
    const TomlValue* value = find(key);
    if (value == nullptr) return;
    const auto* array = value->as<TomlArray>();
    if (array == nullptr) fail(value->line, fmt::format("{} needs sections with two brackets, [[{}]]", key, key));
    for (const TomlValue& element : *array) {
      const auto* table = element.as<TomlTable>();
      if (table == nullptr) fail(element.line, fmt::format("{} needs sections, [[{}]]", key, key));
      const TomlSection section(name_, "[[" + key + "]]", element.line, *table, known);
      builder.add(from(section), section.place());
    }
  }

 private:
  [[nodiscard]] const TomlValue* find(const std::string& key) const {
    const auto found = std::find_if(root_.begin(), root_.end(), [&](const TomlEntry& e) { return e.key == key; });
    return found == root_.end() ? nullptr : &found->value;
  }
  [[noreturn]] void fail(int line, const std::string& what) const {
    throw InputError(fmt::format("{}: line {}: {}", name_, line, what));
  }

  const std::string& name_;
  const TomlTable& root_;
};

}  // namespace

SceneFile::SceneFile(const std::filesystem::path& path)
    : name_(path.string()), directory_(path.parent_path()), root_(read_toml(path)) {}

SceneFile::SceneFile(std::string_view text, std::string name, std::filesystem::path directory)
    : name_(std::move(name)), directory_(std::move(directory)), root_(parse_toml(text, name_)) {}

void SceneFile::describe(SceneBuilder& builder) const {
  namespace from = scene_sections;
  const SceneReader reader(name_, root_);
  reader.read(builder, "scene", from::header_keys, from::header_from);
  reader.read(builder, "camera", from::camera_keys, from::camera_from);
  reader.read(builder, "observer", from::observer_keys, from::observer_from);
  reader.read(builder, "transport", from::transport_keys, from::transport_from);
  reader.read(builder, "spacetime", from::spacetime_keys, from::spacetime_from);
  reader.read(builder, "fields", from::gains_keys, from::gains_from);
  reader.read_all(builder, "field", from::field_keys, from::field_from);
  std::vector<std::string> warnings;
  reader.read_all(builder, "mesh", from::mesh_keys,
                  [&](const TomlSection& section) { return from::mesh_from(section, directory_, warnings); });
  for (std::string& line : warnings) builder.warn(name_ + ": " + std::move(line));
  reader.read_all(builder, "material", from::material_keys, from::material_from);
  reader.read_all(builder, "instance", from::instance_keys, from::instance_from);
  reader.read(builder, "sky", from::sky_keys,
              [&](const TomlSection& section) { return from::sky_from(section, directory_); });
  reader.read(builder, "film", from::film_keys, from::film_from);
  reader.read(builder, "research", from::research_keys(), from::research_from);
}

std::shared_ptr<const SceneSnapshot> read_scene(const std::filesystem::path& path, SceneFlags flags) {
  return make_snapshot(SceneFile(path), std::move(flags));
}

}  // namespace xpr
