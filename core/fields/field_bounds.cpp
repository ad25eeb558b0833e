#include "core/fields/field_bounds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace xpr {

namespace {

FieldVector<double> place_of(const Vec3& x) { return {x.x, x.y, x.z}; }

/// Sums and products of a few numbers, rounded the wrong way.
constexpr double round_off = 1.0 + 1e-13;

bool overlap(const FieldBox& a, const FieldBox& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (a.low[i] > b.high[i] || b.low[i] > a.high[i]) return false;
  }
  return true;
}

FieldBox box_of(const PlacedField& field) {
  const auto& bounds = field.bounds();
  return {{bounds[0][0], bounds[1][0], bounds[2][0]}, {bounds[0][1], bounds[1][1], bounds[2][1]}};
}

FieldBox hull(const FieldBox& a, const FieldBox& b) {
  FieldBox out = a;
  for (std::size_t i = 0; i < 3; ++i) {
    out.low[i] = std::min(a.low[i], b.low[i]);
    out.high[i] = std::max(a.high[i], b.high[i]);
  }
  return out;
}

void require_box(std::string_view what, const FieldBox& box) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (box.low[i] < box.high[i] && std::isfinite(box.low[i]) && std::isfinite(box.high[i])) continue;
    throw std::invalid_argument(fmt::format("{}: its box reaches from {} to {} along axis {}, needs a positive size",
                                            what, box.low[i], box.high[i], i));
  }
}

double bound_of(const PlacedField& field, double u_low, double u_high) {
  return std::abs(field.profile().bending()) * field.stretch() * field.profile().most(u_low, u_high) * round_off;
}

}  // namespace

double curvature_bound(const FieldModel& fields, const FieldBox& box) {
  const Vec3 middle = 0.5 * (box.low + box.high);
  const double half_diagonal = 0.5 * length(box.high - box.low) * round_off;
  double sum = 0.0;
  for (const PlacedField& field : fields.fields()) {
    if (!overlap(box, box_of(field))) continue;
    // The radius changes by no more than `stretch` a length.
    const double r = field.radius(place_of(middle)), reach = field.stretch() * half_diagonal * round_off;
    const double nearest = r - reach, furthest = r + reach;
    if (nearest > field.source().r_outer * round_off) continue;
    sum += bound_of(field, field.profile().normalised(nearest), field.profile().normalised(furthest));
  }
  return sum * round_off;
}

double sagitta_bound(double curvature, double chord) {
  if (!(curvature > 0.0)) return 0.0;
  const double radius = 1.0 / curvature, half = 0.5 * chord;
  if (half >= radius) return std::numeric_limits<double>::infinity();
  // r - sqrt(r^2 - h^2) without cancellation
  return half * half / (radius + std::sqrt((radius - half) * (radius + half))) * round_off;
}

double step_for_curvature(double curvature, double epsilon, double dt_min, double dt_max) {
  if (!(curvature > 0.0)) return dt_max;
  constexpr double least_curvature = 1e-8;
  return std::clamp(std::sqrt(2.0 * epsilon / std::max(least_curvature, curvature)), dt_min, dt_max);
}

FieldTlas::FieldTlas(const FieldModel& fields) {
  for (const PlacedField& field : fields.fields()) boxes_.push_back(box_of(field));
  order_.resize(boxes_.size());
  std::iota(order_.begin(), order_.end(), 0U);
  if (boxes_.empty()) return;
  nodes_.emplace_back();
  split(0, 0, static_cast<std::uint32_t>(boxes_.size()));
}

/// Halves the fields by their centres along the widest axis; ties go by index.
void FieldTlas::split(std::uint32_t node, std::uint32_t first, std::uint32_t last) {
  FieldBox box = boxes_[order_[first]];
  for (std::uint32_t k = first; k < last; ++k) box = hull(box, boxes_[order_[k]]);
  constexpr std::uint32_t leaf_size = 4;
  if (last - first <= leaf_size) {
    nodes_[node] = {box, first, last - first};
    return;
  }
  const Vec3 size = box.high - box.low;
  const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto place = [&](std::uint32_t k) { return boxes_[k].low[axis] + boxes_[k].high[axis]; };
  const std::uint32_t middle = first + (last - first) / 2;
  std::sort(order_.begin() + first, order_.begin() + last,
            [&](std::uint32_t a, std::uint32_t b) { return place(a) != place(b) ? place(a) < place(b) : a < b; });
  const auto left = static_cast<std::uint32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node] = {box, left, 0};
  split(left, first, middle);
  split(left + 1, middle, last);
}

void FieldTlas::query_box(const FieldBox& box, std::vector<std::uint32_t>& found) const {
  found.clear();
  if (nodes_.empty()) return;
  // Halving: a stack no deeper than the number of bits of an index.
  std::array<std::uint32_t, 64> stack{};
  std::size_t size = 1;
  while (size > 0) {
    const Node& node = nodes_[stack[--size]];
    if (!overlap(box, node.box)) continue;
    if (node.count == 0) {
      stack[size++] = node.first;
      stack[size++] = node.first + 1;
      continue;
    }
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
      if (overlap(box, boxes_[order_[k]])) found.push_back(order_[k]);
    }
  }
  std::sort(found.begin(), found.end());
}

CurvatureBoundGrid::CurvatureBoundGrid(std::shared_ptr<const FieldModel> fields, const FieldBox& box,
                                       std::array<std::size_t, 3> cells)
    : box_(box), cells_(cells) {
  require_box("curvature bounds", box);
  if (cells[0] == 0 || cells[1] == 0 || cells[2] == 0) {
    throw std::invalid_argument("curvature bounds: needs at least one cell along each axis");
  }
  everywhere_ = 0.0;
  for (const PlacedField& field : fields->fields()) everywhere_ += bound_of(field, 0.0, 1.0);
  everywhere_ *= round_off;
  bounds_.reserve(cells[0] * cells[1] * cells[2]);
  const auto corner = [&](std::size_t i, std::size_t axis) {
    const double part = static_cast<double>(i) / static_cast<double>(cells_[axis]);
    return box_.low[axis] + part * (box_.high[axis] - box_.low[axis]);
  };
  for (std::size_t i = 0; i < cells[0]; ++i) {
    for (std::size_t j = 0; j < cells[1]; ++j) {
      for (std::size_t k = 0; k < cells[2]; ++k) {
        FieldBox cell{{corner(i, 0), corner(j, 1), corner(k, 2)},
                      {corner(i + 1, 0), corner(j + 1, 1), corner(k + 1, 2)}};
        // A point that round-off puts into its neighbour must not find less.
        const Vec3 margin = 1e-9 * (cell.high - cell.low);
        cell = {cell.low - margin, cell.high + margin};
        bounds_.push_back(curvature_bound(*fields, cell));
      }
    }
  }
}

double CurvatureBoundGrid::at(const Vec3& x) const {
  std::array<std::size_t, 3> cell{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(x[i] >= box_.low[i] && x[i] <= box_.high[i])) return everywhere_;
    const double part = (x[i] - box_.low[i]) / (box_.high[i] - box_.low[i]);
    cell[i] = std::min(static_cast<std::size_t>(part * static_cast<double>(cells_[i])), cells_[i] - 1);
  }
  return bounds_[(cell[0] * cells_[1] + cell[1]) * cells_[2] + cell[2]];
}

FieldGrid::FieldGrid(const FieldModel& fields, const FieldBox& box, std::array<std::size_t, 3> points)
    : box_(box), points_(points) {
  require_box("field grid", box);
  if (points[0] < 2 || points[1] < 2 || points[2] < 2) {
    throw std::invalid_argument("field grid: needs at least two points along each axis");
  }
  values_.reserve(points[0] * points[1] * points[2]);
  for (std::size_t i = 0; i < points[0]; ++i) {
    for (std::size_t j = 0; j < points[1]; ++j) {
      for (std::size_t k = 0; k < points[2]; ++k) {
        const FieldVector<double> a = fields.evaluate(place_of(point(i, j, k))).gradient;
        values_.push_back({a[0], a[1], a[2]});
      }
    }
  }
}

Vec3 FieldGrid::point(std::size_t i, std::size_t j, std::size_t k) const {
  const std::array<std::size_t, 3> at{i, j, k};
  Vec3 out;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double part = static_cast<double>(at[axis]) / static_cast<double>(points_[axis] - 1);
    out[axis] =
        at[axis] + 1 == points_[axis] ? box_.high[axis] : box_.low[axis] + part * (box_.high[axis] - box_.low[axis]);
  }
  return out;
}

std::optional<Vec3> FieldGrid::at(const Vec3& x) const {
  std::array<std::size_t, 3> cell{};
  std::array<double, 3> part{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(x[axis] >= box_.low[axis] && x[axis] <= box_.high[axis])) return std::nullopt;
    const double place =
        (x[axis] - box_.low[axis]) / (box_.high[axis] - box_.low[axis]) * static_cast<double>(points_[axis] - 1);
    cell[axis] = std::min(static_cast<std::size_t>(place), points_[axis] - 2);
    part[axis] = place - static_cast<double>(cell[axis]);
  }
  const auto between = [](double t, const Vec3& a, const Vec3& b) { return (1.0 - t) * a + t * b; };
  std::array<Vec3, 4> edges{};
  for (std::size_t e = 0; e < 4; ++e) {
    const std::size_t i = cell[0] + e / 2, j = cell[1] + e % 2;
    edges[e] = between(part[2], values_[index(i, j, cell[2])], values_[index(i, j, cell[2] + 1)]);
  }
  return between(part[0], between(part[1], edges[0], edges[1]), between(part[1], edges[2], edges[3]));
}

}  // namespace xpr
