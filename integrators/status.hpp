// How a ray ends: every ray ends in exactly one of these, and none is dropped or silently repaired.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace xpr {

enum class Status {
  escaped,              ///< went out through --r-max
  captured,             ///< went in through --r-min
  hit,                  ///< met a surface of the scene
  crossed,              ///< met --l-min or --l-max, or another terminal event
  max_steps,            ///< the step budget ran out
  max_affine,           ///< the affine parameter reached --lambda-max
  step_underflow,       ///< the tolerance asks for steps below round-off, or a fixed step is too long to be solved for
  not_finite,           ///< a NaN or an infinity appeared
  constraint_violated,  ///< the null constraint could not be restored or drifted beyond use
  outside_domain,       ///< the start, or the path, lies where chart or physics end
};

/// In the order of the enum; also the names in ray tables.
inline constexpr std::array<std::string_view, 10> status_names = {"escaped",        "captured",   "hit",
                                                                  "crossed",        "max_steps",  "max_affine",
                                                                  "step_underflow", "not_finite", "constraint_violated",
                                                                  "outside_domain"};

[[nodiscard]] std::string_view to_string(Status status);
[[nodiscard]] std::optional<Status> status_from_name(std::string_view name);

}  // namespace xpr
