// What became of a pixel: every one has exactly one class, whatever its ray did.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "integrators/status.hpp"

namespace xpr {

/// Named as in the earlier engine, whose users sort by them; `captured` is ours.
enum class FilmClass : std::uint8_t {
  geom_hit,
  background_hit,
  escaped_no_hit,
  captured,
  budget_exhausted,
  portal_hit,
  throat_entry,
  throat_exit,
  throat_shell_transform,
  throat_inner_absorb,
  unclassified,
};
inline constexpr std::array<std::string_view, 11> film_class_names{"geom_hit",
                                                                   "background_hit",
                                                                   "escaped_no_hit",
                                                                   "captured",
                                                                   "budget_exhausted",
                                                                   "portal_hit",
                                                                   "throat_entry",
                                                                   "throat_exit",
                                                                   "throat_shell_transform",
                                                                   "throat_inner_absorb",
                                                                   "unclassified"};

/// Where a ray that ended so belongs. What is not named here stays unclassified, with its status kept beside it.
[[nodiscard]] constexpr FilmClass film_class_of(Status status, bool has_sky) {
  switch (status) {
    case Status::hit:
      return FilmClass::geom_hit;
    case Status::escaped:
      return has_sky ? FilmClass::background_hit : FilmClass::escaped_no_hit;
    case Status::captured:
      return FilmClass::captured;
    case Status::max_steps:
    case Status::max_affine:
      return FilmClass::budget_exhausted;
    default:
      return FilmClass::unclassified;
  }
}

}  // namespace xpr
