// A resolved scene in words: what `render --dry-run` prints and every frame's report stores.
#pragma once

#include <string>

#include "core/io/json.hpp"
#include "core/scene/snapshot.hpp"

namespace xpr {

/// Every value as it came out, defaults, flags and Research Mode applied; equal scenes give equal text.
[[nodiscard]] Json scene_json(const SceneSnapshot& scene);
/// The same for people, a line for each section.
[[nodiscard]] std::string scene_text(const SceneSnapshot& scene);

}  // namespace xpr
