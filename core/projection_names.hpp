// Projections under the names that users give them.
#pragma once

#include <array>
#include <string_view>

#include "core/io/errors.hpp"
#include "core/io/names.hpp"
#include "integrators/tracer.hpp"

namespace xpr {

inline constexpr std::array<std::string_view, 4> projection_names{"none", "energy", "momentum", "full"};  // as the enum

[[nodiscard]] inline std::string_view name_of(Projection projection) {
  return projection_names[static_cast<std::size_t>(projection)];
}

/// Throws InputError for an unknown name, saying the nearest known one.
[[nodiscard]] inline Projection projection_named(std::string_view name) {
  for (std::size_t k = 0; k < projection_names.size(); ++k) {
    if (projection_names[k] == name) return static_cast<Projection>(k);
  }
  throw InputError(unknown_name("projection", name, {projection_names.begin(), projection_names.end()}));
}

}  // namespace xpr
