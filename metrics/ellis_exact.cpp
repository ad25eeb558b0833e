#include "metrics/ellis_exact.hpp"

#include <fmt/core.h>

#include <GeographicLib/EllipticFunction.hpp>
#include <algorithm>
#include <boost/math/special_functions/ellint_rd.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "metrics/bounded.hpp"

namespace xpr::ellis_exact {
namespace {

using std::numbers::pi;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

void require_throat(double throat_radius) {
  if (!(throat_radius > 0) || !std::isfinite(throat_radius)) {
    throw std::invalid_argument(fmt::format("throat radius b0 = {}, needs a finite b0 > 0", throat_radius));
  }
}

void require(bool good, const char* name, double value, const char* range) {
  if (!good) throw std::domain_error(fmt::format("{} = {}, needs {}", name, value, range));
}

void require_scattered(double throat_radius, double b) {
  require_throat(throat_radius);
  require(b > throat_radius && std::isfinite(b), "impact parameter b", b, "a finite b > b0");
}

/// K(m) from the complementary parameter, so that m -> 1 keeps its digits.
double complete_first_kind(double complementary_parameter) {
  return GeographicLib::EllipticFunction::RF(complementary_parameter, 1.0);
}

/// 1 - (smaller/larger)^2, without cancellation.
double complement(double smaller, double larger) { return (larger - smaller) / larger * ((larger + smaller) / larger); }

Quad squared(const Quad& x) { return x * x; }

/// A ray as motion in one variable q measured from its throat crossing (q = l) or turning point (q^2 = l^2 - l_turn^2):
/// both are  dphi = b dq/sqrt((q^2 + A^2)(q^2 + B^2)),  dt = (q^2 + A^2) dq/sqrt(...), odd in q.
struct Ray {
  double impact_parameter;
  bool turns;
  Quad larger;           ///< A = max(b, b0)
  Quad smaller_squared;  ///< B^2 = |b^2 - b0^2|

  Ray(double throat_radius, double b) : impact_parameter(b), turns(b > throat_radius) {
    require_throat(throat_radius);
    require(b >= 0 && std::isfinite(b), "impact parameter b", b, "a finite b >= 0");
    larger = std::max(b, throat_radius);
    smaller_squared = abs((Quad(b) - throat_radius) * (Quad(b) + throat_radius));
  }

  [[nodiscard]] Quad variable(const char* name, double l) const {
    if (!turns) return l;
    const Quad square = squared(Quad(l)) - smaller_squared;
    if (square < -8 * epsilon * smaller_squared) {
      throw std::domain_error(
          fmt::format("{} = {}: this ray turns at |l| = {}", name, l, static_cast<double>(sqrt(smaller_squared))));
    }
    return sqrt(std::max(square, Quad(0)));
  }

  /// Carlson's forms; every term is positive.
  [[nodiscard]] Quad angle_to(const Quad& q) const {
    const Quad b = impact_parameter;
    if (isinf(q)) {
      const Quad whole = b / larger * boost::math::ellint_rf(Quad(0), Quad(smaller_squared / squared(larger)), Quad(1));
      return q > 0 ? whole : Quad(-whole);
    }
    return b / larger * q *
           boost::math::ellint_rf(smaller_squared, Quad(smaller_squared * (1 + squared(q / larger))),
                                  Quad(smaller_squared + squared(q)));
  }
  [[nodiscard]] Quad time_to(const Quad& q) const {
    const Quad u = 1 + squared(q / larger);
    const Quad first =
        boost::math::ellint_rf(smaller_squared, Quad(smaller_squared * u), Quad(smaller_squared + squared(q)));
    const Quad second =
        boost::math::ellint_rd(Quad(smaller_squared * u), Quad(smaller_squared + squared(q)), smaller_squared);
    return q * (larger * first + smaller_squared / larger * squared(q) * second / 3);
  }
};

/// Sums a function of q over the path, with its error bound.
template <class F>
Bounded along(const Ray& ray, double l1, double l2, bool via_periapsis, const F& primitive) {
  if (ray.turns) require(l1 * l2 > 0, "l2", l2, "l1 and l2 on one side of the throat: b > b0 does not go through");
  if (via_periapsis) require(ray.turns, "impact parameter b", ray.impact_parameter, "b > b0 to have a turning point");
  const Quad first = primitive(ray.variable("l1", l1)), second = primitive(ray.variable("l2", l2));
  const Quad value = via_periapsis ? Quad(first + second) : Quad(abs(second - first));
  return {value, 256 * std::numeric_limits<Quad>::epsilon() * (abs(first) + abs(second))};
}

void require_off_the_throat(double l1, double l2) {
  require(l1 * l2 > 0, "l2", l2, "l1 and l2 on one side of the throat: b = b0 never reaches it");
}

}  // namespace

ExactValue deflection(double throat_radius, double b) {
  require_scattered(throat_radius, b);
  const double swept = 2 * complete_first_kind(complement(throat_radius, b));
  return {swept - pi, 8 * epsilon * swept};
}

ExactValue transit_angle(double throat_radius, double b) {
  require_throat(throat_radius);
  require(b >= 0 && b < throat_radius, "impact parameter b", b, "0 <= b < b0");
  const double swept = 2 * (b / throat_radius) * complete_first_kind(complement(b, throat_radius));
  return {swept, 8 * epsilon * swept};
}

ExactValue critical_impact_parameter(double throat_radius) {
  require_throat(throat_radius);
  return {throat_radius, 0.0};
}

ExactValue lyapunov_exponent_per_time(double throat_radius) {
  require_throat(throat_radius);
  return {1 / throat_radius, epsilon / throat_radius};
}

ExactValue weak_field_series(double throat_radius, double b, int order) {
  require_scattered(throat_radius, b);
  require(order >= 1, "order", order, "order >= 1");
  const double k_squared = throat_radius / b * (throat_radius / b);
  double term = pi, sum = 0;
  for (int n = 1; n <= order + 1; ++n) {
    const double ratio = (2.0 * n - 1) / (2.0 * n);
    term *= ratio * ratio * k_squared;
    if (n <= order) sum += term;
  }
  // The coefficients fall, so a geometric series in k^2 from the first term left out bounds the rest.
  return {sum, term / complement(throat_radius, b) * (1 + 64 * epsilon) + (8 + 6 * order) * epsilon * sum};
}

ExactValue strong_field_logarithm(double throat_radius, double b) {
  require_scattered(throat_radius, b);
  const double excess = (b - throat_radius) / throat_radius;
  require(excess <= 0.5, "impact parameter b", b, "b0 < b <= 1.5 b0");
  const double value = -std::log(excess) + 3 * std::numbers::ln2 - pi;
  // K(m) = ln(4/k') + (k'^2/4)(ln(4/k') - 1) + ..., k'^2 = 1 - m: with ln(1/k'^2) this leaves (excess/2)(ln(8/excess) +
  // 1) to first order, and less beyond.
  return {value, excess / 2 * (std::log(8 / excess) + 1) + 8 * epsilon * (std::abs(value) + pi)};
}

ExactValue swept_angle(double throat_radius, double b, double l1, double l2, bool via_periapsis) {
  const Ray ray(throat_radius, b);
  require(!std::isnan(l1), "l1", l1, "a number");
  require(!std::isnan(l2), "l2", l2, "a number");
  if (b == throat_radius) {  // dphi = b0 dl/(|l| sqrt(l^2 + b0^2))
    require_off_the_throat(l1, l2);
    const auto angle = [&](const Quad& l) { return isinf(l) ? Quad(0) : Quad(asinh(throat_radius / abs(l))); };
    return rounded(along(ray, l1, l2, via_periapsis, angle));
  }
  return rounded(along(ray, l1, l2, via_periapsis, [&](const Quad& q) { return ray.angle_to(q); }));
}

ExactValue coordinate_time(double throat_radius, double b, double l1, double l2, bool via_periapsis) {
  const Ray ray(throat_radius, b);
  require(std::isfinite(l1), "l1", l1, "a finite l1");
  require(std::isfinite(l2), "l2", l2, "a finite l2");
  if (b == throat_radius) {  // dt = sqrt(l^2 + b0^2) dl/|l|
    require_off_the_throat(l1, l2);
    const auto time = [&](const Quad& l) {
      return Quad(sqrt(squared(l) + squared(ray.larger)) - ray.larger * asinh(throat_radius / abs(l)));
    };
    return rounded(along(ray, l1, l2, via_periapsis, time));
  }
  return rounded(along(ray, l1, l2, via_periapsis, [&](const Quad& q) { return ray.time_to(q); }));
}

ExactValue turning_point(double throat_radius, double b) {
  require_throat(throat_radius);
  require(b >= throat_radius && std::isfinite(b), "impact parameter b", b, "a finite b >= b0");
  const double l = std::sqrt(b - throat_radius) * std::sqrt(b + throat_radius);
  return {l, 4 * epsilon * l};
}

ExactValue proper_distance_from_isotropic(double throat_radius, double rho, int sheet) {
  require_throat(throat_radius);
  require(rho >= throat_radius / 2 && std::isfinite(rho), "isotropic radius rho", rho, "a finite rho >= b0/2");
  require(sheet == 1 || sheet == -1, "sheet", sheet, "+1 or -1");
  const double half = throat_radius / 2;  // rho - half is exact near the throat
  const double l = sheet * (rho - half) * ((rho + half) / rho);
  return {l, 4 * epsilon * std::abs(l)};
}

ExactValue isotropic_from_proper_distance(double throat_radius, double l) {
  require_throat(throat_radius);
  require(std::isfinite(l), "l", l, "a finite l");
  const double rho = (std::abs(l) + std::hypot(l, throat_radius)) / 2;
  return {rho, 4 * epsilon * rho};
}

ExactValue areal_radius(double throat_radius, double l) {
  require_throat(throat_radius);
  require(std::isfinite(l), "l", l, "a finite l");
  const double r = std::hypot(l, throat_radius);
  return {r, 2 * epsilon * r};
}

}  // namespace xpr::ellis_exact
