// Coordinates that several charts share, and the steps between spheroidal and Cartesian phase space that chart maps are
// made of.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "metrics/card.hpp"
#include "metrics/scalar/elementary.hpp"
#include "metrics/tensor.hpp"

namespace xpr {

inline constexpr std::array<Coordinate, 4> cartesian_coordinates{{{"t", CoordinateKind::time},
                                                                  {"x", CoordinateKind::length},
                                                                  {"y", CoordinateKind::length},
                                                                  {"z", CoordinateKind::length}}};

inline constexpr std::array<Coordinate, 4> spherical_coordinates{
    {{"t", CoordinateKind::time},
     {"r", CoordinateKind::length, 0.0},
     {"theta", CoordinateKind::polar_angle, 0.0, std::numbers::pi},
     {"phi", CoordinateKind::azimuth, -std::numbers::pi, std::numbers::pi}}};

inline constexpr std::array<bool, 4> only_time_ignorable{true, false, false, false};
inline constexpr std::array<bool, 4> time_and_azimuth_ignorable{true, false, false, true};

/// Whether no component is NaN or infinite.
template <class T>
[[nodiscard]] constexpr MaskOf<T> all_finite(const Vec4<T>& x) {
  return isfinite(x[0]) & isfinite(x[1]) & isfinite(x[2]) & isfinite(x[3]);
}

/// |x| of the spatial part.
template <class T>
[[nodiscard]] constexpr T euclidean_radius(const Vec4<T>& x) {
  return sqrt(square(x[1]) + square(x[2]) + square(x[3]));
}

/// eta^{mu nu} - f l^mu l^nu for a null vector l, index up: the inverse of the Kerr-Schild form eta + f l l.
template <class T>
[[nodiscard]] constexpr SymTensor4<T> kerr_schild_inverse(const T& f, const Vec4<T>& l) {
  const T f_t = f * l[0], f_x = f * l[1], f_y = f * l[2], f_z = f * l[3];
  return {{-1.0 - f_t * l[0], -f_t * l[1], -f_t * l[2], -f_t * l[3], 1.0 - f_x * l[1], -f_x * l[2], -f_x * l[3],
           1.0 - f_y * l[2], -f_y * l[3], 1.0 - f_z * l[3]}};
}

/// The square of the spheroidal radius of a Cartesian point, and Sigma = r^2 + a^2 cos^2 theta.
template <class T>
struct SpheroidalSquare {
  T r_sq;
  T sigma;
};

/// r >= 0 in x + iy = (r + ia) e^{i phi} sin theta, z = r cos theta: the root of r^4 - b r^2 - a^2 z^2 = 0 with
/// b = x^2 + y^2 + z^2 - a^2, taken without cancellation on either side of b = 0. Sigma is the root's discriminant.
template <class T>
[[nodiscard, gnu::always_inline]] constexpr SpheroidalSquare<T> spheroidal_square(const Vec4<T>& x, const T& a) {
  const T b = square(x[1]) + square(x[2]) + square(x[3]) - square(a);
  const T az = a * x[3];
  const T sigma = sqrt(square(b) + 4.0 * square(az));
  const T larger = 0.5 * (abs(b) + sigma);
  const auto inner = b < 0.0;
  // A division that few points need, and none waits for.
  if (any(inner)) return {select(inner, square(az) / larger, larger), sigma};
  return {larger, sigma};
}

template <class T>
struct SpheroidalRadius {
  T r;
  T sigma;
};
template <class T>
[[nodiscard, gnu::always_inline]] constexpr SpheroidalRadius<T> spheroidal_radius(const Vec4<T>& x, const T& a) {
  const auto [r_sq, sigma] = spheroidal_square(x, a);
  return {sqrt(r_sq), sigma};
}

/// p_phi / sin theta, which is 0 on the axis for rays that have no angular momentum about it.
template <class T>
[[nodiscard]] constexpr T over_sine(const T& p_phi, const T& sin_theta) {
  return select(sin_theta == 0.0, select(p_phi == 0.0, p_phi, p_phi / sin_theta), p_phi / sin_theta);
}

/// (x, p) from (t, r, theta, phi) to (t, x, y, z) with x + iy = (r + ia) e^{i phi} sin theta, z = r cos theta; a = 0 is
/// the spherical case. On the axis p_phi must be 0. Near it the azimuthal momentum p_phi / sin theta is as good as
/// sin theta: close to theta = pi the spacing of doubles, 4e-16, moves the point by that much times r.
template <class T>
[[nodiscard]] constexpr PhaseState<T> spheroidal_to_cartesian(const PhaseState<T>& y, const T& a) {
  const T r = y[1];
  const auto [sin_theta, cos_theta] = sincos(y[2]);
  const auto [sin_phi, cos_phi] = sincos(y[3]);
  const T p_r = y[5], p_theta = y[6];
  const T q = over_sine(y[7], sin_theta);
  const T inv_sigma = 1.0 / (square(r) + square(a * cos_theta));
  // Along e = (cos phi, sin phi), across it, and along z.
  const T p_along = (r * (r * sin_theta * p_r + cos_theta * p_theta) - a * square(cos_theta) * q) * inv_sigma;
  const T p_across = (r * q + a * (r * sin_theta * p_r + cos_theta * p_theta)) * inv_sigma;
  const T p_z = ((square(r) + square(a)) * cos_theta * p_r - sin_theta * (r * p_theta - a * cos_theta * q)) * inv_sigma;
  return {{y[0], (r * cos_phi - a * sin_phi) * sin_theta, (r * sin_phi + a * cos_phi) * sin_theta, r * cos_theta},
          {y[4], cos_phi * p_along - sin_phi * p_across, sin_phi * p_along + cos_phi * p_across, p_z}};
}

/// Undoes spheroidal_to_cartesian. Regular on the axis, where phi = 0 is chosen and only the momentum in the plane
/// phi = 0 is kept: a spherical chart has no room for the rest.
template <class T>
[[nodiscard]] constexpr PhaseState<T> cartesian_to_spheroidal(const PhaseState<T>& y, const T& a) {
  const T r = spheroidal_radius(y.x(), a).r;
  const T distance_sq = square(y[1]) + square(y[2]);
  const T long_axis = sqrt(square(r) + square(a));
  const T theta = atan2(r * sqrt(distance_sq), long_axis * y[3]);
  const T phi = atan2(r * y[2] - a * y[1], r * y[1] + a * y[2]);
  const auto [sin_theta, cos_theta] = sincos(theta);
  const auto [sin_phi, cos_phi] = sincos(phi);
  const T p_along = cos_phi * y[5] + sin_phi * y[6];
  const T p_across = cos_phi * y[6] - sin_phi * y[5];
  return {{y[0], r, theta, phi},
          {y[4], sin_theta * p_along + cos_theta * y[7],
           cos_theta * (r * p_along + a * p_across) - r * sin_theta * y[7], y[1] * y[6] - y[2] * y[5]}};
}

}  // namespace xpr
