#include "core/camera/tetrad.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <stdexcept>

namespace xpr {
namespace {

Vec4<double> combine(double a, const Vec4<double>& u, double b, const Vec4<double>& v) {
  Vec4<double> out;
  for (std::size_t i = 0; i < 4; ++i) out[i] = a * u[i] + b * v[i];
  return out;
}

/// Where an observer is to stand, and what is asked of the spacetime there.
class Standpoint {
 public:
  Standpoint(const Spacetime& chart, const Vec4<double>& x) : chart_(chart), x_(x), metric_(chart.metric(x)) {
    for (const KillingVector& killing : chart.killing_vectors(x)) {
      if (killing.name == "E") time_ = killing.component;
      if (killing.name == "L_z") turn_ = killing.component;
    }
  }

  [[nodiscard]] const SymTensor4<double>& metric() const { return metric_; }
  [[nodiscard]] double product(const Vec4<double>& a, const Vec4<double>& b) const { return inner(metric_, a, b); }

  [[nodiscard]] Vec4<double> at_rest() const {
    if (!time_) refuse("nothing is at rest: no symmetry in time");
    const std::optional<Vec4<double>> u = unit_timelike(metric_, *time_);
    if (!u) refuse("an observer at rest is impossible inside the ergosphere; possible outside the horizon: zamo");
    return *u;
  }

  [[nodiscard]] Vec4<double> zamo() const {
    if (!time_ || !turn_) refuse("an observer without angular momentum needs symmetry in time and about the z axis");
    const double square = product(*turn_, *turn_);
    const double omega = square > 0.0 ? -product(*time_, *turn_) / square : 0.0;
    const std::optional<Vec4<double>> u = unit_timelike(metric_, combine(1.0, *time_, omega, *turn_));
    if (!u) refuse("no observer can stay inside the horizon; put the camera outside");
    return *u;
  }

  /// Geodesic along xi = d_t + Omega d_phi: the acceleration is that of a quadratic in Omega, and radial.
  [[nodiscard]] Vec4<double> circular_orbit(bool retrograde) const {
    (void)zamo();
    const double radius = chart_.radius(x_);
    if (std::abs(off_plane()) > 1e-9 * radius) refuse("a circular orbit about the z axis needs a camera in z = 0");
    const Connection<double> connection = chart_.christoffel(x_);
    const Vec4<double> outward = radial();
    const auto bent = [&](const Vec4<double>& a, const Vec4<double>& b) {
      Vec4<double> out{};
      for (std::size_t mu = 0; mu < 4; ++mu) {
        for (std::size_t i = 0; i < 4; ++i) {
          for (std::size_t j = 0; j < 4; ++j) out[mu] += connection[mu](i, j) * a[i] * b[j];
        }
      }
      return product(outward, out);
    };
    const double c = bent(*time_, *time_);
    const double half_b = bent(*time_, *turn_);
    const double a = bent(*turn_, *turn_) + product(outward, turned_along_itself());
    const double discriminant = half_b * half_b - a * c;
    if (!(discriminant >= 0.0) || a == 0.0) refuse("no circular orbit here: nothing pulls inward");
    const double root = std::sqrt(discriminant);
    const double first = (-half_b + root) / a, second = (-half_b - root) / a;
    const double larger = std::max(first, second), smaller = std::min(first, second);
    const std::optional<Vec4<double>> u =
        unit_timelike(metric_, combine(1.0, *time_, retrograde ? smaller : larger, *turn_));
    if (!u) refuse("a circular orbit here is not timelike: it lies inside the photon orbit");
    return *u;
  }

  /// gamma is 1 over the lapse of the observer without angular momentum, so that E = 1.
  [[nodiscard]] Vec4<double> falling() const {
    const Vec4<double> still = zamo();
    const double gamma = -1.0 / product(still, *time_);
    if (!chart_.card().asymptotically_flat || gamma < 1.0) refuse("nothing falls here from rest at infinity");
    Vec4<double> inward = radial();
    inward = combine(1.0, inward, product(inward, still), still);
    const double length = std::sqrt(product(inward, inward));
    return combine(gamma, still, -std::sqrt(gamma * gamma - 1.0) / length, inward);
  }

  [[noreturn]] void refuse(const char* why) const {
    throw std::invalid_argument(
        fmt::format("observer at ({}, {}, {}) in {}: {}", x_[1], x_[2], x_[3], chart_.card().metric, why));
  }

 private:
  /// The gradient of the radius, its index raised. Differences do: only the direction counts.
  [[nodiscard]] Vec4<double> radial() const {
    Vec4<double> gradient{};
    for (std::size_t i = 1; i < 4; ++i) {
      const double step = 1e-5 * chart_.radius(x_);
      Vec4<double> ahead = x_, behind = x_;
      ahead[i] += step;
      behind[i] -= step;
      gradient[i] = (chart_.radius(ahead) - chart_.radius(behind)) / (2.0 * step);
    }
    return raise_index(chart_.inverse_metric(x_), gradient);
  }

  /// The z coordinate of a Cartesian chart.
  [[nodiscard]] double off_plane() const { return x_[3]; }

  /// (d_phi . grad) d_phi: the rotation is linear in Cartesian coordinates.
  [[nodiscard]] Vec4<double> turned_along_itself() const {
    Vec4<double> ahead = x_;
    for (std::size_t i = 0; i < 4; ++i) ahead[i] += (*turn_)[i];
    for (const KillingVector& killing : chart_.killing_vectors(ahead)) {
      if (killing.name == "L_z") return combine(1.0, killing.component, -1.0, *turn_);
    }
    return {};
  }

  const Spacetime& chart_;
  Vec4<double> x_;
  SymTensor4<double> metric_;
  std::optional<Vec4<double>> time_, turn_;
};

/// The seed made orthogonal to vectors of the given squares and brought to length one.
Vec4<double> orthonormal(const Standpoint& at, const Vec3& seed, const Vec4<double>& time,
                         const std::vector<Vec4<double>>& others) {
  Vec4<double> v{0.0, seed.x, seed.y, seed.z};
  // Twice: rounding of the first pass is orthogonal after the second.
  for (int pass = 0; pass < 2; ++pass) {
    v = combine(1.0, v, at.product(v, time), time);
    for (const Vec4<double>& other : others) v = combine(1.0, v, -at.product(v, other), other);
  }
  const double square = at.product(v, v);
  if (!(square > 1e-20 * dot(seed, seed))) at.refuse("the viewing direction and `up` must not be parallel, nor zero");
  return combine(1.0 / std::sqrt(square), v, 0.0, v);
}

Tetrad framed(const Standpoint& at, const Vec4<double>& time, const Vec3& forward, const Vec3& up) {
  Tetrad frame{.time = time, .right = {}, .up = {}, .forward = {}};
  frame.forward = orthonormal(at, forward, time, {});
  frame.up = orthonormal(at, up, time, {frame.forward});
  frame.right = orthonormal(at, cross(forward, up), time, {frame.forward, frame.up});
  return frame;
}

/// The boost without rotation that takes the frame's time to u.
Tetrad boosted(const Standpoint& at, const Tetrad& frame, const Vec4<double>& u) {
  const Vec4<double> sum = combine(1.0, u, 1.0, frame.time);
  const double scale = 1.0 / (1.0 - at.product(u, frame.time));
  const auto moved = [&](const Vec4<double>& w) { return combine(1.0, w, scale * at.product(u, w), sum); };
  return {.time = u, .right = moved(frame.right), .up = moved(frame.up), .forward = moved(frame.forward)};
}

}  // namespace

double inner(const SymTensor4<double>& metric, const Vec4<double>& a, const Vec4<double>& b) {
  return contract(raise_index(metric, a), b);
}

std::optional<Vec4<double>> unit_timelike(const SymTensor4<double>& metric, const Vec4<double>& a) {
  const double square = inner(metric, a, a);
  if (!(square < 0.0)) return std::nullopt;
  return combine(1.0 / std::sqrt(-square), a, 0.0, a);
}

Tetrad make_tetrad(const Spacetime& chart, const Vec4<double>& x, const SceneObserver& observer, const Vec3& forward,
                   const Vec3& up) {
  const Standpoint at(chart, x);
  switch (observer.kind) {
    case ObserverKind::at_rest:
      return framed(at, at.at_rest(), forward, up);
    case ObserverKind::zamo:
      return framed(at, at.zamo(), forward, up);
    case ObserverKind::circular_orbit:
      return boosted(at, framed(at, at.zamo(), forward, up), at.circular_orbit(!observer.prograde));
    case ObserverKind::falling:
      return boosted(at, framed(at, at.zamo(), forward, up), at.falling());
    case ObserverKind::boosted:
      break;
  }
  const Tetrad rest = framed(at, at.at_rest(), forward, up);
  const double speed = length(observer.velocity);
  if (!(speed < 1.0)) at.refuse("the velocity of a boosted observer needs |v| < 1");
  if (speed == 0.0) return rest;
  const double gamma = 1.0 / std::sqrt((1.0 - speed) * (1.0 + speed));
  const Vec4<double> along = orthonormal(at, observer.velocity, rest.time, {});
  return boosted(at, rest, combine(gamma, rest.time, gamma * speed, along));
}

}  // namespace xpr
