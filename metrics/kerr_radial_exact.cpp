// The integrals along r. Their poles at infinity and at the two horizons are split off exactly:
//   r^2 dtau            = du/u^2 - (A + B u + C u^2)/(1 + sqrt P) dtau
//   (2 r - a lambda) r/Delta dtau = n/D dtau = c/D du + E/(n + c sqrt P) dtau,     |du| = sqrt P dtau,
//   n = 2 - a lambda u,  c = 2 - a^2 u,  E = u [a (a - lambda)(n + c (D + u n)) + u c^2 K]
// (n^2 - c^2 P is E D). What stays is smooth, and is summed by Gauss-Legendre in the variable y that takes the square
// roots of the pair r3, r4 away: u = u_turn -+ g sinh^2 y, or rho + sigma sinh y. So nothing cancels as a -> M, at the
// horizon, far away or next to the critical curve. tau itself is Carlson's R_F wherever the ray turns.
#include "metrics/kerr_radial_exact.hpp"

#include <GeographicLib/EllipticFunction.hpp>
#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <complex>
#include <limits>

#include "metrics/scalar/elementary.hpp"
#include "metrics/scalar/pack.hpp"

namespace xpr::kerr_exact {
namespace {

using Rule = boost::math::quadrature::gauss<double, 20>;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

// A panel of 20 nodes leaves rho^-40 of an analytic integrand, rho the sum of the half-axes of the ellipse about the
// panel that reaches its nearest singularity: 1e-17 for rho = 2.66, that is for a panel no longer than 3.8 times the
// distance of a singularity on the line beyond its end, or 2.7 where it stands pi/2 aside.
constexpr double longest_over_distance = 3.8;
constexpr double longest_panel = 2.7;

using Lanes = Pack<4>;

/// sinh w for w >= 0, to the last digits of small w too.
Lanes sinh_of(const Lanes& w) {
  const Lanes x = w * w;  // the series to w^17/17! leaves 1e-20 of w at 0.5
  const Lanes small =
      w *
      (1.0 + x * (1.0 / 6.0) *
                 (1.0 + x * (1.0 / 20.0) *
                            (1.0 + x * (1.0 / 42.0) *
                                       (1.0 + x * (1.0 / 72.0) *
                                                  (1.0 + x * (1.0 / 110.0) *
                                                             (1.0 + x * (1.0 / 156.0) * (1.0 + x * (1.0 / 210.0))))))));
  if (all(w <= Lanes(0.5))) return small;
  const Lanes grown = exp(w);
  return select(w > Lanes(0.5), 0.5 * (grown - 1.0 / grown), small);
}

/// asinh(to) - asinh(from) for to - from = change, without the cancellation.
double asinh_difference(double from, double to, double change) {
  const double grown_from = std::sqrt(1.0 + to * to) * from, grown_to = std::sqrt(1.0 + from * from) * to;
  return std::asinh(from * to > 0.0 ? change * (from + to) / (grown_to + grown_from) : grown_to - grown_from);
}

/// One monotonic stretch in the smooth variable: u and sqrt P at distance w from its base.
struct Stretch {
  PairKind kind;
  double u_base;
  double y_base;
  double side;           ///< the sign of u - u_base
  double size;           ///< g, or sigma
  double length;         ///< in w
  double before, after;  ///< distances of the nearest singularities beyond its two ends
  bool subtract_horizons;
  // At the base, since all of them may be tiny together next to an extremal horizon: 1 - r+ u, 1 - r- u, n, and where
  // r1 and r2 are real 1 - r1 u and 1 - r2 u.
  double outer_factor = 1.0, inner_factor = 1.0, n = 2.0, factor1 = 1.0, factor2 = 1.0;
  double sinh_twice_base = 0.0, cosh_twice_base = 1.0, exp_base = 1.0;  ///< of y_base

  /// u - u_base, and |du/dy|, which is sqrt P over the square root of the rest.
  struct Place {
    Lanes offset, slope;
  };
  [[nodiscard]] Place at(const Lanes& w) const {
    if (kind == PairKind::straight) return {side * w, 1.0};
    if (kind == PairKind::real_pair) {
      // From sinh w alone: sinh(2 y_base + w) and sinh(2 y_base + 2 w) are sums of positive terms.
      const Lanes sine = sinh_of(w), cosine = sqrt(1.0 + sine * sine);
      return {side * size * sine * (sinh_twice_base * cosine + cosh_twice_base * sine),
              size * (sinh_twice_base * (1.0 + 2.0 * sine * sine) + 2.0 * cosh_twice_base * sine * cosine)};
    }
    const Lanes middle = exp_base * exp(Lanes(0.5 * side * w)), end = middle * middle * (1.0 / exp_base);
    return {side * size * (middle + 1.0 / middle) * sinh_of(0.5 * w), 0.5 * size * (end + 1.0 / end)};
  }
};

/// Integrals over tau of 1, X, u X, Y, u Y; X and Y as in the head of this file.
struct Sums {
  double tau = 0.0, x = 0.0, ux = 0.0, y = 0.0, uy = 0.0;
};

/// The rule's nodes and weights on (-1, 1), all of them.
struct Nodes {
  std::array<double, 20> node, weight;

  Nodes() {
    for (std::size_t i = 0; i < 10; ++i) {
      node[i] = -Rule::abscissa()[i], node[10 + i] = Rule::abscissa()[i];
      weight[i] = weight[10 + i] = Rule::weights()[i];
    }
  }
};

double sum_of_lanes(const Lanes& x) { return (lane(x, 0) + lane(x, 1)) + (lane(x, 2) + lane(x, 3)); }

Sums over_panel(const RadialMotion& m, const Stretch& stretch, double from, double to) {
  static const Nodes rule;
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  const double s = static_cast<double>(m.s), q = static_cast<double>(m.q);
  const double r1 = static_cast<double>(m.r1), r2 = static_cast<double>(m.r2);
  const double r_outer = m.outer_horizon(), r_inner = m.a * m.a / r_outer, a_squared = m.a * m.a;
  // du = slope dy and f = p (slope/2)^2 for a real pair, p slope^2 for a conjugate one.
  const double lead = stretch.kind == PairKind::straight    ? 1.0
                      : stretch.kind == PairKind::real_pair ? 0.25 * static_cast<double>(m.p)
                                                            : static_cast<double>(m.p);
  Lanes tau = 0.0, sum_x = 0.0, sum_ux = 0.0, sum_y = 0.0, sum_uy = 0.0;
  for (std::size_t i = 0; i < rule.node.size(); i += 4) {
    const auto [offset, slope] = stretch.at(middle + half * Lanes::load(&rule.node[i]));
    const Lanes u = stretch.u_base + offset;
    const Lanes other =
        m.far_roots_real ? (stretch.factor1 - r1 * offset) * (stretch.factor2 - r2 * offset) : 1.0 + u * (s + u * q);
    const Lanes rest = sqrt(lead * other), root_P = slope * rest;
    const Lanes dtau = half * Lanes::load(&rule.weight[i]) / rest;
    const Lanes D = (stretch.outer_factor - r_outer * offset) * (stretch.inner_factor - r_inner * offset);
    const Lanes n = stretch.n - m.a * m.lambda * offset;
    const Lanes x = dtau * (m.A + u * (m.B + u * m.C)) / (1.0 + root_P);
    Lanes y = dtau * n / D;
    if (stretch.subtract_horizons) {
      const Lanes c = 2.0 - a_squared * u;
      const Lanes E = u * (m.a * (m.a - m.lambda) * (n + c * (D + u * n)) + u * c * c * m.K);
      y = dtau * E / (n + c * root_P);
    }
    tau += dtau, sum_x += x, sum_ux += u * x, sum_y += y, sum_uy += u * y;
  }
  return {sum_of_lanes(tau), sum_of_lanes(sum_x), sum_of_lanes(sum_ux), sum_of_lanes(sum_y), sum_of_lanes(sum_uy)};
}

Sums over_stretch(const RadialMotion& m, const Stretch& stretch) {
  Sums total;
  double from = 0.0, to = stretch.length;
  const auto add = [&](double low, double high) {
    const Sums part = over_panel(m, stretch, low, high);
    total.tau += part.tau, total.x += part.x, total.ux += part.ux, total.y += part.y, total.uy += part.uy;
  };
  const auto longest = [](double distance) { return std::min(longest_over_distance * distance, longest_panel); };
  while (to > from) {
    const double left = longest(stretch.before + from), right = longest(stretch.after + stretch.length - to);
    const double rest = to - from;
    if (rest <= std::min(left, right)) {
      add(from, to);
      break;
    }
    if (left <= right) {
      add(from, from + std::min(left, 0.5 * rest));
      from += std::min(left, 0.5 * rest);
    } else {
      add(to - std::min(right, 0.5 * rest), to);
      to -= std::min(right, 0.5 * rest);
    }
  }
  return total;
}

/// Notes how far the roots of 1 + s u + q u^2 lie beyond the stretch, in its variable, for a base at sinh y = `lift`.
/// Those aside of the line stand pi/2 away and more, but for light near the axis of a hole (no real roots at all).
void set_far_roots(const RadialMotion& m, Stretch& stretch, double lift) {
  const auto note = [&](double before, double after) {
    stretch.before = std::min(stretch.before, before);
    stretch.after = std::min(stretch.after, after);
  };
  if (!m.far_roots_real) {
    const double s = static_cast<double>(m.s), q = static_cast<double>(m.q);
    const std::complex<double> root = std::complex<double>(-0.5 * s, std::sqrt(q - 0.25 * s * s)) / q;
    const std::complex<double> w =
        stretch.side * (std::asinh(lift + (root - stretch.u_base) / stretch.size) - stretch.y_base);
    note(std::hypot(std::min(w.real(), 0.0), w.imag()), std::hypot(std::max(w.real() - stretch.length, 0.0), w.imag()));
    return;
  }
  for (const double r : {static_cast<double>(m.r1), static_cast<double>(m.r2)}) {
    if (r == 0.0) continue;
    double place = (1.0 / r - stretch.u_base) / stretch.size;
    if (stretch.kind == PairKind::real_pair) {
      place = stretch.side * place + lift * lift;
      if (place <= 0.0) continue;
      place = std::sqrt(place);
    } else {
      place += lift;
    }
    const double w = (stretch.kind == PairKind::real_pair ? 1.0 : stretch.side) * (std::asinh(place) - stretch.y_base);
    if (w > 0.5 * stretch.length) {
      note(stretch.before, w - stretch.length);
    } else {
      note(-w, stretch.after);
    }
  }
}

void set_base(const RadialMotion& m, Stretch& stretch, const Wide& r_base) {
  const double r = static_cast<double>(r_base);
  stretch.u_base = 1.0 / r;
  stretch.outer_factor = m.above_outer_horizon(r_base) / r;
  stretch.inner_factor = m.above_inner_horizon(r_base) / r;
  stretch.n = static_cast<double>(Wide(2.0) - m.constants.spin * m.constants.lambda / r_base);
  if (m.far_roots_real) {
    stretch.factor1 = static_cast<double>(r_base - m.r1) / r;
    stretch.factor2 = static_cast<double>(r_base - m.r2) / r;
  }
}

/// The stretch between two radii on one side of a real pair; its base is the end next to the turning point.
Stretch beside_pair(const RadialMotion& m, const Wide& r_far, const Wide& r_near, bool outside) {
  const Wide& r_base = outside ? r_near : r_far;
  const Wide& turn = outside ? m.r4 : m.r3;
  const double gap = static_cast<double>(m.r4 - m.r3) / static_cast<double>(m.p);
  const double base_offset = static_cast<double>(r_base - turn) / static_cast<double>(r_base * turn);
  const double change = static_cast<double>(r_far - r_near) / static_cast<double>(r_far * r_near);
  const double lift = std::sqrt(std::max(std::abs(base_offset), 0.0) / gap);
  const double y_base = std::asinh(lift), y_end = std::asinh(std::sqrt((std::abs(base_offset) + change) / gap));
  const bool subtract = !(outside && m.turns_outside);
  Stretch stretch{.kind = PairKind::real_pair,
                  .u_base = 0.0,
                  .y_base = y_base,
                  .side = outside ? -1.0 : 1.0,
                  .size = gap,
                  .length = std::asinh(change / (gap * std::sinh(y_end + y_base))),
                  .before = y_base + y_end,
                  .after = 1e300,
                  .subtract_horizons = subtract};
  set_base(m, stretch, r_base);
  stretch.sinh_twice_base = 2.0 * lift * std::sqrt(1.0 + lift * lift);
  stretch.cosh_twice_base = 1.0 + 2.0 * lift * lift;
  if (subtract) {  // n + c sqrt P has a zero where sqrt P is negative, beyond the turning point
    const double u = stretch.u_base, s = static_cast<double>(m.s), q = static_cast<double>(m.q);
    const double rest = std::sqrt(static_cast<double>(m.p) * (1.0 + u * (s + u * q)));
    const double ratio = stretch.n / (2.0 - m.a * m.a * u);
    stretch.before = std::min(stretch.before, y_base + 0.5 * std::asinh(2.0 * ratio / (gap * rest)));
  }
  set_far_roots(m, stretch, lift);
  return stretch;
}

/// The stretch between two radii where no root is in the way; its base is the near end.
Stretch across(const RadialMotion& m, const Wide& r_far, const Wide& r_near) {
  const double change = static_cast<double>(r_far - r_near) / static_cast<double>(r_far * r_near);
  Stretch stretch{.kind = m.kind,
                  .u_base = 0.0,
                  .y_base = 0.0,
                  .side = -1.0,
                  .size = 1.0,
                  .length = change,
                  .before = 1e300,
                  .after = 1e300,
                  .subtract_horizons = true};
  set_base(m, stretch, r_near);
  if (m.kind == PairKind::straight) return stretch;
  const double sigma = std::sqrt(-static_cast<double>(m.quarter_gap)) / static_cast<double>(m.p);
  const double lift = (stretch.u_base - 0.5 * static_cast<double>(m.s / m.p)) / sigma;
  stretch.size = sigma;
  stretch.y_base = std::asinh(lift);
  stretch.exp_base = std::exp(stretch.y_base);
  stretch.length = asinh_difference(lift - change / sigma, lift, change / sigma);
  set_far_roots(m, stretch, lift);
  return stretch;
}

/// d/dtau of the sums where the ray is slowest: at the base next to a real pair, above the middle of a conjugate one.
struct SlowRates {
  double azimuth, time, affine;
};

SlowRates slow_rates(const RadialMotion& m, const Stretch& stretch, const Wide& r_far) {
  double offset = 0.0;
  if (stretch.kind == PairKind::complex_pair) {
    const double slowest = 0.5 * static_cast<double>(m.s / m.p);
    offset = std::clamp(slowest, 1.0 / static_cast<double>(r_far), stretch.u_base) - stretch.u_base;
  }
  const double r_outer = m.outer_horizon(), u = stretch.u_base + offset;
  const double D = (stretch.outer_factor - r_outer * offset) * (stretch.inner_factor - m.a * m.a / r_outer * offset);
  const double horizon = std::abs((stretch.n - m.a * m.lambda * offset) / D);
  return {m.a * u * horizon, (1.0 / u + 2.0) / u + 2.0 * horizon, 1.0 / (u * u)};
}

/// Sums and their elementary parts, from r_far to r_near.
RadialSums assembled(const RadialMotion& m, const Stretch& stretch, const Wide& r_far, const Wide& r_near) {
  const Sums sums = over_stretch(m, stretch);
  const double fall = static_cast<double>(r_far - r_near);
  const double logarithm = std::log1p(fall / static_cast<double>(r_near));
  RadialSums result;
  result.mino = sums.tau;
  result.affine = fall - sums.x;
  result.time = result.affine + 2.0 * (logarithm - sums.ux) + 2.0 * sums.y;
  result.azimuth = m.a * sums.uy;
  double horizon_part = 0.0;
  if (stretch.subtract_horizons) {
    const double w = static_cast<double>(m.horizon_gap);
    const double near_outer = m.above_outer_horizon(r_near), near_inner = m.above_inner_horizon(r_near);
    const double far_inner = m.above_inner_horizon(r_far);
    const double x = fall / (near_outer * far_inner);
    const double over_D = w * x < 1e-300 ? x : std::log1p(2.0 * w * x) / (2.0 * w);
    const double change_of_u = fall / static_cast<double>(r_far * r_near);
    // ln of D at the near end over D at the far end.
    const double D_ratio = 2.0 * logarithm - std::log1p(fall / near_outer) - std::log1p(fall / near_inner);
    const double c_over_D = over_D - 0.5 * D_ratio;
    result.time += 2.0 * c_over_D;
    result.azimuth += m.a * (over_D - change_of_u);
    horizon_part = std::abs(over_D) + std::abs(D_ratio);
  }
  // Each sum has some 20 ... 100 terms of one sign nearly always; its rounding grows as the root of their number.
  constexpr double rounding = 16.0 * epsilon;
  // A change of the pair's gap lengthens or shortens the stay next to it, by half its relative size.
  const double p = std::abs(static_cast<double>(m.p));
  const double stay = p > 0.0 ? m.gap_error / std::sqrt(p) : 0.0;
  const SlowRates rates = slow_rates(m, stretch, r_far);
  result.mino_error = rounding * sums.tau + stay;
  result.affine_error = rounding * (fall + std::abs(sums.x)) + stay * rates.affine;
  result.time_error =
      rounding * (fall + std::abs(sums.x) + 2.0 * (logarithm + std::abs(sums.ux) + std::abs(sums.y) + horizon_part)) +
      stay * rates.time;
  result.azimuth_error = rounding * m.a * (std::abs(sums.uy) + horizon_part) + stay * rates.azimuth;
  return result;
}

/// tau from the turning point to r by one R_F.
double mino_from_turn(const RadialMotion& m, const Wide& r, bool outside) {
  const Wide& turn = outside ? m.r4 : m.r3;
  const double gap = static_cast<double>(m.r4 - m.r3) / static_cast<double>(m.p);
  const double offset = std::abs(static_cast<double>(r - turn)) / static_cast<double>(r * turn);
  // 1 - r1 u and 1 - r2 u at r, and there.
  const double here1 = static_cast<double>(r - m.r1) / static_cast<double>(r);
  const double here2 = static_cast<double>(r - m.r2) / static_cast<double>(r);
  const double turn1 = static_cast<double>(turn - m.r1) / static_cast<double>(turn);
  const double turn2 = static_cast<double>(turn - m.r2) / static_cast<double>(turn);
  return 2.0 * std::sqrt(offset / (static_cast<double>(m.p) * gap * turn1 * turn2)) *
         GeographicLib::EllipticFunction::RF(1.0 + offset / gap, here1 / turn1, here2 / turn2);
}

}  // namespace

RadialSums leg_to_turn(const RadialMotion& motion, const Wide& r) {
  const bool outside = static_cast<double>(r) > 0.5 * static_cast<double>(motion.s);
  const Wide& turn = outside ? motion.r4 : motion.r3;
  const Wide& far = outside ? r : turn;
  const Wide& near = outside ? turn : r;
  if (!(static_cast<double>(far - near) > 0.0)) return {};
  RadialSums sums = assembled(motion, beside_pair(motion, far, near, outside), far, near);
  const double tau = mino_from_turn(motion, r, outside);
  sums.mino_error += std::abs(tau - sums.mino);
  sums.mino = tau;
  return sums;
}

RadialSums straight_leg(const RadialMotion& motion, const Wide& r_far, const Wide& r_near) {
  if (!(static_cast<double>(r_far - r_near) > 0.0)) return {};
  if (motion.kind != PairKind::real_pair) {
    return assembled(motion, across(motion, r_far, r_near), r_far, r_near);
  }
  const bool outside = !motion.turns_outside || static_cast<double>(r_near) > 0.5 * static_cast<double>(motion.s);
  return assembled(motion, beside_pair(motion, r_far, r_near, outside), r_far, r_near);
}

}  // namespace xpr::kerr_exact
