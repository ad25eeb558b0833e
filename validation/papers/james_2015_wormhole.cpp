// James, von Tunzelmann, Franklin & Thorne 2015: the wormhole of Interstellar.
// [JamesTunzelmannFranklinThorne2015Wormhole]
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "validation/papers/flow_light.hpp"
#include "validation/papers/papers.hpp"
#include "validation/papers/quadrature.hpp"

namespace xpr::papers {

namespace {

constexpr double pi_ = std::numbers::pi;
constexpr const char* slope_fault = "paper-james-slope-without-two-over-pi";

/// Throat radius rho = 1, half-length a of the throat, lensing mass M.
struct Wormhole {
  long double a, mass;

  [[nodiscard]] long double radius(long double l) const {
    const long double x = 2.0L * (std::abs(l) - a) / (pi_ * mass);
    return x <= 0.0L ? 1.0L : 1.0L + mass * (x * std::atan(x) - 0.5L * std::log1p(x * x));
  }
  [[nodiscard]] long double slope(long double l) const {
    const long double x = 2.0L * (std::abs(l) - a) / (pi_ * mass);
    return x <= 0.0L ? 0.0L : (l > 0.0L ? 1.0L : -1.0L) * 2.0L / pi_ * std::atan(x);
  }
};

/// x where the embedding leans by 45 degrees, r' = dr/dl = 1/sqrt2: x = tan(pi/(2 sqrt2)).
double width_by_formula() {
  const double angle = pi_ / (2.0 * std::sqrt(2.0));
  return angle * std::tan(angle) + std::log(std::cos(angle));
}
/// (r - rho)/M there, with x found by bisection and r by quadrature of r'.
double width_by_quadrature(const Lab& lab) {
  const long double factor = lab.planted(slope_fault) ? 1.0L : 2.0L / std::numbers::pi_v<long double>;
  const long double x45 = zero_of([=](long double x) { return factor * std::atan(x) - std::sqrt(0.5L); }, 0.0L, 20.0L);
  // dr = r' dl and dl = (pi M/2) dx.
  const Integral width = integral([=](long double x) { return factor * std::atan(x); }, 0.0L, x45);
  return static_cast<double>(width.value * std::numbers::pi_v<long double> / 2.0L);
}

void add_width(PaperSheet& sheet) {
  ClaimSheet width = sheet.claim("lensing width W/M at 45 degrees");
  width.exact({1.42952681918031207, 3e-16}, "(pi/2sqrt2) tan(pi/2sqrt2) + ln cos(pi/2sqrt2), mpmath");
  width.misprinted("1.42053", "footnote 19, as a documentation page that read the arXiv source notes");
  width.ours("the closed form", width_by_formula(), {1e-14, "round-off"});
  width.ours("quadrature of r' up to 45 degrees", width_by_quadrature(sheet.lab()), {1e-13, "round-off"});
  ClaimSheet figure = sheet.claim("W/rho of figure 3, M = 0.5 rho");
  figure.exact({0.5 * 1.42952681918031207, 2e-16}, "half of the above");
  figure.printed("0.715", "figure 3");
  figure.ours("the closed form", 0.5 * width_by_formula(), {1e-14, "round-off"});
  figure.ours("quadrature", 0.5 * width_by_quadrature(sheet.lab()), {1e-13, "round-off"});
  ClaimSheet film = sheet.claim("M/rho of the film, W = 0.05 rho");
  film.exact({0.0349766085736467, 5e-17}, "0.05/1.42952681918");
  film.ours("the closed form", 0.05 / width_by_formula(), {1e-15, "round-off"});
  film.ours("quadrature", 0.05 / width_by_quadrature(sheet.lab()), {1e-14, "round-off"});
  sheet.finding(
      "footnote 19, W = 1.42053 M",
      fmt::format("the paper's own eq. (7) gives {:.11f}; the integral of r' up to dr/dl = 1/sqrt2 gives {:.11f}. A "
                  "digit slipped: 1.42953. Figure 3's printed 0.715 = W/rho for M = 0.5 rho agrees with 1.42953/2 = "
                  "{:.5f}, not with 1.42053/2 = {:.5f}.",
                  width_by_formula(), width_by_quadrature(sheet.lab()), 0.5 * width_by_formula(), 0.5 * 1.42053));
}

void add_shape(PaperSheet& sheet) {
  struct Member {
    double a, mass, l, r, slope;
  };
  for (const Member& at : {Member{0.005, 0.05, 1.0, 1.81799132333099, 0.949852721340985},
                           Member{0.5, 0.5, 2.0, 1.65530594963815, 0.692927785179366},
                           Member{0.5, 0.5, 10.0, 8.75300345166604, 0.947487842327179}}) {
    const Wormhole hole{at.a, at.mass};
    const std::string where = fmt::format("a = {}, M = {}, l = {:g} (rho = 1)", at.a, at.mass, at.l);
    ClaimSheet r = sheet.claim("r, " + where);
    r.exact({at.r, 5e-15}, "mpmath, 15 digits");
    const Tolerance digits{1e-13, "twenty times the digits of the evaluation"};
    r.ours("eqs. (5)", static_cast<double>(hole.radius(at.l)), digits);
    r.ours("quadrature of r'",
           1.0 + static_cast<double>(integral([&](long double l) { return hole.slope(l); }, at.a, at.l).value), digits);
    ClaimSheet slope = sheet.claim("dr/dl, " + where);
    slope.exact({at.slope, 5e-16}, "mpmath, 15 digits");
    slope.ours("(2/pi) arctan x", static_cast<double>(hole.slope(at.l)), {1e-14, "the digits of the evaluation"});
    const long double h = 1e-3L;
    const long double l = at.l;
    slope.ours("five-point difference of r",
               static_cast<double>((hole.radius(l - 2.0L * h) - 8.0L * hole.radius(l - h) + 8.0L * hole.radius(l + h) -
                                    hole.radius(l + 2.0L * h)) /
                                   (12.0L * h)),
               {1e-7, "h^4 = 1e-12 times the fifth derivative, which is 1e4 in units of the small wormhole's M"});
  }
}

/// The paper's rays in the plane: dl = p_l, dphi = b/r^2, dp_l = b^2 r'/r^3 in t. y[0] = t, y[1] = l, y[3] = phi.
Flow rays(const Wormhole& hole, double b) {
  return [hole, b](const PhaseState<double>& y) {
    PhaseState<double> rate;
    for (std::size_t i = 0; i < 8; ++i) rate[i] = 0.0;
    const auto r = static_cast<double>(hole.radius(y[1]));
    rate[0] = 1.0, rate[1] = y[5], rate[3] = b / (r * r);
    rate[5] = b * b * static_cast<double>(hole.slope(y[1])) / (r * r * r);
    return rate;
  };
}

/// From l = -20 to 20, a step ending on each of the throat's mouths, where r'' jumps.
PhaseState<double> transit(const FixedSteps& how, const Wormhole& hole, double b) {
  PhaseState<double> y;
  for (std::size_t i = 0; i < 8; ++i) y[i] = 0.0;
  y[1] = -20.0;
  const auto r = static_cast<double>(hole.radius(20.0));
  y[5] = std::sqrt(1.0 - b * b / (r * r));
  for (const double target : {-static_cast<double>(hole.a), static_cast<double>(hole.a), 20.0}) {
    y = follow_until(
        how, rays(hole, b), y, (target - y[1]) / y[5], [=](const PhaseState<double>& at) { return at[1] - target; },
        [](const PhaseState<double>& at) { return at[5]; });
  }
  return y;
}

void add_transit(PaperSheet& sheet) {
  const Wormhole hole{0.5L, 0.5L};
  ClaimSheet angle = sheet.claim("azimuth from l = -20 to 20, a = M = 0.5, b = 0.5 (rho = 1)", "rad");
  angle.exact({2.40912487627288132, 4e-16}, "mpmath, 18 digits");
  ClaimSheet time = sheet.claim("time of the same");
  time.exact({40.6297314762207106, 7e-15}, "mpmath, 18 digits");
  const auto leg = [&](bool azimuth) {  // outside the throat, where r is smooth, and the throat itself
    const auto f = [&](long double l) {
      const long double r = hole.radius(l), p = std::sqrt(1.0L - 0.25L / (r * r));
      return azimuth ? 0.5L / (r * r) / p : 1.0L / p;
    };
    return static_cast<double>(2.0L * (integral(f, 0.0L, 0.5L).value + integral(f, 0.5L, 20.0L).value));
  };
  angle.ours("quadrature", leg(true), {1e-13, "round-off"});
  time.ours("quadrature", leg(false), {1e-12, "round-off of 40"});
  for (const FixedSteps& how : {FixedSteps{"dop853", 1500}, FixedSteps{"gl6", 4000}}) {
    const PhaseState<double> end = transit(how, hole, 0.5);
    const Tolerance tolerance{1e-10,
                              "steps of 0.013 rho and 0.005 rho past a throat of size 1, eighth and sixth order; a "
                              "kink's two sides stepped apart"};
    angle.ours(route_name(how), end[3], tolerance);
    time.ours(route_name(how), end[0], tolerance);
  }
}

void draw(PaperSheet& sheet) {
  // The embedding, dz/dl = sqrt(1 - r'^2).
  std::vector<Series> shapes;
  for (const auto& [mass, a, name] : {std::tuple{0.014L, 0.005L, "M = 0.014 rho, a = 0.005 rho"},
                                      {0.43L, 0.005L, "M = 0.43 rho, a = 0.005 rho"},
                                      {0.5L, 0.5L, "M = 0.5 rho, a = 0.5 rho"}}) {
    const Wormhole hole{a, mass};
    Series shape{name, Look::line, {}, {}};
    std::vector<double> z{0.0}, r{1.0};
    long double height = 0.0L;
    const long double step = 0.01L;
    for (int k = 1; k <= 500; ++k) {
      const long double slope = hole.slope((k - 0.5L) * step);
      height += step * std::sqrt(1.0L - slope * slope);
      z.push_back(static_cast<double>(height)), r.push_back(static_cast<double>(hole.radius(k * step)));
    }
    for (std::size_t k = z.size(); k-- > 0;) shape.x.push_back(r[k]), shape.y.push_back(-z[k]);
    for (std::size_t k = 0; k < z.size(); ++k) shape.x.push_back(r[k]), shape.y.push_back(z[k]);
    shapes.push_back(std::move(shape));
  }
  Series swept{"a = M = 0.5 rho, from -20 to 20", Look::line, {}, {}}, stepped{"stepped", Look::dots, {}, {}};
  const Wormhole hole{0.5L, 0.5L};
  for (const double b : even_steps(0.02, 0.98, 60)) {
    const auto f = [&](long double l) {
      const long double r = hole.radius(l);
      return b / (r * r) / std::sqrt(1.0L - b * b / (r * r));
    };
    swept.x.push_back(b),
        swept.y.push_back(static_cast<double>(2.0L * (integral(f, 0.0L, 0.5L).value + integral(f, 0.5L, 20.0L).value)));
  }
  for (const double b : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    stepped.x.push_back(b), stepped.y.push_back(transit({"dop853", 200}, hole, b)[3]);
  }
  sheet.figure() = {
      .title = "James et al. 2015: the wormhole of Interstellar",
      .caption =
          "Left: the embedding for three lensing masses. Right: the azimuth that light sweeps on its way "
          "through.",
      .panels = {
          {.title = "Embedding",
           .x_label = "r [rho]",
           .y_label = "z [rho]",
           .equal = true,
           .series = std::move(shapes)},
          {.title = "Transit", .x_label = "b [rho]", .y_label = "swept azimuth [rad]", .series = {swept, stepped}}}};
}

void run(PaperSheet& sheet) {
  add_width(sheet);
  add_shape(sheet);
  add_transit(sheet);
  draw(sheet);
}

}  // namespace

Paper james_2015_wormhole() {
  return {.info = {.id = "james-2015-wormhole",
                   .reference =
                       "O. James, E. von Tunzelmann, P. Franklin, K. S. Thorne, Visualizing Interstellar's wormhole, "
                       "Am. J. Phys. 83, 486 (2015)",
                   .reproduced = "The shape, the lensing width with its misprint, and a ray through the throat.",
                   .cites = "JamesTunzelmannFranklinThorne2015Wormhole",
                   .not_checked = {"Images of the paper's figures: no camera is set up here.",
                                   "Equation numbers of the appendix."}},
          .run = run,
          .faults = {{slope_fault, "dr/dl without the factor 2/pi"}}};
}

}  // namespace xpr::papers
