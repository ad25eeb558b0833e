// A static medium of refractive index n(x) as a spacetime: Gordon's metric of a medium at rest, whose null rays are the
// light rays of optics and whose t is the optical path.
//   ds^2 = -dt^2 / n^2 + dx^2 + dy^2 + dz^2,   H = 1/2 (p^2 - n^2 p_t^2), which separates
// Chart `cartesian`, all of space. Spherical indices n(|x|) about the origin:
// - `medium-uniform` (n): straight lines;
// - `luneburg` (R): n^2 = 2 - |x|^2 / R^2 inside |x| = R, 1 outside: parallel light meets in the point of the rim
//   opposite. The gradient of n^2 jumps at the rim: an integrator must end a step there (interface_radius);
// - `maxwell-fisheye` (R): n = 2 / (1 + |x|^2 / R^2): every ray is a circle, every point is imaged perfectly.
// Units: lengths in any one unit, R too. Cites: [Gordon1923] [Luneburg1964] [Maxwell1854] [BornWolf1999]
#pragma once

#include <cmath>
#include <optional>

#include "metrics/coordinates.hpp"
#include "metrics/killing.hpp"

namespace xpr {

/// n^2 and its derivative in |x|^2.
template <class T>
struct IndexSquared {
  T value;
  T slope;
};

/// The lapse 1 / n and its first two derivatives in |x|^2, written out from the profile: what curvature is declared by.
struct Lapse {
  double value;
  double slope;
  double second;
};

struct UniformIndex {
  double n = 1.5;

  static constexpr Card card{.metric = "medium-uniform",
                             .chart = "cartesian",
                             .title = "Uniform medium of refractive index n",
                             .line_element = "ds^2 = -dt^2 / n^2 + dx^2 + dy^2 + dz^2",
                             .coordinates = cartesian_coordinates,
                             .ignorable = {true, true, true, true},
                             .vacuum = true,
                             .asymptotically_flat = false,
                             .cites = "Gordon1923 BornWolf1999"};
  static constexpr std::array<Parameter<UniformIndex>, 1> parameters{
      {{"n", &UniformIndex::n, "refractive index, n > 0"}}};
  static constexpr bool flat = true;

  /// Throws std::invalid_argument: the value and the allowed range.
  void validate() const;
  template <class T>
  [[nodiscard]] constexpr IndexSquared<T> index_squared(const T& /*distance_sq*/) const {
    return {square(T(n)), T(0.0)};
  }
};

struct LuneburgIndex {
  double R = 1.0;

  static constexpr Card card{.metric = "luneburg",
                             .chart = "cartesian",
                             .title = "Luneburg lens of radius R in vacuum",
                             .line_element = "ds^2 = -dt^2 / n^2 + dx^2 + dy^2 + dz^2, n^2 = 2 - |x|^2 / R^2 inside R",
                             .coordinates = cartesian_coordinates,
                             .ignorable = only_time_ignorable,
                             .vacuum = false,
                             .asymptotically_flat = true,
                             .cites = "Luneburg1964 BornWolf1999"};
  static constexpr std::array<Parameter<LuneburgIndex>, 1> parameters{
      {{"R", &LuneburgIndex::R, "radius of the lens, R > 0"}}};

  /// Throws std::invalid_argument: the value and the allowed range.
  void validate() const;
  template <class T>
  [[nodiscard]] constexpr IndexSquared<T> index_squared(const T& distance_sq) const {
    const auto inside = distance_sq < square(T(R));
    const IndexSquared<T> lens = index_squared_of_side(distance_sq, true);
    return {select(inside, lens.value, T(1.0)), select(inside, lens.slope, T(0.0))};
  }
  /// Each side's own formula, past the rim too.
  template <class T>
  [[nodiscard]] constexpr IndexSquared<T> index_squared_of_side(const T& distance_sq, bool inside) const {
    if (!inside) return {T(1.0), T(0.0)};
    const T inv = 1.0 / square(T(R));
    return {2.0 - distance_sq * inv, -inv};
  }
  [[nodiscard]] Lapse lapse(double distance_sq) const {
    if (distance_sq >= R * R) return {1.0, 0.0, 0.0};
    const double n_sq = 2.0 - distance_sq / (R * R);
    const double value = 1.0 / std::sqrt(n_sq);
    const double slope = 0.5 * value / (n_sq * R * R);
    return {value, slope, 1.5 * slope / (n_sq * R * R)};
  }
  [[nodiscard]] double interface_radius() const { return R; }
};

struct FisheyeIndex {
  double R = 1.0;

  static constexpr Card card{.metric = "maxwell-fisheye",
                             .chart = "cartesian",
                             .title = "Maxwell's fish-eye of radius R, unbounded",
                             .line_element = "ds^2 = -dt^2 / n^2 + dx^2 + dy^2 + dz^2, n = 2 / (1 + |x|^2 / R^2)",
                             .coordinates = cartesian_coordinates,
                             .ignorable = only_time_ignorable,
                             .vacuum = false,
                             .asymptotically_flat = false,
                             .cites = "Maxwell1854 BornWolf1999"};
  static constexpr std::array<Parameter<FisheyeIndex>, 1> parameters{
      {{"R", &FisheyeIndex::R, "radius of the circle on which n = 1, R > 0"}}};

  /// Throws std::invalid_argument: the value and the allowed range.
  void validate() const;
  template <class T>
  [[nodiscard]] constexpr IndexSquared<T> index_squared(const T& distance_sq) const {
    const T radius_sq = square(T(R));
    const T n = 2.0 * radius_sq / (radius_sq + distance_sq);
    const T n_sq = square(n);
    return {n_sq, -n_sq * n / radius_sq};
  }
  [[nodiscard]] Lapse lapse(double distance_sq) const {
    return {0.5 * (1.0 + distance_sq / (R * R)), 0.5 / (R * R), 0.0};
  }
};

/// The spacetime of an index profile: the same physics for every n(|x|).
template <class Index>
struct Medium : Index {
  static constexpr bool separable = true;

  template <Scalar T>
  [[nodiscard]] constexpr SymTensor4<T> inverse_metric(const Vec4<T>& x) const {
    const T n_sq = this->index_squared(distance_squared(x)).value;
    return diagonal<T>(-n_sq, T(1.0), T(1.0), T(1.0));
  }
  /// Hamilton's equations by hand: the slope of n^2 is the profile's own.
  template <Scalar T>
  [[nodiscard]] constexpr PhaseState<T> flow(const PhaseState<T>& y) const {
    return flow_with(this->index_squared(distance_squared(y.x())), y);
  }
  /// The flow of one side of the interface, continued smoothly past it.
  template <Scalar T>
  [[nodiscard]] constexpr PhaseState<T> flow_of_side(const PhaseState<T>& y, bool inside) const requires
      requires(const Index& index) {
    index.interface_radius();
  }
  { return flow_with(this->index_squared_of_side(distance_squared(y.x()), inside), y); }
  template <Scalar T>
  [[nodiscard]] constexpr T radius(const Vec4<T>& x) const {
    return euclidean_radius(x);
  }
  template <Scalar T>
  [[nodiscard]] constexpr auto killing_vectors(const Vec4<T>& x) const {
    if constexpr (Index::card.ignorable[1]) {
      return euclidean_symmetry_cartesian(x);
    } else {
      return spherical_symmetry_cartesian(x);
    }
  }
  template <class T>
  [[nodiscard]] constexpr MaskOf<T> inside_domain(const Vec4<T>& x) const {
    return all_finite(x);
  }

  /// A static lapse N over flat space: R_tt = N div grad N, R_ij = -d_i d_j N / N.
  [[nodiscard]] SymTensor4<double> declared_ricci(const Vec4<double>& x) const requires requires(const Index& index) {
    index.lapse(0.0);
  }
  {
    const double distance_sq = distance_squared(x);
    const Lapse n = this->lapse(distance_sq);
    SymTensor4<double> ricci{};
    ricci(0, 0) = n.value * (6.0 * n.slope + 4.0 * distance_sq * n.second);
    for (std::size_t i = 1; i < 4; ++i) {
      for (std::size_t j = i; j < 4; ++j) {
        ricci(i, j) = -((i == j ? 2.0 * n.slope : 0.0) + 4.0 * n.second * x[i] * x[j]) / n.value;
      }
    }
    return ricci;
  }

 private:
  template <class T>
  [[nodiscard]] static constexpr PhaseState<T> flow_with(const IndexSquared<T>& n_sq, const PhaseState<T>& y) {
    const T pull = square(y[4]) * n_sq.slope;
    return {{-n_sq.value * y[4], y[5], y[6], y[7]}, {T(0.0), pull * y[1], pull * y[2], pull * y[3]}};
  }
  template <class T>
  [[nodiscard]] static constexpr T distance_squared(const Vec4<T>& x) {
    return square(x[1]) + square(x[2]) + square(x[3]);
  }
};

using MediumUniform = Medium<UniformIndex>;
using Luneburg = Medium<LuneburgIndex>;
using MaxwellFisheye = Medium<FisheyeIndex>;

}  // namespace xpr
