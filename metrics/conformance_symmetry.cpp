// Ignorable coordinates, Killing vectors and Carter's constant: what must not change along light.
#include <fmt/format.h>

#include "metrics/conformance_kit.hpp"

namespace xpr::conformance {

namespace {

void check_ignorable(const Subject& subject, std::vector<Finding>& findings) {
  const Spacetime& chart = subject.chart;
  const Card& card = chart.card();
  const char* claim = "the metric does not depend on the coordinates that its card calls ignorable";
  if (std::none_of(card.ignorable.begin(), card.ignorable.end(), [](bool ignorable) { return ignorable; })) {
    findings.push_back(not_checked("ignorable", claim, "the card names no ignorable coordinate"));
    return;
  }
  Worst worst;
  for (const Sample& sample : subject.samples) {
    const SymTensor4<double> here = chart.inverse_metric(sample.x);
    const Vec4<double> scale = frame_of(chart.metric(sample.x), here).scale;
    for (std::size_t mu = 0; mu < 4; ++mu) {
      if (!card.ignorable[mu]) continue;
      Vec4<double> moved = sample.x;
      moved[mu] += 0.7;
      const SymTensor4<double> there = chart.inverse_metric(moved);
      for (std::size_t a = 0; a < 4; ++a) {
        for (std::size_t b = a; b < 4; ++b) {
          worst.look(std::abs(there(a, b) - here(a, b)) / (scale[a] * scale[b]), sample.x,
                     fmt::format("{} against {}", spell(card, "g^", a, b), pretty(card.coordinates[mu].name)));
        }
      }
    }
  }
  findings.push_back(
      finish(subject, "ignorable", claim, worst, {1e-15, "a coordinate that does not enter changes no bit"}));
}

/// dC/dlambda of a constant of motion along the flow, in units of `size` per smooth step: the bracket {C, H}.
template <class Constant>
double rate_along_flow(const Subject& subject, const PhaseState<double>& y, const Constant& constant, double size) {
  const PhaseState<double> rate = subject.chart.flow(y);
  double step = 1e300;
  for (std::size_t mu = 1; mu < 4; ++mu) {
    step = std::min(step, smooth_step(subject, y.x(), mu) / (std::abs(rate[mu]) + 1e-300));
  }
  const std::array<double, 1> slope = differentiate<1>(
      [&](double s) {
        PhaseState<double> moved = y;
        for (std::size_t i = 0; i < 8; ++i) moved[i] += s * rate[i];
        return std::array<double, 1>{constant(moved)};
      },
      step);
  return std::abs(slope[0]) * step / size;
}

double sum_of_sizes(const Vec4<double>& a, const Vec4<double>& b) {
  double sum = 0.0;
  for (std::size_t mu = 0; mu < 4; ++mu) sum += std::abs(a[mu] * b[mu]);
  return sum;
}

void check_killing(const Subject& subject, std::vector<Finding>& findings) {
  const Spacetime& chart = subject.chart;
  const char* claim = "every Killing vector solves Killing's equation: {K.p, H} = 0";
  if (!subject.samples.empty() && chart.killing_vectors(subject.samples[0].x).empty()) {
    findings.push_back(not_checked("killing", claim, "the module names no Killing vector"));
    return;
  }
  Worst worst;
  for (const Sample& sample : subject.samples) {
    const std::vector<KillingVector> vectors = chart.killing_vectors(sample.x);
    for (const Vec4<double>& p : sample.momenta) {
      for (std::size_t k = 0; k < vectors.size(); ++k) {
        const auto constant = [&](const PhaseState<double>& y) {
          return contract(chart.killing_vectors(y.x())[k].component, y.p());
        };
        const double size = sum_of_sizes(vectors[k].component, p) + 1e-300;
        worst.look(rate_along_flow(subject, {sample.x, p}, constant, size), sample.x,
                   fmt::format("{}", vectors[k].name));
      }
    }
  }
  findings.push_back(finish(subject, "killing", claim, worst,
                            {1e-10,
                             "Ridders' differences along the flow, 1e-12 of the constant's terms, which cancel "
                             "by up to 50 near the axis"}));
}

void check_carter(const Subject& subject, std::vector<Finding>& findings) {
  const Spacetime& chart = subject.chart;
  const char* claim = "Carter's constant is constant along the flow: {Q, H} = 0";
  Worst worst;
  for (const Sample& sample : subject.samples) {
    const PhaseState<double> y{sample.x, sample.momenta[0]};
    const std::optional<double> here = chart.carter_constant(y);
    if (!here) {
      findings.push_back(not_checked("carter", claim, "the module has no Carter constant"));
      return;
    }
    const auto constant = [&](const PhaseState<double>& moved) { return chart.carter_constant(moved).value(); };
    const double r = chart.radius(sample.x);
    worst.look(rate_along_flow(subject, y, constant, std::abs(*here) + r * r), sample.x, "Q");
  }
  findings.push_back(finish(subject, "carter", claim, worst,
                            {1e-10,
                             "Ridders' differences along the flow, 1e-12 of Q's terms, which cancel by up to 50 "
                             "near the axis"}));
}

}  // namespace

void check_symmetries(const Subject& subject, std::vector<Finding>& findings) {
  check_ignorable(subject, findings);
  check_killing(subject, findings);
  check_carter(subject, findings);
}

}  // namespace xpr::conformance
