// Penrose 1959, Terrell 1959: how a moving observer sees the sky. [Penrose1959] [Terrell1959]
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "validation/papers/papers.hpp"
#include "validation/papers/quadrature.hpp"
#include "validation/papers/schwarzschild_light.hpp"

namespace xpr::papers {

namespace {

constexpr double pi_ = std::numbers::pi;
constexpr double degree = pi_ / 180.0;
constexpr double beta = 0.5;
constexpr const char* away_fault = "paper-penrose-moving-away";

double formula(const Lab& lab, double theta) {
  const double v = lab.planted(away_fault) ? -beta : beta;
  return std::acos((std::cos(theta) + v) / (1.0 + v * std::cos(theta)));
}

/// Half-angle form: tan(theta'/2) = sqrt((1 - beta)/(1 + beta)) tan(theta/2).
double half_angle(double theta) {
  return 2.0 * std::atan(std::sqrt((1.0 - beta) / (1.0 + beta)) * std::tan(0.5 * theta));
}

/// Light traced from a source at distance 100 under the angle theta from +z to the origin, and what an observer who
/// moves along +z measures there: the direction to the source, and the frequency ratio.
struct Seen {
  RayEnd end;
  double theta, doppler;
};
Seen traced(const Lab& lab, const Spacetime& cartesian, double theta, const MethodAt& method) {
  const double x = 100.0 * std::sin(theta), z = 100.0 * std::cos(theta);
  TraceSettings settings = trace_settings(method);
  settings.lambda_max = 100.0;
  const RayEnd end =
      lab.trace(cartesian, {{0.0, x, 0.0, z}, {-1.0, -std::sin(theta), 0.0, -std::cos(theta)}}, 1, settings);
  const double gamma = 1.0 / std::sqrt(1.0 - beta * beta);
  // -p.u with u = gamma (1, 0, 0, beta), and the boosted spatial momentum.
  const double energy = gamma * (-end.y[4] - beta * end.y[7]), along = gamma * (end.y[7] - beta * -end.y[4]);
  return {end, std::atan2(std::hypot(end.y[5], end.y[6]), -along), energy / -end.y[4]};
}

void add_directions(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  const auto flat = lab.spacetime("minkowski", "cartesian");
  struct Member {
    double theta, seen;
  };
  const Tolerance round_off{1e-11, "round-off in degrees, and fourteen digits"};
  for (const Member& at : {Member{60.0, 36.869897645844}, Member{90.0, 60.0}}) {
    ClaimSheet claim = sheet.claim(fmt::format("where a source at {:g} deg is seen, beta = 0.5", at.theta), "degree");
    claim.exact({at.seen, 5e-13}, "cos(theta') = (cos(theta) + beta)/(1 + beta cos(theta))");
    claim.ours("the formula", formula(lab, at.theta * degree) / degree, round_off);
    claim.ours("half-angle form", half_angle(at.theta * degree) / degree, round_off);
    for (const MethodAt& method : {MethodAt{"dop853", 1e-13}, MethodAt{"gl4", 1.0}}) {
      const Seen seen = traced(lab, *flat, at.theta * degree, method);
      claim.traced({*flat, method, seen.end, Status::max_affine}, seen.theta / degree,
                   {1e-10, "a straight line: round-off of lengths of 100, in degrees"});
    }
  }
  ClaimSheet doppler = sheet.claim("frequency ratio of an emitter moving at 60 deg to the line of sight, beta = 0.5");
  doppler.exact({1.15470053837925, 5e-15}, "1/[gamma (1 - beta cos 60)]");
  doppler.ours("the formula", std::sqrt(0.75) / (1.0 - 0.25), {1e-13, "the digits of the evaluation"});
  // The same by the receiver's frame: its own angle 60 deg from a source that it approaches.
  const double rest = std::acos((std::cos(60.0 * degree) - beta) / (1.0 - beta * std::cos(60.0 * degree)));
  for (const MethodAt& method : {MethodAt{"dop853", 1e-13}, MethodAt{"gl4", 1.0}}) {
    const Seen seen = traced(lab, *flat, rest, method);
    doppler.traced({*flat, method, seen.end, Status::max_affine}, seen.doppler,
                   {1e-12, "a straight line and a boost: round-off"});
  }
}

/// The rim of a cap of 20 degrees about 70 degrees from the motion, by its phase.
std::array<double, 3> rim(double phase) {
  const double cap = 20.0 * degree, tilt = 70.0 * degree;
  const double x = std::sin(cap) * std::cos(phase), y = std::sin(cap) * std::sin(phase), z = std::cos(cap);
  return std::array<double, 3>{x * std::cos(tilt) + z * std::sin(tilt), y, -x * std::sin(tilt) + z * std::cos(tilt)};
}

void add_solid_angle(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  ClaimSheet solid = sheet.claim("solid angle of a small source at 60 deg, times D^2 over its own");
  solid.exact({1.0, 0.0}, "dOmega' = dOmega/D^2");
  const double D = (1.0 + beta * std::cos(60.0 * degree)) / std::sqrt(1.0 - beta * beta), h = 1e-4;
  const auto ratio = [&](const auto& map) {
    return (std::cos(map(60.0 * degree - h)) - std::cos(map(60.0 * degree + h))) /
           (std::cos(60.0 * degree - h) - std::cos(60.0 * degree + h)) * D * D;
  };
  solid.ours("the formula", ratio([&](double t) { return formula(lab, t); }),
             {1e-7, "a cap of 1e-4 rad: its square, and round-off over it"});
  solid.ours("half-angle form", ratio(half_angle), {1e-7, "as above"});
}

void add_circle(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  // A sphere stays circular: the rim of a cap about an axis off the motion, boosted, lies on a cone.
  ClaimSheet circle = sheet.claim("how far the rim of a moving sphere's image is from a circle", "rad");
  circle.exact({0.0, 0.0}, "Moebius maps of the sky take circles to circles");
  const auto deviation = [&](const auto& direction) {
    // The plane through three points of the boosted rim, and the largest distance of the others from it.
    const auto at = [&](double phase) { return direction(phase); };
    const auto a = at(0.0), b = at(2.0), c = at(4.0);
    const std::array<double, 3> u{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    const std::array<double, 3> n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const double size = std::hypot(n[0], n[1], n[2]);
    double most = 0.0;
    for (const double phase : even_steps(0.0, 2.0 * pi_, 50)) {
      const auto p = at(phase);
      most = std::max(most, std::abs((p[0] - a[0]) * n[0] + (p[1] - a[1]) * n[1] + (p[2] - a[2]) * n[2]) / size);
    }
    return most;
  };
  circle.ours(
      "aberration formula", deviation([&](double phase) {
        const auto d = rim(phase);
        const double seen = formula(lab, std::acos(d[2])), across = std::hypot(d[0], d[1]);
        return std::array<double, 3>{std::sin(seen) * d[0] / across, std::sin(seen) * d[1] / across, std::cos(seen)};
      }),
      {1e-13, "round-off"});
  circle.ours("Lorentz transformation of momenta", deviation([&](double phase) {
                const auto d = rim(phase);
                const double gamma = 1.0 / std::sqrt(1.0 - beta * beta), energy = gamma * (1.0 + beta * d[2]);
                return std::array<double, 3>{d[0] / energy, d[1] / energy, gamma * (d[2] + beta) / energy};
              }),
              {1e-13, "round-off"});
}

void draw(PaperSheet& sheet) {
  std::vector<Series> caps;
  for (const double v : {0.0, 0.5, 0.9}) {
    Series outline{fmt::format("beta = {}", v), Look::line, {}, {}};
    for (const double phase : even_steps(0.0, 2.0 * pi_, 121)) {
      const auto d = rim(phase);
      const double gamma = 1.0 / std::sqrt(1.0 - v * v), energy = gamma * (1.0 + v * d[2]),
                   z = gamma * (d[2] + v) / energy;
      outline.x.push_back(2.0 * d[0] / energy / (1.0 + z)), outline.y.push_back(2.0 * d[1] / energy / (1.0 + z));
    }
    caps.push_back(std::move(outline));
  }
  sheet.figure() = {.title = "Penrose 1959, Terrell 1959: a moving sphere is seen as a sphere",
                    .caption =
                        "The rim of a sphere 20 degrees in radius, 70 degrees off the motion, on the sky in "
                        "stereographic projection about the motion: a circle at any speed.",
                    .panels = {{.title = "Outline of a sphere on the sky",
                                .x_label = "x",
                                .y_label = "y",
                                .equal = true,
                                .series = std::move(caps)}}};
}

void run(PaperSheet& sheet) {
  add_directions(sheet);
  add_solid_angle(sheet);
  add_circle(sheet);
  draw(sheet);
}

}  // namespace

Paper penrose_1959() {
  return {.info = {.id = "penrose-1959",
                   .reference =
                       "R. Penrose, The apparent shape of a relativistically moving sphere, Proc. Camb. Phil. Soc. "
                       "55, 137 (1959); J. Terrell, Invisibility of the Lorentz contraction, Phys. Rev. 116, 1041 "
                       "(1959)",
                   .reproduced = "Aberration, Doppler shift and solid angle, and that spheres stay circular.",
                   .cites = "Penrose1959 Terrell1959",
                   .not_checked = {"Printed numbers: none is known from a source."}},
          .run = run,
          .faults = {{away_fault, "the observer moving away from the source instead of towards it"}}};
}

}  // namespace xpr::papers
