// What a camera near a Kerr hole sees: the shadow's edge against Bardeen's curve, and the equatorial plane.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "metrics/kerr_exact.hpp"
#include "metrics/scalar/elementary.hpp"
#include "validation/families/kerr.hpp"
#include "validation/truth/enclosure.hpp"

namespace xpr::kerr_family {

namespace {

namespace exact = kerr_exact;

constexpr double degree = std::numbers::pi / 180.0;
constexpr const char* source_file = "validation/families/kerr_shadow.cpp";

constexpr const char* mirror_fault = "kerr-mirrored-screen";
constexpr const char* beta_fault = "kerr-screen-upside-down";

/// The camera ray of a screen point (DESIGN: the common screen), followed back in time: L = -alpha sin i and eta =
/// (alpha^2 - a^2) cos^2 i + beta^2, which is p_theta = beta at theta = i. Exact constants at any distance.
ChartState camera_ray(const Charts& at, double r, double inclination, double alpha, double beta) {
  return inward_light(at, r, inclination, -alpha * sin(inclination), beta);
}

struct View {
  double spin;
  double inclination_degrees;
};

/// The distance of the edge from (centre, 0) under an angle from the alpha axis.
double edge_from_rays(const Lab& lab, const Charts& at, const View& view, double centre, double angle,
                      const MethodAt& method, Row& row) {
  TraceSettings settings = trace_settings(method, mass);
  settings.r_min = *at.transport->default_r_min();
  settings.r_max = 15.0 * mass;
  return bisect_fate(mass, 8.0 * mass, 1e-13 * mass, [&](double distance) {
    const ChartState start = camera_ray(at, 20.0 * mass, view.inclination_degrees * degree,
                                        centre + distance * cos(angle), distance * sin(angle));
    const RayEnd end = lab.trace(*at.transport, start.state, 1, settings);
    row.evaluations += end.evaluations;
    return end.status == Status::escaped;
  });
}

/// A printed area, all of whose digits the exact edge has too (tests/metrics/kerr_spherical_exact_test.cpp).
struct PrintedArea {
  View view;
  double area;
};
constexpr std::array printed_areas = {PrintedArea{{0.9, 60.0}, 78.5589424588582},
                                      PrintedArea{{0.99, 30.0}, 74.170716437223}};

/// The shadow's area, the integral of rho^2 over half a turn about the middle of its alpha axis, by the trapezoidal
/// rule: rho is periodic and smooth, so that 16 edges of rays give 10 digits.
void append_areas(const Lab& lab, std::vector<Row>& rows) {
  constexpr int intervals = 16;
  const MethodAt method{"dop853", 1e-13};
  for (const PrintedArea& printed : printed_areas) {
    const View& view = printed.view;
    const Charts at = charts(lab, view.spin, "kerr-schild-outgoing");
    Row row =
        make_row(fmt::format("a = {}, i = {} deg, area, {} {:g}", view.spin, view.inclination_degrees,
                             method_label(method), method.setting),
                 *at.transport, method, {{"a/M", view.spin, "1"}, {"inclination", view.inclination_degrees, "degree"}});
    row.unit = "M2";
    const double inclination = view.inclination_degrees * degree;
    const exact::ShadowExtent extent = exact::shadow_extent(mass, view.spin, inclination);
    const double centre = 0.5 * (extent.alpha_left.value + extent.alpha_right.value);
    double traced = 0.0, by_same_rule = 0.0;
    for (int k = 0; k <= intervals; ++k) {
      const double angle = std::numbers::pi * k / intervals;
      const double weight = (k == 0 || k == intervals ? 0.5 : 1.0) * std::numbers::pi / intervals;
      const exact::ScreenPoint edge = exact::shadow_edge(mass, view.spin, inclination, centre, angle);
      traced += weight * square(edge_from_rays(lab, at, view, centre, angle, method, row));
      by_same_rule += weight * (square(edge.alpha.value - centre) + square(edge.beta.value));
    }
    const double rule_error = std::abs(by_same_rule - printed.area) + 1e-13;
    grade(
        row, traced, {printed.area, rule_error},
        {1e-10 * 2.0 * std::sqrt(std::numbers::pi * printed.area),
         "promised: critical parameters below 1e-10, all along the edge; the truth's error is the rule's own, seen on "
         "the exact edge"});
    rows.push_back(std::move(row));
  }
}

/// The edge seen from the screen's origin: proven, but for the circle of a = 0.
exact::ScreenPoint edge_truth(const View& view, double angle) {
  const double inclination = view.inclination_degrees * degree;
  if (view.spin == 0.0) return exact::shadow_edge(mass, view.spin, inclination, 0.0, angle);
  const enclosure::ScreenPoint edge = enclosure::kerr_shadow_edge(mass, view.spin, inclination, 0.0, angle);
  return {proven(edge.alpha), proven(edge.beta)};
}

std::vector<Row> shadow_rows(const Lab& lab) {
  std::vector<Row> rows;
  const std::vector<View> views = lab.full() ? std::vector<View>{{0.9, 17.0}, {0.9, 60.0},   {0.9, 90.0}, {0.99, 30.0},
                                                                 {0.5, 90.0}, {0.998, 90.0}, {0.0, 30.0}}
                                             : std::vector<View>{{0.9, 17.0}, {0.9, 60.0}, {0.9, 90.0}, {0.99, 30.0}};
  // Both ends of the alpha axis and of the beta axis (L = 0: over the poles), and between.
  const std::vector<double> angles =
      lab.full() ? std::vector<double>{0.0, 180.0, 90.0, -90.0, 45.0, 135.0, -30.0, -150.0, 170.0}
                 : std::vector<double>{0.0, 180.0, 90.0, 135.0};
  const std::vector<MethodAt> methods = lab.full() ? std::vector<MethodAt>{{"dop853", 1e-14}, {"dopri54", 1e-13}}
                                                   : std::vector<MethodAt>{{"dop853", 1e-14}};
  for (const View& view : views) {
    const Charts at = charts(lab, view.spin, "kerr-schild-outgoing");
    for (const double angle_degrees : angles) {
      for (const MethodAt& method : methods) {
        if (method.method == "dopri54" && view.inclination_degrees != 60.0) continue;  // 40 rays each: one view will do
        Row row = make_row(fmt::format("a = {}, i = {} deg, seen {} deg from the alpha axis, {} {:g}", view.spin,
                                       view.inclination_degrees, angle_degrees, method_label(method), method.setting),
                           *at.transport, method,
                           {{"a/M", view.spin, "1"},
                            {"inclination", view.inclination_degrees, "degree"},
                            {"screen angle", angle_degrees, "degree"}});
        row.unit = "M";
        const double angle = angle_degrees * degree;
        const double mirrored = std::remainder(std::numbers::pi - angle, 2.0 * std::numbers::pi);
        const exact::ScreenPoint edge = edge_truth(view, lab.planted(mirror_fault) ? mirrored : angle);
        grade(row, edge_from_rays(lab, at, view, 0.0, angle, method, row),
              {std::hypot(edge.alpha.value, edge.beta.value), edge.alpha.error + edge.beta.error},
              {1e-10, "promised: critical parameters below 1e-10"});
        rows.push_back(std::move(row));
      }
    }
  }
  if (lab.full()) append_areas(lab, rows);
  return rows;
}

// --- Where camera rays first meet the equatorial plane ---

/// One row of the test data that a public code lists, with the unit of the last digit printed.
struct Crossing {
  double spin, inclination_degrees, alpha, beta;
  double x, x_digit, y, y_digit;
};

constexpr std::array crossings = {
    Crossing{0.42, 60.0, -17.0, 0.0, -0.0522336, 1e-7, -16.0342, 1e-4},
    Crossing{0.42, 60.0, -9.0, 0.0, -0.103693, 1e-6, -8.09784, 1e-5},
    Crossing{0.42, 60.0, -4.0, 0.0, -0.308159, 1e-6, -3.20445, 1e-5},
    Crossing{0.42, 60.0, 8.0, 0.0, 0.129720, 1e-6, 6.94829, 1e-5},
    Crossing{0.9, 10.0, -12.0, 0.0, -0.164094, 1e-6, -11.0082, 1e-4},
    Crossing{0.9, 10.0, -4.0, 0.0, -0.655582, 1e-6, -2.99558, 1e-5},
    Crossing{0.73, 35.0, 0.0001, -10.0, 11.8258, 1e-4, -0.0858775, 1e-7},
    Crossing{0.73, 35.0, 0.0001, 4.0, -2.11221, 1e-5, 1.02322, 1e-5},
};

const std::array<Event, 1> equatorial_plane{
    {{.name = "equatorial plane",
      .g = [](const Spacetime& chart, const PhaseState<double>& y,
              int) { return chart.card().chart == "boyer-lindquist" ? cos(y[2]) : y[3]; },
      .terminal = true}}};

std::vector<Row> crossing_rows(const Lab& lab) {
  std::vector<Row> rows;
  const std::vector<MethodAt> methods = lab.full() ? std::vector<MethodAt>{{"dop853", 1e-12}, {"dopri54", 1e-10}}
                                                   : std::vector<MethodAt>{{"dop853", 1e-12}};
  for (const Crossing& crossing : crossings) {
    const Charts at = charts(lab, crossing.spin, "kerr-schild-outgoing");
    for (const MethodAt& method : methods) {
      const double beta = lab.planted(beta_fault) ? -crossing.beta : crossing.beta;
      const ChartState start =
          camera_ray(at, 1000.0 * mass, crossing.inclination_degrees * degree, crossing.alpha, beta);
      const RayEnd end = lab.trace(*at.transport, start.state, 1, trace_settings(method, mass), equatorial_plane);
      const Vec4<double> met = change_chart(*at.transport, *at.classical, end.y).state.x();
      const auto append = [&](std::string_view coordinate, double value, double printed, double digit) {
        Row row = make_row(fmt::format("a = {}, i = {} deg, (alpha, beta) = ({:g}, {:g}) M: {}, {} {:g}", crossing.spin,
                                       crossing.inclination_degrees, crossing.alpha, crossing.beta, coordinate,
                                       method_label(method), method.setting),
                           *at.transport, method,
                           {{"a/M", crossing.spin, "1"}, {"alpha", crossing.alpha, "M"}, {"beta", crossing.beta, "M"}});
        row.unit = "M";
        if (ended_as(row, end, Status::crossed)) {
          grade(row, value, {printed, 0.0},
                {digit, "a unit of the last digit printed: the data are cut off in places, not rounded"});
        }
        rows.push_back(std::move(row));
      };
      append("x", met[1] * std::cos(met[3]), crossing.x, crossing.x_digit);
      append("y", met[1] * std::sin(met[3]), crossing.y, crossing.y_digit);
    }
  }
  return rows;
}

}  // namespace

std::vector<Case> shadow_cases() {
  return {
      {info(
           "shadow", "The edge between camera rays that fall in and those that leave is Bardeen's curve.",
           "alpha = -xi/sin i, beta^2 = eta + a^2 cos^2 i - xi^2 cot^2 i with Teo's xi and eta. Bisection along a ray "
           "of the screen from its origin, on the fate of rays traced back in time from 20 M in the outgoing chart; "
           "L and Q of a screen point are exact at any distance, so the curve is too. In the full suite two printed "
           "areas.",
           "the curve solved for the direction on the screen, a certified root in ball arithmetic: its error is proven",
           TruthRank::closed_form, "Bardeen1973 GrallaLupsascaMarrone2020", source_file),
       true, shadow_rows},
      {info("equatorial-crossings", "Camera rays first meet the equatorial plane where public test data has it.",
            "(x, y) = r (cos phi, sin phi) of Boyer-Lindquist; the observer at r = 1000 M, phi = 0, Bardeen's (alpha, "
            "beta). The data's rows inside the horizon, and (a = 0.42, alpha = 6 M), which is a later crossing, are "
            "left out.",
            "printed digits of the test data of the public code kgeo", TruthRank::published_table,
            "Bardeen1973 GrallaLupsasca2020Geodesics", source_file),
       true, crossing_rows},
  };
}

std::vector<Fault> shadow_faults() {
  return {{.id = mirror_fault,
           .description = "alpha = +xi/sin i: the image mirrored, prograde light on the wrong side",
           .case_id = "kerr/shadow"},
          {.id = beta_fault,
           .description = "p_theta = -beta: the screen upside down",
           .case_id = "kerr/equatorial-crossings"}};
}

}  // namespace xpr::kerr_family
