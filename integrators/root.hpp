// Roots and dips of a function of one variable inside a bracket: how events are located. Only + - x / : the same bits
// everywhere.
#pragma once

namespace xpr {

/// A root of f in [a, b], given fa = f(a) and fb = f(b) of opposite signs, by Chandrupatla's combination of bisection
/// and inverse quadratic interpolation. The bracket shrinks to 4 units in the last place of the root, or f vanishes.
/// Cites: [Chandrupatla1997]
template <class F>
[[nodiscard]] double bracketed_root(const F& f, double a, double b, double fa, double fb) {
  const auto magnitude = [](double v) { return v < 0.0 ? -v : v; };
  constexpr double relative_width = 8.9e-16;  // 4 units in the last place of a double
  if (fa == 0.0) return a;
  if (fb == 0.0) return b;
  // x1 is the newest point, (x1, x2) brackets the root, x3 is the point that x1 or x2 replaced.
  double x1 = b, x2 = a, x3 = a;
  double f1 = fb, f2 = fa, f3 = fa;
  double t = 0.5;
  for (int iteration = 0; iteration < 200; ++iteration) {
    const double x = x1 + t * (x2 - x1);
    const double fx = f(x);
    if ((fx < 0.0) == (f1 < 0.0)) {
      x3 = x1;
      f3 = f1;
    } else {
      x3 = x2;
      f3 = f2;
      x2 = x1;
      f2 = f1;
    }
    x1 = x;
    f1 = fx;
    const bool first_is_better = magnitude(f1) < magnitude(f2);
    const double best = first_is_better ? x1 : x2;
    const double least_move = 0.5 * relative_width * magnitude(best) / magnitude(x2 - x1);
    if (least_move > 0.5 || f1 == 0.0 || !(f1 == f1)) return f1 == 0.0 ? x1 : best;
    const double xi = (x1 - x2) / (x3 - x2);
    const double phi = (f1 - f2) / (f3 - f2);
    t = 0.5;
    if (phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi) {
      t = f1 / (f2 - f1) * f3 / (f2 - f3) + (x3 - x1) / (x2 - x1) * f1 / (f3 - f1) * f2 / (f3 - f2);
    }
    if (!(t > least_move)) t = least_move;
    if (t > 1.0 - least_move) t = 1.0 - least_move;
  }
  return x1;
}

/// Follows f > 0 down to its minimum in [a, b] by golden section and stops at the first point where f <= 0: returns
/// that point, or a value below a if f stays positive. f is taken to have one minimum there.
template <class F>
[[nodiscard]] double dip_below_zero(const F& f, double a, double b) {
  constexpr double golden = 0.61803398874989485;
  const double none = a - 1.0;
  double left = a, right = b;
  double x1 = right - golden * (right - left), x2 = left + golden * (right - left);
  double f1 = f(x1), f2 = f(x2);
  // Where f = 0 is only touched, sqrt(eps) of the bracket is as near as values of f can tell; a few steps more are
  // free.
  for (int iteration = 0; iteration < 60; ++iteration) {
    if (f1 <= 0.0) return x1;
    if (f2 <= 0.0) return x2;
    if (f1 < f2) {
      right = x2;
      x2 = x1;
      f2 = f1;
      x1 = right - golden * (right - left);
      f1 = f(x1);
    } else {
      left = x1;
      x1 = x2;
      f1 = f2;
      x2 = left + golden * (right - left);
      f2 = f(x2);
    }
  }
  return none;
}

}  // namespace xpr
