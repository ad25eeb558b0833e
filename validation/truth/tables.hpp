// The tables of reference_data/ that this program computes: what `xprimeray reference` lists, checks and rewrites.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/reference_table.hpp"
#include "validation/result.hpp"

namespace xpr {

/// How a table is made from nothing.
struct ReferenceMaker {
  std::string_view name;
  ReferenceTable (*make)();
};

/// All of them, in alphabetical order: an explicit list.
[[nodiscard]] const std::vector<ReferenceMaker>& reference_makers();

/// The rank that a table's header names. Throws InputError for a word that is none, naming the nearest.
[[nodiscard]] TruthRank rank_of(const ReferenceTable& table);

/// The first thing in which a stored table differs from one made anew, in words ("row 3, deflection: 1.23 stored, 1.24
/// computed"), or nothing.
[[nodiscard]] std::optional<std::string> first_difference(const ReferenceTable& stored, const ReferenceTable& made);

// Makers, by what they compute.

[[nodiscard]] ReferenceTable make_schwarzschild_deflection();
[[nodiscard]] ReferenceTable make_kerr_critical_parameters();
[[nodiscard]] ReferenceTable make_kerr_equatorial_deflection();
[[nodiscard]] ReferenceTable make_kerr_shadow_edge();
[[nodiscard]] ReferenceTable make_kerr_shadow_extent();
[[nodiscard]] ReferenceTable make_kerr_spherical_orbits();
[[nodiscard]] ReferenceTable make_ellis_deflection();
[[nodiscard]] ReferenceTable make_ellis_transit_angle();
/// One ray a chart of the catalogue, at its default parameters.
[[nodiscard]] ReferenceTable make_fifty_digit_rays();
[[nodiscard]] ReferenceTable make_kerr_rays();

}  // namespace xpr
