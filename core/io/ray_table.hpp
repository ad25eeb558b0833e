// The ray table: how rays come in and go out, for the command, for HDF5 and for other people's codes.
//
//   in:   id, x0..x3, p0..p3, optional sheet                    event and covariant momentum in one chart
//   out:  id, status, sheet, x0..x3, p0..p3, lambda, steps, rejected, null_residual, null_residual_max
//
// Angles are in radians, lengths in the unit of the parameters (G = c = 1). HDF5 keeps the table in the group /rays.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/table.hpp"
#include "core/transport.hpp"
#include "metrics/card.hpp"

namespace xpr {

inline constexpr std::string_view ray_schema_name = "xprimeray/rays";
inline constexpr std::string_view traced_ray_schema_name = "xprimeray/traced-rays";
inline constexpr std::string_view ray_schema_version = "1";

/// The columns of a table of starts, and of a table of ends, with units and long names from the chart.
[[nodiscard]] TableSchema ray_schema(const Card& chart);
[[nodiscard]] TableSchema traced_ray_schema(const Card& chart);

/// Between rows and what they mean. A start without a sheet is on sheet +1.
[[nodiscard]] std::vector<Ray> rays_of(const TableBlock& block);
[[nodiscard]] std::vector<TracedRay> traced_rays_of(const TableBlock& block);
[[nodiscard]] TableBlock block_of(std::span<const Ray> rays);
[[nodiscard]] TableBlock block_of(std::span<const TracedRay> rays);

/// Finds ids that occur twice; keeps eight bytes for each ray.
class IdCheck {
 public:
  void add(std::int64_t id) { ids_.push_back(id); }
  /// The smallest id that was added more than once, if there is one. Reorders what it keeps: call it last.
  [[nodiscard]] std::optional<std::int64_t> duplicate();

 private:
  std::vector<std::int64_t> ids_;
};

}  // namespace xpr
