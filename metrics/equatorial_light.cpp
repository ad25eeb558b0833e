#include "metrics/equatorial_light.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <boost/math/constants/constants.hpp>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <boost/math/special_functions/ellint_rj.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace xpr::equatorial_light {
namespace {

using Long = long double;

const Quad quad_epsilon = std::numeric_limits<Quad>::epsilon();

template <class T>
T square(const T& x) {
  return x * x;
}

// phi lies in (0, pi/3]; eps = pi/3 - phi goes to 0 at the critical ray. Each from an arctangent of its own.
void set_three_real_roots(Ray& ray) {
  const Quad third_of_pi = boost::math::constants::third_pi<Quad>();
  const Quad x = ray.s / ray.d;
  const Quad excess = sqrt((ray.s * square(ray.s) / ray.d - 27) / 27);
  const Quad phi = 2 * atan(1 / excess) / 3;
  const Quad eps = 2 * atan(excess) / 3;
  const Quad half_sine = 2 * x * sin(phi / 2) / 3;
  ray.u1 = -half_sine * sin(phi / 2 + 2 * third_of_pi);
  ray.u2 = half_sine * sin(2 * third_of_pi - phi / 2);
  ray.gap = x * sin(eps) / sqrt(Quad(3));
}

void set_one_real_root(Ray& ray) {
  const Quad x = ray.s / ray.d;
  if (x == 0) {
    const Quad q = 1 / cbrt(2 * square(ray.d));
    ray.u1 = -q;
    ray.rho = q / 2;
    ray.sigma = q * sqrt(Quad(3)) / 2;
    return;
  }
  const Quad ratio = 27 * ray.d / (ray.s * square(ray.s));  // 27 / b_eff^2; negative where |b| < |a|
  const bool positive = x > 0;
  const Quad w =
      2 * asinh(sqrt(positive ? Quad((27 * ray.d - ray.s * square(ray.s)) / (ray.s * square(ray.s))) : Quad(-ratio))) /
      3;
  const Quad size = abs(x) / 6;
  ray.u1 = -size * (positive ? Quad(2 * cosh(w) - 1) : Quad(2 * cosh(w) + 1));
  ray.rho = size * (positive ? Quad(cosh(w) + 1) : Quad(2 * square(sinh(w / 2))));
  ray.sigma = size * sqrt(Quad(3)) * sinh(w);
}

/// One stretch along which u grows, from `low` to `high` <= u2.
struct Stretch {
  Quad low;
  Quad high;
};

enum class Integrand { angle, time };

struct Panels {
  Long value;
  Long error;
};

// 30-point Gauss-Legendre on equal panels over [0, length], doubled until a doubling moves the sum by less than 2^-58
// of the integral of |f|, far below the rounding of a double; that last move bounds what is left. No more than 12
// doublings: the error says so if they were not enough.
template <class F>
Panels by_panels(const F& f, Long length) {
  Long last = 0;
  for (int panels = 1;; panels *= 2) {
    Long sum = 0, norm = 0;
    for (int k = 0; k < panels; ++k) {
      Long panel_norm = 0;
      sum += boost::math::quadrature::gauss<Long, 30>::integrate(f, length * Long(k) / Long(panels),
                                                                 length * Long(k + 1) / Long(panels), &panel_norm);
      norm += panel_norm;
    }
    const Long moved = std::abs(sum - last);
    if (panels > 1 && (moved <= std::ldexp(norm, -58) || panels == 4096)) {
      // The integrand itself carries some forty roundings of 2^-64.
      return {sum, moved + 20 * std::numeric_limits<Long>::epsilon() * norm};
    }
    last = sum;
  }
}

/// The stretch in the variable y in which the square roots are gone: u = u2 - gap sinh^2 y (three real roots) or rho +
/// sigma sinh y.
struct SmoothVariable {
  Quad low, high;              ///< y at the ends
  Quad slope_low, slope_high;  ///< |du/dy| there
};

SmoothVariable smooth_variable(const Ray& ray, const Stretch& stretch) {
  if (ray.three_real_roots) {
    const Quad low = asinh(sqrt((ray.u2 - stretch.low) / ray.gap));
    const Quad high = asinh(sqrt(std::max(Quad(ray.u2 - stretch.high), Quad(0)) / ray.gap));
    return {low, high, ray.gap * sinh(2 * low), ray.gap * sinh(2 * high)};
  }
  const Quad low = asinh((stretch.low - ray.rho) / ray.sigma), high = asinh((stretch.high - ray.rho) / ray.sigma);
  return {low, high, ray.sigma * cosh(low), ray.sigma * cosh(high)};
}

/// The numerators and the horizon factors of dphi and dt as polynomials in delta = u - centre: near the horizon of an
/// extremal hole all of them nearly vanish together.
struct Expanded {
  Long outer_value, outer, inner_value, inner;
  std::array<Long, 4> numerator;

  Expanded(const Ray& ray, const Quad& centre, Integrand what) {
    const Quad r_outer = ray.horizon(), r_inner = ray.inner_horizon();
    const Quad &a = ray.spin, &d = ray.d, &c = centre;
    outer_value = static_cast<Long>(1 - r_outer * c), outer = static_cast<Long>(r_outer);
    inner_value = static_cast<Long>(1 - r_inner * c), inner = static_cast<Long>(r_inner);
    if (what == Integrand::angle) {
      numerator = {static_cast<Long>(d + a - 2 * d * c), static_cast<Long>(-2 * d), 0, 0};
    } else {
      numerator = {static_cast<Long>(1 + a * a * c * c - 2 * a * d * c * c * c),
                   static_cast<Long>(2 * a * a * c - 6 * a * d * c * c), static_cast<Long>(a * a - 6 * a * d * c),
                   static_cast<Long>(-2 * a * d)};
    }
  }

  [[nodiscard]] Long operator()(Long delta) const {
    return (numerator[0] + delta * (numerator[1] + delta * (numerator[2] + delta * numerator[3]))) /
           ((outer_value - outer * delta) * (inner_value - inner * delta));
  }
};

// Quadrature over y in two halves, each measured by w from its own end of the stretch, where u is that end plus a
// product: nothing cancels where t goes as 1/u^2 (far away) or as 1/(1 - r+ u) (at the horizon). Next to such a pole,
// at distance q in w, w = q sinh v keeps the integrand smooth.
Bounded quadrature(const Ray& ray, const Stretch& stretch, Integrand what) {
  const SmoothVariable ends = smooth_variable(ray, stretch);
  const auto half = static_cast<Long>(abs(ends.low - ends.high) / 2);
  const Quad outer = ray.horizon();
  const Long u1 = static_cast<Long>(ray.u1), size = static_cast<Long>(ray.three_real_roots ? ray.gap : ray.sigma);
  Panels total{0, 0};
  for (const bool from_low : {true, false}) {
    const Quad end = from_low ? stretch.low : stretch.high;
    const Long u_end = static_cast<Long>(end), y_end = static_cast<Long>(from_low ? ends.low : ends.high);
    const Long sign = from_low ? 1 : -1;
    const Expanded rest(ray, ray.turns ? ray.u2 : end, what);
    const auto integrand = [&](Long w) {
      const Long change = sign * (ray.three_real_roots ? size * std::sinh(w) * std::sinh(2 * y_end - sign * w)
                                                       : 2 * size * std::cosh(y_end + sign * w / 2) * std::sinh(w / 2));
      const Long u = u_end + change;
      const Long value = rest(ray.turns ? -size * square(std::sinh(y_end - sign * w)) : change) / std::sqrt(u - u1);
      return what == Integrand::angle ? value : value / (u * u);
    };
    Long q = half;
    if (from_low && what == Integrand::time) q = std::min(q, static_cast<Long>(stretch.low / ends.slope_low));
    if (!from_low && ends.slope_high > 0) {
      q = std::min(q, static_cast<Long>((1 - outer * stretch.high) / (outer * ends.slope_high)));
    }
    const Panels sum =
        by_panels([&](Long v) { return integrand(q * std::sinh(v)) * q * std::cosh(v); }, std::asinh(half / q));
    total.value += sum.value;
    total.error += sum.error;
  }
  const Quad factor = (ray.three_real_roots ? sqrt(Quad(2)) : 1 / sqrt(Quad(2))) / abs(ray.d);
  return {factor * total.value, factor * total.error};
}

// Legendre's normal form by u = u1 + (u2 - u1) sin^2 theta, the integrals themselves by Carlson's R_F and R_J; the
// partial fractions over the two horizons stay finite as a -> 0.
Bounded angle_by_elliptic_integrals(const Ray& ray, const Stretch& stretch) {
  const Quad u21 = ray.u2 - ray.u1, u31 = u21 + ray.gap;
  const Quad poles[2] = {ray.horizon(), ray.inner_horizon()};
  const Quad separation = poles[0] - poles[1];
  const Quad scale = sqrt(Quad(2)) / (abs(ray.d) * sqrt(u31));
  Quad sum = 0, size = 0;
  for (const auto& [u, sign] : {std::pair(stretch.high, 1), std::pair(stretch.low, -1)}) {
    const Quad sine = sqrt((u - ray.u1) / u21);
    const Quad cosine_squared = std::max(Quad(ray.u2 - u), Quad(0)) / u21;
    const Quad delta_squared = (std::max(Quad(ray.u2 - u), Quad(0)) + ray.gap) / u31;
    const Quad first_kind = sine * boost::math::ellint_rf(cosine_squared, delta_squared, Quad(1));
    for (int k = 0; k < 2; ++k) {
      const Quad& r = poles[k];
      const Quad residue = (k == 0 ? 1 : -1) * ((ray.d + ray.spin) * r - 2 * ray.d) / separation;
      const Quad n = r * u21 / (1 - r * ray.u1);
      Quad third_kind = first_kind;
      if (r > 0) {
        third_kind +=
            n / 3 * sine * square(sine) *
            boost::math::ellint_rj(cosine_squared, delta_squared, Quad(1), Quad((1 - r * u) / (1 - r * ray.u1)));
      }
      const Quad term = scale * residue / (1 - r * ray.u1) * third_kind;
      sum += sign * term;
      size += abs(term);
    }
  }
  return {sum, 64 * quad_epsilon * size};
}

// Carlson's R_F between finite limits: every term is positive, so nothing cancels. a = 0 only, where |b| = |d| cancels
// against the |d| of sqrt P.
Bounded angle_of_schwarzschild(const Ray& ray, const Stretch& stretch) {
  const Quad &lo = stretch.low, &hi = stretch.high;
  const Quad width = hi - lo;
  if (ray.turns) {
    const Quad x1 = sqrt(hi - ray.u1), y1 = sqrt(lo - ray.u1);
    const Quad to_turn = std::max(Quad(ray.u2 - hi), Quad(0));
    const Quad x2 = sqrt(to_turn), y2 = sqrt(ray.u2 - lo);
    const Quad x3 = sqrt(to_turn + ray.gap), y3 = sqrt(ray.u2 - lo + ray.gap);
    const Quad angle = sqrt(Quad(2)) * boost::math::ellint_rf(square((x1 * x2 * y3 + y1 * y2 * x3) / width),
                                                              square((x1 * x3 * y2 + y1 * y3 * x2) / width),
                                                              square((x2 * x3 * y1 + y2 * y3 * x1) / width));
    return {angle, 64 * quad_epsilon * angle};
  }
  // One linear and one quadratic factor, x - u1 and 2[(x - rho)^2 + sigma^2].
  const Quad x = hi - ray.rho, y = lo - ray.rho, sigma_squared = square(ray.sigma);
  const Quad root = sqrt((square(x) + sigma_squared) * (square(y) + sigma_squared));
  const Quad xy = x * y;
  const Quad root_plus_xy =
      xy >= 0 ? Quad(root + xy) : Quad(sigma_squared * (square(x) + square(y) + sigma_squared) / (root - xy));
  const Quad linear = square(sqrt(hi - ray.u1) + sqrt(lo - ray.u1));
  const Quad big_u = linear * 4 * (root_plus_xy + sigma_squared) / square(width);
  const Quad reach = ray.rho - ray.u1, hypotenuse = sqrt(square(reach) + sigma_squared);
  const Quad angle = 4 * boost::math::ellint_rf(big_u, Quad(big_u + 4 * (reach + hypotenuse)),
                                                Quad(big_u - 4 * sigma_squared / (reach + hypotenuse)));
  return {angle, 1024 * quad_epsilon * angle};
}

Bounded angle_over(const Ray& ray, const Stretch& stretch) {
  if (stretch.low == stretch.high) return {};
  if (ray.straight) {  // dphi = a/(1 - 2u + a^2 u^2) du, as the logarithm of one plus a difference
    if (ray.spin == 0) return {};
    const Quad outer = ray.horizon(), inner = ray.inner_horizon();
    const Quad width = stretch.high - stretch.low;
    const Quad argument = width / ((1 - outer * stretch.high) * (1 - inner * stretch.low));
    const Quad angle = outer == inner ? Quad(ray.spin * argument)
                                      : Quad(ray.spin * log1p((outer - inner) * argument) / (outer - inner));
    return {angle, 1024 * quad_epsilon * abs(angle)};
  }
  if (ray.spin == 0) {
    Bounded angle = angle_of_schwarzschild(ray, stretch);
    if (ray.d < 0) angle.value = -angle.value;
    return angle;
  }
  const bool extremal = ray.horizon() == ray.inner_horizon();
  return ray.three_real_roots && !extremal ? angle_by_elliptic_integrals(ray, stretch)
                                           : quadrature(ray, stretch, Integrand::angle);
}

Bounded time_over(const Ray& ray, const Stretch& stretch) {
  if (stretch.low == stretch.high) return {};
  if (!ray.straight) return quadrature(ray, stretch, Integrand::time);
  // The principal null ray: dt/dr = (r^2 + a^2)/Delta.
  const Quad outer = ray.horizon(), inner = ray.inner_horizon();
  const Quad r_far = 1 / stretch.low, r_near = 1 / stretch.high, width = r_far - r_near;
  const Quad outer_log = log1p(width / (r_near - outer)), inner_log = log1p(width / (r_near - inner));
  const Quad rest = outer == inner ? Quad(2 * outer_log + 2 * width / ((r_near - 1) * (r_far - 1)))
                                   : Quad(2 * (outer * outer_log - inner * inner_log) / (outer - inner));
  const Quad separation = outer == inner ? Quad(1) : Quad(outer - inner);  // the two logarithms cancel to this
  return {width + rest, 1024 * quad_epsilon * (width + (abs(rest) + outer_log + inner_log) / separation)};
}

void require_reached(const Ray& ray, const char* name, double radius, bool must_be_finite) {
  const Quad r = Quad(radius) / ray.mass;
  const Quad floor = ray.turns ? ray.periapsis() : ray.horizon();
  // A radius given as periapsis().value is the periapsis rounded to a double, and counts as it.
  const Quad slack = ray.turns ? Quad(4 * std::numeric_limits<double>::epsilon() * floor) : Quad(0);
  if (!(r >= floor - slack) || (!ray.turns && !(r > floor)) || (must_be_finite && !std::isfinite(radius))) {
    throw std::domain_error(
        fmt::format("{} = {}: needs a {}radius outside the {} at {}", name, radius, must_be_finite ? "finite " : "",
                    ray.turns ? "periapsis of this ray" : "horizon", static_cast<double>(floor * ray.mass)));
  }
}

template <class Integral>
Bounded along(const Ray& ray, const Path& path, bool must_be_finite, const Integral& integral) {
  require_reached(ray, "r1", path.r1, must_be_finite);
  require_reached(ray, "r2", path.r2, must_be_finite);
  if (path.via_periapsis && !ray.turns) {
    throw std::domain_error(
        fmt::format("via_periapsis: b = {} M falls into the hole and has none", static_cast<double>(ray.d + ray.spin)));
  }
  Quad a = ray.mass / Quad(path.r1), b = ray.mass / Quad(path.r2);
  if (ray.turns) a = std::min(a, ray.u2), b = std::min(b, ray.u2);
  if (!path.via_periapsis) return integral(ray, Stretch{std::min(a, b), std::max(a, b)});
  const Bounded first = integral(ray, Stretch{a, ray.u2}), second = integral(ray, Stretch{b, ray.u2});
  return {first.value + second.value, first.error + second.error};
}

}  // namespace

Ray::Ray(double mass_in, double spin_in, double impact_parameter) : mass(mass_in) {
  if (!(mass_in > 0) || !std::isfinite(mass_in)) {
    throw std::invalid_argument(fmt::format("mass M = {}, needs a finite M > 0", mass_in));
  }
  if (!(std::abs(spin_in) <= mass_in)) {
    throw std::invalid_argument(fmt::format("spin a/M = {}, needs |a/M| <= 1", spin_in / mass_in));
  }
  if (!std::isfinite(impact_parameter)) {
    throw std::domain_error(fmt::format("impact parameter b = {}, needs a finite b", impact_parameter));
  }
  spin = Quad(spin_in) / mass;
  s = (Quad(impact_parameter) + Quad(spin_in)) / mass;
  d = (Quad(impact_parameter) - Quad(spin_in)) / mass;
  straight = d == 0;
  if (straight) return;
  const Quad excess = s * square(s) / d - 27;
  if (excess == 0) {
    throw std::domain_error(
        fmt::format("impact parameter b = {} is the critical one: the ray winds for ever", impact_parameter));
  }
  three_real_roots = s / d > 0 && excess > 0;
  if (three_real_roots) {
    set_three_real_roots(*this);
    turns = u2 * horizon() < 1;
  } else {
    set_one_real_root(*this);
  }
}

Quad Ray::horizon() const { return 1 + sqrt((1 - spin) * (1 + spin)); }
Quad Ray::inner_horizon() const { return square(spin) / horizon(); }
Quad Ray::periapsis() const { return 1 / u2; }

Bounded swept_angle(const Ray& ray, const Path& path) { return along(ray, path, false, angle_over); }

Bounded coordinate_time(const Ray& ray, const Path& path) {
  Bounded t = along(ray, path, true, time_over);
  return {t.value * ray.mass, t.error * ray.mass};
}

Bounded whole_swept_angle(const Ray& ray) {
  const Bounded leg = angle_over(ray, Stretch{Quad(0), ray.u2});
  return {2 * leg.value, 2 * leg.error};
}

}  // namespace xpr::equatorial_light
