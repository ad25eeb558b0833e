// Null rays of R x ellipsoid against GeographicLib's exact geodesics: an oracle that nobody here wrote.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "metrics/chart_map.hpp"
#include "validation/families.hpp"
#include "validation/kit.hpp"
#include "validation/surface_rays.hpp"

namespace xpr {

namespace {

struct Body {
  std::string_view name;
  Spheroid shape;
};
constexpr std::array<Body, 2> bodies{{{"WGS84", {6378137.0, 1.0 / 298.257223563}}, {"f = 1/3", {1.0, 1.0 / 3.0}}}};

struct Launch {
  std::string_view name;
  double latitude, azimuth;  ///< degrees
  double length;             ///< in units of the semi-major axis
};
// Generic, along the equator, over the pole exactly and almost, nearly antipodal, several times around.
constexpr std::array<Launch, 7> launches{{{"north-east", 30.0, 45.0, 0.8},
                                          {"equator", 0.0, 90.0, 1.5},
                                          {"over the pole", 20.0, 0.0, 3.0},
                                          {"past the pole", 20.0, 0.01, 3.0},
                                          {"from the pole's cap", 85.0, 120.0, 2.5},
                                          {"nearly antipodal", -15.0, 60.0, 3.1},
                                          {"three times around", 40.0, 70.0, 19.0}}};

std::vector<Row> geodesic_rows(const Lab& lab) {
  std::vector<Row> rows;
  std::vector<MethodAt> methods = {{"dop853", 1e-13}, {"dopri54", 1e-10}};
  if (lab.full()) methods.insert(methods.end(), {{"dop853", 1e-9}, {"rkf45", 1e-10}, {"odeint:dopri5", 1e-11}});
  for (const Body& body : bodies) {
    const double a_axis = body.shape.a_axis;
    const std::array<NamedValue, 2> values{{{"a_axis", a_axis}, {"f", body.shape.f}}};
    const auto chart = lab.spacetime("ellipsoid", "geographic", values);
    for (const Launch& launch : launches) {
      const auto truth = surface_arrival(body.shape, launch.latitude, launch.azimuth, launch.length * a_axis);
      for (const MethodAt& method : methods) {
        const std::array<Event, 1> arrival{
            {{.name = "path length",
              .g = [&](const Spacetime&, const PhaseState<double>& y, int) { return y[0] - launch.length * a_axis; },
              .terminal = true}}};
        const RayEnd end = lab.trace(*chart, surface_light(body.shape, launch.latitude, launch.azimuth), 1,
                                     trace_settings(method, a_axis), arrival);
        const PhaseState<double> y = change_chart(*end.chart, *chart, end.y, end.sheet).state;
        const auto traced = point_on_surface(body.shape, y[1], y[2]);
        Row row = make_row(fmt::format("{}, {}, {} {:g}", body.name, launch.name, method_label(method), method.setting),
                           *chart, method,
                           {{"latitude", launch.latitude, "degree"},
                            {"azimuth", launch.azimuth, "degree"},
                            {"length", launch.length, "a"},
                            {"f", body.shape.f, "1"}});
        row.evaluations = end.evaluations;
        const double off = std::hypot(traced[0] - truth[0], traced[1] - truth[1], traced[2] - truth[2]) / a_axis;
        Tolerance tolerance = accumulated(end, method.setting, 1.0 + launch.length);
        tolerance.value += 2e-14 * (1.0 + launch.length);
        tolerance.reason +=
            "; neighbouring geodesics part at most linearly with the length; degrees to radians and back";
        if (end.status != Status::crossed) {
          row.note = fmt::format("the ray ended as '{}' before it had gone its way", to_string(end.status));
          rows.push_back(std::move(row));
          continue;
        }
        grade(row, off, {0.0, surface_oracle_error}, tolerance);
        rows.push_back(std::move(row));
      }
    }
  }
  return rows;
}

}  // namespace

std::vector<Case> ellipsoid_cases() {
  return {{{.id = "ellipsoid/geodesics",
            .family = "ellipsoid",
            .claim = "Null rays of R x ellipsoid are the geodesics of the ellipsoid, run through in time t.",
            .physics =
                "ds^2 = -dt^2 + h: the end point after t = s, against the direct geodesic problem; over the poles the "
                "atlas turns to its second chart.",
            .truth = "GeographicLib::GeodesicExact, elliptic integrals (Karney)",
            .rank = TruthRank::high_precision,
            .grades_metric = true,
            .cites = "Karney2013",
            .source = "validation/families/ellipsoid.cpp"},
           true,
           geodesic_rows}};
}

}  // namespace xpr
