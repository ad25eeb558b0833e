#include "metrics/fields/field_model.hpp"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

namespace xpr {

namespace {

using Rows = std::array<FieldVector<double>, 3>;

double dot(const FieldVector<double>& a, const FieldVector<double>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
FieldVector<double> cross_product(const FieldVector<double>& a, const FieldVector<double>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Rows of the inverse of the matrix with these columns.
Rows undone(const FieldSource& source) {
  const Rows& a = source.world_from_local.axes;
  const double volume = dot(a[0], cross_product(a[1], a[2]));
  const double size = xpr::sqrt(dot(a[0], a[0]) * dot(a[1], a[1]) * dot(a[2], a[2]));
  constexpr double flat = 1e-12;
  if (!(xpr::abs(volume) > flat * size) || !xpr::isfinite(size)) {
    throw std::invalid_argument(
        fmt::format("field '{}': its frame has volume {}, needs axes that span space", source.name, volume));
  }
  Rows out{cross_product(a[1], a[2]), cross_product(a[2], a[0]), cross_product(a[0], a[1])};
  for (FieldVector<double>& row : out) {
    for (double& component : row) component /= volume;
  }
  return out;
}

/// No smaller than the largest stretch of the map with these rows: exact where they are orthogonal (a rotation and
/// scales along the source's own axes), else Frobenius' norm.
double largest_stretch(const Rows& rows) {
  const double lengths[3] = {dot(rows[0], rows[0]), dot(rows[1], rows[1]), dot(rows[2], rows[2])};
  const double sum = lengths[0] + lengths[1] + lengths[2];
  const double skew =
      xpr::abs(dot(rows[0], rows[1])) + xpr::abs(dot(rows[1], rows[2])) + xpr::abs(dot(rows[2], rows[0]));
  constexpr double round_off = 1e-14;
  if (skew > round_off * sum) return xpr::sqrt(sum);
  return xpr::sqrt(xpr::max(lengths[0], xpr::max(lengths[1], lengths[2]))) * (1.0 + round_off);
}

}  // namespace

PlacedField::PlacedField(const FieldSource& source, const FieldGains& gains)
    : source_(source), profile_(source, bending_of(source, gains)), local_from_world_(undone(source)) {
  const FieldFrame identity;
  only_moved_ = source.world_from_local.axes == identity.axes;
  Rows steepness = local_from_world_;
  if (source.shape == FieldShape::box) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double half = source.half_size[i];
      if (!(half > 0.0 && xpr::isfinite(half))) {
        throw std::invalid_argument(
            fmt::format("field '{}': half_size[{}] = {}, needs 0 < half_size < infinity", source.name, i, half));
      }
      box_scale_[i] = source.r_outer / half;
      for (double& component : steepness[i]) component *= box_scale_[i];
    }
  }
  contraction_ = 1.0 / largest_stretch(steepness);
  for (const double component : source.world_from_local.origin) {
    if (!xpr::isfinite(component)) {
      throw std::invalid_argument(fmt::format("field '{}': its origin is not finite", source.name));
    }
  }
  const Rows& axes = source.world_from_local.axes;
  const bool same_lengths =
      dot(axes[0], axes[0]) == dot(axes[1], axes[1]) && dot(axes[0], axes[0]) == dot(axes[2], axes[2]);
  const bool square_axes = dot(axes[0], axes[1]) == 0.0 && dot(axes[1], axes[2]) == 0.0 && dot(axes[2], axes[0]) == 0.0;
  spherical_ = source.shape == FieldShape::sphere && same_lengths && square_axes;
  find_bounds();
}

/// A sphere becomes an ellipsoid, whose extent along an axis is the length of the frame's row there; a box's extent is
/// the sum.
void PlacedField::find_bounds() {
  const FieldFrame& frame = source_.world_from_local;
  for (std::size_t k = 0; k < 3; ++k) {
    double squares = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      squares += square(frame.axes[i][k]);
      sum += xpr::abs(frame.axes[i][k]) * source_.half_size[i];
    }
    // An ulp or two more than round-off takes away.
    constexpr double margin = 1.0 + 1e-14;
    const double extent = margin * (source_.shape == FieldShape::box ? sum : xpr::sqrt(squares) * source_.r_outer);
    bounds_[k] = {frame.origin[k] - extent, frame.origin[k] + extent};
  }
}

FieldModel::FieldModel(const FieldSet& set) {
  for (const FieldSource& source : set.sources) {
    PlacedField field(source, set.gains);
    if (source.absorb && source.r_inner == 0.0) {
      throw std::invalid_argument(
          fmt::format("field '{}': it absorbs inside r_inner = 0, needs r_inner > 0", source.name));
    }
    if (field.profile().bending() != 0.0 || source.absorb) fields_.push_back(std::move(field));
  }
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const FieldSource &one = fields_[j].source(), &other = fields_[i].source();
      if (!one.absorb || !other.absorb) continue;
      const FieldVector<double> apart = {fields_[i].origin()[0] - fields_[j].origin()[0],
                                         fields_[i].origin()[1] - fields_[j].origin()[1],
                                         fields_[i].origin()[2] - fields_[j].origin()[2]};
      // Cores reach no further than this; of stretched ones and boxes it is the ball around them that counts.
      const auto reach = [](const PlacedField& field) {
        double squares = 0.0;
        for (const auto& [low, high] : field.bounds()) squares += square(0.5 * (high - low));
        const double ball =
            field.spherical() ? 0.5 * (field.bounds()[0][1] - field.bounds()[0][0]) : xpr::sqrt(squares);
        return ball * field.source().r_inner / field.source().r_outer;
      };
      if (xpr::sqrt(dot(apart, apart)) < reach(fields_[i]) + reach(fields_[j])) {
        throw std::invalid_argument(
            fmt::format("fields '{}' and '{}' both absorb and their cores overlap: light would "
                        "end in two places; move them apart or let one absorb",
                        one.name, other.name));
      }
    }
  }
}

double FieldModel::absorber_distance(const FieldVector<double>& x) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const PlacedField& field : fields_) {
    if (field.source().absorb) nearest = xpr::min(nearest, field.core_distance(x));
  }
  return nearest;
}

bool FieldModel::absorbs() const {
  for (const PlacedField& field : fields_) {
    if (field.source().absorb) return true;
  }
  return false;
}

const FieldVector<double>* FieldModel::centre() const {
  for (const PlacedField& field : fields_) {
    if (!field.spherical() || field.origin() != fields_.front().origin()) return nullptr;
  }
  return fields_.empty() ? nullptr : &fields_.front().origin();
}

}  // namespace xpr
