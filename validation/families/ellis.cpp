// Light in the Ellis wormhole against its closed forms: deflection, transit, the throat.
#include "metrics/ellis_exact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "metrics/scalar/elementary.hpp"
#include "validation/families.hpp"
#include "validation/kit.hpp"
#include "validation/truth/enclosure.hpp"

namespace xpr {

namespace {

namespace exact = ellis_exact;

constexpr double throat = 1.0;
constexpr double far = std::numeric_limits<double>::infinity();

Charts charts(const Lab& lab, std::string_view transport) {
  const std::array<NamedValue, 1> values{{{"b0", throat}}};
  return charts(lab, "ellis", "proper-distance", transport, values);
}

/// A ray from l0 > 0 inward until it is back at l0 or has come out at -l0.
SweptRay through_or_back(const Lab& lab, const Charts& at, const ChartState& start, double l0, const MethodAt& method) {
  TraceSettings settings = trace_settings(method, throat);
  settings.l_max = l0;
  settings.l_min = -l0;
  settings.grade_time = true;
  return trace_swept(lab, *at.classical, *at.transport, start, settings);
}

/// The ray must have ended on the side where it was expected.
bool came_out(Row& row, const SweptRay& ray, int side) {
  if (ray.end.status == Status::crossed && (ray.end_classical[1] > 0.0) == (side > 0)) return true;
  row.verdict = Verdict::error;
  row.note = fmt::format("the ray ended as '{}' at l = {}", to_string(ray.end.status), ray.end_classical[1]);
  return false;
}

/// 1 + |b d alpha / d b| ~ 1 + b / |b - b0| near the throat's photon orbit.
double condition(double b) { return 1.0 + b / std::abs(b - throat); }

constexpr const char* modulus_fault = "ellis-modulus-for-parameter";
constexpr const char* diverging_fault = "ellis-diverging-lens";

/// The deflection, or what a planted fault makes of it.
ExactValue deflection_truth(const Lab& lab, double b) {
  ExactValue truth = proven(enclosure::ellis_deflection(throat, b));
  // std::comp_ellint_1 takes the modulus k = b0/b; here it gets the parameter m = k^2.
  if (lab.planted(modulus_fault)) truth.value = 2.0 * std::comp_ellint_1(square(throat / b)) - pi<double>();
  if (lab.planted(diverging_fault)) truth.value = -truth.value;
  return truth;
}

std::vector<MethodAt> angle_methods(const Lab& lab) {
  std::vector<MethodAt> methods = {{"dop853", 1e-8}, {"dop853", 1e-15}, {"dopri54", 1e-10}};
  if (lab.full()) {
    methods.insert(methods.end(), {{"dop853", 1e-11},
                                   {"rkf45", 1e-9},
                                   {"dopri54", 1e-13},
                                   {"odeint:dopri5", 1e-10},
                                   {"dop853", 1e-10, Projection::full}});
  }
  return methods;
}

constexpr std::array<std::string_view, 2> both_charts{"isotropic", "proper-distance"};

std::vector<Row> deflection_rows(const Lab& lab) {
  std::vector<Row> rows;
  for (const std::string_view transport : both_charts) {
    const Charts at = charts(lab, transport);
    for (const double b : {1.0001, 1.001, 1.05, 1.1, 1.25, 3.0, 20.0, 1000.0}) {
      for (const MethodAt& method : angle_methods(lab)) {
        Row row = make_row(fmt::format("b = {} b0, {}, {} {:g}", b, transport, method_label(method), method.setting),
                           *at.transport, method, {{"b/b0", b, "1"}});
        row.unit = "rad";
        const double l0 = std::max(50.0, 2.0 * b);
        const SweptRay ray =
            through_or_back(lab, at, equatorial_light(*at.classical, *at.transport, l0, b), l0, method);
        row.evaluations = ray.end.evaluations;
        if (came_out(row, ray, +1)) {
          const double stored_b = impact_parameter(*at.classical, ray.start_classical);
          const double tails = exact::swept_angle(throat, stored_b, ray.start_classical[1], far, false).value +
                               exact::swept_angle(throat, stored_b, ray.end_classical[1], far, false).value;
          const ExactValue truth = deflection_truth(lab, stored_b);
          grade(row, std::abs(ray.azimuth()) + tails - pi<double>(), {truth.value, truth.error},
                deflection_tolerance(ray.end, method, b / throat, condition(b), std::abs(truth.value)));
        }
        rows.push_back(std::move(row));
      }
    }
  }
  return rows;
}

std::vector<Row> transit_rows(const Lab& lab) {
  std::vector<Row> rows;
  for (const std::string_view transport : both_charts) {
    const Charts at = charts(lab, transport);
    for (const double b : {0.1, 0.5, 0.9, 0.95, 0.999}) {
      for (const MethodAt& method : angle_methods(lab)) {
        Row row = make_row(fmt::format("b = {} b0, {}, {} {:g}", b, transport, method_label(method), method.setting),
                           *at.transport, method, {{"b/b0", b, "1"}});
        row.unit = "rad";
        constexpr double l0 = 50.0;
        const SweptRay ray =
            through_or_back(lab, at, equatorial_light(*at.classical, *at.transport, l0, b), l0, method);
        row.evaluations = ray.end.evaluations;
        if (came_out(row, ray, -1)) {
          const double stored_b = impact_parameter(*at.classical, ray.start_classical);
          const double tails = exact::swept_angle(throat, stored_b, ray.start_classical[1], far, false).value +
                               exact::swept_angle(throat, stored_b, -ray.end_classical[1], far, false).value;
          const ExactValue truth = proven(enclosure::ellis_transit_angle(throat, stored_b));
          grade(row, std::abs(ray.azimuth()) + tails, {truth.value, truth.error},
                accumulated(ray.end, method.setting, condition(b)));
        }
        rows.push_back(std::move(row));
      }
    }
  }
  return rows;
}

/// Bisects b on the side where the ray comes out.
double critical_b_from_rays(const Lab& lab, const Charts& at, const MethodAt& method) {
  double through = 0.9 * throat;
  double back = 1.1 * throat;
  while (back - through > 1e-14) {
    const double b = 0.5 * (through + back);
    if (!(b > through && b < back)) break;
    const ChartState start = equatorial_light(*at.classical, *at.transport, 10.0, b);
    (through_or_back(lab, at, start, 10.0, method).end_classical[1] > 0.0 ? back : through) = b;
  }
  return 0.5 * (through + back);
}

/// l after half an orbit of a ray that starts tangentially at l = delta.
double displacement_after_half_orbit(const Lab& lab, const Charts& at, double delta, const MethodAt& method) {
  const Vec4<double> x = {0.0, delta, 0.5 * pi<double>(), 0.0};
  const PhaseState<double> start(x, {-1.0, 0.0, 0.0, std::sqrt(square(throat) + square(delta))});
  const std::array<Event, 1> half_orbit{
      {{.name = "half orbit",
        .g = [](const Spacetime&, const PhaseState<double>& y, int) { return y[0] - pi<double>() * throat; },
        .terminal = true}}};
  return trace_swept(lab, *at.classical, *at.transport, change_chart(*at.classical, *at.transport, start),
                     trace_settings(method, throat), half_orbit)
      .end_classical[1];
}

std::vector<Row> throat_rows(const Lab& lab) {
  std::vector<Row> rows;
  for (const std::string_view transport : both_charts) {
    const Charts at = charts(lab, transport);
    const MethodAt method{"dop853", 1e-13};
    Row critical = make_row(fmt::format("b_c by bisection, {}", transport), *at.transport, method, {});
    critical.unit = "b0";
    const ExactValue truth = exact::critical_impact_parameter(throat);
    grade(critical, critical_b_from_rays(lab, at, method), {truth.value, truth.error},
          {1e-10, "promised: critical parameters below 1e-10"});
    rows.push_back(std::move(critical));
    for (const double delta : {1e-4, 1e-5}) {
      const MethodAt tight{"dop853", 1e-15};
      Row row = make_row(fmt::format("growth of a displacement {:g} b0, {}", delta, transport), *at.transport, tight,
                         {{"displacement", delta, "b0"}});
      row.unit = "b0-1";
      const double traced =
          std::acosh(displacement_after_half_orbit(lab, at, delta, tight) / delta) / (pi<double>() * throat);
      const ExactValue rate = exact::lyapunov_exponent_per_time(throat);
      const double third_order = square(delta) * std::exp(2.0 * pi<double>());
      grade(row, traced, {rate.value, rate.error},
            {third_order + 200.0 * tight.setting / delta,
             fmt::format("third order in the displacement, delta^2 e^(2 pi) = {:.1e}, and 200 tol / delta",
                         third_order)});
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

std::vector<Row> constants_rows(const Lab& lab) {
  std::vector<Row> rows;
  const Charts at = charts(lab, "isotropic");
  for (const MethodAt& method : {MethodAt{"dop853", 1e-12}, MethodAt{"dopri54", 1e-10}, MethodAt{"gl6", 0.02},
                                 MethodAt{"dop853", 1e-9, Projection::full}}) {
    const ChartState start = general_light(*at.classical, *at.transport, 20.0, 1.1, 0.4, 0.5);
    const SweptRay ray = through_or_back(lab, at, start, 20.0, method);
    for (const std::string_view name : {"E", "L_x", "L_y", "L_z"}) {
      Row row = make_row(fmt::format("{} through the throat, {} {:g}", name, method_label(method), method.setting),
                         *at.transport, method, {});
      row.unit = name == "E" ? "1" : "b0";
      row.evaluations = ray.end.evaluations;
      if (came_out(row, ray, -1)) {
        const double before = killing_constant(*at.transport, start.state, name);
        const double after = killing_constant(*ray.end.chart, ray.end.y, name);
        // Rotations about a point 20 b0 away turn momentum errors into twenty times as much angular momentum.
        Tolerance tolerance = accumulated(ray.end, method_card(method.method).adaptive ? method.setting : 1e-13, 20.0);
        if (method.projection == Projection::full) {
          tolerance = {1e-13, "projected onto its start value after every step: round-off of products of size 20"};
        }
        grade(row, after, {before, 0.0}, tolerance);
      }
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

std::vector<Row> chart_rows(const Lab& lab) {
  std::vector<Row> rows;
  struct Member {
    std::string_view name;
    double theta, L, p_theta;
  };
  for (const Member& member :
       {Member{"back, inclined", 1.1, 1.5, 1.2}, Member{"through, inclined", 0.8, 0.4, 0.6},
        Member{"through, over the pole", 0.9, 0.0, 0.7}, Member{"straight down the throat", 0.7, 0.0, 0.0}}) {
    for (const std::string_view transport : both_charts) {
      const Charts at = charts(lab, transport);
      const MethodAt method{"dop853", 1e-13};
      const ChartState start =
          general_light(*at.classical, *at.transport, 30.0, member.theta, member.L, member.p_theta);
      const SweptRay ray = through_or_back(lab, at, start, 30.0, method);
      const PhaseState<double>& y = ray.start_classical;
      const double b = std::hypot(y[6], y[7] / std::sin(y[2])) / -y[4];
      const bool back = b > throat;
      Row row =
          make_row(fmt::format("{}: time, {}", member.name, transport), *at.transport, method, {{"b/b0", b, "1"}});
      row.unit = "b0";
      row.evaluations = ray.end.evaluations;
      if (came_out(row, ray, back ? 1 : -1)) {
        const ExactValue truth = exact::coordinate_time(throat, b, y[1], ray.end_classical[1], back);
        grade(row, ray.end_classical[0] - y[0], {truth.value, truth.error},
              accumulated(ray.end, method.setting, 60.0 * condition(b)));
      }
      rows.push_back(row);
      row.label = fmt::format("{}: angle between the ends, {}", member.name, transport);
      row.unit = "rad";
      if (came_out(row, ray, back ? 1 : -1)) {
        const ExactValue truth = exact::swept_angle(throat, b, y[1], ray.end_classical[1], back);
        const double folded = std::abs(std::remainder(truth.value, 2.0 * pi<double>()));
        grade(row, angle_between(y, ray.end_classical), {folded, truth.error},
              accumulated(ray.end, method.setting, condition(b)));
      }
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace

std::vector<Case> ellis_cases() {
  return {
      {closed_form_case(
           "ellis", "deflection",
           "A ray with impact parameter b > b0 is deflected towards the wormhole by 2 K(b0/b) - pi.",
           "alpha = 2 K(k = b0/b) - pi > 0. Traced from l0 = max(50 b0, 2b) and back; the angles beyond both ends "
           "are added in closed form.",
           "the complete elliptic integral of the first kind at the stored b, in ball arithmetic: its error is proven",
           "NakajimaAsada2012 Perlick2004 Johansson2017"),
       true, deflection_rows},
      {closed_form_case(
           "ellis", "transit", "A ray with b < b0 goes through the throat and sweeps 2 (b/b0) K(b/b0).",
           "Delta phi = 2 (b/b0) K(k = b/b0) from l = -infinity to +infinity, traced from 50 b0 to -50 b0; theta and "
           "phi continue unchanged through the throat.",
           "the complete elliptic integral of the first kind at the stored b, in ball arithmetic: its error is proven",
           "ChetouaniClement1984 Johansson2017"),
       true, transit_rows},
      {closed_form_case(
           "ellis", "throat", "The throat is an unstable photon sphere: b_c = b0, deviations grow as e^(t/b0).",
           "b_c by bisection on the side where rays come out; the growth from a ray that starts tangentially at "
           "l = delta and is followed for half an orbit, l = delta cosh(t/b0).",
           "b0 and 1/b0", "ChetouaniClement1984 Perlick2004"),
       true, throat_rows},
      {closed_form_case(
           "ellis", "constants", "E and the angular momentum are the same on both sides of the throat.",
           "Killing constants before and after an inclined ray has gone from one isotropic sheet to the other.",
           "their own values at the start", "MorrisThorne1988"),
       true, constants_rows},
      {closed_form_case(
           "ellis", "charts",
           "The same ray in both charts, off the equator and over the pole, takes the exact time and angle.",
           "The angle between first and last direction is the equatorial swept angle of the total angular momentum; "
           "elapsed t is the length of the path.",
           "incomplete elliptic integrals at the stored b and l", "ChetouaniClement1984"),
       true, chart_rows},
  };
}

std::vector<Fault> ellis_faults() {
  return {{.id = modulus_fault,
           .description = "the complete elliptic integral called with m = k^2 where the library wants k",
           .case_id = "ellis/deflection"},
          {.id = diverging_fault,
           .description = "the wormhole taken for a diverging lens: the deflection's sign turned",
           .case_id = "ellis/deflection"}};
}

}  // namespace xpr
