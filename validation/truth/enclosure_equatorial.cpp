#include <acb.h>
#include <acb_calc.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "validation/truth/enclosure.hpp"

namespace xpr::enclosure {

namespace {

void require(bool holds, const std::string& what) {
  if (!holds) throw std::domain_error(what);
}

/// The roots of P(u) = 1 - s d u^2 + 2 d^2 u^3 for b = b_c and beyond. With u = (s/d) (1/6 + c/3) it becomes 4 c^3 - 3
/// c = cos 3 theta = 1 - 54 d/s^3.
struct Cubic {
  Ball u1, u2, u3;

  Cubic(const Ball& s, const Ball& d, const std::string& ray) {
    const Ball cosine = Ball(1) - Ball(54) * d / (s * s * s);
    require(cosine > Ball(-1) && cosine < Ball(1),
            ray + " does not turn: it falls in, or cannot be told from one that does");
    const Ball third = acos(cosine) / Ball(3), turn = Ball(2) * ball_pi() / Ball(3);
    const auto root = [&](const Ball& angle) { return s / d * (Ball(1) + Ball(2) * cos(angle)) / Ball(6); };
    u3 = root(third), u2 = root(third - turn), u1 = root(third + turn);
    require(u1 < Ball(0) && u2 > Ball(0) && u2 < u3, ray + ": the roots of its cubic cannot be told apart");
  }
  [[nodiscard]] Ball parameter() const { return (u2 - u1) / (u3 - u1); }
  /// Where u = 0 lies in u = u1 + (u2 - u1) sin^2 psi.
  [[nodiscard]] Ball psi_at_infinity() const { return asin(sqrt(-u1 / (u2 - u1))); }
};

/// An equatorial ray of Kerr in units of M, with a >= 0.
struct Equatorial {
  Ball mass, a, b, d;
  Cubic roots;
  bool extremal;

  Equatorial(double M, double spin, double impact_parameter)
      : mass(M),
        a(abs(Ball(spin)) / Ball(M)),
        b((spin < 0.0 ? -Ball(impact_parameter) : Ball(impact_parameter)) / Ball(M)),
        d(b - a),
        roots(checked_sum(M, spin, impact_parameter), d, name(spin, impact_parameter)),
        extremal(std::abs(spin) == M) {
    // u2 beyond the horizon: 1 - 2 u + a^2 u^2 > 0 and u < 1/M, left of the first root.
    require(roots.u2 < Ball(1) && roots.u2 * (Ball(2) - a * a * roots.u2) < Ball(1),
            name(spin, impact_parameter) + " falls in");
  }

  static std::string name(double spin, double impact_parameter) {
    return fmt::format("the ray of b = {} about a = {}", impact_parameter, spin);
  }
  /// s = b + a, after what everything else needs has been asked for.
  Ball checked_sum(double M, double spin, double impact_parameter) const {
    require(M > 0.0 && std::isfinite(M), fmt::format("mass M = {}, needs a finite M > 0", M));
    require(std::abs(spin) <= M, fmt::format("spin a/M = {}, needs |a/M| <= 1", spin / M));
    require(std::isfinite(impact_parameter) && std::abs(impact_parameter) > std::abs(spin),
            name(spin, impact_parameter) + " falls in");
    return b + a;
  }
};

/// The integrand of the swept angle over theta, for Arb's quadrature: 4 N / (D sqrt(2 d^2 (u3 - u))).
int swept_integrand(acb_ptr out, const acb_t theta, void* ray_pointer, slong order, slong bits) {
  const auto& ray = *static_cast<const Equatorial*>(ray_pointer);
  struct Scratch {
    std::array<acb_struct, 5> z;
    Scratch() {
      for (acb_struct& x : z) acb_init(&x);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    ~Scratch() {
      for (acb_struct& x : z) acb_clear(&x);
    }
  } scratch;
  auto& [u, n, denominator, root, term] = scratch.z;
  const Ball width = ray.roots.u2 - ray.roots.u1, two_d = Ball(2) * ray.d, a_squared = ray.a * ray.a;
  const Ball two_d_squared = two_d * ray.d;
  acb_sin(&u, theta, bits);
  acb_mul(&u, &u, &u, bits);
  acb_mul_arb(&u, &u, width.get(), bits);
  acb_add_arb(&u, &u, ray.roots.u1.get(), bits);
  acb_mul_arb(&n, &u, two_d.get(), bits);  // N = b - 2 d u
  acb_neg(&n, &n);
  acb_add_arb(&n, &n, ray.b.get(), bits);
  acb_mul_arb(&denominator, &u, a_squared.get(), bits);  // D = 1 + u (a^2 u - 2)
  acb_sub_si(&denominator, &denominator, 2, bits);
  acb_mul(&denominator, &denominator, &u, bits);
  acb_add_si(&denominator, &denominator, 1, bits);
  acb_neg(&root, &u);
  acb_add_arb(&root, &root, ray.roots.u3.get(), bits);
  acb_mul_arb(&root, &root, two_d_squared.get(), bits);
  acb_sqrt_analytic(&term, &root, order != 0 ? 1 : 0, bits);
  acb_mul(&denominator, &denominator, &term, bits);
  acb_div(out, &n, &denominator, bits);
  acb_mul_si(out, out, 4, bits);
  return 0;
}

Ball swept_by_quadrature(Equatorial ray) {
  const Ball from = ray.roots.psi_at_infinity(), to = ball_pi() / Ball(2);
  acb_t a, b, integral;
  acb_init(a);
  acb_init(b);
  acb_init(integral);
  acb_set_arb(a, from.get());
  acb_set_arb(b, to.get());
  mag_t tolerance;
  mag_init(tolerance);
  constexpr slong goal = 200;  // bits: 60 digits
  mag_set_ui_2exp_si(tolerance, 1, -goal);
  const bool done =
      acb_calc_integrate(integral, swept_integrand, &ray, a, b, goal, tolerance, nullptr, Ball::bits) == 0;
  Ball out;
  arb_set(out.get(), acb_realref(integral));
  mag_clear(tolerance);
  acb_clear(a);
  acb_clear(b);
  acb_clear(integral);
  require(done && out.finite(), "the quadrature of a swept angle proves nothing here");
  return abs(out);
}

/// 0 < a < 1.
Ball swept_by_legendre(const Equatorial& ray) {
  const Cubic& roots = ray.roots;
  const Ball m = roots.parameter(), psi = roots.psi_at_infinity();
  const Ball w = sqrt(Ball(1) - ray.a * ray.a);
  const Ball outer = Ball(1) / (Ball(1) + w), inner = Ball(1) / (Ball(1) - w);  // u at the horizons
  const auto part = [&](const Ball& here, const Ball& other) {
    const Ball residue = (ray.b - Ball(2) * ray.d * here) / (Ball(1) - here / other);
    const Ball n = (roots.u2 - roots.u1) / (here - roots.u1);
    return residue * here / (here - roots.u1) * (legendre_pi(n, m) - legendre_pi(n, psi, m));
  };
  const Ball sum = part(outer, inner) + part(inner, outer);
  return abs(Ball(4) * sum / (abs(ray.d) * sqrt(Ball(2) * (roots.u3 - roots.u1))));
}

}  // namespace

Ball schwarzschild_deflection(double mass, double impact_parameter) {
  const Equatorial ray(mass, 0.0, std::abs(impact_parameter));
  const Ball m = ray.roots.parameter();
  const Ball half = legendre_k(m) - legendre_f(ray.roots.psi_at_infinity(), m);
  return Ball(4) * half / sqrt(Ball(2) * (ray.roots.u3 - ray.roots.u1)) - ball_pi();
}

Ball schwarzschild_periapsis(double mass, double impact_parameter) {
  return kerr_periapsis(mass, 0.0, std::abs(impact_parameter));
}

Ball kerr_deflection(double mass, double spin, double impact_parameter) {
  if (spin == 0.0) return schwarzschild_deflection(mass, impact_parameter);
  const Equatorial ray(mass, spin, impact_parameter);
  return (ray.extremal ? swept_by_quadrature(ray) : swept_by_legendre(ray)) - ball_pi();
}

Ball kerr_deflection_by_quadrature(double mass, double spin, double impact_parameter) {
  return swept_by_quadrature(Equatorial(mass, spin, impact_parameter)) - ball_pi();
}

Ball kerr_periapsis(double mass, double spin, double impact_parameter) {
  const Equatorial ray(mass, spin, impact_parameter);
  return ray.mass / ray.roots.u2;
}

Ball ellis_deflection(double throat_radius, double impact_parameter) {
  require(throat_radius > 0.0 && impact_parameter > throat_radius,
          fmt::format("impact parameter b = {}, needs b > b0 = {} > 0", impact_parameter, throat_radius));
  const Ball k = Ball(throat_radius) / Ball(impact_parameter);
  return Ball(2) * legendre_k(k * k) - ball_pi();
}

Ball ellis_transit_angle(double throat_radius, double impact_parameter) {
  require(impact_parameter > 0.0 && impact_parameter < throat_radius,
          fmt::format("impact parameter b = {}, needs 0 < b < b0 = {}", impact_parameter, throat_radius));
  const Ball k = Ball(impact_parameter) / Ball(throat_radius);
  return Ball(2) * k * legendre_k(k * k);
}

}  // namespace xpr::enclosure
