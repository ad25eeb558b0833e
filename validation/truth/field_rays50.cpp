#include "validation/truth/field_rays50.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "validation/truth/fifty_digits.hpp"

namespace xpr {

namespace {

using State = std::vector<Real50>;  ///< x, y, z, p_x, p_y, p_z

/// |x - c|^2 - R^2
Real50 depth(const PowerField& field, const State& y) {
  Real50 sum = -square(Real50(field.r_outer));
  for (std::size_t i = 0; i < 3; ++i) sum += square(Real50(y[i] - field.centre[i]));
  return sum;
}

/// dx = p, dp = n^2 grad ln n: H = (p^2 - n^2)/2.
void rates(std::span<const PowerField> fields, const State& y, State& rate) {
  Real50 log_index = 0;
  std::array<Real50, 3> pull{0, 0, 0};
  for (const PowerField& field : fields) {
    const Real50 R = field.r_outer, r_squared = depth(field, y) + square(R);
    if (r_squared >= square(R)) continue;
    const Real50 r = sqrt(r_squared), w = 1 - r / R;
    const Real50 f = pow(w, Real50(field.power));
    log_index += field.bending * R * w * f / (Real50(field.power) + 1);
    for (std::size_t i = 0; i < 3; ++i) pull[i] -= field.bending * f * (y[i] - field.centre[i]) / r;
  }
  const Real50 n_squared = exp(2 * log_index);
  for (std::size_t i = 0; i < 3; ++i) {
    rate[i] = y[i + 3];
    rate[i + 3] = n_squared * pull[i];
  }
}

/// The distance along p, a unit vector, at which a straight ray meets the first rim; negative where it meets none.
Real50 way_to_first_rim(std::span<const PowerField> fields, const State& y) {
  Real50 first = -1;
  for (const PowerField& field : fields) {
    Real50 along = 0;
    for (std::size_t i = 0; i < 3; ++i) along += (field.centre[i] - y[i]) * y[i + 3];
    const Real50 discriminant = square(along) - depth(field, y);
    if (!(along > 0 && discriminant > 0)) continue;
    const Real50 way = along - sqrt(discriminant);
    // A rim that the ray is on, it has just left.
    if (way > 1e-15 && (first < 0 || way < first)) first = way;
  }
  return first;
}

}  // namespace

grin_exact::Line outgoing50(std::span<const PowerField> fields, const std::array<double, 3>& from,
                            const std::array<double, 3>& direction, double tol) {
  State y(6);
  Real50 norm = 0;
  for (const double d : direction) norm += square(Real50(d));
  for (std::size_t i = 0; i < 3; ++i) {
    y[i] = from[i];
    y[i + 3] = direction[i] / sqrt(norm);
  }
  double largest = 0.0;
  for (const PowerField& field : fields) largest = std::max(largest, field.r_outer);
  const auto flow = [&](const State& at, State& rate) { rates(fields, at, rate); };
  // Below zero inside any of them. Rims that are crossed within cost short steps, which the tolerance asks for.
  const auto outside = [&](const State& at) {
    Real50 least = depth(fields.front(), at);
    for (const PowerField& field : fields.subspan(1)) least = std::min<Real50>(least, depth(field, at));
    return least;
  };
  const ExtrapolationSettings settings{.columns = 7, .tol = tol};
  // So short that no rim is grazed between two looks at the fields by more than 1e-12 of bending.
  const Real50 piece = 0.02 * largest;
  for (Real50 way = way_to_first_rim(fields, y); way >= 0; way = way_to_first_rim(fields, y)) {
    for (std::size_t i = 0; i < 3; ++i) y[i] += way * y[i + 3];
    State next = integrate50(flow, y, piece, settings).y;
    for (int pieces = 0; outside(next) < 0; ++pieces) {
      if (pieces == 5000) throw std::runtime_error("50 digits: light that does not leave the fields");
      y = std::move(next);
      next = integrate50(flow, y, piece, settings).y;
    }
    y = integrate50_to(flow, y, outside, 1, Real50(piece / 8), Real50(2 * piece), settings).y;
  }
  norm = 0;
  for (std::size_t i = 3; i < 6; ++i) norm += square(y[i]);
  grin_exact::Line out{};
  for (std::size_t i = 0; i < 3; ++i) {
    out.point[i] = static_cast<double>(y[i]);
    out.direction[i] = static_cast<double>(Real50(y[i + 3] / sqrt(norm)));
  }
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  out.direction_error = epsilon + 1e4 * tol;
  out.point_error = epsilon * std::hypot(out.point[0], out.point[1], out.point[2]) + 1e4 * tol;
  return out;
}

}  // namespace xpr
