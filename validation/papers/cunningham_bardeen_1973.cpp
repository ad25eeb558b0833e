// Cunningham & Bardeen 1973: the redshift of a star on a circular orbit around a Kerr hole. [CunninghamBardeen1973]
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "validation/families/kerr.hpp"
#include "validation/papers/papers.hpp"
#include "validation/papers/schwarzschild_light.hpp"

namespace xpr::papers {

namespace {

constexpr double pi_ = std::numbers::pi;
constexpr const char* kepler_fault = "paper-cunningham-bardeen-kepler";

/// g = 1/[u^t (1 - Omega lambda)] of a prograde orbit.
long double formula(long double a, long double r, long double lambda, bool planted) {
  const long double q = std::sqrt(r), omega = 1.0L / (r * q + (planted ? 0.0L : a));
  const long double u_t = (r * q + a) / std::sqrt(r * r * r - 3.0L * r * r + 2.0L * a * r * q);
  return 1.0L / (u_t * (1.0L - omega * lambda));
}

/// The same from the metric's components in any chart: u = u^t (Killing vector of t + Omega that of phi).
double from_components(const Spacetime& bl, double a, double r, double p_t, double p_phi) {
  const SymTensor4<double> g = bl.metric({0.0, r, pi_ / 2.0, 0.0});
  const double omega = 1.0 / (std::pow(r, 1.5) + a);
  const double u_t = 1.0 / std::sqrt(-(g(0, 0) + 2.0 * omega * g(0, 3) + omega * omega * g(3, 3)));
  return -p_t / (-u_t * (p_t + omega * p_phi));
}

struct Member {
  double a, r, lambda, p_theta;
};
constexpr std::array members = {Member{0.9, 4.0, 0.0, 2.0},    Member{0.9, 4.0, 3.0, 2.5},
                                Member{0.9, 4.0, -3.0, 2.5},   Member{0.998, 3.0, 2.0, 2.0},
                                Member{0.998, 3.0, -2.0, 2.0}, Member{0.5, 10.0, 5.0, 4.0}};

void run(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  for (const Member& member : members) {
    ClaimSheet claim =
        sheet.claim(fmt::format("g at a = {} M, r = {:g} M, lambda = {:+g} M", member.a, member.r, member.lambda));
    const auto exact = static_cast<double>(formula(member.a, member.r, member.lambda, false));
    claim.exact({exact, 4e-16 * exact}, "1/[u^t (1 - Omega lambda)], u^t and Omega in closed form");
    claim.ours("the formula in long double",
               static_cast<double>(formula(member.a, member.r, member.lambda, lab.planted(kepler_fault))),
               {1e-14, "round-off"});
    const Charts bl = kerr_family::charts(lab, member.a, "boyer-lindquist");
    claim.ours("components of the Boyer-Lindquist metric",
               from_components(*bl.classical, member.a, member.r, -1.0, member.lambda), {1e-13, "round-off of a norm"});
    if (&member == &members[0]) claim.not_established("tables for a = M", "the paper's tables are not at hand");
    for (const Route& route : {Route{"kerr-schild", {"dop853", 1e-13}}, Route{"boyer-lindquist", {"dopri54", 1e-12}}}) {
      const Charts at = kerr_family::charts(lab, member.a, route.chart);
      TraceSettings settings = trace_settings(route.method);
      settings.r_max = 1000.0;
      // Light that leaves the orbit outward, off the plane; constants where it ends, of the star where it began.
      const ChartState start =
          general_light(*at.classical, *at.transport, member.r, pi_ / 2.0, member.lambda, member.p_theta, false);
      const SweptRay ray = trace_swept(lab, *at.classical, *at.transport, start, settings);
      const PhaseState<double>&from = ray.start_classical, &to = ray.end_classical;
      const double sent = -from[4] / from_components(*at.classical, member.a, member.r, from[4], from[7]);
      claim.traced({*at.transport, route.method, ray.end}, -to[4] / sent,
                   {1e-11, "E and L conserved to the tracer's tolerance"});
    }
  }
  std::vector<Series> curves;
  for (const double r : {2.5, 4.0, 8.0, 20.0}) {
    Series curve{fmt::format("r = {:g} M", r), Look::line, {}, {}};
    for (const double lambda : even_steps(-6.5, 2.8, 90)) {
      curve.x.push_back(lambda), curve.y.push_back(static_cast<double>(formula(0.9L, r, lambda, false)));
    }
    curves.push_back(std::move(curve));
  }
  sheet.figure() = {
      .title = "Cunningham & Bardeen 1973: a star orbiting a Kerr hole",
      .caption =
          "Received over emitted frequency of a star on a prograde circular orbit, a = 0.9 M, against "
          "its light's angular momentum.",
      .panels = {{.title = "g = 1/(1 + z)", .x_label = "lambda [M]", .y_label = "g", .series = std::move(curves)}}};
}

}  // namespace

Paper cunningham_bardeen_1973() {
  return {.info = {.id = "cunningham-bardeen-1973",
                   .reference =
                       "C. T. Cunningham, J. M. Bardeen, The optical appearance of a star orbiting an extreme Kerr "
                       "black hole, Astrophys. J. 183, 237 (1973)",
                   .reproduced =
                       "The redshift of a star on a circular orbit, from the formula, the metric and traced light.",
                   .cites = "CunninghamBardeen1973",
                   .not_checked = {"The paper's tables and light curves: not at hand."}},
          .run = run,
          .faults = {{kepler_fault, "Kepler's Omega without the spin"}}};
}

}  // namespace xpr::papers
