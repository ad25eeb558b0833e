// Field equations: Ricci-flat where the card says vacuum, Riemann-flat where the module says so, the declared Ricci
// tensor elsewhere.
#include <fmt/format.h>

#include "metrics/conformance_kit.hpp"

namespace xpr::conformance {

namespace {

/// The largest frame component of R^r_{smn}.
double riemann_size(const Curvature& curvature, const Frame& frame) {
  std::array<double, 256> now = curvature.riemann;
  // One index after another: contract the leading index with the frame's legs and rotate it to the back.
  for (std::size_t index = 0; index < 4; ++index) {
    std::array<double, 256> next{};
    for (std::size_t lead = 0; lead < 4; ++lead) {
      for (std::size_t rest = 0; rest < 64; ++rest) {
        for (std::size_t a = 0; a < 4; ++a) {
          const double leg = index == 0 ? frame.theta[a][lead] : frame.e[a][lead];
          next[4 * rest + a] += leg * now[64 * lead + rest];
        }
      }
    }
    now = next;
  }
  double size = 0.0;
  for (const double v : now) size = std::max(size, std::abs(v));
  return size;
}

/// Looks at every component of a covariant tensor that should vanish, in units of `size` in the frame.
void look_at_components(const Subject& subject, const Vec4<double>& x, const Frame& frame,
                        const SymTensor4<double>& tensor, double size, Worst& worst) {
  std::size_t mu_worst = 0;
  std::size_t nu_worst = 0;
  double loudest = -1.0;
  for (std::size_t mu = 0; mu < 4; ++mu) {
    for (std::size_t nu = mu; nu < 4; ++nu) {
      const double v = std::abs(tensor(mu, nu)) * frame.scale[mu] * frame.scale[nu];
      if (!(v > loudest)) continue;
      loudest = v;
      mu_worst = mu;
      nu_worst = nu;
    }
  }
  worst.look(largest(in_frame(frame, tensor)) / size, x, spell(subject.chart.card(), "R_", mu_worst, nu_worst));
}

void check_ricci(const Subject& subject, std::vector<Finding>& findings) {
  const Spacetime& chart = subject.chart;
  const bool vacuum = chart.card().vacuum;
  const char* claim = vacuum ? "the Ricci tensor vanishes" : "the Ricci tensor is the one that the module declares";
  Worst worst;
  for (const Sample& sample : subject.samples) {
    const std::optional<SymTensor4<double>> declared = chart.declared_ricci(sample.x);
    if (!declared) {
      findings.push_back(not_checked("ricci", claim, "the module declares neither vacuum nor a Ricci tensor"));
      return;
    }
    const Curvature curvature = chart.curvature(sample.x);
    const Frame frame = frame_of(chart.metric(sample.x), chart.inverse_metric(sample.x));
    SymTensor4<double> rest = curvature.ricci;
    for (std::size_t i = 0; i < rest.c.size(); ++i) rest.c[i] -= declared->c[i];
    double size = riemann_size(curvature, frame);
    // Where there is no curvature to speak of, its round-off is measured against the terms that cancel in it.
    if (size * subject.length * subject.length < 1e-7) size = std::max(curvature.connection_scale, 1e-300);
    look_at_components(subject, sample.x, frame, rest, size, worst);
  }
  Finding finding = finish(subject, "ricci", claim, worst,
                           {1e-9,
                            "round-off of curvature by duals: 2e-16 times (|dGamma| + |Gamma|^2) / |Riemann|, at "
                            "most about 1e6 at the events sampled (r <= 20 lengths, 0.02 rad off the axis)"});
  if (finding.state == FindingState::failed) {
    if (const std::string repair = single_component_repair(subject); !repair.empty()) {
      finding.message = repair;
    } else {
      finding.message += fmt::format(" ({}); no single component multiplied by a simple factor cures it",
                                     vacuum ? "of |Riemann|, where 0 is meant" : "of |Riemann| off what is declared");
    }
  }
  findings.push_back(std::move(finding));
}

void check_flat(const Subject& subject, std::vector<Finding>& findings) {
  const Spacetime& chart = subject.chart;
  if (!chart.declared_flat()) return;
  Worst worst;
  for (const Sample& sample : subject.samples) {
    const Curvature curvature = chart.curvature(sample.x);
    double size = 0.0;
    for (const double v : curvature.riemann) size = std::max(size, std::abs(v));
    worst.look(size / std::max(curvature.connection_scale, 1e-300), sample.x, "Riemann");
  }
  findings.push_back(finish(subject, "flat", "the Riemann tensor vanishes", worst,
                            {1e-12, "round-off of curvature against the terms that cancel in it"}));
}

}  // namespace

void check_curvature(const Subject& subject, std::vector<Finding>& findings) {
  check_ricci(subject, findings);
  check_flat(subject, findings);
}

}  // namespace xpr::conformance
