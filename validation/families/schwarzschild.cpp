// Light in Schwarzschild against its closed forms: deflection, capture, the photon sphere, time.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "metrics/scalar/elementary.hpp"
#include "metrics/schwarzschild_exact.hpp"
#include "validation/families.hpp"
#include "validation/kit.hpp"
#include "validation/schwarzschild_rays.hpp"
#include "validation/truth/enclosure.hpp"

namespace xpr {

namespace {

namespace exact = schwarzschild_exact;

constexpr double mass = 1.0;

const double critical_b = exact::critical_impact_parameter(mass).value;

/// Darwin's formula as someone writes it whose library wants the modulus k where the paper's tables give m = k^2.
double deflection_with_modulus_for_parameter(double b) {
  const double P = exact::periapsis(mass, b).value;
  const double Q = std::sqrt((P - 2.0) * (P + 6.0));
  const double m = (Q - P + 6.0) / (2.0 * Q);
  const double zeta = std::asin(std::sqrt((Q - P + 2.0) / (Q - P + 6.0)));
  // std::ellint_1 takes the modulus: sqrt(m) would be right.
  return 4.0 * std::sqrt(P / Q) * (std::comp_ellint_1(m) - std::ellint_1(m, zeta)) - pi<double>();
}

constexpr const char* modulus_fault = "schwarzschild-modulus-for-parameter";
constexpr const char* half_deflection_fault = "schwarzschild-half-deflection";

/// The truth of the deflection, or what a planted fault makes of it.
ExactValue deflection_truth(const Lab& lab, double b) {
  ExactValue truth = proven(enclosure::schwarzschild_deflection(mass, b));
  if (lab.planted(modulus_fault)) truth.value = deflection_with_modulus_for_parameter(b);
  if (lab.planted(half_deflection_fault)) truth.value *= 0.5;
  return truth;
}

constexpr double promised = 1e-12;

std::vector<MethodAt> deflection_methods(const Lab& lab) {
  std::vector<MethodAt> methods = {{"dop853", 1e-8}, {"dop853", 1e-15}, {"dopri54", 1e-10}};
  if (lab.full()) {
    methods.insert(methods.end(), {{"dop853", 1e-11},
                                   {"dopri54", 1e-7},
                                   {"dopri54", 1e-13},
                                   {"rkf45", 1e-9},
                                   {"odeint:dopri5", 1e-10},
                                   {"odeint:rkf78", 1e-12},
                                   {"dop853", 1e-11, Projection::full},
                                   {"dopri54", 1e-9, Projection::energy}});
  }
  return methods;
}

constexpr const char* blind_pair =
    "Fehlberg's 7(8) pair cannot see its own error here: its two formulas differ by 41/840 (k1 + k11 - k12 - k13), "
    "which "
    "is zero wherever the force depends on lambda alone, as along a nearly straight ray; measured 1e-9 at tol 1e-12";

std::vector<Row> deflection_rows(const Lab& lab) {
  std::vector<Row> rows;
  const std::vector<std::string_view> transports =
      lab.full() ? std::vector<std::string_view>{"kerr-schild", "kerr-schild-outgoing", "isotropic", "areal"}
                 : std::vector<std::string_view>{"kerr-schild", "isotropic"};
  for (const std::string_view transport : transports) {
    const Charts at = schwarzschild_charts(lab, transport);
    for (const double ratio : {1.0001, 1.001, 1.01, 1.1, 1.5, 3.0, 20.0, 200.0, 1924.5}) {
      for (const MethodAt& method : deflection_methods(lab)) {
        if (method.method == "odeint:rkf78" && ratio > 100.0) {
          rows.push_back(skipped_row(fmt::format("b = {} b_c, {}, odeint:rkf78", ratio, transport), blind_pair, "rad"));
          continue;
        }
        const double b = ratio * critical_b;
        Row row =
            make_row(fmt::format("b = {} b_c, {}, {} {:g}", ratio, transport, method_label(method), method.setting),
                     *at.transport, method, {{"b/b_c", ratio, "1"}});
        row.unit = "rad";
        const SweptRay ray = there_and_back(lab, at, b, std::max(50.0, 2.0 * b), method);
        if (ended_as(row, ray.end, Status::escaped)) {
          const double stored_b = impact_parameter(*at.classical, ray.start_classical);
          const ExactValue truth = deflection_truth(lab, stored_b);
          grade(row, traced_deflection(ray, stored_b), {truth.value, truth.error},
                deflection_tolerance(ray.end, method, ratio, deflection_condition(b), truth.value));
        }
        rows.push_back(std::move(row));
      }
    }
  }
  return rows;
}

std::vector<Row> capture_rows(const Lab& lab) {
  std::vector<Row> rows;
  const Charts at = schwarzschild_charts(lab, "kerr-schild");
  for (const double ratio : {0.1, 0.5, 0.9, 0.99, 0.999}) {
    for (const MethodAt& method : {MethodAt{"dop853", 1e-9}, MethodAt{"dop853", 1e-14}, MethodAt{"dopri54", 1e-11}}) {
      const double b = ratio * critical_b;
      Row row = make_row(fmt::format("b = {} b_c, {} {:g}", ratio, method_label(method), method.setting), *at.transport,
                         method, {{"b/b_c", ratio, "1"}});
      row.unit = "rad";
      const SweptRay ray = there_and_back(lab, at, b, 50.0, method);
      if (ended_as(row, ray.end, Status::captured)) {
        const double stored_b = impact_parameter(*at.classical, ray.start_classical);
        const ExactValue truth =
            exact::swept_angle(mass, stored_b, ray.start_classical[1], ray.end_classical[1], false);
        grade(row, std::abs(ray.azimuth()), {truth.value, truth.error},
              accumulated(ray.end, method.setting, 1.0 + b / (critical_b - b)));
      }
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

std::vector<Row> weak_field_rows(const Lab& lab) {
  std::vector<Row> rows;
  const Charts at = schwarzschild_charts(lab, "kerr-schild");
  struct Member {
    double b;
    int order;
  };
  for (const Member& member : {Member{3000.0, 4}, Member{1e4, 4}, Member{100.0, 10}, Member{1000.0, 6}}) {
    const MethodAt method{"dop853", 1e-15};
    Row row = make_row(fmt::format("b = {:g} M against {} terms", member.b, member.order), *at.transport, method,
                       {{"b", member.b, "M"}, {"terms", static_cast<double>(member.order), "1"}});
    row.unit = "rad";
    const SweptRay ray = there_and_back(lab, at, member.b, 2.0 * member.b, method);
    if (ended_as(row, ray.end, Status::escaped)) {
      const double stored_b = impact_parameter(*at.classical, ray.start_classical);
      const ExactValue series = exact::weak_field_series(mass, stored_b, member.order);
      grade(row, traced_deflection(ray, stored_b), {series.value, series.error},
            {promised, "promised: 1e-12 rad; the terms left out stay below a tenth of it"});
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<Row> strong_field_rows(const Lab& lab) {
  std::vector<Row> rows;
  const Charts at = schwarzschild_charts(lab, "kerr-schild");
  for (const double excess : {1e-3, 1e-4, 1e-5, 1e-6}) {
    const MethodAt method{"dop853", 1e-14};
    const double b = (1.0 + excess) * critical_b;
    Row row = make_row(fmt::format("bbar from b/b_c - 1 = {:g}", excess), *at.transport, method,
                       {{"b/b_c - 1", excess, "1"}});
    row.unit = "rad";
    const SweptRay ray = there_and_back(lab, at, b, 50.0, method);
    if (ended_as(row, ray.end, Status::escaped)) {
      const double stored_b = impact_parameter(*at.classical, ray.start_classical);
      const double left_out = 2.0 * exact::strong_field_logarithm(mass, stored_b).error;
      const double traced = traced_deflection(ray, stored_b) + std::log(stored_b / critical_b - 1.0);
      grade(row, traced, {std::log(216.0 * (7.0 - 4.0 * std::sqrt(3.0))) - pi<double>(), 1e-15},
            {left_out + accumulated(ray.end, method.setting, deflection_condition(b)).value,
             "twice what the logarithm leaves out of the deflection, and the traced ray's accumulated error"});
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

/// The radius at which light that moves tangentially stays: where dp_r/dlambda changes sign.
double photon_sphere_from_flow(const Spacetime& areal) {
  const auto radial_force = [&areal](double r) {
    const Vec4<double> x = {0.0, r, 0.5 * pi<double>(), 0.0};
    const SymTensor4<double> g = areal.inverse_metric(x);
    return areal.flow(PhaseState<double>(x, {-1.0, 0.0, 0.0, std::sqrt(-g(0, 0) / g(3, 3))}))[5];
  };
  double inside = 2.5 * mass;
  double outside = 4.0 * mass;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (inside + outside);
    ((radial_force(middle) > 0.0) == (radial_force(outside) > 0.0) ? outside : inside) = middle;
  }
  return 0.5 * (inside + outside);
}

/// A state of the areal chart moving tangentially at r.
PhaseState<double> tangential(const Spacetime& areal, double r) {
  const Vec4<double> x = {0.0, r, 0.5 * pi<double>(), 0.0};
  const SymTensor4<double> g = areal.inverse_metric(x);
  return {x, {-1.0, 0.0, 0.0, std::sqrt(-g(0, 0) / g(3, 3))}};
}

std::vector<Row> photon_sphere_rows(const Lab& lab) {
  std::vector<Row> rows;
  const Charts at = schwarzschild_charts(lab, "kerr-schild");
  const ExactValue truth = proven(enclosure::kerr_critical_parameters(mass, 0.0).prograde_radius);
  Row flow = make_row("r_ph from the flow of the metric", *at.classical, {}, {});
  flow.unit = "M";
  grade(flow, photon_sphere_from_flow(*at.classical), {truth.value, truth.error},
        {1e-14, "bisection to the last bit of a force that crosses zero at a slope of order 1: 20 units of round-off"});
  rows.push_back(std::move(flow));
  for (const MethodAt& method : {MethodAt{"dop853", 1e-13}, MethodAt{"dopri54", 1e-13}}) {
    Row row = make_row(fmt::format("r_ph by bisection on rays, {} {:g}", method_label(method), method.setting),
                       *at.transport, method, {});
    row.unit = "M";
    TraceSettings settings = trace_settings(method, mass);
    settings.r_min = 2.5;
    settings.r_max = 10.0;
    const double traced = bisect_fate(2.9, 3.1, 1e-14, [&](double r) {
      const ChartState start = change_chart(*at.classical, *at.transport, tangential(*at.classical, r));
      return lab.trace(*at.transport, start.state, 1, settings).status == Status::escaped;
    });
    grade(row, traced, {truth.value, truth.error}, {1e-10, "promised: critical parameters below 1e-10"});
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<Row> critical_b_rows(const Lab& lab) {
  std::vector<Row> rows;
  const ExactValue truth = proven(enclosure::kerr_critical_parameters(mass, 0.0).prograde_b);
  for (const std::string_view transport : {"kerr-schild", "isotropic", "areal"}) {
    const Charts at = schwarzschild_charts(lab, transport);
    for (const MethodAt& method : {MethodAt{"dop853", 1e-13}, MethodAt{"dopri54", 1e-13}}) {
      if (!lab.full() && method.method != "dop853") continue;
      Row row = make_row(fmt::format("b_c by bisection, {}, {} {:g}", transport, method_label(method), method.setting),
                         *at.transport, method, {});
      row.unit = "M";
      TraceSettings settings = trace_settings(method, mass);
      settings.r_min = 2.5;
      settings.r_max = 20.0;
      const double traced = bisect_fate(5.1, 5.3, 1e-14, [&](double b) {
        const ChartState start = equatorial_light(*at.classical, *at.transport, 10.0, b);
        return lab.trace(*at.transport, start.state, 1, settings).status == Status::escaped;
      });
      grade(row, traced, {truth.value, truth.error}, {1e-10, "promised: critical parameters below 1e-10"});
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

std::vector<Row> lyapunov_rows(const Lab& lab) {
  std::vector<Row> rows;
  const Charts at = schwarzschild_charts(lab, "kerr-schild");
  const ExactValue truth = exact::lyapunov_exponent_per_half_orbit();
  const std::array<Event, 1> half_orbit{{{.name = "half orbit",
                                          .g = [](const Spacetime&, const PhaseState<double>& y, int) { return y[2]; },
                                          .direction = -1,
                                          .terminal = true}}};
  for (const MethodAt& method : {MethodAt{"dop853", 1e-15}, MethodAt{"dopri54", 1e-14}}) {
    for (const double delta : {1e-4, 1e-5}) {
      Row row = make_row(fmt::format("displaced by {:g} M, {} {:g}", delta, method_label(method), method.setting),
                         *at.transport, method, {{"displacement", delta, "M"}});
      row.unit = "1";
      const auto radius_after_half_orbit = [&](double r) {
        const ChartState start = change_chart(*at.classical, *at.transport, tangential(*at.classical, r));
        return at.transport->radius(
            lab.trace(*at.transport, start.state, 1, trace_settings(method, mass), half_orbit).y.x());
      };
      // A displacement at a turning point grows as cosh(gamma n): the odd part over +-delta is free of second order.
      const double grown = radius_after_half_orbit(3.0 + delta) - radius_after_half_orbit(3.0 - delta);
      const double traced = std::acosh(grown / (2.0 * delta));
      const double third_order = square(delta) * std::exp(2.0 * pi<double>());
      grade(row, traced, {truth.value, truth.error},
            {third_order + 200.0 * method.setting / delta,
             fmt::format("third order in the displacement, delta^2 e^(2 pi) = {:.1e}, and the tracer's 200 tol / delta",
                         third_order)});
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

std::vector<Row> time_rows(const Lab& lab) {
  std::vector<Row> rows;
  struct Member {
    double b;
    double r0;
  };
  for (const std::string_view transport : {"kerr-schild", "areal", "isotropic"}) {
    const Charts at = schwarzschild_charts(lab, transport);
    for (const Member& member : {Member{5.25, 50.0}, Member{8.0, 100.0}, Member{11.0, 1000.0}, Member{100.0, 1e4}}) {
      for (const MethodAt& method : {MethodAt{"dop853", 1e-9}, MethodAt{"dop853", 1e-14}}) {
        Row row = make_row(fmt::format("b = {:g} M from {:g} M and back, {}, {} {:g}", member.b, member.r0, transport,
                                       method_label(method), method.setting),
                           *at.transport, method, {{"b", member.b, "M"}, {"r", member.r0, "M"}});
        row.unit = "M";
        const SweptRay ray = there_and_back(lab, at, member.b, member.r0, method, true);
        if (ended_as(row, ray.end, Status::escaped)) {
          const double stored_b = impact_parameter(*at.classical, ray.start_classical);
          const ExactValue truth =
              exact::coordinate_time(mass, stored_b, ray.start_classical[1], ray.end_classical[1], true);
          const double condition = deflection_condition(member.b) * stored_b + 2.0 * member.r0;
          grade(row, ray.end_classical[0] - ray.start_classical[0], {truth.value, truth.error},
                accumulated(ray.end, method.setting, condition));
        }
        rows.push_back(std::move(row));
      }
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
  // Off the equator; through the axis exactly (L = 0); past it within 1e-6 M.
  for (const Member& member : {Member{"inclined", 1.1, 4.0, 5.0}, Member{"over the pole", 0.9, 0.0, 7.0},
                               Member{"past the pole within 1e-6", 1.3, 1e-6, -7.0}}) {
    for (const std::string_view transport : {"kerr-schild", "kerr-schild-outgoing", "isotropic", "areal"}) {
      if (transport == "areal" && member.L < 1.0) continue;  // the polar chart has no way over its own axis
      const Charts at = schwarzschild_charts(lab, transport);
      const MethodAt method{"dop853", 1e-13};
      Row row = make_row(fmt::format("{}, {}", member.name, transport), *at.transport, method,
                         {{"L", member.L, "M"}, {"p_theta", member.p_theta, "M"}});
      row.unit = "rad";
      TraceSettings settings = trace_settings(method, mass);
      settings.r_max = 40.0;
      const ChartState start =
          general_light(*at.classical, *at.transport, 30.0, member.theta, member.L, member.p_theta);
      const SweptRay ray = trace_swept(lab, *at.classical, *at.transport, start, settings);
      if (ended_as(row, ray.end, Status::escaped)) {
        const PhaseState<double>& y = ray.start_classical;
        const double b = std::hypot(y[6], y[7] / std::sin(y[2])) / -y[4];
        const ExactValue swept = exact::swept_angle(mass, b, y[1], ray.end_classical[1], true);
        const double folded = std::abs(std::remainder(swept.value, 2.0 * pi<double>()));
        grade(row, angle_between(y, ray.end_classical), {folded, swept.error},
              accumulated(ray.end, method.setting, deflection_condition(b)));
      }
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace

std::vector<Case> schwarzschild_cases() {
  return {
      {closed_form_case(
           "schwarzschild", "deflection",
           "A ray with impact parameter b > b_c is deflected by Darwin's elliptic integral.",
           "alpha = 4 sqrt(P/Q) [K(m) - F(zeta|m)] - pi. The ray is traced from r0 = max(50 M, 2b) and back to r0; "
           "the angles beyond both ends are added in closed form, at the radii where the ray really is.",
           "Darwin's closed form at the stored b = L/E in ball arithmetic: its error is proven",
           "Darwin1959 Johansson2017"),
       true, deflection_rows},
      {closed_form_case("schwarzschild", "capture",
                        "A ray with b < b_c falls in, sweeping the angle of the cubic with one real root.",
                        "phi = int du / sqrt(1/b^2 - u^2 + 2 M u^3) from 50 M to the stop near the horizon.",
                        "Carlson's R_F at the stored b and radii", "Darwin1959"),
       true, capture_rows},
      {closed_form_case("schwarzschild", "weak-field", "Far from the hole the deflection follows the series in M/b.",
                        "alpha = 4 (M/b) + (15 pi/4) (M/b)^2 + (128/3) (M/b)^3 + (3465 pi/64) (M/b)^4 + ...",
                        "the series of Iyer and Petters, with a bound on what it leaves out", "IyerPetters2007"),
       true, weak_field_rows},
      {closed_form_case("schwarzschild", "strong-field", "Near b_c the deflection diverges as -ln(b/b_c - 1) + bbar.",
                        "bbar = ln[216 (7 - 4 sqrt 3)] - pi = -0.40023...; measured as alpha + ln(b/b_c - 1).",
                        "Bozza's strong deflection limit", "Bozza2002"),
       true, strong_field_rows},
      {closed_form_case(
           "schwarzschild", "photon-sphere", "Light circles the hole at r = 3 M.",
           "From the metric: where the radial force on tangential light changes sign. From rays: bisection on whether "
           "light that starts tangentially falls or escapes.",
           "r_ph = 3 M", "Synge1966"),
       true, photon_sphere_rows},
      {closed_form_case("schwarzschild", "critical-b", "Rays fall in below b_c = 3 sqrt 3 M and come back above it.",
                        "Bisection on the fate of traced rays, to 1e-14 in b.", "b_c = 3 sqrt 3 M", "Synge1966"),
       true, critical_b_rows},
      {closed_form_case(
           "schwarzschild", "lyapunov", "A displacement from the photon orbit grows by e^pi every half orbit.",
           "Rays that start tangentially at 3 M +- delta; their separation after half an orbit is 2 delta cosh(gamma).",
           "gamma = pi", "Johnson2020"),
       true, lyapunov_rows},
      {closed_form_case(
           "schwarzschild", "time", "Light takes Shapiro's time between two radii.",
           "t = int dr / [(1 - 2M/r) sqrt(1 - b^2 (1 - 2M/r)/r^2)], from r0 to the periapsis and back to r0.",
           "adaptive quadrature of the first integral in long double, with its error", "Shapiro1964"),
       true, time_rows},
      {closed_form_case(
           "schwarzschild", "charts", "The same ray in every chart ends in the same direction, over the pole too.",
           "Rays off the equator, through the axis and past it; the angle between first and last direction is the "
           "equatorial swept angle of b = sqrt(p_theta^2 + L^2/sin^2 theta)/E.",
           "Carlson's R_F for the swept angle", "Darwin1959"),
       true, chart_rows},
  };
}

std::vector<Fault> schwarzschild_faults() {
  return {
      {.id = modulus_fault,
       .description = "Darwin's elliptic integrals called with the parameter m where the library wants the modulus k",
       .case_id = "schwarzschild/deflection"},
      {.id = half_deflection_fault,
       .description = "Newtonian light: half the deflection",
       .case_id = "schwarzschild/deflection"}};
}

}  // namespace xpr
