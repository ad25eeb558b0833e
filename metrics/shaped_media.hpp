// Static media that are no spheres.
// - `selfoc` (n0, g): the parabolic fibre along z, n^2 = n0^2 (1 - g^2 rho^2), rho < 1/g: rays are harmonic across it.
//     ds^2 = -dt^2 / n^2 + dx^2 + dy^2 + dz^2
// - `stretched-fisheye` (R, s): Maxwell's fish-eye drawn out by s along (1, 1, 0)/sqrt 2, an anisotropic medium:
//   x = D q, D = 1 + (s - 1) e e^T, light runs in q as in the fish-eye, and sees n_ij = n(q)^2 (D^-2)_ij:
//     ds^2 = -dt^2 / n(q)^2 + (D^-2)_ij dx^i dx^j,   n(q) = 2 / (1 + |q|^2 / R^2)
// Chart `cartesian`. Units: lengths in any one unit, R and 1/g too. Cites: [BornWolf1999] [Maxwell1854]
#pragma once

#include "metrics/coordinates.hpp"
#include "metrics/killing.hpp"

namespace xpr {

struct SelfocFibre {
  double n0 = 1.5;
  double g = 0.3;

  static constexpr Card card{
      .metric = "selfoc",
      .chart = "cartesian",
      .title = "Parabolic fibre along z, index n0 on the axis",
      .line_element = "ds^2 = -dt^2 / n^2 + dx^2 + dy^2 + dz^2, n^2 = n0^2 (1 - g^2 (x^2 + y^2))",
      .coordinates = cartesian_coordinates,
      .ignorable = {true, false, false, true},
      .vacuum = false,
      .asymptotically_flat = false,
      .cites = "BornWolf1999"};
  static constexpr std::array<Parameter<SelfocFibre>, 2> parameters{
      {{"n0", &SelfocFibre::n0, "index on the axis, n0 > 0"},
       {"g", &SelfocFibre::g, "strength, g > 0, per length: n = 0 at a distance of 1/g"}}};
  static constexpr bool separable = true;

  /// Throws std::invalid_argument: the value and the allowed range.
  void validate() const;
  template <Scalar T>
  [[nodiscard]] constexpr SymTensor4<T> inverse_metric(const Vec4<T>& x) const {
    return diagonal<T>(-index_squared(x), T(1.0), T(1.0), T(1.0));
  }
  template <Scalar T>
  [[nodiscard]] constexpr PhaseState<T> flow(const PhaseState<T>& y) const {
    const T pull = -square(y[4]) * (square(n0) * square(g));
    return {{-index_squared(y.x()) * y[4], y[5], y[6], y[7]}, {T(0.0), pull * y[1], pull * y[2], T(0.0)}};
  }
  template <Scalar T>
  [[nodiscard]] constexpr T radius(const Vec4<T>& x) const {
    return euclidean_radius(x);
  }
  template <Scalar T>
  [[nodiscard]] constexpr std::array<KillingVectorOf<T>, 3> killing_vectors(const Vec4<T>& x) const {
    return {time_translation<T>(), cartesian_rotation_z(x),
            KillingVectorOf<T>{"p_z", 1.0, {T(0.0), T(0.0), T(0.0), T(1.0)}}};
  }
  template <class T>
  [[nodiscard]] constexpr MaskOf<T> inside_domain(const Vec4<T>& x) const {
    return all_finite(x) & (index_squared(x) > T(0.0));
  }

 private:
  template <class T>
  [[nodiscard]] constexpr T index_squared(const Vec4<T>& x) const {
    return square(n0) * (1.0 - square(g) * (square(x[1]) + square(x[2])));
  }
};

struct StretchedFisheye {
  double R = 1.0;
  double s = 1.6;

  static constexpr Card card{
      .metric = "stretched-fisheye",
      .chart = "cartesian",
      .title = "Maxwell's fish-eye stretched by s along (1, 1, 0): an anisotropic medium",
      .line_element = "ds^2 = -dt^2 / n(q)^2 + |dq|^2, x = q + (s - 1) e (e.q), e = (1, 1, 0)/sqrt 2",
      .coordinates = cartesian_coordinates,
      .ignorable = only_time_ignorable,
      .vacuum = false,
      .asymptotically_flat = false,
      .cites = "Maxwell1854 BornWolf1999"};
  static constexpr std::array<Parameter<StretchedFisheye>, 2> parameters{
      {{"R", &StretchedFisheye::R, "radius of the sphere of q on which n = 1, R > 0"},
       {"s", &StretchedFisheye::s, "stretch, s > 0; 1 is the fish-eye itself"}}};
  static constexpr bool for_lanes = false;  // nobody traces many

  /// Throws std::invalid_argument: the value and the allowed range.
  void validate() const;
  template <Scalar T>
  [[nodiscard]] constexpr SymTensor4<T> inverse_metric(const Vec4<T>& x) const {
    // |q|^2 = |x|^2 + (1/s^2 - 1) (e.x)^2, and g^{ij} = (D^2)_ij.
    const T along_sq = 0.5 * square(x[1] + x[2]);
    const T q_sq = square(x[1]) + square(x[2]) + square(x[3]) + (1.0 / square(s) - 1.0) * along_sq;
    const T n = 2.0 / (1.0 + q_sq / square(R));
    const double stretch = 0.5 * (square(s) - 1.0);
    SymTensor4<T> g_inverse = diagonal<T>(-square(n), T(1.0 + stretch), T(1.0 + stretch), T(1.0));
    g_inverse(1, 2) = T(stretch);
    return g_inverse;
  }
  template <Scalar T>
  [[nodiscard]] constexpr T radius(const Vec4<T>& x) const {
    return euclidean_radius(x);
  }
  template <class T>
  [[nodiscard]] constexpr MaskOf<T> inside_domain(const Vec4<T>& x) const {
    return all_finite(x);
  }
};

}  // namespace xpr
