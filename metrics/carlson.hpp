// Carlson's R_F, R_D and R_J of the same x, y, z in one duplication, for double and for packs: the three share their
// square roots, which is most of the work, and a pack does several arguments at once.
//   R_F = 1/2 int dt/[s(t)],  R_D = 3/2 int dt/[s(t)(t + z)],  R_J = 3/2 int dt/[s(t)(t + p)] over t > 0,
//   s(t) = sqrt((t + x)(t + y)(t + z))
// 0 <= x <= p <= z <= y with p > 0: what Legendre's integrals need for a negative parameter and 0 <= n <= 1. R_C in the
// duplication of R_J is an arctangent then. Relative error below 1e-15.
// Cites: [Carlson1995]
#pragma once

#include <cmath>

#include "metrics/scalar/elementary.hpp"

namespace xpr::carlson {

template <class T>
struct Integrals {
  T f, d, j;
};

/// R_C(1, 1 + e) = arctan(sqrt e)/sqrt e, e >= 0.
template <MachineScalar T>
[[nodiscard]] constexpr T degenerate(const T& e) {
  // Sixty-four times smaller at every duplication: the series soon serves. 0.02^10 is 1e-17.
  if (all(e < T(0.02))) {
    T sum = T(1.0 / 21.0);
    for (int k = 9; k >= 0; --k) sum = 1.0 / static_cast<double>(2 * k + 1) - e * sum;
    return sum;
  }
  const T root = sqrt(max(e, T(1e-300)));
  return atan2(root, T(1.0)) / root;
}

/// The common tail of R_D and R_J in the elementary symmetric functions of five deviations.
template <MachineScalar T>
[[nodiscard]] constexpr T tail(const T& e2, const T& e3, const T& e4, const T& e5) {
  return 1.0 - 3.0 / 14.0 * e2 + e3 / 6.0 + 9.0 / 88.0 * e2 * e2 - 3.0 / 22.0 * e4 - 9.0 / 52.0 * e2 * e3 +
         3.0 / 26.0 * e5 - e2 * e2 * e2 / 16.0 + 3.0 / 40.0 * e3 * e3 + 3.0 / 20.0 * e2 * e4 +
         45.0 / 272.0 * e2 * e2 * e3 - 9.0 / 68.0 * (e3 * e4 + e2 * e5);
}

template <MachineScalar T>
[[nodiscard]] constexpr Integrals<T> first_second_third(const T& x0, const T& y0, const T& z0, const T& p0) {
  const T mean_f0 = (x0 + y0 + z0) / 3.0, mean_d0 = (x0 + y0 + 3.0 * z0) / 5.0;
  const T mean_j0 = (x0 + y0 + z0 + 2.0 * p0) / 5.0;
  const T delta = (p0 - x0) * (p0 - y0) * (p0 - z0);
  // Deviations below 5e-3 leave 1e-18 of the tails' next order, the eighth.
  const T spread = max(max(abs(mean_d0 - x0), abs(mean_d0 - y0)), max(abs(mean_d0 - z0), abs(mean_j0 - p0)));
  const T needed = 200.0 * max(spread, max(max(abs(mean_j0 - x0), abs(mean_j0 - y0)), abs(mean_j0 - z0)));
  T x = x0, y = y0, z = z0, p = p0, mean_f = mean_f0, mean_d = mean_d0, mean_j = mean_j0;
  T sum_d = T(0.0), sum_j = T(0.0);
  double fourth = 1.0;  // 4^-n
  for (int n = 0; n < 60 && any(needed * fourth > min(mean_d, mean_j)); ++n) {
    const T rx = sqrt(x), ry = sqrt(y), rz = sqrt(z), rp = sqrt(p);
    const T lambda = rx * ry + (rx + ry) * rz;
    const T d = (rp + rx) * (rp + ry) * (rp + rz);
    const T inverse = 1.0 / (d * rz * (z + lambda));  // one division for both sums
    const T inverse_d = inverse * (rz * (z + lambda));
    sum_d += fourth * (inverse * d);
    sum_j += fourth * inverse_d * degenerate(T(fourth * fourth * fourth * delta * inverse_d * inverse_d));
    x = 0.25 * (x + lambda), y = 0.25 * (y + lambda), z = 0.25 * (z + lambda), p = 0.25 * (p + lambda);
    mean_f = 0.25 * (mean_f + lambda), mean_d = 0.25 * (mean_d + lambda), mean_j = 0.25 * (mean_j + lambda);
    fourth *= 0.25;
  }
  Integrals<T> result;
  {
    const T over = fourth / mean_f;
    const T X = (mean_f0 - x0) * over, Y = (mean_f0 - y0) * over, Z = -(X + Y);
    const T e2 = X * Y - Z * Z, e3 = X * Y * Z;
    result.f = (1.0 - e2 / 10.0 + e3 / 14.0 + e2 * e2 / 24.0 - 3.0 / 44.0 * e2 * e3 - 5.0 / 208.0 * e2 * e2 * e2 +
                3.0 / 104.0 * e3 * e3 + e2 * e2 * e3 / 16.0) /
               sqrt(mean_f);
  }
  {
    const T over = fourth / mean_d;
    const T X = (mean_d0 - x0) * over, Y = (mean_d0 - y0) * over, Z = -(X + Y) / 3.0;
    const T e2 = X * Y - 6.0 * Z * Z, e3 = (3.0 * X * Y - 8.0 * Z * Z) * Z;
    const T e4 = 3.0 * (X * Y - Z * Z) * Z * Z, e5 = X * Y * Z * Z * Z;
    result.d = fourth * tail(e2, e3, e4, e5) / (mean_d * sqrt(mean_d)) + 3.0 * sum_d;
  }
  {
    const T over = fourth / mean_j;
    const T X = (mean_j0 - x0) * over, Y = (mean_j0 - y0) * over, Z = (mean_j0 - z0) * over, P = -0.5 * (X + Y + Z);
    const T e2 = X * Y + X * Z + Y * Z - 3.0 * P * P;
    const T e3 = X * Y * Z + 2.0 * e2 * P + 4.0 * P * P * P;
    const T e4 = (2.0 * X * Y * Z + e2 * P + 3.0 * P * P * P) * P, e5 = X * Y * Z * P * P;
    result.j = fourth * tail(e2, e3, e4, e5) / (mean_j * sqrt(mean_j)) + 6.0 * sum_j;
  }
  return result;
}

}  // namespace xpr::carlson
