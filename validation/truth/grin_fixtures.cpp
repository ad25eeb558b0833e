#include "validation/truth/grin_fixtures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "validation/truth/field_rays50.hpp"

namespace xpr {

namespace {

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector between(const Vector& a, const Vector& b) { return {b[0] - a[0], b[1] - a[1], b[2] - a[2]}; }

FieldSource field_at(double x) {
  FieldSource field{.name = "radial", .curve = FieldCurve::power, .amplitude = 0.9, .r_outer = 5.0, .a = 1.8};
  field.world_from_local.origin = {x, 0.0, 0.0};
  return field;
}

GrinFixture fixture(std::string_view id, const std::vector<double>& centres, const std::vector<double>& rows) {
  GrinFixture out{.id = id, .fields = {}, .spheres = {}};
  for (const double x : centres) out.fields.sources.push_back(field_at(x));
  for (const double y : rows) {
    for (const double x : {-6.0, -3.0, 0.0, 3.0, 6.0}) out.spheres.push_back({x, y, -18.0});
  }
  return out;
}

}  // namespace

Vector GrinFixture::direction(int column, int row) const {
  const double half = std::tan(0.5 * 42.0 * std::numbers::pi / 180.0);
  const double u = 2.0 * (column + 0.5) / width - 1.0, v = 1.0 - 2.0 * (row + 0.5) / height;
  const Vector d{u * half * width / height, v * half, -1.0};
  const double norm = std::sqrt(dot(d, d));
  return {d[0] / norm, d[1] / norm, d[2] / norm};
}

FixtureTruth GrinFixture::truth(int column, int row) const {
  const Vector along = direction(column, row);
  if (fields.sources.size() == 1) {
    const grin_exact::RadialIndex index(fields.sources[0], fields.gains);
    const auto line = grin_exact::outgoing(index, camera, along);
    if (!line) throw std::runtime_error("fixture " + std::string(id) + ": light that stays in the field");
    return classified(*line);
  }
  std::vector<PowerField> powers;
  for (const FieldSource& field : fields.sources) {
    powers.push_back({field.world_from_local.origin, bending_of(field, fields.gains), field.r_outer, field.a});
  }
  return classified(outgoing50(powers, camera, along));
}

FixtureTruth GrinFixture::classified(const grin_exact::Line& line) const {
  FixtureTruth out{.line = line};
  out.margin = std::numeric_limits<double>::infinity();
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    const Vector to = between(line.point, spheres[k]);
    const double along = dot(to, line.direction);
    const double off = std::sqrt(std::max(0.0, dot(to, to) - along * along));
    if (along <= 0.0) continue;
    out.margin = std::min(out.margin, std::abs(off - sphere_radius));
    if (off >= sphere_radius || along >= nearest) continue;
    nearest = along;
    out.hit = FixtureHit::source;
    out.sphere = static_cast<int>(k);
  }
  if (out.hit == FixtureHit::source) return out;
  // The box by slabs; light comes from the front, z > its front face.
  double enter = 0.0, leave = std::numeric_limits<double>::infinity();
  const Vector centre{0.0, 0.0, backdrop_z};
  for (std::size_t i = 0; i < 3; ++i) {
    const double one = (centre[i] - backdrop_half[i] - line.point[i]) / line.direction[i];
    const double other = (centre[i] + backdrop_half[i] - line.point[i]) / line.direction[i];
    enter = std::max(enter, std::min(one, other));
    leave = std::min(leave, std::max(one, other));
  }
  out.margin = std::min(out.margin, std::abs(leave - enter));
  if (leave > enter) out.hit = FixtureHit::backdrop;
  return out;
}

const std::vector<GrinFixture>& grin_fixtures() {
  static const std::vector<GrinFixture> all = {
      fixture("001", {0.0}, {3.5, 0.0, -3.5}),
      fixture("002", {0.0}, {0.0}),
      fixture("003", {2.0}, {3.5, 0.0, -3.5}),
      fixture("004", {-2.0, 2.0}, {3.5, 0.0, -3.5}),
  };
  return all;
}

}  // namespace xpr
