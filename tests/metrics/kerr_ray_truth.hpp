// The truth for Kerr rays by another route: Taylor series in Mino time of the first integrals in their second-order
// form (smooth through every turning point), order 30, with no root, no elliptic integral and no formula of the closed
// form.
//   u'' = P'(u)/2, c'' = [a^2 - lambda^2 - eta - 2 a^2 c^2] c, and phi', t', affine' as [Carter1968] has them.
// Over any scalar with + - * / and sqrt: Wide (30 digits, fast) for thousands of rays, 50 digits to check Wide itself.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace xpr::kerr_ray_truth {

template <class T>
struct Ray {
  T a, lambda, eta;
  T r0, cosine, sine;
  int radial_sign, polar_sign;
};

template <class T>
struct End {
  bool reached = false;
  T mino = T(0.0), phi = T(0.0), time = T(0.0), affine = T(0.0), cosine = T(0.0), sine = T(0.0);
  int radial_turns = 0, polar_turns = 0;
  double radial_sign = 0.0;
};

constexpr std::size_t order = 30;
template <class T>
using Series = std::array<T, order + 1>;

/// Coefficient k of a product.
template <class T>
T coefficient(const Series<T>& x, const Series<T>& y, std::size_t k) {
  T sum = x[0] * y[k];
  for (std::size_t i = 1; i <= k; ++i) sum = sum + x[i] * y[k - i];
  return sum;
}

/// Coefficient k of 1/x, the lower ones known.
template <class T>
T reciprocal(const Series<T>& x, const Series<T>& inverse, std::size_t k) {
  if (k == 0) return T(1.0) / x[0];
  T sum = x[1] * inverse[k - 1];
  for (std::size_t i = 2; i <= k; ++i) sum = sum + x[i] * inverse[k - i];
  return -(sum / x[0]);
}

template <class T>
struct Expansion {
  Series<T> u{}, c{}, phi_rate{}, time_rate{}, affine_rate{}, inverse_sine_squared{};

  Expansion(const Ray<T>& ray, const T& u0, const T& u_rate, const T& c0, const T& c_rate) {
    const T a2 = ray.a * ray.a, A = a2 - ray.lambda * ray.lambda - ray.eta;
    const T K = ray.eta + (ray.lambda - ray.a) * (ray.lambda - ray.a), C = -(a2 * ray.eta);
    Series<T> u2{}, u3{}, c2{}, c3{}, D{}, inverse_D{}, sine_squared{}, n{}, r{}, r2{}, horizon{};
    u[0] = u0, u[1] = u_rate, c[0] = c0, c[1] = c_rate;
    for (std::size_t k = 0; k <= order; ++k) {
      u2[k] = coefficient(u, u, k), c2[k] = coefficient(c, c, k);
      u3[k] = coefficient(u2, u, k), c3[k] = coefficient(c2, c, k);
      const T one = T(k == 0 ? 1.0 : 0.0);
      D[k] = one - T(2.0) * u[k] + a2 * u2[k];
      n[k] = T(2.0) * one - ray.a * ray.lambda * u[k];
      sine_squared[k] = one - c2[k];
      inverse_D[k] = reciprocal(D, inverse_D, k);
      r[k] = reciprocal(u, r, k);
      r2[k] = coefficient(r, r, k);
      horizon[k] = coefficient(n, inverse_D, k);
      if (static_cast<double>(ray.lambda) != 0.0) {
        inverse_sine_squared[k] = reciprocal(sine_squared, inverse_sine_squared, k);
      }
      phi_rate[k] = ray.a * coefficient(u, horizon, k) + ray.lambda * inverse_sine_squared[k];
      affine_rate[k] = r2[k] + a2 * c2[k];
      time_rate[k] = affine_rate[k] + T(2.0) * r[k] + T(2.0) * horizon[k];
      if (k + 2 > order) continue;
      const T steps = T(static_cast<double>((k + 1) * (k + 2)));
      u[k + 2] = (A * u[k] + T(3.0) * K * u2[k] + T(2.0) * C * u3[k]) / steps;
      c[k + 2] = (A * c[k] - T(2.0) * a2 * c3[k]) / steps;
    }
  }

  /// The longest step whose last terms stay below 1e-26 of the first.
  [[nodiscard]] double step() const {
    double h = 1e300;
    for (const Series<T>* series : {&u, &c, &phi_rate, &time_rate, &affine_rate, &inverse_sine_squared}) {
      double size = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        size = std::max(size, std::abs(static_cast<double>((*series)[k])) * std::pow(0.05, static_cast<double>(k)));
      }
      if (series == &u || series == &c) size = std::max(size, 1e-3);
      for (const std::size_t k : {order - 1, order}) {
        const double last = std::abs(static_cast<double>((*series)[k]));
        if (last > 0.0) h = std::min(h, std::pow(1e-26 * size / last, 1.0 / static_cast<double>(k)));
      }
    }
    return h;
  }
};

template <class T>
T value(const Series<T>& series, const T& h) {
  T sum = series[order];
  for (std::size_t k = order; k-- > 0;) sum = sum * h + series[k];
  return sum;
}

template <class T>
T slope(const Series<T>& series, const T& h) {
  T sum = T(static_cast<double>(order)) * series[order];
  for (std::size_t k = order; k-- > 1;) sum = sum * h + T(static_cast<double>(k)) * series[k];
  return sum;
}

template <class T>
T integral(const Series<T>& series, const T& h) {
  T sum = series[order] / T(static_cast<double>(order + 1));
  for (std::size_t k = order; k-- > 0;) sum = sum * h + series[k] / T(static_cast<double>(k + 1));
  return sum * h;
}

template <class T>
T square_root(const T& x) {
  using std::sqrt;
  return static_cast<double>(x) > 0.0 ? T(sqrt(x)) : T(0.0);
}

/// Followed until r = r_end moving along `end_sign` (of p_r), r_end not the start.
template <class T>
End<T> followed(const Ray<T>& ray, const T& r_end, int end_sign) {
  const T one = T(1.0), a2 = ray.a * ray.a, u_end = one / r_end;
  const T K = ray.eta + (ray.lambda - ray.a) * (ray.lambda - ray.a), A = a2 - ray.lambda * ray.lambda - ray.eta;
  T u = one / ray.r0, c = ray.cosine;
  const T P = one + u * u * (A + u * (T(2.0) * K - u * a2 * ray.eta));
  const T s2 = ray.sine * ray.sine;
  T u_rate = T(-1.0 * ray.radial_sign) * square_root(P);
  const T rate_squared = ray.eta * s2 + c * c * (a2 * s2 - ray.lambda * ray.lambda);
  // A start at a turning point of theta to thirty digits is one.
  const double size =
      static_cast<double>(ray.eta * ray.eta + a2 * a2 + ray.lambda * ray.lambda * ray.lambda * ray.lambda);
  T c_rate = T(0.0);
  if (static_cast<double>(rate_squared) > 0x1p-98 * std::sqrt(size)) {
    c_rate = T(-1.0 * ray.polar_sign) * square_root(rate_squared);
  }
  End<T> end;
  for (int steps = 0; steps < 20000; ++steps) {
    const Expansion<T> y(ray, u, u_rate, c, c_rate);
    T h = T(y.step());
    T next = value(y.u, h), next_rate = slope(y.u, h);
    // What ends before its turning point must not step across it.
    const bool inward = static_cast<double>(u_rate) > 0.0;
    for (int i = 0; i < 60 && inward == (end_sign < 0) && (static_cast<double>(next_rate) > 0.0) != inward; ++i) {
      h = h * T(0.5);
      next = value(y.u, h), next_rate = slope(y.u, h);
    }
    const bool arrives = end_sign > 0
                             ? static_cast<double>(next_rate) < 0.0 && static_cast<double>(next - u_end) <= 0.0
                             : static_cast<double>(next_rate) > 0.0 && static_cast<double>(next - u_end) >= 0.0;
    if (arrives) {
      for (int i = 0; i < 60; ++i) {
        const T change = (next - u_end) / next_rate;
        h = h - change;
        next = value(y.u, h), next_rate = slope(y.u, h);
        if (!(std::abs(static_cast<double>(change)) > 1e-30 * static_cast<double>(h))) break;
      }
    }
    const T next_c = value(y.c, h), next_c_rate = slope(y.c, h);
    end.mino = end.mino + h;
    end.phi = end.phi + integral(y.phi_rate, h);
    end.time = end.time + integral(y.time_rate, h);
    end.affine = end.affine + integral(y.affine_rate, h);
    if (static_cast<double>(u_rate) * static_cast<double>(next_rate) < 0.0) ++end.radial_turns;
    if (static_cast<double>(c_rate) * static_cast<double>(next_c_rate) < 0.0) ++end.polar_turns;
    u = next, u_rate = next_rate, c = next_c, c_rate = next_c_rate;
    if (arrives) {
      end.reached = true;
      break;
    }
    if (static_cast<double>(u) < 0.0 || static_cast<double>(one - T(2.0) * u + a2 * u * u) <= 0.0) break;
  }
  end.cosine = c;
  end.sine = square_root(T(one - c * c));
  return end;
}

}  // namespace xpr::kerr_ray_truth
