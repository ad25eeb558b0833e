// The two quadratics of the radial quartic, to some thirty digits.
#include <algorithm>
#include <cmath>

#include "metrics/kerr_radial_exact.hpp"

namespace xpr::kerr_exact {
namespace {

constexpr double wide_epsilon = 0x1p-100;  // a few operations on Wide numbers

/// Largest root S = s^2 = (r3 + r4)^2 of S^3 + 2 A S^2 + (A^2 - 4 C) S - B^2, B > 0, as a start: by the cubic formula.
double resolvent_root(double A, double B, double C) {
  const double third = (A * A + 12.0 * C) / 9.0;
  const double half = A * A * A / 27.0 - 4.0 * A * C / 3.0 + B * B / 2.0;
  const double cube = third * third * third;
  double x;
  if (half * half <= cube) {
    x = 2.0 * std::sqrt(third) * std::cos(std::acos(std::clamp(half / std::sqrt(cube), -1.0, 1.0)) / 3.0);
  } else {
    const double grown = std::cbrt(std::abs(half) + std::sqrt(half * half - cube));
    x = std::copysign(grown + third / grown, half);
  }
  return x - 2.0 * A / 3.0;
}

/// The same where the cubic formula cancels (rays close to a principal one): Newton's rule from above the root, where
/// the cubic is convex and the iteration cannot overshoot.
double small_resolvent_root(const Wide& A, const Wide& B, const Wide& C) {
  const Wide linear = A * A - scaled(C, 4.0), constant = B * B;
  // Above the largest root every term with a negative coefficient is outweighed.
  const double a2 = std::abs(2.0 * A.high), a1 = std::sqrt(std::abs(linear.high)), a0 = std::cbrt(constant.high);
  Wide S = 2.0 * std::max({A.high < 0.0 ? a2 : 0.0, linear.high < 0.0 ? a1 : 0.0, a0});
  for (int i = 0; i < 200; ++i) {
    const Wide value = ((S + scaled(A, 2.0)) * S + linear) * S - constant;
    const Wide slope = (Wide(3.0) * S + scaled(A, 4.0)) * S + linear;
    if (!(slope.high > 0.0)) break;
    const Wide step = value / slope;
    S = S - step;
    if (!(std::abs(step.high) > 1e-14 * S.high)) break;
  }
  return S.high;
}

struct Quadratics {
  Wide s, p, q;
};

/// Newton's rule on p + q - s^2 = A, s (p - q) = B, p q = C with Wide residuals: two steps square the error twice.
Quadratics polished(const Wide& A, const Wide& B, const Wide& C, double s_start) {
  const double S = s_start * s_start;
  Quadratics f{s_start, 0.5 * (A.high + S + B.high / s_start), 0.5 * (A.high + S - B.high / s_start)};
  // The smaller of p and q cancels; their product does not.
  if (std::abs(f.p.high) > std::abs(f.q.high)) {
    f.q = C.high / f.p.high;
  } else if (f.q.high != 0.0) {
    f.p = C.high / f.q.high;
  }
  for (int i = 0; i < 12; ++i) {
    const double e1 = static_cast<double>(f.p + f.q - f.s * f.s - A);
    const double e2 = static_cast<double>(f.s * (f.p - f.q) - B);
    const double e3 = static_cast<double>(f.p * f.q - C);
    const double s = f.s.high, sum = f.p.high + f.q.high, difference = f.p.high - f.q.high;
    const double determinant = sum * s + difference * difference / (2.0 * s);
    if (determinant == 0.0) break;
    const double ds = (-e3 + 0.5 * sum * e1 - difference * e2 / (2.0 * s)) / determinant;
    const double d_sum = 2.0 * s * ds - e1, d_difference = (-e2 - difference * ds) / s;
    f.s = f.s + Wide(ds);
    f.p = f.p + Wide(0.5 * (d_sum + d_difference));
    f.q = f.q + Wide(0.5 * (d_sum - d_difference));
    // The step after this one would be its square.
    if (std::abs(ds) < 1e-15 * std::abs(s) && std::abs(d_sum) + std::abs(d_difference) < 1e-15 * (std::abs(sum) + S)) {
      break;
    }
  }
  return f;
}

}  // namespace

RadialMotion::RadialMotion(const UnitConstants& given) : constants(given) {
  const Wide one = 1.0;
  const Wide wide_K = given.eta + (given.lambda - given.spin) * (given.lambda - given.spin);
  const Wide wide_A = given.spin * given.spin - given.lambda * given.lambda - given.eta;
  const Wide wide_B = scaled(wide_K, 2.0), wide_C = -(given.spin * given.spin * given.eta);
  a = static_cast<double>(given.spin), lambda = static_cast<double>(given.lambda);
  A = static_cast<double>(wide_A), B = static_cast<double>(wide_B), C = static_cast<double>(wide_C);
  K = static_cast<double>(wide_K);
  horizon_gap = sqrt((one - given.spin) * (one + given.spin));
  // K = 0 is the principal null ray alone: its R is the square (r^2 + a^2 - a lambda)^2.
  const double size = std::abs(given.eta.high) + given.lambda.high * given.lambda.high + a * a;
  if (!(K > 1e-28 * size)) {
    const Wide square = given.spin * (given.spin - given.lambda);
    s = 0.0, p = square, q = square;
    quarter_gap = -square;
    kind = square.high > 0.0 ? PairKind::complex_pair : PairKind::straight;
    return;
  }
  double S = resolvent_root(A, B, C);
  if (!(S > 1e-2 * std::abs(A))) S = small_resolvent_root(wide_A, wide_B, wide_C);
  const Quadratics f = polished(wide_A, wide_B, wide_C, std::sqrt(S));
  s = f.s, p = f.p, q = f.q;
  quarter_gap = scaled(s * s, 0.25) - p;
  const double gap = std::abs(quarter_gap.high), middle = 0.5 * s.high;
  gap_error = wide_epsilon * (middle * middle + std::abs(p.high)) / gap;
  const bool beyond_horizon = above_outer_horizon(scaled(s, 0.5)) > 0.0;
  spherical = !(gap_error < 0.25) && beyond_horizon;
  kind = quarter_gap.high > 0.0 || spherical ? PairKind::real_pair : PairKind::complex_pair;
  if (kind == PairKind::real_pair) {
    // Where the pair has merged any tiny gap serves: nothing passes it.
    const Wide half_gap = spherical ? Wide(1e-18 * middle) : sqrt(quarter_gap);
    r4 = scaled(s, 0.5) + half_gap;
    r3 = scaled(s, 0.5) - half_gap;
    turns_outside = beyond_horizon;
  }
  const Wide far_gap = scaled(s * s, 0.25) - q;
  far_roots_real = far_gap.high >= 0.0;
  if (far_roots_real) {
    r1 = -scaled(s, 0.5) - sqrt(far_gap);
    r2 = q / r1;
  }
}

double RadialMotion::potential(const Wide& r) const {
  const Wide u = Wide(1.0) / r;
  const Wide one = 1.0;
  const double near = kind == PairKind::real_pair ? static_cast<double>((one - r4 * u) * (one - r3 * u))
                                                  : static_cast<double>(one - s * u + p * u * u);
  return near * static_cast<double>(one + s * u + q * u * u);
}

RadialSums& RadialSums::operator+=(const RadialSums& other) {
  mino += other.mino, azimuth += other.azimuth, time += other.time, affine += other.affine;
  mino_error += other.mino_error, azimuth_error += other.azimuth_error;
  time_error += other.time_error, affine_error += other.affine_error;
  return *this;
}

}  // namespace xpr::kerr_exact
