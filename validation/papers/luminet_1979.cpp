// Luminet 1979: isoradial curves and redshifts of a thin disk around a Schwarzschild hole. [Luminet1979]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "metrics/schwarzschild_exact.hpp"
#include "validation/papers/papers.hpp"
#include "validation/papers/quadrature.hpp"
#include "validation/papers/schwarzschild_light.hpp"

namespace xpr::papers {

namespace {

namespace exact = schwarzschild_exact;

constexpr double pi_ = std::numbers::pi;
constexpr double degree = pi_ / 180.0;
constexpr double inclination = 80.0 * degree;
constexpr double far = std::numeric_limits<double>::infinity();
constexpr const char* plate_fault = "paper-luminet-plate-upside-down";

/// mpmath, 14 digits: b and 1 + z of the direct image at plate angle alpha and of the first ghost at alpha + 180.
struct Line {
  double r, alpha, b, z, b_ghost, z_ghost;
};
constexpr Line lines[] = {{6, 0, 1.0432174887002, 1.4142135623731, 5.2646955221320, 1.4142135623731},
                          {6, 90, 6.9321484791895, 2.0711259286756, 5.4789137220838, 0.89501432872335},
                          {6, 180, 6.6693652767363, 1.4142135623731, 6.3045664780352, 1.4142135623731},
                          {10, 0, 1.7378104897460, 1.1952286093344, 5.3040583001817, 1.1952286093344},
                          {10, 90, 10.956115049792, 1.6030396911547, 5.6661503406687, 0.98432183355818},
                          {10, 180, 8.4071152571863, 1.1952286093344, 7.4299270418503, 1.1952286093344},
                          {20, 0, 3.4742924844581, 1.0846522890933, 5.3414944791932, 1.0846522890933},
                          {20, 90, 20.976651135838, 1.3351669562710, 5.8654108413262, 1.0146043374322},
                          {20, 180, 11.892317367751, 1.0846522890933, 9.3311266457098, 1.0846522890933},
                          {30, 0, 5.2107743338578, 1.0540925533895, 5.3561221559817, 1.0540925533895},
                          {30, 90, 30.984087520982, 1.2498359107073, 5.9505398829357, 1.0164997518022},
                          {30, 180, 14.831342264772, 1.0540925533895, 10.649531282766, 1.0540925533895}};

/// The angle at the hole between observer and emitter (eq. 10 of public re-implementations), alpha from the near side.
double gamma_of(double alpha) {
  const double c = std::cos(alpha), cot = 1.0 / std::tan(inclination);
  return std::acos(c / std::sqrt(c * c + cot * cot));
}

/// A ray that reaches radius r after sweeping an angle from infinity, before or after its periapsis.
struct Image {
  double b;
  bool via_periapsis;
};
Image solve(double r, double swept) {
  const double tangent = r / std::sqrt(1.0 - 2.0 / r);
  const double at_tangent = exact::swept_angle(1.0, tangent * (1.0 - 1e-12), far, r, false).value;
  const bool via = swept > at_tangent;
  const auto off = [&](long double b) {
    return static_cast<long double>(exact::swept_angle(1.0, static_cast<double>(b), far, r, via).value - swept);
  };
  const long double low = via ? 3.0L * std::sqrt(3.0L) * (1.0L + 1e-9L) : 1e-6L, high = tangent * (1.0L - 1e-12L);
  return {static_cast<double>(zero_of(off, low, high)), via};
}

/// b from the orbit equation in long double, independent of Carlson's integrals: one step of Newton's from `b`.
double quadrature_sweep(double b, double r, bool via) {
  const long double ur = 1.0L / static_cast<long double>(r), bb = 1.0L / (static_cast<long double>(b) * b);
  if (!via) {
    const bool turns = b > 3.0 * std::sqrt(3.0);
    if (!turns) {
      return static_cast<double>(
          integral([&](long double u) { return 1.0L / std::sqrt(bb - u * u + 2.0L * u * u * u); }, 0.0L, ur).value);
    }
  }
  const long double u2 = 1.0L / periapsis_of(b);
  const auto f = [u2](long double s) {
    const long double w = s * s;
    return 2.0L / std::sqrt(2.0L * u2 - 6.0L * u2 * u2 + (6.0L * u2 - 1.0L) * w - 2.0L * w * w);
  };
  const long double at_r = std::sqrt(u2 - ur), at_infinity = std::sqrt(u2);
  const long double outer = integral(f, 0.0L, at_infinity).value, inner = integral(f, 0.0L, at_r).value;
  return static_cast<double>(via ? outer + inner : outer - inner);
}

/// From the emitter at r to 1000 M by rays, closed-form tail beyond.
SweptRay traced_from(const Lab& lab, const Charts& at, const Image& image, double r, const MethodAt& method) {
  TraceSettings settings = trace_settings(method);
  settings.r_max = 1000.0;
  settings.r_min = 2.01;
  return trace_swept(lab, *at.classical, *at.transport,
                     equatorial_light(*at.classical, *at.transport, r, image.b, image.via_periapsis), settings);
}

double redshift(const Lab& lab, double r, double b, double alpha) {
  const double sine = std::sin(lab.planted(plate_fault) ? -alpha : alpha);
  return (1.0 + std::pow(r, -1.5) * b * std::sin(inclination) * sine) / std::sqrt(1.0 - 3.0 / r);
}

/// From the metric's components: E and L of the light in the disk's plane, the emitter's own u.
double redshift_from_metric(const Spacetime& areal, double r, double b, double alpha) {
  const SymTensor4<double> g = areal.metric({0.0, r, 0.5 * pi_, 0.0});
  const double omega = std::pow(r, -1.5), u_t = 1.0 / std::sqrt(-(g(0, 0) + omega * omega * g(3, 3)));
  // Towards the observer's right, alpha = 90 degrees, the disk recedes: L of its light is -b sin(i) sin(alpha).
  return u_t * (1.0 + omega * b * std::sin(inclination) * std::sin(alpha));
}

void add_image(PaperSheet& sheet, const Line& line, bool ghost) {
  const Lab& lab = sheet.lab();
  const double plate = (line.alpha + (ghost ? 180.0 : 0.0)) * degree, gamma = gamma_of(line.alpha * degree);
  // The ghost of the same emitter: the other way round the hole.
  const double swept = ghost ? 2.0 * pi_ - gamma : gamma;
  const double r = line.r, value = ghost ? line.b_ghost : line.b;
  const Image image = solve(r, swept);
  const auto sweep = [&](double b) { return exact::swept_angle(1.0, b, far, r, image.via_periapsis).value; };
  const double slope = (sweep(value * (1.0 + 1e-7)) - sweep(value * (1.0 - 1e-7))) / (2e-7 * value);
  const std::string name = fmt::format("{} image of r = {:g} M at plate angle {:g} deg", ghost ? "ghost" : "direct", r,
                                       line.alpha + (ghost ? 180.0 : 0.0));
  ClaimSheet b = sheet.claim("b of the " + name, "M");
  b.exact({value, 5e-13}, "mpmath, 14 digits; where there is a periapsis, the corrected eq. 13");
  const Tolerance digits{1e-11, "twenty times the digits of the evaluation"};
  b.ours("Carlson's integral solved for b", image.b, digits);
  b.ours("quadrature of the orbit equation", value + (swept - quadrature_sweep(value, r, image.via_periapsis)) / slope,
         digits);
  for (const Route& route : schwarzschild_routes()) {
    const Charts at = schwarzschild_charts(lab, route.chart);
    const SweptRay ray = traced_from(lab, at, {value, image.via_periapsis}, r, route.method);
    const double traced =
        std::abs(ray.azimuth()) + exact::swept_angle(1.0, value, ray.end_classical[1], far, false).value;
    Tolerance tolerance = accumulated(ray.end, route.method.setting, (1.0 + std::abs(value * slope)) / std::abs(slope));
    tolerance.value = 10.0 * tolerance.value + 5e-12;
    tolerance.reason =
        "a step of Newton's from the exact b; ten digits of room for the turning point; " + tolerance.reason;
    b.traced({*at.transport, route.method, ray.end}, value + (swept - traced) / slope, tolerance);
  }
  ClaimSheet z = sheet.claim("1 + z of the " + name);
  z.exact({ghost ? line.z_ghost : line.z, 5e-13}, "mpmath, 14 digits");
  z.ours("eq. 19 with our b", redshift(lab, r, image.b, plate), digits);
  z.ours("components of the metric with our b",
         redshift_from_metric(*schwarzschild_charts(lab, "areal").classical, r, image.b, plate), digits);
}

/// sn(u|m) by the descending arithmetic-geometric mean.
double jacobi_sn(double u, double m) {
  std::vector<double> a{1.0}, c{std::sqrt(m)};
  double b = std::sqrt(1.0 - m);
  while (std::abs(c.back()) > 1e-16 && a.size() < 20) {
    const double mean = 0.5 * (a.back() + b);
    c.push_back(0.5 * (a.back() - b));
    b = std::sqrt(a.back() * b);
    a.push_back(mean);
  }
  double phi = std::ldexp(1.0, static_cast<int>(a.size()) - 1) * a.back() * u;
  for (std::size_t n = a.size() - 1; n > 0; --n)
    phi = 0.5 * (phi + std::asin(std::clamp(c[n] / a[n] * std::sin(phi), -1.0, 1.0)));
  return std::sin(phi);
}

/// r from eq. 13; how it is printed differs in three places.
struct Misprints {
  bool b_for_b_squared = false, no_brackets = false, multiplied = false;
};
double radius_from_eq_13(double b, double gamma, int n, const Misprints& as_printed) {
  // b^2 = P^3/(P - 2); as printed, b = P^3/(P - 2), which has no root above 3 where b < 27.
  const double b_squared = as_printed.b_for_b_squared ? b : b * b;
  const double P = b_squared > 27.0 ? static_cast<double>(periapsis_of(std::sqrt(b_squared))) : std::nan("");
  const double Q = std::sqrt((P - 2.0) * (P + 6.0));
  const double m = as_printed.no_brackets ? Q - P + 6.0 / (2.0 * Q) : (Q - P + 6.0) / (2.0 * Q);
  const double zeta = std::asin(std::sqrt((Q - P + 2.0) / (Q - P + 6.0)));
  if (!(m >= 0.0 && m < 1.0)) return std::nan("");
  const double k = std::sqrt(m), root = std::sqrt(P / Q);
  const double u = n == 0 ? gamma / (2.0 * root) + std::ellint_1(k, zeta)
                          : (as_printed.multiplied ? (gamma - 2.0 * n * pi_) * (2.0 * root)
                                                   : (gamma - 2.0 * n * pi_) / (2.0 * root)) -
                                std::ellint_1(k, zeta) + 2.0 * std::comp_ellint_1(k);
  const double sn = jacobi_sn(u, m);
  return 4.0 * P / (-(Q - P + 2.0) + (Q - P + 6.0) * sn * sn);
}

void add_equation_13(PaperSheet& sheet) {
  const double gamma = gamma_of(90.0 * degree);
  ClaimSheet direct = sheet.claim("r from eq. 13, corrected, at the direct image of r = 10 M, 90 deg", "M");
  direct.exact({10.0, 1e-11}, "the emitter's radius");
  const double b = lines[4].b, b_ghost = lines[4].b_ghost;
  const Tolerance digits{1e-9, "b to 14 digits, over the slope of r"};
  direct.ours("eq. 13 corrected", radius_from_eq_13(b, gamma, 0, {}), digits);
  direct.ours("exact solutions' module: radius after that angle",
              static_cast<double>(zero_of(
                  [&](long double r) {
                    return static_cast<long double>(
                        exact::swept_angle(1.0, b, far, static_cast<double>(r), false).value - gamma);
                  },
                  9.95L, 30.0L)),
              digits);
  const double no_square = radius_from_eq_13(b, gamma, 0, {.b_for_b_squared = true});
  const double no_brackets = radius_from_eq_13(b, gamma, 0, {.no_brackets = true});
  ClaimSheet ghost = sheet.claim("r from eq. 13, corrected, at the ghost of r = 10 M, 270 deg", "M");
  ghost.exact({10.0, 1e-11}, "the emitter's radius");
  ghost.ours("eq. 13 corrected", radius_from_eq_13(b_ghost, gamma, 1, {}),
             {1e-7, "b to 14 digits, over the slope of r next to b_c"});
  const double multiplied = radius_from_eq_13(b_ghost, gamma, 1, {.multiplied = true});
  ghost.ours("exact solutions' module: radius after that angle",
             static_cast<double>(zero_of(
                 [&](long double r) {
                   return static_cast<long double>(
                       exact::swept_angle(1.0, b_ghost, far, static_cast<double>(r), true).value - (2.0 * pi_ - gamma));
                 },
                 4.5L, 40.0L)),
             {1e-7, "as above"});
  ghost.wrong_formula("as printed: the square root multiplies", multiplied, 0.1, "off by more than 0.1 M");
  const auto said = [](double r) {
    return std::isfinite(r) ? fmt::format("{:.6f} M", r) : std::string("no number at all");
  };
  sheet.finding(
      "eq. 13 (as two public re-implementations, bgmeulem/Luminet and peytondmurray/bhsim, read it)",
      fmt::format("At the direct image of r = 10 M (theta0 = 80 deg, alpha = 90 deg, b = {:.12f} M) the corrected "
                  "equation gives back r = {:.9f} M. With b for b^2 in b^2 = P^3/(P - 2): {}. Without the brackets "
                  "in k^2 = (Q - P + 6)/(2Q): {} (k^2 > 1). At the ghost (b = {:.12f} M) the corrected equation "
                  "gives {:.9f} M; with sqrt(P/Q) multiplying instead of dividing: {}. The paper itself was not seen.",
                  b, radius_from_eq_13(b, gamma, 0, {}), said(no_square), said(no_brackets), b_ghost,
                  radius_from_eq_13(b_ghost, gamma, 1, {}), said(multiplied)));
}

void draw(PaperSheet& sheet) {
  std::vector<Series> direct, ghosts;
  for (const double r : {6.0, 10.0, 20.0, 30.0}) {
    Series curve{fmt::format("r = {:g} M", r), Look::line, {}, {}};
    Series ghost{fmt::format("ghost, r = {:g} M", r), Look::dashed, {}, {}};
    for (const double alpha : even_steps(0.0, 2.0 * pi_, 73)) {
      const double gamma = gamma_of(alpha);
      const double b = solve(r, gamma).b, b_ghost = solve(r, 2.0 * pi_ - gamma).b;
      curve.x.push_back(b * std::sin(alpha)), curve.y.push_back(-b * std::cos(alpha));
      ghost.x.push_back(-b_ghost * std::sin(alpha)), ghost.y.push_back(b_ghost * std::cos(alpha));
    }
    direct.push_back(std::move(curve)), ghosts.push_back(std::move(ghost));
  }
  Series points{"mpmath", Look::dots, {}, {}};
  for (const Line& line : lines) {
    points.x.push_back(line.b * std::sin(line.alpha * degree)),
        points.y.push_back(-line.b * std::cos(line.alpha * degree));
  }
  direct.push_back(points);
  Series hole{"", Look::area, {}, {}};
  for (const double angle : even_steps(0.0, 2.0 * pi_, 97)) {
    hole.x.push_back(3.0 * std::sqrt(3.0) * std::cos(angle)), hole.y.push_back(3.0 * std::sqrt(3.0) * std::sin(angle));
  }
  ghosts.insert(ghosts.begin(), hole);
  sheet.figure() = {
      .title = "Luminet 1979: isoradial curves of a disk seen at 80 degrees",
      .caption =
          "Left: direct images of circles of the disk. Right: their first ghosts around the shadow, "
          "seen from below the hole's equator.",
      .panels = {{.title = "Direct images", .x_label = "X [M]", .y_label = "Y [M]", .equal = true, .series = direct},
                 {.title = "First ghosts", .x_label = "X [M]", .y_label = "Y [M]", .equal = true, .series = ghosts}}};
}

void run(PaperSheet& sheet) {
  for (const Line& line : lines) {
    add_image(sheet, line, false);
    add_image(sheet, line, true);
  }
  add_equation_13(sheet);
  draw(sheet);
}

}  // namespace

Paper luminet_1979() {
  return {.info = {.id = "luminet-1979",
                   .reference =
                       "J.-P. Luminet, Image of a spherical black hole with thin accretion disk, Astron. Astrophys. "
                       "75, 228 (1979)",
                   .reproduced = "Isoradial curves, direct and ghost, their redshifts, and eq. 13 with its misprints.",
                   .cites = "Luminet1979",
                   .not_checked = {"The paper itself was not seen: equation numbers and misprints are as two public "
                                   "re-implementations give them; eqs. 5, 12 and 18 are not tested.",
                                   "The photograph of bolometric flux; the flux itself is in page-thorne-1974."}},
          .run = run,
          .faults = {{plate_fault, "the plate angle turned the other way: approaching and receding sides exchanged"}}};
}

}  // namespace xpr::papers
