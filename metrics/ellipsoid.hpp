// Ultrastatic ellipsoid of revolution: its null geodesics are the geodesics of the surface, run through in time t.
//   ds^2 = -dt^2 + h + dz^2,   h = m^2 dlat^2 + N^2 cos^2 lat dlon^2,
//   N = a_axis / w,  m = a_axis (1 - e^2) / w^3,  w^2 = 1 - e^2 sin^2 lat,  e^2 = f (2 - f)
// lat is the geographic latitude, the direction of the surface's normal nu = (cos lat cos lon, cos lat sin lon, sin
// lat) in a frame whose third axis is the axis of revolution; z is a flat direction in which light need not move (p_z =
// 0). Charts: `geographic`, (t, lat, lon, z), breaks on the poles; `geographic-turned`, (t, beta, lambda, z) with nu =
// (sin beta, cos beta cos lambda, cos beta sin lambda), breaks on the equator at lon = 0 and 180 degrees. From
//   h = N^2 (dnu^2 - k dnu_3^2),  k = e^2 (2 - e^2 - e^2 nu_3^2) / w^4
// both follow. The atlas goes over where the sine of the latitude passes 0.9 in size: the other chart's is then below
// 0.44, so that a ray crosses half of that chart before it may return. The hub is `geographic`.
// Units: lengths as a_axis. f < 0 is prolate. Ricci is not zero. Cites: [Karney2013]
#pragma once

#include <cmath>
#include <numbers>
#include <optional>

#include "metrics/atlas.hpp"
#include "metrics/coordinates.hpp"
#include "metrics/killing.hpp"

namespace xpr {

/// What both charts share: the spheroid, and its metric at a normal whose component along the axis is nu_3.
struct Spheroid {
  double a_axis = 1.0;             ///< equatorial radius
  double f = 1.0 / 298.257223563;  ///< flattening (a - b) / a; default: that of WGS84

  /// Throws std::invalid_argument: the value and the allowed range.
  void validate() const;

  /// e^2 = f (2 - f).
  template <class T>
  [[nodiscard]] constexpr T eccentricity_squared() const {
    return f * (2.0 - T(f));
  }
  /// 1 / N^2 = (1 - e^2 nu_3^2) / a_axis^2.
  template <class T>
  [[nodiscard]] constexpr T inverse_prime_vertical_squared(const T& nu_3) const {
    return (1.0 - eccentricity_squared<T>() * square(nu_3)) / square(T(a_axis));
  }
  /// k w^4 / (1 - e^2)^2: what the spheroid adds to the sphere's inverse metric along grad nu_3.
  template <class T>
  [[nodiscard]] constexpr T flattening_term(const T& nu_3) const {
    const T e_sq = eccentricity_squared<T>();
    return e_sq * (2.0 - e_sq - e_sq * square(nu_3)) / square(1.0 - e_sq);
  }
  /// Gaussian curvature 1 / (m N) = w^4 / (a_axis^2 (1 - e^2)): the Ricci tensor is that times the surface's metric.
  [[nodiscard]] double gaussian_curvature(double nu_3) const {
    const double e_sq = eccentricity_squared<double>();
    return square((1.0 - e_sq * square(nu_3)) / a_axis) / (1.0 - e_sq);
  }
  /// Distance from the centre, the flat direction included.
  template <class T>
  [[nodiscard]] constexpr T centre_distance(const T& nu_3, const T& z) const {
    const T polar = square(1.0 - eccentricity_squared<T>());
    const T nu_3_sq = square(nu_3);
    return sqrt((1.0 - nu_3_sq + polar * nu_3_sq) / inverse_prime_vertical_squared(nu_3) + square(z));
  }
};

inline constexpr std::array<Coordinate, 4> geographic_coordinates{
    {{"t", CoordinateKind::time},
     {"lat", CoordinateKind::latitude, -0.5 * std::numbers::pi, 0.5 * std::numbers::pi},
     {"lon", CoordinateKind::azimuth, -std::numbers::pi, std::numbers::pi},
     {"z", CoordinateKind::length}}};

inline constexpr std::array<Coordinate, 4> turned_geographic_coordinates{
    {{"t", CoordinateKind::time},
     {"beta", CoordinateKind::latitude, -0.5 * std::numbers::pi, 0.5 * std::numbers::pi},
     {"lambda", CoordinateKind::azimuth, -std::numbers::pi, std::numbers::pi},
     {"z", CoordinateKind::length}}};

/// Where the atlas goes over to the other chart: |sin lat| there.
inline constexpr double ellipsoid_switch_sine = 0.9;

struct EllipsoidTurned;

struct EllipsoidGeographic : Spheroid {
  static constexpr Card card{.metric = "ellipsoid",
                             .chart = "geographic",
                             .title = "Time and an ellipsoid of revolution: geodesics of the surface as light rays",
                             .line_element = "ds^2 = -dt^2 + m^2 dlat^2 + N^2 cos^2 lat dlon^2 + dz^2",
                             .coordinates = geographic_coordinates,
                             .ignorable = {true, false, true, true},
                             .vacuum = false,
                             .asymptotically_flat = false,
                             .cites = "Karney2013"};
  static constexpr std::array<Parameter<EllipsoidGeographic>, 2> parameters{
      {{"a_axis", &EllipsoidGeographic::a_axis, "equatorial radius, a_axis > 0"},
       {"f", &EllipsoidGeographic::f, "flattening, f < 1; negative is prolate"}}};

  template <Scalar T>
  [[nodiscard]] constexpr SymTensor4<T> inverse_metric(const Vec4<T>& x) const {
    const auto [sin_lat, cos_lat] = sincos(x[1]);
    const T inv_n_sq = inverse_prime_vertical_squared(sin_lat);
    return diagonal<T>(T(-1.0), inv_n_sq * (1.0 + flattening_term(sin_lat) * square(cos_lat)),
                       inv_n_sq / square(cos_lat), T(1.0));
  }
  template <Scalar T>
  [[nodiscard]] constexpr T radius(const Vec4<T>& x) const {
    return centre_distance(sin(x[1]), x[3]);
  }
  template <Scalar T>
  [[nodiscard]] constexpr std::array<KillingVectorOf<T>, 3> killing_vectors(const Vec4<T>& /*x*/) const {
    const T zero = T(0.0), one = T(1.0);
    return {time_translation<T>(), KillingVectorOf<T>{"L_z", 1.0, {zero, zero, one, zero}},
            KillingVectorOf<T>{"p_z", 1.0, {zero, zero, zero, one}}};
  }
  [[nodiscard]] SymTensor4<double> declared_ricci(const Vec4<double>& x) const {
    const auto [sin_lat, cos_lat] = sincos(x[1]);
    const double e_sq = eccentricity_squared<double>();
    const double w_sq = 1.0 - e_sq * square(sin_lat);
    const double n_sq = square(a_axis) / w_sq;
    const double curvature = gaussian_curvature(sin_lat);
    return diagonal<double>(0.0, curvature * n_sq * square((1.0 - e_sq) / w_sq), curvature * n_sq * square(cos_lat),
                            0.0);
  }
  template <class T>
  [[nodiscard]] constexpr MaskOf<T> inside_domain(const Vec4<T>& x) const {
    return all_finite(x);
  }

  [[nodiscard]] EllipsoidTurned atlas_partner() const;
  [[nodiscard]] std::optional<AtlasMove> atlas_switch(const PhaseState<double>& y, int sheet) const;
};

struct EllipsoidTurned : Spheroid {
  static constexpr Card card{.metric = "ellipsoid",
                             .chart = "geographic-turned",
                             .title = "The same with the axis of the coordinates turned by 90 degrees, for the poles",
                             .line_element = "ds^2 = -dt^2 + N^2 (dnu^2 - k dnu_3^2) + dz^2",
                             .coordinates = turned_geographic_coordinates,
                             .ignorable = {true, false, false, true},
                             .vacuum = false,
                             .asymptotically_flat = false,
                             .cites = "Karney2013"};
  static constexpr std::array<Parameter<EllipsoidTurned>, 2> parameters{
      {{"a_axis", &EllipsoidTurned::a_axis, "equatorial radius, a_axis > 0"},
       {"f", &EllipsoidTurned::f, "flattening, f < 1; negative is prolate"}}};

  template <Scalar T>
  [[nodiscard]] constexpr SymTensor4<T> inverse_metric(const Vec4<T>& x) const {
    const auto [sin_beta, cos_beta] = sincos(x[1]);
    const auto [sin_lambda, cos_lambda] = sincos(x[2]);
    const T nu_3 = cos_beta * sin_lambda;
    const T inv_n_sq = inverse_prime_vertical_squared(nu_3);
    const T extra = flattening_term(nu_3);
    // The gradient of nu_3 on the unit sphere, index up.
    const T up_beta = -sin_beta * sin_lambda, up_lambda = cos_lambda / cos_beta;
    SymTensor4<T> g = diagonal<T>(T(-1.0), inv_n_sq * (1.0 + extra * square(up_beta)),
                                  inv_n_sq * (1.0 / square(cos_beta) + extra * square(up_lambda)), T(1.0));
    g(1, 2) = inv_n_sq * extra * up_beta * up_lambda;
    return g;
  }
  template <Scalar T>
  [[nodiscard]] constexpr T radius(const Vec4<T>& x) const {
    return centre_distance(cos(x[1]) * sin(x[2]), x[3]);
  }
  /// E, the rotation about the axis of revolution, and the flat direction.
  template <Scalar T>
  [[nodiscard]] constexpr std::array<KillingVectorOf<T>, 3> killing_vectors(const Vec4<T>& x) const {
    const T zero = T(0.0);
    const auto [sin_beta, cos_beta] = sincos(x[1]);
    const auto [sin_lambda, cos_lambda] = sincos(x[2]);
    return {time_translation<T>(),
            KillingVectorOf<T>{"L_z", 1.0, {zero, -cos_lambda, -sin_beta * sin_lambda / cos_beta, zero}},
            KillingVectorOf<T>{"p_z", 1.0, {zero, zero, zero, T(1.0)}}};
  }
  [[nodiscard]] SymTensor4<double> declared_ricci(const Vec4<double>& x) const {
    const auto [sin_beta, cos_beta] = sincos(x[1]);
    const auto [sin_lambda, cos_lambda] = sincos(x[2]);
    const double nu_3 = cos_beta * sin_lambda, d_beta = -sin_beta * sin_lambda, d_lambda = cos_beta * cos_lambda;
    const double e_sq = eccentricity_squared<double>();
    const double w_sq = 1.0 - e_sq * square(nu_3);
    const double k = e_sq * (2.0 - e_sq - e_sq * square(nu_3)) / square(w_sq);
    const double scale = gaussian_curvature(nu_3) * square(a_axis) / w_sq;
    SymTensor4<double> ricci{};
    ricci(1, 1) = scale * (1.0 - k * square(d_beta));
    ricci(1, 2) = -scale * k * d_beta * d_lambda;
    ricci(2, 2) = scale * (square(cos_beta) - k * square(d_lambda));
    return ricci;
  }
  template <class T>
  [[nodiscard]] constexpr MaskOf<T> inside_domain(const Vec4<T>& x) const {
    return all_finite(x);
  }

  template <class T>
  [[nodiscard]] constexpr Vec4<T> to_hub(const Vec4<T>& x, int /*sheet*/) const {
    const auto [sin_beta, cos_beta] = sincos(x[1]);
    const auto [sin_lambda, cos_lambda] = sincos(x[2]);
    const T nu_1 = sin_beta, nu_2 = cos_beta * cos_lambda, nu_3 = cos_beta * sin_lambda;
    return {x[0], atan2(nu_3, sqrt(square(nu_1) + square(nu_2))), atan2(nu_2, nu_1), x[3]};
  }
  template <class T>
  [[nodiscard]] constexpr Vec4<T> from_hub(const Vec4<T>& x) const {
    const auto [sin_lat, cos_lat] = sincos(x[1]);
    const auto [sin_lon, cos_lon] = sincos(x[2]);
    const T nu_1 = cos_lat * cos_lon, nu_2 = cos_lat * sin_lon, nu_3 = sin_lat;
    return {x[0], atan2(nu_1, sqrt(square(nu_2) + square(nu_3))), atan2(nu_3, nu_2), x[3]};
  }

  [[nodiscard]] EllipsoidGeographic atlas_partner() const;
  [[nodiscard]] std::optional<AtlasMove> atlas_switch(const PhaseState<double>& y, int sheet) const;
};

}  // namespace xpr
