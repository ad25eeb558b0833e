// Values of a scene file over the defaults of a description.
#pragma once

#include <array>
#include <optional>

#include "core/geometry/vec3.hpp"

namespace xpr {

[[nodiscard]] constexpr Vec3 vec3(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }

/// Keeps `to` where nothing was said.
template <class T, class V>
void assign(T& to, const std::optional<V>& value) {
  if (value) to = *value;
}
inline void assign(Vec3& to, const std::optional<std::array<double, 3>>& value) {
  if (value) to = vec3(*value);
}

}  // namespace xpr
