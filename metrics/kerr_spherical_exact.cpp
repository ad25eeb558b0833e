#include <fmt/core.h>

#include <algorithm>
#include <boost/math/special_functions/ellint_rd.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <boost/math/special_functions/ellint_rj.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "metrics/kerr_exact.hpp"
#include "metrics/kerr_quad.hpp"

namespace xpr::kerr_exact {
namespace {

Quad squared(const Quad& x) { return x * x; }

/// xi and eta of the spherical orbit at r (units of M, a > 0). At a = M the factor (r - 1) is cancelled by name.
struct Constants {
  Quad xi, eta;
};

Constants spherical_constants(const Hole& hole, const Quad& r) {
  if (hole.extremal()) return {2 - squared(r - 1), r * squared(r) * (4 - r)};
  const Quad& a = hole.spin;
  const Quad delta_over = (r - 1) - (1 - a) * (1 + a) / (r - 1);
  return {(squared(r) + squared(a) - 2 * r * delta_over) / a,
          r * squared(r) * (4 * squared(a) - r * squared(r - 3)) / squared(a * (r - 1))};
}

void require_spin(double spin) {
  if (spin == 0) throw std::domain_error("spin a = 0, needs a != 0: Schwarzschild has the photon sphere r = 3 M alone");
}

/// r in units of M, in the range of the spherical orbits; its ends may be rounded to doubles.
Quad spherical_radius(const Hole& hole, double r_in) {
  const Quad r = Quad(r_in) / hole.mass, low = hole.photon_orbit(Sense::prograde),
             high = hole.photon_orbit(Sense::retrograde);
  const Quad slack = 4 * std::numeric_limits<double>::epsilon();
  if (!(r >= low * (1 - slack) && r <= high * (1 + slack) && r > 1)) {
    throw std::domain_error(fmt::format("radius r = {}, needs {} <= r <= {} and r > M", r_in,
                                        static_cast<double>(hole.mass * low), static_cast<double>(hole.mass * high)));
  }
  return r;
}

/// The screen of one observer. beta^2 vanishes at the radii `low` and `high`, the curve's ends; at a = M `low` may be
/// the horizon itself, where the curve ends above the axis and a straight line goes down to it.
class Screen {
 public:
  Screen(const Hole& hole, double inclination) : hole_(hole) {
    if (!(inclination > 0 && inclination < std::numbers::pi)) {
      throw std::domain_error(fmt::format("inclination i = {}, needs 0 < i < pi", inclination));
    }
    sine_ = sin(Quad(inclination));
    cosine_squared_ = squared(cos(Quad(inclination)));
  }

  [[nodiscard]] const Quad& sine() const { return sine_; }
  [[nodiscard]] Quad alpha(const Quad& r) const { return -spherical_constants(hole_, r).xi / sine_; }
  [[nodiscard]] Quad beta_squared(const Quad& r) const {
    const Constants c = spherical_constants(hole_, r);
    return c.eta + cosine_squared_ * (squared(hole_.spin) - squared(c.xi / sine_));
  }
  [[nodiscard]] Quad beta(const Quad& r) const { return sqrt(std::max(beta_squared(r), Quad(0))); }

  [[nodiscard]] Quad low() const {
    return bisected(hole_.photon_orbit(Sense::prograde), hole_.polar_photon_orbit(),
                    [&](const Quad& r) { return beta_squared(r); })
        .first;
  }
  [[nodiscard]] Quad high() const {
    return bisected(hole_.polar_photon_orbit(), hole_.photon_orbit(Sense::retrograde),
                    [&](const Quad& r) { return Quad(-beta_squared(r)); })
        .second;
  }
  /// Where beta is greatest: xi/sin^2 i = -a (r + 1)/(r - 1).
  [[nodiscard]] Quad highest() const {
    return bisected(hole_.polar_photon_orbit(), hole_.photon_orbit(Sense::retrograde),
                    [&](const Quad& r) {
                      return Quad(-spherical_constants(hole_, r).xi - squared(sine_) * hole_.spin * (r + 1) / (r - 1));
                    })
        .first;
  }

  /// Neighbours about the zero of a function that is negative at `low` and positive at `high`; where it already is
  /// positive at `low`, or still negative at `high`, that end.
  template <class F>
  [[nodiscard]] static std::pair<Quad, Quad> bisected(Quad low, Quad high, const F& f) {
    if (f(low) >= 0) return {low, low};
    if (f(high) <= 0) return {high, high};
    for (;;) {
      const Quad middle = (low + high) / 2;
      if (middle <= low || middle >= high) return {low, high};
      (f(middle) < 0 ? low : high) = middle;
    }
  }

 private:
  const Hole& hole_;
  Quad sine_, cosine_squared_;
};

/// a = 0: the circle of radius 3 sqrt3 M.
ScreenPoint circle_edge(const Hole& hole, const Quad& centre, const Quad& cosine, const Quad& sine) {
  const Quad half = centre * cosine;
  const Quad distance = sqrt(27 - squared(centre * sine)) - half;
  return {rounded(hole.mass * (centre + distance * cosine)), rounded(hole.mass * (distance * sine))};
}

}  // namespace

SphericalOrbit spherical_orbit(double mass, double spin, double r_in) {
  const Hole hole(mass, spin);
  require_spin(spin);
  const Quad r = spherical_radius(hole, r_in);
  const Quad& a = hole.spin;
  Constants c = spherical_constants(hole, r);
  c.eta = std::max(c.eta, Quad(0));
  // u+ and 1 - u+ each as 2 x/(sum + root): neither cancels. w = a sqrt(-u-).
  const Quad middle = squared(c.xi) + c.eta - squared(a);
  const Quad w_squared = (middle + sqrt(squared(middle) + 4 * squared(a) * c.eta)) / 2, w = sqrt(w_squared);
  const Quad u_plus = c.eta / w_squared;
  const Quad sum = squared(a) + squared(c.xi) + c.eta;
  const Quad sine_squared = 2 * squared(c.xi) / (sum + sqrt(squared(sum) - squared(2 * a * c.xi)));
  const Quad m1 = 1 + squared(a) * u_plus / w_squared;  // 1 - m, m = u+/u- <= 0
  const Quad first = boost::math::ellint_rf(Quad(0), m1, Quad(1));
  const Quad second = u_plus / 3 * boost::math::ellint_rd(Quad(0), m1, Quad(1));  // of u = cos^2 theta
  const Quad third =
      c.xi == 0 ? Quad(0)
                : Quad(c.xi * (first + u_plus / 3 * boost::math::ellint_rj(Quad(0), m1, Quad(1), sine_squared)));
  const Quad period = 4 * first / w;
  const Quad azimuth = 4 * third / w + (2 * a * r / (r - 1) - a) * period;
  const Quad time =
      ((squared(r) + squared(a)) * 2 * r / (r - 1) + a * c.xi - squared(a)) * period + squared(a) * 4 * second / w;
  const Quad chi = (r - 1) / r + (1 - a) * (1 + a) / (r * squared(r - 1));
  return {.xi = rounded(hole.mass * hole.sign * c.xi),
          .eta = rounded(squared(hole.mass) * c.eta),
          .cos_squared_least = rounded(u_plus),
          .minus_u_minus = rounded(w_squared / squared(a)),
          .mino_period = rounded(period / hole.mass),
          .azimuth = rounded(Bounded{
              hole.sign * azimuth, 1024 * std::numeric_limits<Quad>::epsilon() * (abs(azimuth) + abs(4 * third / w))}),
          .time = rounded(hole.mass * time),
          .lyapunov_half_orbit = rounded(r * sqrt(chi) * period)};
}

ScreenPoint shadow_curve(double mass, double spin, double inclination, double r_in) {
  const Hole hole(mass, spin);
  require_spin(spin);
  const Screen screen(hole, inclination);
  const Quad r = spherical_radius(hole, r_in);
  const Quad beta_squared = screen.beta_squared(r);
  // At an end given as a double, beta^2 is zero to 1e-15 of eta's scale.
  if (beta_squared < -1e-13) {
    throw std::domain_error(fmt::format(
        "radius r = {}: its orbit is not seen at inclination i = {}, needs {} <= r <= {}", r_in, inclination,
        static_cast<double>(hole.mass * screen.low()), static_cast<double>(hole.mass * screen.high())));
  }
  return {rounded(hole.mass * hole.sign * screen.alpha(r)), rounded(hole.mass * screen.beta(r))};
}

ScreenPoint shadow_edge(double mass, double spin, double inclination, double alpha_centre, double screen_angle) {
  const Hole hole(mass, spin);
  const Screen screen(hole, inclination);
  if (!(std::abs(screen_angle) <= std::numbers::pi)) {
    throw std::domain_error(fmt::format("screen angle = {}, needs -pi <= angle <= pi", screen_angle));
  }
  const ShadowExtent extent = shadow_extent(mass, spin, inclination);
  if (!(alpha_centre > extent.alpha_left.value && alpha_centre < extent.alpha_right.value)) {
    throw std::domain_error(fmt::format("alpha_centre = {}, needs {} < alpha_centre < {}", alpha_centre,
                                        extent.alpha_left.value, extent.alpha_right.value));
  }
  // a < 0 is the mirror image in alpha; the lower half that in beta.
  const Quad centre = hole.sign * Quad(alpha_centre) / hole.mass;
  const Quad cosine = hole.sign * cos(Quad(screen_angle)), sine = abs(sin(Quad(screen_angle)));
  const int half = screen_angle < 0 ? -1 : 1;
  ScreenPoint point;
  if (spin == 0) {
    point = circle_edge(hole, centre, cosine, sine);
  } else {
    const Quad low = screen.low();
    const auto outside = [&](const Quad& r) {
      return Quad(sine * (screen.alpha(r) - centre) - cosine * screen.beta(r));
    };
    Quad alpha, beta, alpha_error = 0, beta_error = 0;
    if (sine == 0) {
      alpha = screen.alpha(cosine > 0 ? screen.high() : low);
      beta = 0;
    } else if (outside(low) >= 0) {  // a = M: on the straight line through the curve's end
      alpha = screen.alpha(low);
      beta = (alpha - centre) * sine / cosine;
    } else {
      // Near the alpha axis beta goes as the root of the distance from the curve's end, and alpha alone is well
      // determined by r; the asked direction gives the other.
      const auto [below, above] = Screen::bisected(low, screen.high(), outside);
      alpha = screen.alpha(below), alpha_error = abs(screen.alpha(above) - alpha);
      if (abs(cosine) > sine) {
        beta = (alpha - centre) * sine / cosine, beta_error = alpha_error;
      } else {
        beta = screen.beta(below), beta_error = abs(screen.beta(above) - beta);
      }
    }
    const Quad rounding = 1024 * std::numeric_limits<Quad>::epsilon();
    point.alpha = rounded(Bounded{hole.sign * hole.mass * alpha, hole.mass * (alpha_error + rounding * abs(alpha))});
    point.beta = rounded(Bounded{hole.mass * beta, hole.mass * (beta_error + rounding * abs(beta))});
  }
  point.beta.value *= half;
  return point;
}

ShadowExtent shadow_extent(double mass, double spin, double inclination) {
  const Hole hole(mass, spin);
  const Screen screen(hole, inclination);
  if (spin == 0) {
    const Quad radius = hole.mass * sqrt(Quad(27));
    return {rounded(-radius), rounded(radius), rounded(radius), ExactValue{0.0, 0.0}};
  }
  const Quad left = hole.mass * screen.alpha(screen.low()), right = hole.mass * screen.alpha(screen.high());
  const Quad highest = screen.highest();
  const ExactValue beta_max = rounded(hole.mass * screen.beta(highest)),
                   alpha_at_max = rounded(hole.mass * hole.sign * screen.alpha(highest));
  if (hole.sign < 0) return {rounded(-right), rounded(-left), beta_max, alpha_at_max};
  return {rounded(left), rounded(right), beta_max, alpha_at_max};
}

Hole::Hole(double mass_in, double spin_in) : mass(mass_in), sign(spin_in < 0 ? -1 : 1) {
  if (!(mass_in > 0) || !std::isfinite(mass_in)) {
    throw std::invalid_argument(fmt::format("mass M = {}, needs a finite M > 0", mass_in));
  }
  if (!(std::abs(spin_in) <= mass_in)) {
    throw std::invalid_argument(fmt::format("spin a/M = {}, needs |a/M| <= 1", spin_in / mass_in));
  }
  spin = abs(Quad(spin_in)) / mass;
}

Quad Hole::photon_orbit(Sense sense) const {
  if (sense == Sense::retrograde) return 2 * (1 + cos(2 * acos(spin) / 3));
  return extremal() ? Quad(1) : Quad(2 * (1 + cos(2 * acos(-spin) / 3)));
}

Quad Hole::polar_photon_orbit() const {
  const Quad s = 1 - squared(spin) / 3;
  return 1 + 2 * sqrt(s) * cos(acos(std::min(Quad((1 - spin) * (1 + spin) / (s * sqrt(s))), Quad(1))) / 3);
}

}  // namespace xpr::kerr_exact
