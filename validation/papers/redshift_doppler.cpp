// Redshift of static emitters and of emitters on circular orbits around a Schwarzschild hole.
#include <fmt/format.h>

#include <cmath>

#include "validation/papers/papers.hpp"
#include "validation/papers/schwarzschild_light.hpp"

namespace xpr::papers {

namespace {

constexpr const char* inverse_fault = "paper-redshift-upside-down";

/// An emitter in the equatorial plane: u^t and dphi/dt.
struct Emitter {
  double u_t, omega;
};
Emitter static_emitter(const Spacetime& areal, double r) {
  return {1.0 / std::sqrt(-areal.metric({0.0, r, 0.5 * std::acos(-1.0), 0.0})(0, 0)), 0.0};
}
/// u^t from the norm of u in the module's own metric.
Emitter circular_emitter(const Spacetime& areal, double r) {
  const double omega = std::pow(r, -1.5);
  const SymTensor4<double> g = areal.metric({0.0, r, 0.5 * std::acos(-1.0), 0.0});
  return {1.0 / std::sqrt(-(g(0, 0) + 2.0 * omega * g(0, 3) + omega * omega * g(3, 3))), omega};
}

/// E_infinity/E_emitter of light with p_t = -1 and p_phi = lambda.
double ratio(const Lab& lab, const Emitter& emitter, double p_t, double p_phi) {
  const double g = p_t / (emitter.u_t * (p_t + emitter.omega * p_phi));
  return lab.planted(inverse_fault) ? 1.0 / g : g;
}

struct Source {
  const char* name;
  double r;
  bool orbits;
  double lambda_sign;  ///< 0: radial; +-1: along or against the orbit, tangential
  double exact;
};
constexpr Source sources[] = {{"static at r = 3 M", 3.0, false, 0.0, 0.577350269189626},
                              {"static at r = 10 M", 10.0, false, 0.0, 0.894427190999916},
                              {"orbit at r = 6 M, radial light", 6.0, true, 0.0, 0.707106781187},
                              {"orbit at r = 10 M, radial light", 10.0, true, 0.0, 0.836660026534},
                              {"orbit at r = 6 M, light forward", 6.0, true, 1.0, 1.41421356237},
                              {"orbit at r = 6 M, light backward", 6.0, true, -1.0, 0.471404520791032},
                              {"orbit at r = 10 M, light forward", 10.0, true, 1.0, 1.29424458935892},
                              {"orbit at r = 10 M, light backward", 10.0, true, -1.0, 0.618121185576108}};

double by_formula(const Lab& lab, const Source& source) {
  const double r = source.r, lambda = source.lambda_sign * r / std::sqrt(1.0 - 2.0 / r);
  const double g =
      source.orbits ? std::sqrt(1.0 - 3.0 / r) / (1.0 - lambda * std::pow(r, -1.5)) : std::sqrt(1.0 - 2.0 / r);
  return lab.planted(inverse_fault) ? 1.0 / g : g;
}

void run(PaperSheet& sheet) {
  const Lab& lab = sheet.lab();
  for (const Source& source : sources) {
    ClaimSheet claim = sheet.claim(fmt::format("g of {}", source.name));
    claim.exact({source.exact, 5e-12}, "closed forms by mpmath, twelve digits and more");
    const Tolerance digits{1e-10, "twenty times the digits of the evaluation"};
    claim.ours("closed form", by_formula(lab, source), digits);
    for (const Route& route : schwarzschild_routes()) {
      const Charts at = schwarzschild_charts(lab, route.chart);
      const Emitter emitter =
          source.orbits ? circular_emitter(*at.classical, source.r) : static_emitter(*at.classical, source.r);
      // Tangential light is at its turning point: one rounding inside it, no ray exists.
      const double b = source.lambda_sign * source.r / std::sqrt(1.0 - 2.0 / source.r) * (1.0 - 1e-14);
      TraceSettings settings = trace_settings(route.method);
      settings.r_max = 1000.0;
      const SweptRay ray = trace_swept(lab, *at.classical, *at.transport,
                                       equatorial_light(*at.classical, *at.transport, source.r, b, false), settings);
      // What a static receiver at the ray's end measures, brought to infinity by its own redshift.
      const PhaseState<double>&from = ray.start_classical, &to = ray.end_classical;
      const double received = -to[4] * static_emitter(*at.classical, to[1]).u_t * std::sqrt(1.0 - 2.0 / to[1]);
      const double sent = ratio(lab, emitter, from[4], from[7]);
      claim.traced({*at.transport, route.method, ray.end}, sent * received / -from[4], digits);
    }
  }
  Series still{"static", Look::line, {}, {}}, face_on{"orbit, radial light", Look::line, {}, {}};
  Series forward{"orbit, forward", Look::dashed, {}, {}}, backward{"orbit, backward", Look::dashed, {}, {}};
  for (const double r : even_steps(2.02, 30.0, 200)) {
    still.x.push_back(r), still.y.push_back(std::sqrt(1.0 - 2.0 / r));
    if (r < 3.02) continue;
    const double shift = 1.0 / std::sqrt(r - 2.0);
    for (const auto& [series, sign] : {std::pair{&face_on, 0.0}, {&forward, 1.0}, {&backward, -1.0}}) {
      series->x.push_back(r), series->y.push_back(std::sqrt(1.0 - 3.0 / r) / (1.0 - sign * shift));
    }
  }
  sheet.figure() = {.title = "Redshift of emitters near a Schwarzschild hole",
                    .caption = "Received over emitted frequency, 1/(1 + z).",
                    .panels = {{.title = "g = 1/(1 + z)",
                                .x_label = "r [M]",
                                .y_label = "received / emitted frequency",
                                .series = {still, face_on, forward, backward}}}};
}

}  // namespace

Paper redshift_doppler() {
  return {.info = {.id = "redshift-doppler",
                   .reference = "Gravitational redshift and Doppler shift around a Schwarzschild hole, as in C. W. "
                                "Misner, K. S. Thorne, J. A. Wheeler, Gravitation (1973)",
                   .reproduced = "Frequencies received from static emitters and from circular orbits.",
                   .cites = "MisnerThorneWheeler1973",
                   .not_checked = {"A textbook result: no paper is named for it, and no printed number is known."}},
          .run = run,
          .faults = {{inverse_fault, "1 + z taken for g = 1/(1 + z)"}}};
}

}  // namespace xpr::papers
