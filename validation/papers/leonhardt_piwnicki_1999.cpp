// Gordon 1923; Leonhardt & Piwnicki 1999: light in moving media, and in a vortex. [Gordon1923] [LeonhardtPiwnicki1999]
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
constexpr const char* momentum_fault = "paper-leonhardt-piwnicki-no-circulation";

/// The vortex v_phi = W/r in a medium of index n; g^{mn} = eta^{mn} - (n^2 - 1) u^m u^n, p_t = -1, p_phi = J:
///   p_r^2 = 1 - J^2/r^2 + k G,  G = gamma^2 (1 - W J/r^2)^2,  dphi/dlambda = J/r^2 + k gamma^2 (1 - W J/r^2) W/r^2
struct Vortex {
  long double k, W, J;

  /// Light with geometric impact parameter b: J = n b - k W.
  Vortex(long double n, long double w, long double b, bool planted)
      : k(n * n - 1.0L), W(w), J(n * b - (planted ? 0.0L : k * w)) {}
  [[nodiscard]] long double gamma_squared(long double r) const { return r * r / ((r - W) * (r + W)); }
  [[nodiscard]] long double radial_squared(long double r) const {
    const long double A = 1.0L - W * J / (r * r);
    return 1.0L - J * J / (r * r) + k * gamma_squared(r) * A * A;
  }
  [[nodiscard]] long double turning(long double r) const {
    return J / (r * r) + k * gamma_squared(r) * (1.0L - W * J / (r * r)) * W / (r * r);
  }
  [[nodiscard]] long double periapsis() const {
    return zero_of([this](long double r) { return radial_squared(r); }, std::abs(J) / std::sqrt(1.0L + k) * 0.8L,
                   std::abs(J) / std::sqrt(1.0L + k) * 1.3L);
  }
  /// |Delta phi| between the periapsis and r1 (infinity where r1 is 0), twice.
  [[nodiscard]] double swept(long double from) const {
    const long double r0 = periapsis();
    // r = r0/(1 - s^2)
    const long double start = from > 0.0L ? std::sqrt(1.0L - r0 / from) : 0.0L;
    const Integral half = integral(
        [&](long double s) {
          const long double x = 1.0L - s * s, r = r0 / x;
          return turning(r) / std::sqrt(radial_squared(r)) * r0 * 2.0L * s / (x * x);
        },
        start, 1.0L);
    return static_cast<double>(2.0L * std::abs(half.value));
  }
};

/// Hamilton's equations, the parameter stretched by r: y[1] = r, y[3] = phi, y[5] = p_r.
Flow vortex_flow(const Vortex& v) {
  return [v](const PhaseState<double>& y) {
    const long double r = y[1], A = 1.0L - v.W * v.J / (r * r), g2 = v.gamma_squared(r), d = (r - v.W) * (r + v.W);
    const long double dG = -2.0L * r * v.W * v.W / (d * d) * A * A + 4.0L * g2 * A * v.W * v.J / (r * r * r);
    PhaseState<double> rate;
    for (std::size_t i = 0; i < 8; ++i) rate[i] = 0.0;
    rate[1] = static_cast<double>(r * y[5]);
    rate[3] = static_cast<double>(r * v.turning(r));
    rate[5] = static_cast<double>(r * (v.J * v.J / (r * r * r) + 0.5L * v.k * dG));
    return rate;
  };
}

double swept_by_steps(const FixedSteps& how, const Vortex& v) {
  constexpr double far = 2000.0;
  PhaseState<double> start;
  for (std::size_t i = 0; i < 8; ++i) start[i] = 0.0;
  start[1] = static_cast<double>(v.periapsis());
  const double n = std::sqrt(static_cast<double>(1.0L + v.k));
  const PhaseState<double> end = follow_until(
      how, vortex_flow(v), start, std::acosh(far / start[1]) / n,
      [](const PhaseState<double>& y) { return y[1] - far; }, [](const PhaseState<double>& y) { return y[1] * y[5]; });
  return 2.0 * std::abs(end[3]) + v.swept(end[1]);
}

void add_uniform(PaperSheet& sheet) {
  struct Member {
    double v, speed;
  };
  for (const Member& at : {Member{0.1, 0.71875}, Member{-0.1, 0.607142857142857}}) {
    ClaimSheet claim =
        sheet.claim(fmt::format("speed of light {} a flow of 0.1 in n = 1.5", at.v > 0.0 ? "with" : "against"));
    claim.exact({at.speed, at.v > 0.0 ? 0.0 : 5e-16}, "(1/n + v)/(1 + v/n)");
    const Tolerance round_off{1e-13, "the digits of the evaluation"};
    claim.ours("addition of velocities", (1.0 / 1.5 + at.v) / (1.0 + at.v / 1.5), round_off);
    // Gordon's metric: -1 + V^2 + (1 - 1/n^2) gamma^2 (1 - v V)^2 = 0.
    const long double v = at.v, g2 = 1.0L / (1.0L - v * v);
    claim.ours("null lines of Gordon's metric",
               static_cast<double>(zero_of(
                   [=](long double V) {
                     const long double A = 1.0L - v * V;
                     return -1.0L + V * V + (1.0L - 1.0L / 2.25L) * g2 * A * A;
                   },
                   0.3L, 0.95L)),
               round_off);
  }
}

void add_vortex(PaperSheet& sheet) {
  const bool planted = sheet.lab().planted(momentum_fault);
  struct Member {
    double b, swept;
  };
  for (const Member& at : {Member{4.0, 3.14807243272816392}, Member{-4.0, 3.14970638543444791}}) {
    const Vortex vortex(4.0L / 3.0L, 0.25L, at.b, planted);
    ClaimSheet claim = sheet.claim(fmt::format("swept angle past a vortex, n = 4/3, W = 0.25, b = {:+g}", at.b), "rad");
    claim.exact({at.swept, 1e-15}, "mpmath, 18 digits");
    claim.ours("quadrature", vortex.swept(0.0L),
               {1e-11, "a root under the integral left as a difference: 1e-19 over 1e-8"});
    for (const FixedSteps& how : flow_routes()) {
      claim.ours(route_name(how), swept_by_steps(how, vortex),
                 {1e-9, "steps of 0.015 in ln r, sixth and eighth order; the way beyond r = 2000 by quadrature"});
    }
  }
  for (const double n : {1.1, 4.0 / 3.0, 1.5, 2.0}) {
    const double leading = 0.75 * pi_ * (n * n - 1.0);
    ClaimSheet claim = sheet.claim(fmt::format("(b/W)^2 times the deflection as W -> 0, n = {:.4g}", n));
    claim.exact({leading, 4e-16 * leading}, "(3 pi/4)(n^2 - 1): no first-order bending");
    // The mean of both senses takes out the odd orders; the fourth is W^2/b^2 = 1e-4 of it.
    const double w = 0.04, b = 4.0;
    double mean = 0.0, stepped = 0.0;
    for (const double sign : {1.0, -1.0}) {
      const Vortex vortex(n, w, sign * b, planted);
      mean += 0.5 * (vortex.swept(0.0L) - pi_);
      stepped += 0.5 * (swept_by_steps(flow_routes()[0], vortex) - pi_);
    }
    const Tolerance next{50.0 * leading * w * w / (b * b) * n * n * n * n,
                         "the fourth order in W/b = 0.01, coefficient below 50 n^4"};
    claim.ours("quadrature at W/b = 0.01, both senses", mean * b * b / (w * w), next);
    claim.ours("dop853 at W/b = 0.01, both senses", stepped * b * b / (w * w), next);
  }
}

void draw(PaperSheet& sheet) {
  std::vector<Series> rays;
  for (const double b : {-4.0, -3.0, -2.5, 1.5, 2.0, 2.5, 3.0, 4.0}) {
    const Vortex vortex(4.0L / 3.0L, 0.5L, b, false);
    PhaseState<double> from;
    for (std::size_t i = 0; i < 8; ++i) from[i] = 0.0;
    from[1] = static_cast<double>(vortex.periapsis());
    Series ray{"", Look::line, {}, {}};
    std::vector<std::pair<double, double>> out{{from[1], 0.0}};
    PhaseState<double> y = from;
    for (int k = 0; k < 60 && y[1] < 6.0; ++k) {
      y = follow({"dop853", 4}, vortex_flow(vortex), y, 0.03);
      out.emplace_back(y[1], y[3]);
    }
    // The whole ray, turned so that it comes in along -x.
    const double in = b > 0.0 ? pi_ : -pi_;
    const double turn = in - vortex.swept(0.0L) / 2.0 * (b > 0.0 ? 1.0 : -1.0) * 1.0;
    for (std::size_t i = out.size(); i-- > 0;) {
      ray.x.push_back(out[i].first * std::cos(turn - out[i].second)),
          ray.y.push_back(out[i].first * std::sin(turn - out[i].second));
    }
    for (const auto& [r, phi] : out)
      ray.x.push_back(r * std::cos(turn + phi)), ray.y.push_back(r * std::sin(turn + phi));
    rays.push_back(std::move(ray));
  }
  Series core{"v = c/n", Look::dotted, {}, {}};
  for (const double angle : even_steps(0.0, 2.0 * pi_, 73)) {
    core.x.push_back(0.5 * 4.0 / 3.0 * std::cos(angle)), core.y.push_back(0.5 * 4.0 / 3.0 * std::sin(angle));
  }
  rays.push_back(std::move(core));
  sheet.figure() = {.title = "Leonhardt & Piwnicki 1999: light past an optical vortex",
                    .caption =
                        "Rays in a fluid that turns counter-clockwise, n = 4/3, W = 0.5: light against the flow is "
                        "drawn in more.",
                    .panels = {{.title = "Rays, n = 4/3, W = 0.5",
                                .x_label = "x",
                                .y_label = "y",
                                .equal = true,
                                .series = std::move(rays)}}};
}

void run(PaperSheet& sheet) {
  add_uniform(sheet);
  add_vortex(sheet);
  draw(sheet);
}

}  // namespace

Paper leonhardt_piwnicki_1999() {
  return {
      .info = {.id = "leonhardt-piwnicki-1999",
               .reference = "W. Gordon, Ann. Phys. 377, 421 (1923); U. Leonhardt, P. Piwnicki, Optics of nonuniformly "
                            "moving media, Phys. Rev. A 60, 4301 (1999)",
               .reproduced = "Fizeau's drag, and the deflection of light by a vortex, which has no first order.",
               .cites = "Gordon1923 LeonhardtPiwnicki1999",
               .not_checked = {"The capture radius of the optical black hole: the papers' number is not verified.",
                               "Sections not verified."}},
      .run = run,
      .faults = {{momentum_fault, "J = n b: the circulation's share of the canonical momentum left out"}}};
}

}  // namespace xpr::papers
