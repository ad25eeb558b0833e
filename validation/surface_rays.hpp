// Light on an ellipsoid of revolution, and where GeographicLib says that it arrives: an oracle that nobody here wrote.
#pragma once

#include <array>

#include "metrics/ellipsoid.hpp"
#include "metrics/tensor.hpp"

namespace xpr {

/// Light at a latitude (degrees), longitude 0, along an azimuth clockwise from north (degrees), E = 1, in the
/// `geographic` chart.
[[nodiscard]] PhaseState<double> surface_light(const Spheroid& body, double latitude, double azimuth);

/// The point of the surface with a given geographic normal (radians), in the unit of the axis: where two ends are
/// compared, poles included.
[[nodiscard]] std::array<double, 3> point_on_surface(const Spheroid& body, double latitude, double longitude);

/// What GeodesicExact states of itself, 15 nm on the Earth, over the semi-major axis.
inline constexpr double surface_oracle_error = 2.5e-15;

/// Where the geodesic of that light is after a length in the unit of the axis, by GeographicLib::GeodesicExact.
[[nodiscard]] std::array<double, 3> surface_arrival(const Spheroid& body, double latitude, double azimuth,
                                                    double length);

}  // namespace xpr
