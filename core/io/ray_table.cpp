#include "core/io/ray_table.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace xpr {
namespace {

constexpr std::size_t state_size = PhaseState<double>::size;
constexpr std::array<std::string_view, state_size> state_names{"x0", "x1", "x2", "x3", "p0", "p1", "p2", "p3"};

// Where the columns stand in the two schemas.
struct In {
  static constexpr std::size_t id = 0, state = 1, sheet = 9, columns = 10;
};
struct Out {
  static constexpr std::size_t id = 0, status = 1, sheet = 2, state = 3, lambda = 11, steps = 12, rejected = 13,
                               null_residual = 14, null_residual_max = 15, columns = 16;
};

void add_state_columns(TableSchema& schema, const Card& chart, bool finite) {
  for (std::size_t i = 0; i < state_size; ++i) {
    const Coordinate& coordinate = chart.coordinates[i % 4];
    const bool angle = coordinate.kind != CoordinateKind::time && coordinate.kind != CoordinateKind::length;
    const std::string name(coordinate.name);
    const DatasetText text{.units = angle && i < 4 ? "radian" : "1",
                           .long_name = i < 4 ? "coordinate " + name : "covariant momentum p_" + name};
    schema.columns.push_back({.name = std::string(state_names[i]), .finite = finite, .text = text});
  }
}

Column integer_column(const std::string& name, const std::string& long_name, bool required = true) {
  return {.name = name, .type = ColumnType::integer, .required = required, .text = {.long_name = long_name}};
}

std::vector<double>& reals(TableBlock& block, std::size_t column) {
  return std::get<std::vector<double>>(block.columns[column]);
}

std::vector<std::int64_t>& integers(TableBlock& block, std::size_t column) {
  return std::get<std::vector<std::int64_t>>(block.columns[column]);
}

PhaseState<double> state_of(const TableBlock& block, std::size_t first, std::size_t row) {
  PhaseState<double> y;
  for (std::size_t i = 0; i < state_size; ++i) y[i] = block.reals(first + i)[row];
  return y;
}

}  // namespace

TableSchema ray_schema(const Card& chart) {
  TableSchema schema{.group = "/rays", .columns = {integer_column("id", "ray number, unique in the table")}};
  add_state_columns(schema, chart, true);
  schema.columns.push_back(integer_column("sheet", "side of a wormhole: +1 near, -1 far", false));
  return schema;
}

TableSchema traced_ray_schema(const Card& chart) {
  TableSchema schema{.group = "/rays", .columns = {integer_column("id", "ray number, as it came in")}};
  schema.columns.push_back(
      {.name = "status", .type = ColumnType::name, .text = {.long_name = "how the ray ended"}, .names = status_names});
  schema.columns.push_back(integer_column("sheet", "side of a wormhole: +1 near, -1 far"));
  add_state_columns(schema, chart, false);
  schema.columns.push_back({.name = "lambda", .text = {.long_name = "affine parameter at the end"}});
  schema.columns.push_back(integer_column("steps", "steps accepted"));
  schema.columns.push_back(integer_column("rejected", "steps tried and rejected"));
  schema.columns.push_back({.name = "null_residual",
                            .text = {.long_name = "|g^{mn} p_m p_n| / (n.p)^2 at the end, in the transport chart"}});
  schema.columns.push_back({.name = "null_residual_max", .text = {.long_name = "largest null residual over the path"}});
  return schema;
}

std::vector<Ray> rays_of(const TableBlock& block) {
  std::vector<Ray> rays(block.rows);
  const auto& sheets = block.integers(In::sheet);
  for (std::size_t row = 0; row < block.rows; ++row) {
    rays[row] = {.id = block.integers(In::id)[row],
                 .start = state_of(block, In::state, row),
                 .sheet = sheets.empty() ? 1 : static_cast<int>(sheets[row])};
  }
  return rays;
}

TableBlock block_of(std::span<const Ray> rays) {
  TableBlock block{.rows = rays.size(), .columns = std::vector<ColumnData>(In::columns), .places = {}};
  block.columns[In::id] = block.columns[In::sheet] = std::vector<std::int64_t>{};
  for (const Ray& ray : rays) {
    integers(block, In::id).push_back(ray.id);
    integers(block, In::sheet).push_back(ray.sheet);
    for (std::size_t i = 0; i < state_size; ++i) reals(block, In::state + i).push_back(ray.start[i]);
  }
  return block;
}

std::vector<TracedRay> traced_rays_of(const TableBlock& block) {
  std::vector<TracedRay> rays(block.rows);
  for (std::size_t row = 0; row < block.rows; ++row) {
    rays[row] = {.id = block.integers(Out::id)[row],
                 .status = static_cast<Status>(block.integers(Out::status)[row]),
                 .sheet = static_cast<int>(block.integers(Out::sheet)[row]),
                 .end = state_of(block, Out::state, row),
                 .lambda = block.reals(Out::lambda)[row],
                 .steps = block.integers(Out::steps)[row],
                 .rejected = block.integers(Out::rejected)[row],
                 .null_residual = block.reals(Out::null_residual)[row],
                 .null_residual_max = block.reals(Out::null_residual_max)[row]};
  }
  return rays;
}

TableBlock block_of(std::span<const TracedRay> rays) {
  TableBlock block{.rows = rays.size(), .columns = std::vector<ColumnData>(Out::columns), .places = {}};
  for (const std::size_t k : {Out::id, Out::status, Out::sheet, Out::steps, Out::rejected}) {
    block.columns[k] = std::vector<std::int64_t>{};
  }
  for (const TracedRay& ray : rays) {
    integers(block, Out::id).push_back(ray.id);
    integers(block, Out::status).push_back(static_cast<std::int64_t>(ray.status));
    integers(block, Out::sheet).push_back(ray.sheet);
    for (std::size_t i = 0; i < state_size; ++i) reals(block, Out::state + i).push_back(ray.end[i]);
    reals(block, Out::lambda).push_back(ray.lambda);
    integers(block, Out::steps).push_back(ray.steps);
    integers(block, Out::rejected).push_back(ray.rejected);
    reals(block, Out::null_residual).push_back(ray.null_residual);
    reals(block, Out::null_residual_max).push_back(ray.null_residual_max);
  }
  return block;
}

std::optional<std::int64_t> IdCheck::duplicate() {
  if (!std::is_sorted(ids_.begin(), ids_.end())) std::sort(ids_.begin(), ids_.end());
  const auto twice = std::adjacent_find(ids_.begin(), ids_.end());
  return twice == ids_.end() ? std::nullopt : std::optional(*twice);
}

}  // namespace xpr
