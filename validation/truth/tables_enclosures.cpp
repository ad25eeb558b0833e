// Tables whose every printed digit is proven: balls that agree with themselves once rounded.
#include <fmt/format.h>

#include <array>
#include <initializer_list>
#include <numbers>
#include <string>
#include <vector>

#include "core/io/csv.hpp"
#include "validation/truth/enclosure.hpp"
#include "validation/truth/tables.hpp"

namespace xpr {

namespace {

constexpr int digits = 30;

ReferenceTable proven_table(std::string_view name, std::string quantity, std::string units, std::string formula,
                            std::string cites, std::vector<std::string> columns) {
  return {
      .name = std::string(name),
      .quantity = std::move(quantity),
      .units = std::move(units),
      .origin = "computed",
      .method = std::move(formula) + "; ball arithmetic at 384 bits: every digit is proven, the last correctly rounded",
      .digits = digits,
      .rank = std::string(to_string(TruthRank::closed_form)),
      .cites = "Johansson2017 " + std::move(cites),
      .maker = fmt::format("xprimeray reference --regenerate {}", name),
      .columns = std::move(columns),
      .rows = {}};
}

void add_row(ReferenceTable& table, std::initializer_list<double> inputs, std::initializer_list<Ball> outputs) {
  std::vector<std::string>& row = table.rows.emplace_back();
  for (const double x : inputs) row.push_back(number_text(x));
  for (const Ball& x : outputs) row.push_back(decimal_text(x, digits));
}

double to_nearest(const Ball& x) { return proven(x).value; }

constexpr double degree = std::numbers::pi / 180.0;

}  // namespace

ReferenceTable make_schwarzschild_deflection() {
  ReferenceTable table = proven_table("schwarzschild_deflection",
                                      "deflection of light from infinity to infinity, and its closest approach",
                                      "M and b any one length; deflection rad; periapsis as M",
                                      "Darwin's K - F by Legendre's integrals of the roots of 2 u^3 - u^2 + (M/b)^2",
                                      "Darwin1959", {"M", "b", "deflection", "periapsis"});
  const auto add = [&](double M, double b) {
    add_row(table, {M, b}, {enclosure::schwarzschild_deflection(M, b), enclosure::schwarzschild_periapsis(M, b)});
  };
  const double critical = to_nearest(enclosure::kerr_critical_parameters(1.0, 0.0).prograde_b);
  for (const double excess : {1e-14, 1e-12, 1e-9, 1e-6, 1e-4, 1e-3}) add(1.0, critical * (1.0 + excess));
  for (const double b : {5.2, 5.25, 5.5, 6.0, 7.0, 8.0, 10.0, 20.0, 50.0, 100.0, 1000.0, 1e6}) add(1.0, b);
  add(1.7, 10.2);
  return table;
}

ReferenceTable make_kerr_critical_parameters() {
  ReferenceTable table = proven_table(
      "kerr_critical_parameters",
      "photon orbits in the equator and over the poles, and the impact parameters between capture and escape",
      "M and a any one length; all others as M; b signed as L",
      "r = 2 M (1 + cos(2/3 arccos(-+a/M))), b = -a +- 6 M cos(1/3 arccos(-+a/M)); polar: the root of xi = 0",
      "BardeenPressTeukolsky1972", {"M", "a", "prograde_r", "retrograde_r", "polar_r", "prograde_b", "retrograde_b"});
  for (const double a : {0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 0.998, 0.999, 0.999999, 1.0, -0.5}) {
    const enclosure::CriticalParameters c = enclosure::kerr_critical_parameters(1.0, a);
    add_row(table, {1.0, a}, {c.prograde_radius, c.retrograde_radius, c.polar_radius, c.prograde_b, c.retrograde_b});
  }
  return table;
}

ReferenceTable make_kerr_equatorial_deflection() {
  ReferenceTable table = proven_table(
      "kerr_equatorial_deflection", "|Delta phi| - pi of equatorial light from infinity to infinity, and its periapsis",
      "M, a and b any one length, b signed as L; deflection rad; periapsis as M",
      "Legendre's Pi of partial fractions over the horizons; proven quadrature at a = M",
      "Chandrasekhar1983 IyerHansen2009", {"M", "a", "b", "deflection", "periapsis"});
  for (const double a : {1e-6, 0.1, 0.5, 0.6, 0.9, 0.99, 0.998, 1.0, -0.9}) {
    const enclosure::CriticalParameters c = enclosure::kerr_critical_parameters(1.0, a);
    for (const double critical : {to_nearest(c.prograde_b), to_nearest(c.retrograde_b)}) {
      const double sign = critical < 0.0 ? -1.0 : 1.0;
      // Around the extremal hole the prograde angle grows as 1/(b - b_c): a thousand turns, which no quadrature likes.
      const bool extreme = a == 1.0 && sign > 0.0;
      for (const double b : {critical * (1.0 + 1e-9), critical * 1.0001, critical * 1.01, 8.0 * sign, 10.0 * sign,
                             100.0 * sign, 1000.0 * sign}) {
        if (extreme && b < critical * 1.001) continue;
        add_row(table, {1.0, a, b}, {enclosure::kerr_deflection(1.0, a, b), enclosure::kerr_periapsis(1.0, a, b)});
      }
    }
  }
  add_row(table, {1.7, 1.2, 10.2},
          {enclosure::kerr_deflection(1.7, 1.2, 10.2), enclosure::kerr_periapsis(1.7, 1.2, 10.2)});
  return table;
}

ReferenceTable make_kerr_spherical_orbits() {
  ReferenceTable table = proven_table(
      "kerr_spherical_orbits",
      "constants of the spherical photon orbit at r, and one full latitudinal oscillation of it",
      "M, a and r any one length; xi as M; eta as M^2; u_plus and minus_u_minus 1; mino_period 1/M; azimuth rad; time "
      "as M; "
      "lyapunov for half an oscillation, 1",
      "xi and eta at the double root of R; Legendre's K, E and Pi of m = u_plus/u_minus", "Teo2003 Johnson2020",
      {"M", "a", "r", "xi", "eta", "u_plus", "minus_u_minus", "mino_period", "azimuth", "time", "lyapunov"});
  const auto add = [&](double a, double r) {
    const enclosure::SphericalOrbit o = enclosure::kerr_spherical_orbit(1.0, a, r);
    add_row(
        table, {1.0, a, r},
        {o.xi, o.eta, o.cos_squared_least, o.minus_u_minus, o.mino_period, o.azimuth, o.time, o.lyapunov_half_orbit});
  };
  for (const double a : {0.1, 0.5, 0.9, 0.998, 1.0, -0.9}) {
    const enclosure::CriticalParameters c = enclosure::kerr_critical_parameters(1.0, a);
    const double low = to_nearest(c.prograde_radius), high = to_nearest(c.retrograde_radius);
    for (const double part : {0.001, 0.1, 0.3, 0.5, 0.7, 0.9, 0.999}) add(a, low + part * (high - low));
  }
  for (const double r : {1.0316, 2.0, 2.414213562373095, 2.732050807568877, 3.0, 3.82842712474619}) add(1.0, r);
  add(0.9, 2.5);
  add(0.5, 3.2);
  return table;
}

ReferenceTable make_kerr_shadow_extent() {
  ReferenceTable table = proven_table(
      "kerr_shadow_extent", "where the shadow's edge meets the alpha axis of a distant screen, and where it is highest",
      "M and a any one length; inclination rad; all others as M",
      "certified roots of beta^2 = 0 and d(beta^2)/dr = 0 as polynomials of degree 6",
      "Bardeen1973 GrallaLupsascaMarrone2020",
      {"M", "a", "inclination", "alpha_left", "alpha_right", "beta_max", "alpha_at_beta_max"});
  for (const double a : {0.1, 0.5, 0.9, 0.99, 0.998, -0.9}) {
    for (const double inclination : {10.0, 30.0, 60.0, 85.0, 90.0, 120.0}) {
      const double i = inclination * degree;
      const enclosure::ShadowExtent e = enclosure::kerr_shadow_extent(1.0, a, i);
      add_row(table, {1.0, a, i}, {e.alpha_left, e.alpha_right, e.beta_max, e.alpha_at_beta_max});
    }
  }
  return table;
}

ReferenceTable make_kerr_shadow_edge() {
  ReferenceTable table = proven_table(
      "kerr_shadow_edge", "the point of the shadow's edge seen from (centre, 0) under an angle from the alpha axis",
      "M and a any one length; inclination and angle rad; all others as M",
      "the certified root of beta cos(angle) = (alpha - centre) sin(angle) as a polynomial of degree 6",
      "Bardeen1973 GrallaLupsascaMarrone2020", {"M", "a", "inclination", "centre", "angle", "alpha", "beta"});
  for (const auto& [a, inclination, centre] : {std::array{0.5, 90.0, 1.0}, std::array{0.9, 60.0, 1.5},
                                               std::array{0.99, 30.0, 1.0}, std::array{0.998, 85.0, 2.0}}) {
    for (const double angle : {1e-6, 0.5, 1.0, 1.5707963267948966, 2.0, 2.5, 3.1, -1.0}) {
      const double i = inclination * degree;
      const enclosure::ScreenPoint p = enclosure::kerr_shadow_edge(1.0, a, i, centre, angle);
      add_row(table, {1.0, a, i, centre, angle}, {p.alpha, p.beta});
    }
  }
  return table;
}

ReferenceTable make_ellis_deflection() {
  ReferenceTable table = proven_table("ellis_deflection", "deflection of light that stays on its side of the throat",
                                      "b0 and b any one length; deflection rad", "2 K(m = (b0/b)^2) - pi",
                                      "ChetouaniClement1984 NakajimaAsada2012", {"b0", "b", "deflection"});
  for (const double b : {1.0 + 1e-12, 1.000001, 1.001, 1.05, 1.25, 1.5, 2.0, 3.0, 5.0, 10.0, 20.0, 100.0, 1e4}) {
    add_row(table, {1.0, b}, {enclosure::ellis_deflection(1.0, b)});
  }
  return table;
}

ReferenceTable make_ellis_transit_angle() {
  ReferenceTable table =
      proven_table("ellis_transit_angle", "Delta phi of light through the throat, from one infinity to the other",
                   "b0 and b any one length; azimuth rad", "2 (b/b0) K(m = (b/b0)^2)", "ChetouaniClement1984",
                   {"b0", "b", "azimuth"});
  for (const double b : {1e-6, 0.01, 0.1, 0.25, 0.5, 0.75, 0.9, 0.95, 0.99, 0.999999, 1.0 - 1e-12}) {
    add_row(table, {1.0, b}, {enclosure::ellis_transit_angle(1.0, b)});
  }
  return table;
}

}  // namespace xpr
