// Gralla & Lupsasca 2020; Dexter & Agol 2009: null geodesics of Kerr in closed form. [GrallaLupsasca2020Geodesics]
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/camera_screen.hpp"
#include "metrics/kerr_ray_exact.hpp"
#include "validation/families/kerr.hpp"
#include "validation/papers/papers.hpp"
#include "validation/papers/quadrature.hpp"
#include "validation/papers/schwarzschild_light.hpp"

namespace xpr::papers {

namespace {

using kerr_exact::KerrRay;

constexpr double pi_ = std::numbers::pi;
constexpr double degree = pi_ / 180.0;
constexpr const char* mirror_fault = "paper-gralla-lupsasca-screen-upside-down";

// --- Constants of one ray ---

/// a = 0.9 M, i = 60 degrees, (alpha, beta) = (5, 4) M.
struct Fixture {
  long double a = 0.9L;
  long double lambda = -5.0L * std::sqrt(0.75L);
  long double eta = (25.0L - 0.81L) * 0.25L + 16.0L;
  [[nodiscard]] long double radial(long double r) const {
    const long double P = r * r + a * a - a * lambda;
    return P * P - (r * r - 2.0L * r + a * a) * (eta + (lambda - a) * (lambda - a));
  }
  /// Of a^2 u^2 + b u - eta, whose roots are u+ and u-.
  [[nodiscard]] long double linear() const { return lambda * lambda + eta - a * a; }
  [[nodiscard]] long double u_plus() const {
    const long double b = linear();
    return 2.0L * eta / (b + std::sqrt(b * b + 4.0L * a * a * eta));
  }
  [[nodiscard]] long double u_minus() const { return -eta / (a * a * u_plus()); }
};
constexpr std::array<double, 4> radial_roots{-7.3342372132194, 0.19633292809827, 2.9899102227491, 4.147994062372};

void add_fixture(PaperSheet& sheet, const char* name, const char* unit, double value,
                 const std::array<std::pair<const char*, double>, 2>& routes) {
  ClaimSheet claim = sheet.claim(fmt::format("{}, a = 0.9 M, i = 60 deg, (alpha, beta) = (5, 4) M", name), unit);
  claim.exact({value, 5e-14}, "mpmath, 15 digits");
  for (const auto& [route, ours] : routes) {
    claim.ours(route, ours, {1e-12, "the digits of the evaluation, and a = 0.9 in binary"});
  }
}

double rounded(long double x) { return static_cast<double>(x); }

void add_constants(PaperSheet& sheet) {
  const Fixture ray;
  const CameraScreen screen{.spin = 0.9, .inclination = pi_ / 3.0};
  const auto constants = screen.constants(5.0, 4.0);
  add_fixture(sheet, "lambda", "M", -4.33012701892219,
              {{{"-alpha sin i", rounded(ray.lambda)}, {"the camera's own constants", constants.angular_momentum}}});
  add_fixture(
      sheet, "eta", "M2", 22.0475,
      {{{"(alpha^2 - a^2) cos^2 i + beta^2", rounded(ray.eta)}, {"the camera's own constants", constants.carter}}});
  const auto polar = [&](long double u) { return ray.a * ray.a * u * u + ray.linear() * u - ray.eta; };
  add_fixture(sheet, "u+", "1", 0.545335748088869,
              {{{"quadratic formula", rounded(ray.u_plus())}, {"bisection", rounded(zero_of(polar, 0.0L, 1.0L))}}});
  add_fixture(
      sheet, "u-", "1", -49.9126196987062,
      {{{"product of the roots", rounded(ray.u_minus())}, {"bisection", rounded(zero_of(polar, -60.0L, -1.0L))}}});
  const auto found = [&](std::size_t j) {
    const long double at = radial_roots[j];
    return zero_of([&](long double r) { return ray.radial(r); }, at - 0.05L, at + 0.05L);
  };
  for (std::size_t k = 0; k < 4; ++k) {
    ClaimSheet claim = sheet.claim(fmt::format("radial root {}", k + 1), "M");
    claim.exact({radial_roots[k], 5e-13}, "mpmath, 13 digits");
    claim.ours("bisection of R(r)", rounded(found(k)), {1e-11, "twenty times the digits of the evaluation"});
    long double others = 0.0L;  // there is no cubic term: the roots' sum vanishes
    for (std::size_t j = 0; j < 4; ++j) others -= j == k ? 0.0L : found(j);
    claim.ours("less the sum of the other three", rounded(others), {1e-11, "as above"});
  }
}

void add_periods(PaperSheet& sheet) {
  const Fixture ray;
  const long double ratio = -ray.u_plus() / ray.u_minus();
  const Integral quarter = integral(
      [ratio](long double psi) {
        const long double s = std::sin(psi);
        return 1.0L / std::sqrt(1.0L + ratio * s * s);
      },
      0.0L, std::numbers::pi_v<long double> / 2.0L);
  // K(m) of m < 0 by a positive modulus: K(-m) = K(m/(1 + m))/sqrt(1 + m).
  const double m = rounded(ratio), scale = 0.9 * std::sqrt(rounded(-ray.u_minus()));
  const double complete = std::comp_ellint_1(std::sqrt(m / (1.0 + m))) / std::sqrt(1.0 + m);
  add_fixture(
      sheet, "half polar period", "M-1", 0.492744242626108,
      {{{"quadrature", 2.0 * rounded(quarter.value) / scale}, {"complete elliptic integral", 2.0 * complete / scale}}});
  const long double r4 = zero_of([&](long double r) { return ray.radial(r); }, 4.1L, 4.2L);
  const Integral total = integral(
      [&](long double s) {  // r = r4/(1 - s^2)
        const long double x = 1.0L - s * s;
        return 2.0L * std::sqrt(r4) /
               std::sqrt((r4 - radial_roots[0] * x) * (r4 - radial_roots[1] * x) * (r4 - radial_roots[2] * x));
      },
      0.0L, 1.0L);
  const KerrRay closed(
      {1.0, 0.9},
      kerr_exact::RayStart{.r = 1e7, .theta = pi_ / 3.0, .lambda = rounded(ray.lambda), .eta = rounded(ray.eta)});
  ClaimSheet mino = sheet.claim("Mino time from infinity to the turning point and back", "M-1");
  mino.exact({0.980571077458834228, 1e-15}, "mpmath, 18 digits");
  mino.ours("quadrature with the roots taken out", rounded(2.0L * total.value), {1e-11, "the roots' thirteen digits"});
  mino.ours("closed form from r = 1e7 M, both ends added", closed.at_end(1e7, 2.0).mino.value + 2e-7,
            {1e-12, "1/r at each end to first order; the next is 1e-14"});
}

// --- A whole ray ---

void add_ray(PaperSheet& sheet) {
  constexpr double spin = 0.6;
  const PhaseState<double> start({0.0, 50.0, 1.0, 0.0}, {-1.0, -1.03322680185732755, 6.0, 2.0});
  struct Quantity {
    const char* name;
    const char* unit;
    double value;
  };
  const std::array<Quantity, 5> quantities{{{"theta", "rad", 1.2812911704019574},
                                            {"phi", "rad", 3.58737316228051762},
                                            {"t", "M", 118.228672106212655},
                                            {"affine length", "M", 102.455218678658406},
                                            {"least r", "M", 5.12725436642659012}}};
  const KerrRay ray({1.0, spin}, kerr_exact::RayMomentum{.r = 50.0, .theta = 1.0, .lambda = 2.0, .p_theta = 6.0});
  const kerr_exact::Arrival end = ray.at_end(50.0, 2.0);
  const std::array<double, 5> closed{end.theta.value, end.phi.value, end.time.value, end.affine.value,
                                     ray.turning_radius()};
  std::vector<ClaimSheet> claims;
  for (std::size_t k = 0; k < 5; ++k) {
    claims.push_back(
        sheet.claim(fmt::format("{} of the whole ray, back at r = 50 M", quantities[k].name), quantities[k].unit));
    claims[k].exact({quantities[k].value, 2e-15 * (1.0 + quantities[k].value)},
                    "closed form and Hamiltonian ODE by mpmath, agreeing to 1e-33");
    claims[k].ours("closed form of the module", closed[k],
                   {1e-13 * (1.0 + quantities[k].value), "round-off of the start, amplified by at most 100"});
  }
  const double Q = 37.5440381403280533;
  const auto radial = [&](long double r) {
    const long double a = spin, P = r * r + a * a - 2.0L * a;
    return P * P - (r * r - 2.0L * r + a * a) * (Q + (2.0L - a) * (2.0L - a));
  };
  claims[4].ours("root of R(r)", static_cast<double>(zero_of(radial, 4.0L, 8.0L)),
                 {1e-12, "Q's eighteen digits in a double"});
  for (const Route& route : {Route{"kerr-schild", {"dop853", 1e-14}}, Route{"boyer-lindquist", {"dopri54", 1e-13}}}) {
    const Charts at = kerr_family::charts(sheet.lab(), spin, route.chart);
    TraceSettings settings = trace_settings(route.method);
    settings.r_max = 50.0;
    settings.grade_time = true;
    const SweptRay traced = trace_swept(sheet.lab(), *at.classical, *at.transport,
                                        change_chart(*at.classical, *at.transport, start), settings);
    const Tolerance tolerance = accumulated(traced.end, route.method.setting, 200.0);
    const TracedRoute how{*at.transport, route.method, traced.end};
    claims[0].traced(how, traced.end_classical[2], tolerance);
    claims[1].traced(how, traced.azimuth(), tolerance);
    claims[2].traced(how, traced.end_classical[0], tolerance);
    claims[3].traced(how, traced.end.lambda, tolerance);
  }
}

// --- First crossings of the equatorial plane, as public test data list them ---

struct Crossing {
  double spin, inclination, alpha, beta;
  const char* x;
  const char* y;
  double exact_x, exact_y;  ///< mpmath, 12 digits
};
constexpr std::array crossings = {
    Crossing{0.42, 60, -17, 0, "-0.0522336", "-16.0342", -0.0522335907659, -16.0342334137},
    Crossing{0.42, 60, -9, 0, "-0.103693", "-8.09784", -0.103693371068, -8.09783511273},
    Crossing{0.42, 60, -4, 0, "-0.308159", "-3.20445", -0.308158526902, -3.20444879601},
    Crossing{0.42, 60, 8, 0, "0.129720", "6.94829", 0.129720293699, 6.94829094317},
    Crossing{0.9, 10, -12, 0, "-0.164094", "-11.0082", -0.16409369268, -11.0081960857},
    Crossing{0.9, 10, -4, 0, "-0.655582", "-2.99558", -0.655581437265, -2.99557558932},
    Crossing{0.73, 35, 0.0001, -10, "11.8258", "-0.0858775", 11.8258285831, -0.0858775219454},
    Crossing{0.73, 35, 0.0001, 4, "-2.11221", "1.02322", -2.11220711819, 1.02322913698}};

std::array<Event, 1> equatorial_plane() {
  return {{{.name = "equatorial plane",
            .g = [](const Spacetime& chart, const PhaseState<double>& y,
                    int) { return chart.card().chart == "boyer-lindquist" ? std::cos(y[2]) : y[3]; },
            .terminal = true}}};
}

void add_crossings(PaperSheet& sheet) {
  const double upright = sheet.lab().planted(mirror_fault) ? -1.0 : 1.0;
  for (const Crossing& crossing : crossings) {
    const std::string where = fmt::format("a = {} M, i = {:g} deg, (alpha, beta) = ({:g}, {:g}) M", crossing.spin,
                                          crossing.inclination, crossing.alpha, crossing.beta);
    const double inclination = crossing.inclination * degree;
    ClaimSheet x = sheet.claim("x where the equatorial plane is met, " + where, "M");
    ClaimSheet y = sheet.claim("y where the equatorial plane is met, " + where, "M");
    x.exact({crossing.exact_x, 4.2e-12 * (1.0 + std::abs(crossing.exact_x))}, "mpmath, 12 digits");
    y.exact({crossing.exact_y, 4.2e-12 * (1.0 + std::abs(crossing.exact_y))}, "mpmath, 12 digits");
    const char* source = "test data of the public code kgeo, which cuts digits off in places";
    x.printed(crossing.x, source, 2.0);
    y.printed(crossing.y, source, 2.0);
    const double lambda = -crossing.alpha * std::sin(inclination);
    // Closed form: the radius at which theta is 90 degrees, by bisection on the polar motion.
    // The ray goes back in time: p is minus the light's own.
    const CameraScreen screen{.spin = crossing.spin, .inclination = inclination};
    const PhaseState<double> from = *screen.ray(crossing.alpha, upright * crossing.beta);
    const KerrRay ray(
        {1.0, crossing.spin},
        kerr_exact::RayEvent{
            .r = from[1], .theta = from[2], .p_t = from[4], .p_r = from[5], .p_theta = from[6], .p_phi = from[7]});
    const double guess = std::hypot(crossing.exact_x, crossing.exact_y);
    const auto height = [&](long double r) {
      return static_cast<long double>(ray.at_radius(static_cast<double>(r), 0).cos_theta);
    };
    if (upright > 0.0) {
      const auto r = static_cast<double>(zero_of(height, 0.999L * guess, 1.001L * guess));
      const kerr_exact::Arrival met = ray.at_radius(r, 0);
      const Tolerance closed{1e-9, "twelve digits of the evaluation, and the observer's 1000 M in doubles"};
      x.ours("closed form of the module", r * std::cos(met.phi.value), closed);
      y.ours("closed form of the module", r * std::sin(met.phi.value), closed);
    }
    for (const Route& route :
         {Route{"kerr-schild-outgoing", {"dop853", 1e-13}}, Route{"boyer-lindquist", {"dopri54", 1e-12}}}) {
      const Charts at = kerr_family::charts(sheet.lab(), crossing.spin, route.chart);
      ChartState start =
          general_light(*at.classical, *at.transport, 1000.0, inclination, lambda, upright * crossing.beta, false);
      start.state = reversed(start.state);
      const RayEnd end =
          sheet.lab().trace(*at.transport, start.state, 1, trace_settings(route.method), equatorial_plane());
      const Vec4<double> met = change_chart(*at.transport, *at.classical, end.y).state.x();
      Tolerance tolerance = accumulated(end, route.method.setting, 2000.0);
      tolerance.reason = "in a picture of the observer's size, 1000 M; " + tolerance.reason;
      const TracedRoute how{*at.transport, route.method, end, Status::crossed};
      x.traced(how, met[1] * std::cos(met[3]), tolerance);
      y.traced(how, met[1] * std::sin(met[3]), tolerance);
    }
  }
}

void draw(PaperSheet& sheet) {
  std::vector<Series> all;
  Series hole{"", Look::area, {}, {}};
  const double horizon = 1.0 + std::sqrt(1.0 - 0.81);
  for (const double angle : even_steps(0.0, 2.0 * pi_, 97))
    hole.x.push_back(horizon * std::cos(angle)), hole.y.push_back(horizon * std::sin(angle));
  all.push_back(std::move(hole));
  const Charts at = kerr_family::charts(sheet.lab(), 0.9, "kerr-schild");
  Series rays{"traced", Look::line, {}, {}};
  for (const double b : {-9.0, -8.0, -7.2, -6.9, -6.5, -5.0, -3.0, -1.0, 1.0, 2.0, 2.7, 2.9, 3.2, 4.0, 5.0, 7.0}) {
    TraceSettings settings = trace_settings({"dop853", 1e-10});
    settings.r_max = 20.0;
    settings.r_min = *at.transport->default_r_min();
    const ChartState start = kerr_family::inward_light(at, 20.0, pi_ / 2.0, b, 0.0);
    const RayEnd end = sheet.lab().trace(*at.transport, start.state, 1, settings, {}, [&](const StepView& step) {
      for (const double part : {0.25, 0.5, 0.75, 1.0}) {
        const PhaseState<double> y = step.at(part);
        if (std::hypot(y[1], y[2]) > 11.0) continue;
        rays.x.push_back(y[1]), rays.y.push_back(y[2]);
      }
    });
    (void)end;
    rays.x.push_back(std::nan("")), rays.y.push_back(std::nan(""));
  }
  all.push_back(std::move(rays));
  sheet.figure() = {.title = "Gralla & Lupsasca 2020: null geodesics of the Kerr exterior",
                    .caption =
                        "Equatorial light that comes from the right, seen along the axis in Kerr-Schild coordinates; "
                        "a = 0.9 M, the hole turns counter-clockwise.",
                    .panels = {{.title = "Equatorial light, a = 0.9 M",
                                .x_label = "x [M]",
                                .y_label = "y [M]",
                                .equal = true,
                                .series = std::move(all)}}};
}

void run(PaperSheet& sheet) {
  add_constants(sheet);
  add_periods(sheet);
  add_ray(sheet);
  add_crossings(sheet);
  draw(sheet);
}

}  // namespace

Paper gralla_lupsasca_2020() {
  return {
      .info =
          {.id = "gralla-lupsasca-2020",
           .reference = "S. E. Gralla, A. Lupsasca, Null geodesics of the Kerr exterior, Phys. Rev. D 101, 044032 "
                        "(2020); J. Dexter, E. Agol, Astrophys. J. 696, 1616 (2009)",
           .reproduced = "Roots, periods and whole rays of Kerr in closed form, and printed crossings of the "
                         "equatorial plane.",
           .cites = "GrallaLupsasca2020Geodesics DexterAgol2009",
           .not_checked = {"kgeo's rows (0.42, 60, 1, 0), (0.9, 10, 1, 0), (0.9, 10, 2, 0), (0.73, 35, 0.0001, +-1) "
                           "and (0.73, 35, 0.0001, 3): their radius lies inside the horizon, so they are artefacts.",
                           "kgeo's row (0.42, 60, 6, 0): not the first crossing, which is at (0.190126166522, "
                           "4.93986658318) M.",
                           "The paper's case tables by equation number."}},
      .run = run,
      .faults = {{mirror_fault, "p_theta = -beta: the screen upside down"}}};
}

}  // namespace xpr::papers
