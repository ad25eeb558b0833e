#include "validation/truth/tables.hpp"

#include <fmt/format.h>

#include <array>

#include "core/io/errors.hpp"
#include "metrics/catalogue.hpp"

namespace xpr {

const std::vector<ReferenceMaker>& reference_makers() {
  static const std::vector<ReferenceMaker> makers = {
      {"ellis_deflection", make_ellis_deflection},
      {"ellis_transit_angle", make_ellis_transit_angle},
      {"fifty_digit_rays", make_fifty_digit_rays},
      {"kerr_critical_parameters", make_kerr_critical_parameters},
      {"kerr_equatorial_deflection", make_kerr_equatorial_deflection},
      {"kerr_rays", make_kerr_rays},
      {"kerr_shadow_edge", make_kerr_shadow_edge},
      {"kerr_shadow_extent", make_kerr_shadow_extent},
      {"kerr_spherical_orbits", make_kerr_spherical_orbits},
      {"schwarzschild_deflection", make_schwarzschild_deflection},
  };
  return makers;
}

TruthRank rank_of(const ReferenceTable& table) {
  std::vector<std::string_view> names;
  for (int k = 0; k <= static_cast<int>(TruthRank::self_convergence); ++k) {
    const auto rank = static_cast<TruthRank>(k);
    if (to_string(rank) == table.rank) return rank;
    names.push_back(to_string(rank));
  }
  const std::string near = nearest_name(table.rank, names);
  throw InputError(fmt::format("reference table '{}': unknown rank '{}'{}", table.name, table.rank,
                               near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
}

std::optional<std::string> first_difference(const ReferenceTable& stored, const ReferenceTable& made) {
  const std::array<std::pair<std::string_view, std::string ReferenceTable::*>, 7> header{{
      {"quantity", &ReferenceTable::quantity},
      {"units", &ReferenceTable::units},
      {"origin", &ReferenceTable::origin},
      {"method", &ReferenceTable::method},
      {"rank", &ReferenceTable::rank},
      {"cites", &ReferenceTable::cites},
      {"maker", &ReferenceTable::maker},
  }};
  for (const auto& [name, text] : header) {
    if (stored.*text != made.*text) {
      return fmt::format("header, {}: '{}' stored, '{}' made anew", name, stored.*text, made.*text);
    }
  }
  if (stored.digits != made.digits)
    return fmt::format("header, digits: {} stored, {} made", stored.digits, made.digits);
  if (stored.columns != made.columns) return "its columns have other names";
  for (std::size_t r = 0; r < std::min(stored.rows.size(), made.rows.size()); ++r) {
    for (std::size_t c = 0; c < made.columns.size(); ++c) {
      if (stored.rows[r][c] == made.rows[r][c]) continue;
      return fmt::format("row {}, {}: {} stored, {} computed", r + 1, made.columns[c], stored.rows[r][c],
                         made.rows[r][c]);
    }
  }
  if (stored.rows.size() != made.rows.size()) {
    return fmt::format("{} rows stored, {} computed", stored.rows.size(), made.rows.size());
  }
  return std::nullopt;
}

}  // namespace xpr
