// Karney 2013: geodesics of an ellipsoid of revolution, as null rays of R x ellipsoid. [Karney2013]
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "metrics/chart_map.hpp"
#include "validation/papers/papers.hpp"
#include "validation/papers/quadrature.hpp"
#include "validation/papers/schwarzschild_light.hpp"
#include "validation/surface_rays.hpp"

namespace xpr::papers {

namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr Spheroid wgs84{6378137.0, 1.0 / 298.257223563};
constexpr const char* sphere_fault = "paper-karney-sphere";

struct Arrival {
  double latitude, longitude, azimuth;  ///< degrees
  RayEnd end;
};

/// Light from (latitude, 0) after a length, latitude and longitude from the geographic chart, azimuth by its momenta.
Arrival follow(const Lab& lab, const Spacetime& chart, double latitude, double azimuth, double length,
               const MethodAt& method) {
  const std::array<Event, 1> arrival{
      {{.name = "path length",
        .g = [length](const Spacetime&, const PhaseState<double>& y, int) { return y[0] - length; },
        .terminal = true}}};
  const RayEnd end =
      lab.trace(chart, surface_light(wgs84, latitude, azimuth), 1, trace_settings(method, wgs84.a_axis), arrival);
  const PhaseState<double> y = change_chart(*end.chart, chart, end.y, end.sheet).state;
  // Clairaut: p_lambda = N cos(latitude) sin(azimuth), and p_latitude = M cos(azimuth).
  const SymTensor4<double> g = chart.inverse_metric(y.x());
  return {y[1] / degree, y[2] / degree, std::atan2(y[6] * std::sqrt(g(2, 2)), y[5] * std::sqrt(g(1, 1))) / degree, end};
}

void add_direct(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  // The series-free evaluation and GeodSolve agree to 15 digits.
  constexpr double latitude = 51.909819304885019, longitude = 53.883256191623924, azimuth = 82.49298066966138;
  ClaimSheet lat = sheet.claim("latitude after 5000 km from (30, 0), azimuth 45 deg", "degree");
  ClaimSheet lon = sheet.claim("longitude of the same", "degree");
  ClaimSheet azi = sheet.claim("azimuth of the same", "degree");
  lat.exact({latitude, 1e-14}, "GeographicLib's GeodSolve and a 50-digit evaluation");
  lon.exact({longitude, 1e-14}, "as above");
  azi.exact({azimuth, 1e-14}, "as above");
  const Spheroid body = lab.planted(sphere_fault) ? Spheroid{wgs84.a_axis, 1e-12} : wgs84;
  const auto oracle = surface_arrival(body, 30.0, 45.0, 5e6);
  const double e2 = body.f * (2.0 - body.f), a = body.a_axis;
  const double rho = std::hypot(oracle[0], oracle[1]);
  const Tolerance digits{2e-12, "round-off of degrees, and the oracle's own nanometres over 1e5 m a degree"};
  lat.ours("GeographicLib's elliptic integrals, from the point in space",
           std::atan2(oracle[2], (1.0 - e2) * rho) / degree, digits);
  lon.ours("GeographicLib's elliptic integrals, from the point in space", std::atan2(oracle[1], oracle[0]) / degree,
           digits);
  // Clairaut's constant at both ends: cos(beta) sin(azimuth), beta the reduced latitude.
  const auto reduced = [&](double phi) { return std::atan((1.0 - body.f) * std::tan(phi * degree)); };
  azi.ours("Clairaut's relation",
           std::asin(std::cos(reduced(30.0)) * std::sin(45.0 * degree) / std::cos(reduced(latitude))) / degree,
           {2e-12, "round-off over the cosine of an azimuth near 90 degrees"});
  (void)a;
  const std::array<NamedValue, 2> values{{{"a_axis", wgs84.a_axis}, {"f", wgs84.f}}};
  for (const MethodAt& method : {MethodAt{"dop853", 1e-14}, MethodAt{"dopri54", 1e-12}}) {
    const auto chart = lab.spacetime("ellipsoid", "geographic", values);
    const Arrival at = follow(lab, *chart, 30.0, 45.0, 5e6, method);
    Tolerance tolerance = accumulated(at.end, method.setting, 10.0 / degree);
    tolerance.value += 1e-11;
    tolerance.reason += "; in degrees, and as much again for the surface's own doubles";
    const TracedRoute route{*chart, method, at.end, Status::crossed};
    lat.traced(route, at.latitude, tolerance);
    lon.traced(route, at.longitude, tolerance);
    azi.traced(route, at.azimuth, tolerance);
  }
}

void add_lengths(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  ClaimSheet equator = sheet.claim("longitude after 10000 km along the equator", "degree");
  equator.exact({89.831528411952144, 1e-14}, "s/a");
  equator.ours("s/a", 1e7 / wgs84.a_axis / degree, {1e-12, "round-off"});
  const std::array<NamedValue, 2> values{{{"a_axis", wgs84.a_axis}, {"f", wgs84.f}}};
  const auto chart = lab.spacetime("ellipsoid", "geographic", values);
  for (const MethodAt& method : {MethodAt{"dop853", 1e-14}, MethodAt{"dopri54", 1e-12}}) {
    const Arrival at = follow(lab, *chart, 0.0, 90.0, 1e7, method);
    equator.traced({*chart, method, at.end, Status::crossed}, at.longitude,
                   accumulated(at.end, method.setting, 10.0 / degree));
  }
  ClaimSheet quarter = sheet.claim("length of the quarter meridian", "m");
  quarter.exact({10001965.72931272, 5e-9}, "GeodSolve, 16 digits");
  const long double e2 = wgs84.f * (2.0L - wgs84.f);
  const Integral by_latitude = integral(
      [e2](long double phi) {
        const long double s = std::sin(phi), w = 1.0L - e2 * s * s;
        return (1.0L - e2) / (w * std::sqrt(w));
      },
      0.0L, std::numbers::pi_v<long double> / 2.0L);
  const Tolerance nanometres{1e-7, "a tenth of a micrometre: f as a double is 1e-16 of 1e7 m, and sixteen digits"};
  quarter.ours("quadrature of the curvature radius over the latitude",
               wgs84.a_axis * static_cast<double>(by_latitude.value), nanometres);
  quarter.ours("complete elliptic integral of the second kind",
               wgs84.a_axis * std::comp_ellint_2(std::sqrt(static_cast<double>(e2))), nanometres);
  // Where traced light starts south along the meridian and meets the equator.
  for (const MethodAt& method : {MethodAt{"dop853", 1e-14}}) {
    const std::array<Event, 1> meets{{{.name = "equator",
                                       .g = [](const Spacetime&, const PhaseState<double>& y, int) { return y[1]; },
                                       .terminal = true}}};
    const RayEnd end =
        lab.trace(*chart, surface_light(wgs84, 45.0, 180.0), 1, trace_settings(method, wgs84.a_axis), meets);
    const double rest =
        static_cast<double>(integral(
                                [e2](long double phi) {
                                  const long double s = std::sin(phi), w = 1.0L - e2 * s * s;
                                  return (1.0L - e2) / (w * std::sqrt(w));
                                },
                                std::numbers::pi_v<long double> / 4.0L, std::numbers::pi_v<long double> / 2.0L)
                                .value);
    quarter.traced({*chart, method, end, Status::crossed}, end.y[0] + wgs84.a_axis * rest,
                   {1e-5, "steps' local errors of 1e-14 of the axis, and the chart's way from 45 degrees"});
  }
}

void draw(PaperSheet& sheet) {
  std::vector<Series> paths;
  Series ends{"GeographicLib", Look::dots, {}, {}};
  // A flatter body than the Earth, so that it shows: geodesics from one point do not meet again.
  constexpr Spheroid flat{1.0, 1.0 / 3.0};
  const std::array<NamedValue, 2> values{{{"a_axis", 1.0}, {"f", flat.f}}};
  const auto chart = sheet.lab().spacetime("ellipsoid", "geographic", values);
  for (const double azimuth : even_steps(15.0, 165.0, 11)) {
    Series path{"", Look::line, {}, {}};
    for (const double length : even_steps(0.02, 2.9, 60)) {
      const std::array<Event, 1> arrival{
          {{.name = "path length",
            .g = [length](const Spacetime&, const PhaseState<double>& y, int) { return y[0] - length; },
            .terminal = true}}};
      const RayEnd end =
          sheet.lab().trace(*chart, surface_light(flat, -30.0, azimuth), 1, trace_settings({"dop853", 1e-10}), arrival);
      const PhaseState<double> y = change_chart(*end.chart, *chart, end.y, end.sheet).state;
      path.x.push_back(y[2] / degree), path.y.push_back(y[1] / degree);
    }
    paths.push_back(std::move(path));
    const auto end = surface_arrival(flat, -30.0, azimuth, 2.9);
    const double e2 = flat.f * (2.0 - flat.f);
    ends.x.push_back(std::atan2(end[1], end[0]) / degree);
    ends.y.push_back(std::atan2(end[2], (1.0 - e2) * std::hypot(end[0], end[1])) / degree);
  }
  paths.push_back(std::move(ends));
  sheet.figure() = {.title = "Karney 2013: geodesics of an ellipsoid of revolution",
                    .caption =
                        "Traced geodesics from latitude -30 on a body with f = 1/3, and where GeographicLib ends "
                        "them: they form an envelope and do not meet in a point.",
                    .panels = {{.title = "Geodesics from one point, f = 1/3",
                                .x_label = "longitude [degree]",
                                .y_label = "latitude [degree]",
                                .series = std::move(paths)}}};
}

void run(PaperSheet& sheet) {
  add_direct(sheet);
  add_lengths(sheet);
  draw(sheet);
}

}  // namespace

Paper karney_2013() {
  return {.info = {.id = "karney-2013",
                   .reference = "C. F. F. Karney, Algorithms for geodesics, J. Geodesy 87, 43 (2013)",
                   .reproduced = "A direct geodesic problem on WGS84, the equator, and the quarter meridian.",
                   .cites = "Karney2013",
                   .not_checked = {"The inverse problem and areas: no ray finds them.",
                                   "The paper's own test data: GeographicLib stands for it."}},
          .run = run,
          .faults = {{sphere_fault, "a sphere taken for the ellipsoid"}}};
}

}  // namespace xpr::papers
