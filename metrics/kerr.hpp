// Kerr: a rotating black hole of mass M and specific angular momentum a, |a| <= M (the extremal one too).
//
// Charts `kerr-schild` (s = +1, ingoing: regular on the future horizon) and `kerr-schild-outgoing` (s = -1: regular on
// the past horizon, for camera rays traced back in time):
//   g_{mu nu} = eta_{mu nu} + f l_mu l_nu,   f = 2 M r / Sigma,   Sigma = r^2 + a^2 cos^2 theta,
//   l_mu = (s, (r x + s a y) / (r^2 + a^2), (r y - s a x) / (r^2 + a^2), z / r),
//   x + iy = (r + i s a) e^{i phi_s} sin theta,   z = r cos theta
// The outgoing chart is the ingoing one under t -> -t, y -> -y, which keeps the sense of rotation. Both break on the
// ring r = 0 only, and each on the horizon of the other.
//
// Chart `boyer-lindquist`, with Delta = r^2 - 2 M r + a^2; breaks on the horizons and the axis:
//   ds^2 = -(1 - 2 M r / Sigma) dt^2 - 4 M a r sin^2 theta / Sigma dt dphi + Sigma / Delta dr^2 + Sigma dtheta^2
//          + (r^2 + a^2 + 2 M a^2 r sin^2 theta / Sigma) sin^2 theta dphi^2
//
// Between them t_s = t + s T(r), phi_s = phi + s Phi(r) with T' = 2 M r / Delta, Phi' = a / Delta and the constants
//   T   = 2 M / (r+ - r-) [r+ ln|(r - r+) / 2M| - r- ln|(r - r-) / 2M|],
//   Phi = a / (r+ - r-) ln|(r - r+) / (r - r-)|;   at a = M: 2 M ln|(r - M) / 2M| - 2 M^2 / (r - M) and -a / (r - M).
// The hub is `kerr-schild`: it is Cartesian, so that no map between the two regular charts meets the axis.
// Units: lengths in any one unit, M and a too. Cites: [Kerr1963] [BoyerLindquist1967] [Carter1968]
#pragma once

#include <cmath>

#include "metrics/coordinates.hpp"
#include "metrics/killing.hpp"
#include "metrics/separable.hpp"

namespace xpr {

/// What all charts of Kerr share: the two parameters and what follows from them.
struct KerrParameters {
  double M = 1.0;
  double a = 0.9;

  /// Throws std::invalid_argument: the value and the allowed range.
  void validate() const;

  /// r+ = M + sqrt(M^2 - a^2).
  [[nodiscard]] double horizon_radius() const { return M + std::sqrt((M - a) * (M + a)); }

  /// r_ph - r+ for the prograde equatorial photon orbit r_ph = 2 M [1 + cos((2/3) arccos(-|a|/M))], written with
  /// d = arccos(|a|/M) so that nothing cancels as |a| -> M: M [2 sin^2(d/3) + sqrt(3) sin(2d/3) - sin d].
  [[nodiscard]] double photon_orbit_gap() const {
    const double d = atan2(std::sqrt((M - a) * (M + a)), std::abs(a));
    return M * (2.0 * square(sin(d / 3.0)) + std::sqrt(3.0) * sin(2.0 * d / 3.0) - sin(d));
  }

  /// Halfway between the horizon and the prograde photon orbit, or 0.5% outside the horizon where that is closer; at
  /// a = M, where both coincide, 1e-12 M outside.
  [[nodiscard]] double default_r_min() const {
    const double r_plus = horizon_radius();
    return r_plus + std::fmax(0.5 * std::fmin(0.01 * r_plus, photon_orbit_gap()), 1e-12 * M);
  }

  template <class T>
  [[nodiscard]] constexpr T delta(const T& r) const {
    return square(r - M) - (T(M) - a) * (T(M) + a);
  }

  /// For first integrals: metrics/separable.hpp.
  [[nodiscard]] constexpr SeparatedLight separated() const { return {.mass = M, .spin = a, .charge_squared = 0.0}; }
};

/// T(r) and Phi(r): what the Kerr-Schild charts add to Boyer-Lindquist t and phi.
template <class T>
struct KerrShift {
  T time;
  T azimuth;
};

/// With u = r - M, w = sqrt(M^2 - a^2) and G = artanh(w / u) / u = ln|(u + w) / (u - w)| / 2w:
///   T = M ln|Delta / 4 M^2| - 2 M^2 G,   Phi = -a G,
/// where the series of artanh serves small w / u, so that a -> M is smooth.
template <class T>
[[nodiscard]] constexpr KerrShift<T> kerr_shift(const KerrParameters& kerr, const T& r) {
  const T mass = T(kerr.M);
  const T u = r - mass;
  const T w_sq = (mass - kerr.a) * (mass + kerr.a);
  const T w = sqrt(w_sq);
  const T q_sq = w_sq / square(u);  // from w^2: the derivative of sqrt is not finite at a = M
  // (1/4)^2k falls below 1e-51 at k = 42: enough for 50 digits; no map runs inside a step.
  T series = T(0.0);
  for (int k = 42; k >= 0; --k) series = series * q_sq + 1.0 / T(2 * k + 1);
  const T logarithm = log(abs((u + w) / (u - w))) / (2.0 * w);
  const T g = select(4.0 * w < abs(u), series / u, logarithm);
  const T outside = abs(kerr.delta(r) / (4.0 * square(mass)));
  return {mass * log(outside) - 2.0 * square(mass) * g, -kerr.a * g};
}

template <int Direction>
struct KerrSchild : KerrParameters {
  static_assert(Direction == 1 || Direction == -1);
  static constexpr Card card{
      .metric = "kerr",
      .chart = Direction > 0 ? "kerr-schild" : "kerr-schild-outgoing",
      .title = Direction > 0 ? "Kerr black hole, ingoing Kerr-Schild: regular for rays that fall in"
                             : "Kerr black hole, outgoing Kerr-Schild: regular for camera rays traced back in time",
      .line_element = "g = eta + f l l, f = 2 M r / Sigma, l null in eta and g",
      .coordinates = cartesian_coordinates,
      .ignorable = only_time_ignorable,
      .vacuum = true,
      .asymptotically_flat = true,
      .cites = "Kerr1963 Carter1968"};
  static constexpr std::array<Parameter<KerrSchild>, 2> parameters{
      {{"M", &KerrSchild::M, "mass, a length, M > 0"}, {"a", &KerrSchild::a, "spin, a length, |a| <= M"}}};

  template <Scalar T>
  [[nodiscard]] constexpr SymTensor4<T> inverse_metric(const Vec4<T>& x) const {
    const T spin = T(Direction * a);
    const auto [r, sigma] = spheroidal_radius(x, spin);
    const T inv = 1.0 / (square(r) + square(spin));
    const T f = 2.0 * M * r / sigma;
    const Vec4<T> l_up{T(-Direction), (r * x[1] + spin * x[2]) * inv, (r * x[2] - spin * x[1]) * inv, x[3] / r};
    return kerr_schild_inverse<T>(f, l_up);
  }

  /// Hamilton's equations of H = 1/2 (eta^{mu nu} p_mu p_nu - f (l.p)^2) by hand: two square roots, one division.
  template <Scalar T>
  [[nodiscard]] constexpr PhaseState<T> flow(const PhaseState<T>& y) const {
    const T X = y[1], Y = y[2], Z = y[3], p_x = y[5], p_y = y[6], p_z = y[7];
    const T spin = T(Direction * a);
    const auto [r_sq, sigma] = spheroidal_square(y.x(), spin);
    const T long_axis_sq = r_sq + square(spin);
    // Of r^2, so that the division need not wait for the root.
    const T inv = 1.0 / (r_sq * sigma * long_axis_sq);
    const T r = sqrt(r_sq);
    const T inv_r = r * (inv * (sigma * long_axis_sq));
    const T inv_sigma = inv * (r_sq * long_axis_sq), inv_long = inv * (r_sq * sigma);

    const T l_x = (r * X + spin * Y) * inv_long, l_y = (r * Y - spin * X) * inv_long, l_z = Z * inv_r;
    const T in_plane = l_x * p_x + l_y * p_y;
    const T l_p = in_plane + l_z * p_z - static_cast<double>(Direction) * y[4];
    const T f = 2.0 * M * r * inv_sigma;
    const T k = f * l_p;
    const T half = 0.5 * k * l_p;
    // Derivative of l.p in r at fixed x, y, z; then of the whole potential; then dr/dx^i, which is r x^i / Sigma in the
    // plane and (r^2 + a^2) z / (r Sigma) along the axis.
    const T slope_l_p = ((X * p_x + Y * p_y) - 2.0 * r * in_plane) * inv_long - l_z * p_z * inv_r;
    const T slope = half * (3.0 * inv_r - 4.0 * r * inv_sigma) + k * slope_l_p;
    const T slope_in_plane = slope * r * inv_sigma;
    const T k_long = k * inv_long;
    return {{static_cast<double>(Direction) * k - y[4], p_x - k * l_x, p_y - k * l_y, p_z - k * l_z},
            {T(0.0), k_long * (r * p_x - spin * p_y) + slope_in_plane * X,
             k_long * (r * p_y + spin * p_x) + slope_in_plane * Y,
             k * p_z * inv_r + (slope * long_axis_sq - 2.0 * half * square(spin) * inv_r) * (Z * inv_r * inv_sigma)}};
  }

  template <Scalar T>
  [[nodiscard]] constexpr T radius(const Vec4<T>& x) const {
    return spheroidal_radius(x, T(a)).r;
  }
  template <Scalar T>
  [[nodiscard]] constexpr std::array<KillingVectorOf<T>, 2> killing_vectors(const Vec4<T>& x) const {
    return {time_translation<T>(), cartesian_rotation_z(x)};
  }

  /// Q = p_theta^2 + cos^2 theta [a^2 (mu^2 - E^2) + L_z^2 / sin^2 theta] with mu^2 = -2H, 0 for light, written in
  /// Cartesian components: a polynomial in them, regular on the axis.
  template <Scalar T>
  [[nodiscard]] constexpr T carter_constant(const PhaseState<T>& y) const {
    const T r_sq = square(spheroidal_radius(y.x(), T(a)).r);
    const T long_axis_sq = r_sq + square(T(a));
    const T cos_sq = square(y[3]) / r_sq;
    const T distance_sq = square(y[1]) + square(y[2]);
    const T p = contract(y.p(), raise_index(inverse_metric(y.x()), y.p()));
    return cos_sq * (long_axis_sq * (square(y[5]) + square(y[6])) - square(T(a)) * (p + square(y[4]))) -
           2.0 * y[3] * y[7] * (y[1] * y[5] + y[2] * y[6]) + r_sq * distance_sq / long_axis_sq * square(y[7]);
  }

  /// All of space but the disc r = 0; inside the horizon too.
  template <class T>
  [[nodiscard]] constexpr MaskOf<T> inside_domain(const Vec4<T>& x) const {
    return all_finite(x) & (radius(x) > 0.0);
  }

  /// Boyer-Lindquist phi less the polar angle of (x, y): -s [Phi(r) + arg(r + ia)], which grows without bound towards
  /// the horizon.
  [[nodiscard]] double azimuth_offset(const Vec4<double>& x) const {
    const double r = radius(x);
    return -Direction * (kerr_shift(*this, r).azimuth + atan2(a, r));
  }

  /// From outgoing to ingoing: twice the shift, about the axis by the phase of (r + ia) / (r - ia) as well.
  template <class T>
  requires(Direction < 0) [[nodiscard]] constexpr PhaseState<T> to_hub(const PhaseState<T>& y, int /*sheet*/) const {
    return turned(y, 1.0);
  }
  template <class T>
  requires(Direction < 0) [[nodiscard]] constexpr PhaseState<T> from_hub(const PhaseState<T>& y) const {
    return turned(y, -1.0);
  }

 private:
  /// What diverges on a horizon, p_r's share of the shift, is taken off (or put on) where it stands, before p is
  /// turned: the angle's round-off, which grows as 1 / Delta too, times that share would be left otherwise.
  template <class T>
  [[nodiscard]] constexpr PhaseState<T> turned(const PhaseState<T>& y, double sense) const {
    const auto [r, sigma] = spheroidal_radius(y.x(), T(a));
    const T long_axis_sq = square(r) + square(T(a)), inv = 1.0 / long_axis_sq;
    const T L = y[1] * y[6] - y[2] * y[5];
    const T share = -2.0 * sense * ((2.0 * M * r * y[4] + a * L) / delta(r) - a * L * inv);
    const T in_plane = share * r / sigma;  // times dr/dx^i
    const T p_x = y[5] + in_plane * y[1], p_y = y[6] + in_plane * y[2];
    const T p_z = y[7] + share * long_axis_sq * y[3] / (r * sigma);
    const KerrShift<T> shift = kerr_shift(*this, r);
    const auto [sin_shift, cos_shift] = sincos(2.0 * sense * shift.azimuth);
    const T sin_phase = 2.0 * sense * a * r * inv, cos_phase = (square(r) - square(T(a))) * inv;
    const T sine = sin_shift * cos_phase + cos_shift * sin_phase;
    const T cosine = cos_shift * cos_phase - sin_shift * sin_phase;
    return {{y[0] + 2.0 * sense * shift.time, cosine * y[1] - sine * y[2], sine * y[1] + cosine * y[2], y[3]},
            {y[4], cosine * p_x - sine * p_y, sine * p_x + cosine * p_y, p_z}};
  }
};

using KerrSchildIngoing = KerrSchild<1>;
using KerrSchildOutgoing = KerrSchild<-1>;

struct KerrBoyerLindquist : KerrParameters {
  static constexpr Card card{
      .metric = "kerr",
      .chart = "boyer-lindquist",
      .title = "Kerr black hole, Boyer-Lindquist: the classical chart, singular on horizons and axis",
      .line_element =
          "ds^2 = -(1 - 2 M r / Sigma) dt^2 - 4 M a r sin^2 theta / Sigma dt dphi + Sigma / Delta dr^2 + "
          "Sigma dtheta^2 + (r^2 + a^2 + 2 M a^2 r sin^2 theta / Sigma) sin^2 theta dphi^2",
      .coordinates = spherical_coordinates,
      .ignorable = time_and_azimuth_ignorable,
      .vacuum = true,
      .asymptotically_flat = true,
      .cites = "BoyerLindquist1967 Carter1968"};
  static constexpr std::array<Parameter<KerrBoyerLindquist>, 2> parameters{
      {{"M", &KerrBoyerLindquist::M, "mass, a length, M > 0"},
       {"a", &KerrBoyerLindquist::a, "spin, a length, |a| <= M"}}};

  template <Scalar T>
  [[nodiscard]] constexpr SymTensor4<T> inverse_metric(const Vec4<T>& x) const {
    const T r = x[1];
    const auto [sin_theta, cos_theta] = sincos(x[2]);
    const T spin = T(a);
    const T sin_sq = square(sin_theta), spin_sq = square(spin);
    const T long_axis_sq = square(r) + spin_sq;
    const T d = delta(r);
    const T inv_sigma = 1.0 / (square(r) + square(spin * cos_theta));
    const T inv_sigma_delta = inv_sigma / d;
    SymTensor4<T> g = diagonal<T>((spin_sq * d * sin_sq - square(long_axis_sq)) * inv_sigma_delta, d * inv_sigma,
                                  inv_sigma, inv_sigma / sin_sq - spin_sq * inv_sigma_delta);
    g(0, 3) = -2.0 * M * spin * r * inv_sigma_delta;
    return g;
  }
  template <Scalar T>
  [[nodiscard]] constexpr T radius(const Vec4<T>& x) const {
    return x[1];
  }
  template <Scalar T>
  [[nodiscard]] constexpr std::array<KillingVectorOf<T>, 2> killing_vectors(const Vec4<T>& /*x*/) const {
    return {time_translation<T>(), KillingVectorOf<T>{"L_z", 1.0, {T(0.0), T(0.0), T(0.0), T(1.0)}}};
  }
  /// Q = p_theta^2 + cos^2 theta [a^2 (mu^2 - E^2) + L_z^2 / sin^2 theta], mu^2 = -2H, which is 0 for light.
  template <Scalar T>
  [[nodiscard]] constexpr T carter_constant(const PhaseState<T>& y) const {
    const auto [sin_theta, cos_theta] = sincos(y[2]);
    const T p = contract(y.p(), raise_index(inverse_metric(y.x()), y.p()));
    return square(y[6]) + square(cos_theta) * (square(over_sine(y[7], sin_theta)) - square(T(a)) * (p + square(y[4])));
  }
  /// r > 0 off the horizons, where t and phi diverge; between them too.
  template <class T>
  [[nodiscard]] constexpr MaskOf<T> inside_domain(const Vec4<T>& x) const {
    return all_finite(x) & (x[1] > 0.0) & (delta(x[1]) != 0.0);
  }

  template <class T>
  [[nodiscard]] constexpr PhaseState<T> to_hub(const PhaseState<T>& y, int /*sheet*/) const {
    const KerrShift<T> shift = kerr_shift(*this, y[1]);
    const T p_r = y[5] - (2.0 * M * y[1] * y[4] + a * y[7]) / delta(y[1]);
    return spheroidal_to_cartesian<T>({{y[0] + shift.time, y[1], y[2], y[3] + shift.azimuth}, {y[4], p_r, y[6], y[7]}},
                                      T(a));
  }
  template <class T>
  [[nodiscard]] constexpr PhaseState<T> from_hub(const PhaseState<T>& hub) const {
    const PhaseState<T> y = cartesian_to_spheroidal(hub, T(a));
    const KerrShift<T> shift = kerr_shift(*this, y[1]);
    const T p_r = y[5] + (2.0 * M * y[1] * y[4] + a * y[7]) / delta(y[1]);
    return {{y[0] - shift.time, y[1], y[2], y[3] - shift.azimuth}, {y[4], p_r, y[6], y[7]}};
  }
};

}  // namespace xpr
