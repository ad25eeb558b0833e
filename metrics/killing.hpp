// Killing vectors: what a module says of its symmetries, and the sets that charts share.
#pragma once

#include <array>
#include <string_view>

#include "metrics/scalar/elementary.hpp"
#include "metrics/tensor.hpp"

namespace xpr {

/// A Killing vector as a module gives it, over any scalar. The constant is sign * K^mu p_mu.
template <class T>
struct KillingVectorOf {
  std::string_view name;  ///< "E" stands for -p_t; "L_x", "L_y", "L_z" for rotations, "p_x", ... for translations
  double sign = 1.0;
  Vec4<T> component{};
};

template <class T>
[[nodiscard]] constexpr KillingVectorOf<T> time_translation() {
  return {"E", -1.0, {T(1.0), T(0.0), T(0.0), T(0.0)}};
}

/// The rotation about z in a Cartesian chart: L_z = x p_y - y p_x.
template <class T>
[[nodiscard]] constexpr KillingVectorOf<T> cartesian_rotation_z(const Vec4<T>& x) {
  return {"L_z", 1.0, {T(0.0), -x[2], x[1], T(0.0)}};
}

/// E and the three rotations, in a Cartesian chart of a static spherical spacetime.
template <class T>
[[nodiscard]] constexpr std::array<KillingVectorOf<T>, 4> spherical_symmetry_cartesian(const Vec4<T>& x) {
  const T zero = T(0.0);
  return {time_translation<T>(), KillingVectorOf<T>{"L_x", 1.0, {zero, zero, -x[3], x[2]}},
          KillingVectorOf<T>{"L_y", 1.0, {zero, x[3], zero, -x[1]}}, cartesian_rotation_z(x)};
}

/// E, the three rotations and the three translations of flat space.
template <class T>
[[nodiscard]] constexpr std::array<KillingVectorOf<T>, 7> euclidean_symmetry_cartesian(const Vec4<T>& x) {
  const auto [energy, about_x, about_y, about_z] = spherical_symmetry_cartesian(x);
  const T zero = T(0.0), one = T(1.0);
  return {energy,
          about_x,
          about_y,
          about_z,
          KillingVectorOf<T>{"p_x", 1.0, {zero, one, zero, zero}},
          KillingVectorOf<T>{"p_y", 1.0, {zero, zero, one, zero}},
          KillingVectorOf<T>{"p_z", 1.0, {zero, zero, zero, one}}};
}

/// E and the three rotations in a chart (t, r, theta, phi). Those about x and y break on the axis, as the chart does.
template <class T>
[[nodiscard]] constexpr std::array<KillingVectorOf<T>, 4> spherical_symmetry(const Vec4<T>& x) {
  const T zero = T(0.0);
  const auto [sin_theta, cos_theta] = sincos(x[2]);
  const auto [sin_phi, cos_phi] = sincos(x[3]);
  const T cot_theta = cos_theta / sin_theta;
  return {time_translation<T>(), KillingVectorOf<T>{"L_x", 1.0, {zero, zero, -sin_phi, -cot_theta * cos_phi}},
          KillingVectorOf<T>{"L_y", 1.0, {zero, zero, cos_phi, -cot_theta * sin_phi}},
          KillingVectorOf<T>{"L_z", 1.0, {zero, zero, zero, T(1.0)}}};
}

}  // namespace xpr
