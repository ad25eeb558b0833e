// Sections of a scene file, each as the description that the builder takes; docs/scenes.md is their reference. Throws
// InputError for values of another type; ranges are the builder's.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/affine3.hpp"
#include "core/io/toml_section.hpp"
#include "core/scene/scene_host.hpp"

namespace xpr::scene_sections {

using Keys = std::vector<std::string_view>;

extern const Keys header_keys, camera_keys, observer_keys, transport_keys, spacetime_keys, gains_keys, field_keys,
    mesh_keys, material_keys, instance_keys, sky_keys, film_keys;
/// All fields of ResearchOverrides, and preset and enabled.
[[nodiscard]] Keys research_keys();

[[nodiscard]] SceneHeader header_from(const TomlSection& section);
[[nodiscard]] SceneCamera camera_from(const TomlSection& section);
[[nodiscard]] SceneObserver observer_from(const TomlSection& section);
[[nodiscard]] SceneTransport transport_from(const TomlSection& section);
[[nodiscard]] SceneSpacetime spacetime_from(const TomlSection& section);
[[nodiscard]] FieldGains gains_from(const TomlSection& section);
[[nodiscard]] FieldSource field_from(const TomlSection& section);
/// Reads the mesh's file, which stands in `directory`, or makes its shape; what was dropped of it is a line more in
/// `warnings`.
[[nodiscard]] MeshDescription mesh_from(const TomlSection& section, const std::filesystem::path& directory,
                                        std::vector<std::string>& warnings);
[[nodiscard]] MaterialDescription material_from(const TomlSection& section);
[[nodiscard]] InstanceDescription instance_from(const TomlSection& section);
/// Reads its image, which stands in `directory`.
[[nodiscard]] SceneSky sky_from(const TomlSection& section, const std::filesystem::path& directory);
[[nodiscard]] SceneFilm film_from(const TomlSection& section);
[[nodiscard]] SceneResearch research_from(const TomlSection& section);

/// translate, rotate, scale (in the reverse of that order) or matrix; the identity where none is given.
[[nodiscard]] Affine3 transform_from(const TomlSection& section);

}  // namespace xpr::scene_sections
