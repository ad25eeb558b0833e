#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "validation/truth/enclosure.hpp"

namespace xpr::enclosure {

namespace {

void require(bool holds, const std::string& what) {
  if (!holds) throw std::domain_error(what);
}

void require_hole(double mass, double spin) {
  require(mass > 0.0 && std::isfinite(mass), fmt::format("mass M = {}, needs a finite M > 0", mass));
  require(std::abs(spin) <= mass, fmt::format("spin a/M = {}, needs |a/M| <= 1", spin / mass));
}

/// M = 1 and a > 0; a hole that turns the other way is the mirror image.
struct Scaled {
  Ball mass, a;
  int sign;

  Scaled(double M, double spin) : mass(M), a(abs(Ball(spin)) / Ball(M)), sign(spin < 0.0 ? -1 : 1) {
    require_hole(M, spin);
    require(spin != 0.0, "spin a = 0, needs a != 0: Schwarzschild has the photon sphere r = 3 M alone");
  }
};

/// A polynomial in r by its coefficients.
using Polynomial = std::vector<Ball>;

Polynomial operator*(const Polynomial& p, const Polynomial& q) {
  Polynomial out(p.size() + q.size() - 1);
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = 0; j < q.size(); ++j) out[i + j] = out[i + j] + p[i] * q[j];
  }
  return out;
}
Polynomial operator*(const Ball& factor, Polynomial p) {
  for (Ball& c : p) c = factor * c;
  return p;
}
Polynomial operator+(Polynomial p, const Polynomial& q) {
  if (p.size() < q.size()) p.resize(q.size());
  for (std::size_t i = 0; i < q.size(); ++i) p[i] = p[i] + q[i];
  return p;
}
Polynomial derivative(const Polynomial& p) {
  Polynomial out;
  for (std::size_t k = 1; k < p.size(); ++k) out.push_back(Ball(static_cast<int>(k)) * p[k]);
  return out;
}
Ball value(const Polynomial& p, const Ball& r) {
  Ball sum;
  for (std::size_t k = p.size(); k-- > 0;) sum = sum * r + p[k];
  return sum;
}

/// xi = X/[a (r - 1)] and eta = Y/[a (r - 1)]^2.
struct Constants {
  Polynomial X, Y;

  explicit Constants(const Ball& a) : X{-(a * a), -(a * a), 3, -1}, Y{0, 0, 0, Ball(4) * a * a, -9, 6, -1} {}
};

/// The equatorial photon orbits for 0 <= a <= 1.
Ball prograde_orbit(const Ball& a) { return Ball(2) * (Ball(1) + cos(Ball(2) * acos(-a) / Ball(3))); }
Ball retrograde_orbit(const Ball& a) { return Ball(2) * (Ball(1) + cos(Ball(2) * acos(a) / Ball(3))); }

/// Those of `roots` that certainly lie between.
std::vector<Ball> between(const Ball& low, const std::vector<Ball>& roots, const Ball& high) {
  std::vector<Ball> out;
  for (const Ball& root : roots) {
    if (low < root && root < high) out.push_back(root);
  }
  return out;
}

/// The screen of one observer: B = [a (r - 1) sin i]^2 beta^2 as a polynomial in r, positive on the edge.
struct Screen {
  Scaled hole;
  Constants constants;
  Ball sine, sine_squared;
  Polynomial B;
  Ball low, high;  ///< of r on the edge

  Screen(double mass, double spin, double inclination)
      : hole(mass, spin), constants(hole.a), sine(sin(Ball(inclination))), sine_squared(sine * sine) {
    require(inclination > 0.0 && inclination < std::numbers::pi,
            fmt::format("inclination i = {}, needs 0 < i < pi", inclination));
    require(std::abs(spin) < mass, fmt::format("spin a/M = {}, needs 0 < |a/M| < 1", spin / mass));
    const Ball cosine_squared = Ball(1) - sine_squared, a_squared = hole.a * hole.a;
    const Polynomial r_less_1 = {-1, 1};
    B = sine_squared * constants.Y + sine_squared * cosine_squared * a_squared * a_squared * (r_less_1 * r_less_1) +
        -cosine_squared * (constants.X * constants.X);
    const std::vector<Ball> ends = between(prograde_orbit(hole.a), real_roots(B), retrograde_orbit(hole.a));
    require(ends.size() == 2, "the ends of the shadow's edge cannot be told from the equatorial orbits");
    low = ends[0], high = ends[1];
  }

  /// In units of M, of the hole that turns the positive way.
  [[nodiscard]] Ball alpha(const Ball& r) const { return -value(constants.X, r) / (hole.a * (r - Ball(1)) * sine); }
  [[nodiscard]] Ball beta(const Ball& r) const { return sqrt(value(B, r)) / (hole.a * (r - Ball(1)) * sine); }
};

}  // namespace

CriticalParameters kerr_critical_parameters(double mass, double spin) {
  require_hole(mass, spin);
  const Ball M = mass, a = abs(Ball(spin)) / M, third = Ball(1) / Ball(3);
  const Ball along = Ball(6) * cos(acos(-a) * third) - a, against = Ball(6) * cos(acos(a) * third) + a;
  CriticalParameters out{.prograde_radius = M * prograde_orbit(a),
                         .retrograde_radius = M * retrograde_orbit(a),
                         .polar_radius = Ball(3) * M,
                         .prograde_b = spin < 0.0 ? -M * along : M * along,
                         .retrograde_b = spin < 0.0 ? M * against : -M * against};
  if (spin != 0.0) out.polar_radius = M * real_roots(Constants(a).X).back();
  return out;
}

SphericalOrbit kerr_spherical_orbit(double mass, double spin, double radius) {
  const Scaled hole(mass, spin);
  const Ball& a = hole.a;
  const Ball r = Ball(radius) / hole.mass;
  require(prograde_orbit(a) < r && r < retrograde_orbit(a) && Ball(1) < r,
          fmt::format("radius r = {}: needs one between the equatorial photon orbits", radius));
  const Constants constants(a);
  const Ball scale = a * (r - Ball(1)), a_squared = a * a;
  const Ball xi = value(constants.X, r) / scale, eta = value(constants.Y, r) / (scale * scale);
  const Ball half = (xi * xi + eta - a_squared) / Ball(2), root = sqrt(half * half + a_squared * eta);
  const Ball u_plus = (root - half) / a_squared, minus_u_minus = (root + half) / a_squared;
  const Ball rate = a * sqrt(minus_u_minus), m = -u_plus / minus_u_minus;
  const Ball K = legendre_k(m), period = Ball(4) * K / rate;
  const Ball area = r * r + a_squared, delta = area - Ball(2) * r, P = area - a * xi;
  const Ball azimuth = Ball(4) * xi * legendre_pi(u_plus, m) / rate + (a * P / delta - a) * period;
  const Ball cosine_squared = Ball(4) * u_plus * (K - legendre_e(m)) / (m * rate);  // of theta, over one oscillation
  const Ball time = (area * P / delta + a * xi - a_squared) * period + a_squared * cosine_squared;
  const Ball chi = Ball(1) - delta / (r * (r - Ball(1)) * (r - Ball(1)));
  const Ball sign = hole.sign;
  return {.xi = sign * hole.mass * xi,
          .eta = hole.mass * hole.mass * eta,
          .cos_squared_least = u_plus,
          .minus_u_minus = minus_u_minus,
          .mino_period = period / hole.mass,
          .azimuth = sign * azimuth,
          .time = hole.mass * time,
          .lyapunov_half_orbit = r * sqrt(chi) * period};
}

ScreenPoint kerr_shadow_curve(double mass, double spin, double inclination, double radius) {
  const Screen screen(mass, spin, inclination);
  const Ball r = Ball(radius) / screen.hole.mass;
  require(screen.low < r && r < screen.high,
          fmt::format("radius r = {}: its orbit is not seen at inclination i = {}", radius, inclination));
  return {Ball(screen.hole.sign) * screen.hole.mass * screen.alpha(r), screen.hole.mass * screen.beta(r)};
}

ScreenPoint kerr_shadow_edge(double mass, double spin, double inclination, double alpha_centre, double screen_angle) {
  const Screen screen(mass, spin, inclination);
  require(std::abs(screen_angle) <= std::numbers::pi,
          fmt::format("screen angle = {}, needs -pi <= angle <= pi", screen_angle));
  const Ball a = screen.hole.a, sign = screen.hole.sign, M = screen.hole.mass;
  const Ball centre = sign * Ball(alpha_centre) / M;
  require(screen.alpha(screen.low) < centre && centre < screen.alpha(screen.high),
          fmt::format("alpha_centre = {}, needs one inside the shadow", alpha_centre));
  if (screen_angle == 0.0) return {sign * M * screen.alpha(spin < 0.0 ? screen.low : screen.high), 0};
  const Ball cosine = sign * cos(Ball(screen_angle)), sine = sin(Ball(screen_angle));
  // beta cos = (alpha - centre) sin, squared, times [a (r - 1) sin i]^2.
  const Polynomial offset = Ball(-1) * screen.constants.X + (-centre * a * screen.sine) * Polynomial{Ball(-1), Ball(1)};
  const Polynomial met = cosine * cosine * screen.B + (-sine * sine) * (offset * offset);
  for (const Ball& r : between(screen.low, real_roots(met), screen.high)) {
    // The other root lies in the opposite direction.
    const Ball along = (screen.alpha(r) - centre) * cosine;
    if (!(along > Ball(0))) continue;
    return {sign * M * screen.alpha(r), (screen_angle < 0.0 ? -M : M) * screen.beta(r)};
  }
  throw std::domain_error(fmt::format("screen angle = {}: the point of the edge cannot be enclosed", screen_angle));
}

ShadowExtent kerr_shadow_extent(double mass, double spin, double inclination) {
  const Screen screen(mass, spin, inclination);
  const Ball sign = screen.hole.sign, M = screen.hole.mass;
  // d(beta^2)/dr = 0.
  const Polynomial slope = derivative(screen.B) * Polynomial{Ball(-1), Ball(1)} + Ball(-2) * screen.B;
  const std::vector<Ball> flat = between(screen.low, real_roots(slope), screen.high);
  require(flat.size() == 1, "the highest point of the shadow's edge cannot be told from its ends");
  const Ball first = sign * M * screen.alpha(screen.low), last = sign * M * screen.alpha(screen.high);
  return {.alpha_left = spin < 0.0 ? last : first,
          .alpha_right = spin < 0.0 ? first : last,
          .beta_max = M * screen.beta(flat[0]),
          .alpha_at_beta_max = sign * M * screen.alpha(flat[0])};
}

}  // namespace xpr::enclosure
