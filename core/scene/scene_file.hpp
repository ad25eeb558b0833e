// Scenes as TOML files with meshes and images beside them (docs/scenes.md has every key).
//
// Whatever is wrong with a file ends in one InputError of one line: the file, the line, the section, the key, what is
// wrong and what would be right.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/io/toml_file.hpp"
#include "core/scene/scene_host.hpp"

namespace xpr {

/// A scene file as a host.
class SceneFile : public SceneHost {
 public:
  /// Reads the file. Throws InputError where it cannot be read or is no TOML.
  explicit SceneFile(const std::filesystem::path& path);
  /// The text of a scene; files that it names are looked for in `directory`, `name` stands for it in errors.
  SceneFile(std::string_view text, std::string name, std::filesystem::path directory);

  void describe(SceneBuilder& builder) const override;

 private:
  std::string name_;
  std::filesystem::path directory_;
  TomlTable root_;
};

/// The snapshot of a scene file. Throws InputError.
[[nodiscard]] std::shared_ptr<const SceneSnapshot> read_scene(const std::filesystem::path& path, SceneFlags flags = {});

}  // namespace xpr
