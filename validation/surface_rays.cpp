#include "validation/surface_rays.hpp"

#include <GeographicLib/GeodesicExact.hpp>
#include <cmath>

#include "metrics/scalar/elementary.hpp"

namespace xpr {

namespace {

constexpr double degree = 0.017453292519943295;

}  // namespace

PhaseState<double> surface_light(const Spheroid& body, double latitude, double azimuth) {
  const double e_sq = body.eccentricity_squared<double>();
  const double w_sq = 1.0 - e_sq * square(sin(latitude * degree));
  const double prime_vertical = body.a_axis / std::sqrt(w_sq);
  const double meridian = prime_vertical * (1.0 - e_sq) / w_sq;
  return {
      {0.0, latitude * degree, 0.0, 0.0},
      {-1.0, meridian * cos(azimuth * degree), prime_vertical * cos(latitude * degree) * sin(azimuth * degree), 0.0}};
}

std::array<double, 3> point_on_surface(const Spheroid& body, double latitude, double longitude) {
  const double e_sq = body.eccentricity_squared<double>();
  const double prime_vertical = body.a_axis / std::sqrt(1.0 - e_sq * square(sin(latitude)));
  return {prime_vertical * cos(latitude) * cos(longitude), prime_vertical * cos(latitude) * sin(longitude),
          prime_vertical * (1.0 - e_sq) * sin(latitude)};
}

std::array<double, 3> surface_arrival(const Spheroid& body, double latitude, double azimuth, double length) {
  const GeographicLib::GeodesicExact oracle(body.a_axis, body.f);
  double end_latitude = 0.0, end_longitude = 0.0, end_azimuth = 0.0;
  oracle.Direct(latitude, 0.0, azimuth, length, end_latitude, end_longitude, end_azimuth);
  return point_on_surface(body, end_latitude * degree, end_longitude * degree);
}

}  // namespace xpr
