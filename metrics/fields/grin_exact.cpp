#include "metrics/fields/grin_exact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace xpr::grin_exact {

namespace {

using Long = long double;
constexpr Long pi_ = std::numbers::pi_v<Long>;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

struct Quadrature {
  Long value = 0.0L;
  Long error = 0.0L;
};

/// Gauss-Legendre with 30 points, halved until the halves agree with the whole.
template <class F>
Quadrature integrate(const F& f, Long from, Long to, Long tolerance, int depth = 0) {
  using Gauss = boost::math::quadrature::gauss<Long, 30>;
  const Long middle = 0.5L * (from + to);
  const Long whole = Gauss::integrate(f, from, to);
  const Long left = Gauss::integrate(f, from, middle), right = Gauss::integrate(f, middle, to);
  const Long change = std::abs(left + right - whole);
  const Long round_off = 16.0L * std::numeric_limits<Long>::epsilon() * (std::abs(left) + std::abs(right));
  // At an end where f is a power, this many halvings leave nothing.
  if (change <= tolerance + round_off || depth == 25) return {left + right, change};
  const Quadrature a = integrate(f, from, middle, tolerance, depth + 1);
  const Quadrature b = integrate(f, middle, to, tolerance, depth + 1);
  return {a.value + b.value, a.error + b.error};
}

Long clamped(Long f) { return std::clamp(f, 0.0L, 1.0L); }

Long smoothstep(Long from, Long to, Long x) {
  const Long t = clamped((x - from) / (to - from));
  return t * t * (3.0L - 2.0L * t);
}

/// A zero of f where it changes sign between a and b, to the last bit.
template <class F>
Long bisected(const F& f, Long a, Long b) {
  const bool rises = f(b) > 0.0L;
  for (int k = 0; k < 120; ++k) {
    const Long middle = 0.5L * (a + b);
    if (middle == a || middle == b) break;
    ((f(middle) > 0.0L) == rises ? b : a) = middle;
  }
  return 0.5L * (a + b);
}

}  // namespace

RadialIndex::RadialIndex(const FieldSource& source, const FieldGains& gains)
    : curve_(source.curve),
      a_(source.a),
      b_(source.b),
      c_(source.c),
      softness_(source.edge_softness),
      inner_(source.r_inner),
      outer_(source.r_outer),
      bending_(bending_of(source, gains)),
      table_(source.table),
      centre_(source.world_from_local.origin) {
  if (source.shape != FieldShape::sphere || source.world_from_local.axes != FieldFrame{}.axes) {
    throw std::domain_error(fmt::format("field '{}' is no plain sphere, which alone has a closed form", source.name));
  }
  breaks_ = {0.0L, 1.0L};
  if (softness_ > 1e-6L) breaks_.insert(breaks_.end(), {softness_, 1.0L - softness_});
  for (std::size_t k = 1; k + 1 < table_.size() && curve_ == FieldCurve::custom; ++k) {
    breaks_.push_back(static_cast<Long>(k) / static_cast<Long>(table_.size() - 1));
  }
  if (curve_ == FieldCurve::polynomial) {
    // Where the parabola meets its bounds: sign changes on a fine grid, then halving.
    for (const Long bound : {0.0L, 1.0L}) {
      const auto off = [&](Long u) { return a_ + u * (b_ + u * c_) - bound; };
      for (int k = 0; k < 1000; ++k) {
        const Long low = static_cast<Long>(k) / 1000, high = static_cast<Long>(k + 1) / 1000;
        if (off(low) * off(high) < 0.0L) breaks_.push_back(bisected(off, low, high));
      }
    }
  }
  std::sort(breaks_.begin(), breaks_.end());
  breaks_.erase(std::unique(breaks_.begin(), breaks_.end()), breaks_.end());
  for (const Long u : breaks_) {
    const Long r = inner_ + u * (outer_ - inner_);
    if (r > 0.0L) seams_.push_back(r);
  }
}

Long RadialIndex::curve(Long u) const {
  u = clamped(u);
  Long f = 1.0L - u;
  switch (curve_) {
    case FieldCurve::linear:
      break;
    case FieldCurve::power:
      f = a_ == 0.0L ? 1.0L : std::pow(1.0L - u, a_);
      break;
    case FieldCurve::polynomial:
      f = clamped(a_ + b_ * u + c_ * u * u);
      break;
    case FieldCurve::exponential:
      f = std::exp(-a_ * u);
      break;
    case FieldCurve::gaussian:
      f = std::exp(-(u / a_) * (u / a_));
      break;
    case FieldCurve::custom: {
      const Long place = u * static_cast<Long>(table_.size() - 1);
      const std::size_t k = std::min(static_cast<std::size_t>(place), table_.size() - 2);
      f = std::lerp(static_cast<Long>(table_[k]), static_cast<Long>(table_[k + 1]), place - static_cast<Long>(k));
      break;
    }
  }
  if (softness_ <= 1e-6L) return f;
  return f * smoothstep(0.0L, softness_, u) * (1.0L - smoothstep(1.0L - softness_, 1.0L, u));
}

Long RadialIndex::integral(Long u) const {
  u = clamped(u);
  const Long w = 1.0L - u;
  if (softness_ <= 1e-6L) {
    switch (curve_) {
      case FieldCurve::linear:
        return 0.5L * w * w;
      case FieldCurve::power:
        return std::pow(w, a_ + 1.0L) / (a_ + 1.0L);
      case FieldCurve::exponential:
        return a_ == 0.0L ? w : -std::exp(-a_ * u) * std::expm1(-a_ * w) / a_;
      case FieldCurve::gaussian:
        return 0.5L * a_ * std::sqrt(pi_) * (std::erf(1.0L / a_) - std::erf(u / a_));
      case FieldCurve::polynomial:
        if (breaks_.size() == 2) {
          return a_ * w + b_ * (1.0L - u * u) / 2.0L + c_ * (1.0L - u * u * u) / 3.0L;
        }
        break;
      case FieldCurve::custom:
        break;
    }
  }
  Long sum = 0.0L;
  for (std::size_t k = 0; k + 1 < breaks_.size(); ++k) {
    const Long from = std::max(u, breaks_[k]);
    if (from >= breaks_[k + 1]) continue;
    sum += integrate([&](Long v) { return curve(v); }, from, breaks_[k + 1], 1e-19L).value;
  }
  return sum;
}

Long RadialIndex::log_index(Long r) const {
  if (r >= outer_) return 0.0L;
  const Long span = outer_ - inner_;
  if (r < inner_) return bending_ * (span * integral(0.0L) + curve(0.0L) * (inner_ - r));
  return bending_ * span * integral((r - inner_) / span);
}

Long RadialIndex::bending(Long r) const {
  return r >= outer_ ? 0.0L : bending_ * curve((r - inner_) / (outer_ - inner_));
}

namespace {

/// Radii where 1 - r bending(r) changes sign, ascending.
std::vector<Long> circular_rays(const RadialIndex& index) {
  const auto off = [&](Long r) { return 1.0L - r * index.bending(r); };
  std::vector<Long> out;
  Long from = 0.0L;
  for (const Long seam : index.seams()) {
    // Between seams curves are smooth and few-humped.
    constexpr int pieces = 400;
    const Long to = seam * (1.0L - 1e-15L);  // bending jumps at the rim itself
    for (int k = 0; k < pieces; ++k) {
      const Long low = from + (to - from) * static_cast<Long>(k) / pieces;
      const Long high = from + (to - from) * static_cast<Long>(k + 1) / pieces;
      if ((off(low) > 0.0L) != (off(high) > 0.0L)) out.push_back(bisected(off, low, high));
    }
    if ((off(to) > 0.0L) != (off(seam) > 0.0L)) out.push_back(seam);
    from = seam;
  }
  return out;
}

/// The radius inside `from` where n r first falls to b.
Long turn(const RadialIndex& index, Long from, Long b) {
  if (b == 0.0L) return 0.0L;
  const auto above = [&](Long r) { return std::log(r / b) + index.log_index(r); };
  std::vector<Long> ends = circular_rays(index);
  ends.insert(ends.begin(), 0.0L);
  Long outer = from;
  while (!ends.empty()) {
    const Long inner = ends.back();
    ends.pop_back();
    if (inner >= outer) continue;
    // n r is monotone from inner to outer, and 0 at the centre.
    if (inner == 0.0L || above(inner) < 0.0L) return bisected(above, inner, outer);
    outer = inner;
  }
  return 0.0L;
}

/// The angle swept from `from` out to `to`, starting with the invariant b and n r cos(psi) = `radial` there; `radial`
/// is 0 at a turning point.
Quadrature swept(const RadialIndex& index, Long from, Long to, Long b, Long radial) {
  const Long log_from = index.log_index(from);
  const Long nr_squared = radial == 0.0L ? b * b : b * b + radial * radial;
  const Long first_seam = *std::upper_bound(index.seams().begin(), index.seams().end(), from);
  const auto integrand = [&](Long t) {
    const Long beyond = t * t, r = from + beyond;
    // Near the turning point the difference of ln n would cancel: there it is integrated.
    const bool near = beyond < 0.05L * from && r < first_seam;
    const Long change = near ? -boost::math::quadrature::gauss<Long, 30>::integrate(
                                   [&](Long way) { return index.bending(from + way); }, 0.0L, beyond)
                             : index.log_index(r) - log_from;
    const Long growth = 2.0L * (std::log1p(beyond / from) + change);
    const Long root = std::sqrt(nr_squared * std::expm1(growth) + radial * radial);
    return 2.0L * b * t / (r * root);
  };
  Quadrature sum;
  Long begin = 0.0L;
  for (const Long seam : index.seams()) {
    if (seam <= from) continue;
    const Long end = std::sqrt(std::min(seam, to) - from);
    if (end <= begin) break;
    const Quadrature part = integrate(integrand, begin, end, 1e-17L);
    sum.value += part.value;
    sum.error += part.error;
    begin = end;
  }
  return sum;
}

using Plane = std::array<Long, 3>;
Long dot(const Plane& a, const Plane& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Plane combined(Long s, const Plane& a, Long t, const Plane& b) {
  return {s * a[0] + t * b[0], s * a[1] + t * b[1], s * a[2] + t * b[2]};
}

Line line_of(const Plane& point, const Plane& direction, const Vector& centre, Long angle_error) {
  Line out{};
  for (std::size_t i = 0; i < 3; ++i) {
    out.point[i] = static_cast<double>(point[i] + static_cast<Long>(centre[i]));
    out.direction[i] = static_cast<double>(direction[i]);
  }
  const double size = static_cast<double>(std::sqrt(dot(point, point)));
  out.direction_error = epsilon + static_cast<double>(angle_error);
  out.point_error = size * out.direction_error + epsilon * std::hypot(centre[0], centre[1], centre[2]);
  return out;
}

}  // namespace

std::vector<double> photon_spheres(const RadialIndex& index) {
  std::vector<double> out;
  const std::vector<Long> radii = circular_rays(index);
  for (auto r = radii.rbegin(); r != radii.rend(); ++r) out.push_back(static_cast<double>(*r));
  return out;
}

double turning_radius(const RadialIndex& index, double from, double b) {
  return static_cast<double>(turn(index, from, b));
}

ExactValue deflection(const RadialIndex& index, double b) {
  if (!(b >= 0.0)) throw std::domain_error(fmt::format("impact parameter {}, needs b >= 0", b));
  const Long R = index.r_outer();
  if (b >= R || b == 0.0) return {0.0, 0.0};
  const Quadrature half = swept(index, turn(index, R, b), R, b, 0.0L);
  const Long angle = 2.0L * (half.value + std::asin(b / R)) - pi_;
  return {static_cast<double>(angle),
          epsilon * (1.0 + static_cast<double>(std::abs(angle))) + static_cast<double>(2.0L * half.error)};
}

std::optional<Line> outgoing(const RadialIndex& index, const Vector& from, const Vector& direction) {
  const Long R = index.r_outer();
  Plane x{}, d{};
  for (std::size_t i = 0; i < 3; ++i) {
    x[i] = static_cast<Long>(from[i]) - static_cast<Long>(index.centre()[i]);
    d[i] = direction[i];
  }
  d = combined(1.0L / std::sqrt(dot(d, d)), d, 0.0L, d);
  const Plane start = x;
  Long r = std::sqrt(dot(x, x));
  if (r >= R) {
    const Long along = dot(x, d);
    const Plane nearest = combined(1.0L, x, -along, d);
    const Long missed = dot(nearest, nearest);
    if (along >= 0.0L || missed >= R * R) return line_of(start, d, index.centre(), 0.0L);
    x = combined(1.0L, nearest, -std::sqrt(R * R - missed), d);  // where it meets the rim
    r = R;
  }
  if (r == 0.0L) return line_of(combined(R, d, 0.0L, d), d, index.centre(), 0.0L);
  const Plane e = combined(1.0L / r, x, 0.0L, x);
  const Long cosine = dot(e, d);
  const Plane across = combined(1.0L, d, -cosine, e);
  const Long sine = std::sqrt(dot(across, across));
  if (sine == 0.0L) return line_of(combined(R, d, 0.0L, d), d, index.centre(), 0.0L);
  const Plane f = combined(1.0L / sine, across, 0.0L, across);
  const Long nr = r * std::exp(index.log_index(r));
  const Long b = nr * sine;
  if (b >= R) return std::nullopt;
  // Nothing may turn it back on the way out.
  for (const Long circle : circular_rays(index)) {
    if (circle > r && std::log(circle / b) + index.log_index(circle) <= 0.0L) return std::nullopt;
  }
  Quadrature angle;
  if (cosine < 0.0L) {
    const Long r0 = turn(index, r, b);
    angle = swept(index, r0, R, b, 0.0L);
    const Quadrature to_start = r < R ? swept(index, r0, r, b, 0.0L) : angle;
    angle = {angle.value + to_start.value, angle.error + to_start.error};
  } else {
    angle = swept(index, r, R, b, nr * cosine);
  }
  const Long s = std::sin(angle.value), c = std::cos(angle.value);
  const Plane outward = combined(c, e, s, f), onward = combined(c, f, -s, e);
  const Long sine_out = b / R;
  const Plane leaves = combined(std::sqrt((1.0L - sine_out) * (1.0L + sine_out)), outward, sine_out, onward);
  return line_of(combined(R, outward, 0.0L, outward), leaves, index.centre(), angle.error);
}

}  // namespace xpr::grin_exact
