// The maps between the charts of one spacetime: inverse to each other, canonical, and carrying one metric into the
// other. Two modules that agree here are two routes to every component.
#include <fmt/format.h>

#include <numbers>

#include "metrics/chart_map.hpp"
#include "metrics/conformance_kit.hpp"
#include "metrics/scalar/elementary.hpp"

namespace xpr::conformance {

namespace {

Frame frame_at(const Spacetime& chart, const Vec4<double>& x) {
  return frame_of(chart.metric(x), chart.inverse_metric(x));
}

/// The sample's image in a sibling; nothing where either chart does not cover it, or names it on another sheet.
std::optional<ChartState> image_in(const Subject& subject, const Spacetime& sibling, const Sample& sample,
                                   const Vec4<double>& p) {
  const std::optional<ChartSwitch> elsewhere = subject.chart.atlas_switch({sample.x, p}, sample.sheet);
  if (elsewhere && elsewhere->chart == &subject.chart) return std::nullopt;
  ChartState image = change_chart(subject.chart, sibling, {sample.x, p}, sample.sheet);
  if (!sibling.inside_domain(image.state.x())) return std::nullopt;
  return image;
}

/// By how much the map stretches covectors, at least 1: going there and back loses its square to round-off, which near
/// a horizon is 1/(r - r+)^2.
double stretch_of(const Spacetime& sibling, const ChartState& image) {
  const Vec4<double> scale = frame_at(sibling, image.state.x()).scale;
  double stretch = 1.0;
  for (std::size_t mu = 0; mu < 4; ++mu) stretch = std::max(stretch, std::abs(image.state[4 + mu]) * scale[mu]);
  return stretch;
}

double periodic_difference(const Coordinate& coordinate, double a, double b) {
  const double d = a - b;
  if (coordinate.kind != CoordinateKind::azimuth) return d;
  return d - 2.0 * std::numbers::pi * std::round(d / (2.0 * std::numbers::pi));
}

void check_there_and_back(const Subject& subject, const Spacetime& sibling, std::vector<Finding>& findings) {
  Worst worst;
  for (const Sample& sample : subject.samples) {
    const Vec4<double>& p = sample.momenta[1];
    const std::optional<ChartState> image = image_in(subject, sibling, sample, p);
    if (!image) continue;
    const ChartState back = change_chart(sibling, subject.chart, image->state, image->sheet);
    const Vec4<double> scale = frame_at(subject.chart, sample.x).scale;
    const double loss = square(stretch_of(sibling, *image));
    for (std::size_t mu = 0; mu < 4; ++mu) {
      const Coordinate& c = subject.chart.card().coordinates[mu];
      const double size = loss * (std::abs(sample.x[mu]) + subject.length * scale[mu]);
      worst.look(std::abs(periodic_difference(c, back.state[mu], sample.x[mu])) / size, sample.x, pretty(c.name));
      worst.look(std::abs(back.state[4 + mu] - p[mu]) * scale[mu] / loss, sample.x, "p_" + pretty(c.name));
    }
    if (back.sheet != sample.sheet) worst.look(1.0, sample.x, "sheet");
  }
  findings.push_back(finish(subject, fmt::format("map-inverse:{}", sibling.card().chart),
                            fmt::format("going to chart {} and back changes nothing", sibling.card().chart), worst,
                            {1e-10,
                             "round-off, 2e-16 times 1/sin(theta) = 50 near the axis and a few hundred operations; "
                             "errors are in units of the square of the map's stretch"}));
}

/// J^T Omega J = Omega for the map of (x, p), J by differences in directions of unit size in the frame.
void check_symplectic(const Subject& subject, const Spacetime& sibling, std::vector<Finding>& findings) {
  Worst worst;
  for (const Sample& sample : subject.samples) {
    const Vec4<double>& p = sample.momenta[1];
    const std::optional<ChartState> image = image_in(subject, sibling, sample, p);
    if (!image) continue;
    const Vec4<double> scale = frame_at(subject.chart, sample.x).scale;
    const Vec4<double> scale_there = frame_at(sibling, image->state.x()).scale;
    const double loss = square(stretch_of(sibling, *image));
    double step = 0.02 * subject.length;
    for (std::size_t mu = 1; mu < 4; ++mu) {
      step = std::min(step, smooth_step(subject, sample.x, mu) / scale[mu]);
      const Subject there{.chart = sibling, .siblings = {}, .samples = {}, .length = subject.length};
      step = std::min(step, smooth_step(there, image->state.x(), mu) / scale_there[mu]);
    }
    // The azimuth turns by more than 1/(r - r+) times the step close to a horizon: take much less than is smooth there.
    step *= 0.1;
    std::array<std::array<double, 8>, 8> column{};
    for (std::size_t i = 0; i < 8; ++i) {
      const double size = i < 4 ? step * scale[i] : 0.1 / scale[i - 4];
      column[i] = differentiate<8>(
          [&](double s) {
            PhaseState<double> y{sample.x, p};
            y[i] += s * size;
            std::array<double, 8> out = change_chart(subject.chart, sibling, y, sample.sheet).state.c;
            for (std::size_t mu = 0; mu < 4; ++mu) {
              out[mu] = periodic_difference(sibling.card().coordinates[mu], out[mu], image->state[mu]);
            }
            return out;
          },
          1.0);
    }
    for (std::size_t i = 0; i < 8; ++i) {
      for (std::size_t j = i + 1; j < 8; ++j) {
        double form = j == i + 4 ? -0.1 * step : 0.0;
        for (std::size_t mu = 0; mu < 4; ++mu) {
          form += column[i][mu] * column[j][4 + mu] - column[i][4 + mu] * column[j][mu];
        }
        worst.look(std::abs(form) / (0.1 * step * loss), sample.x, fmt::format("bracket ({}, {})", i, j));
      }
    }
  }
  findings.push_back(finish(subject, fmt::format("map-symplectic:{}", sibling.card().chart),
                            fmt::format("the map of (x, p) to chart {} is canonical", sibling.card().chart), worst,
                            {1e-8,
                             "Ridders' differences of the map over a short step, good to about 1e-10; errors are in "
                             "units of the square of the map's stretch"}));
}

/// g^{mu nu} that the sibling implies at the sample: its own, carried along by the images of four unit covectors.
std::optional<SymTensor4<double>> implied_inverse_metric(const Subject& subject, const Spacetime& sibling,
                                                         const Sample& sample) {
  std::array<Vec4<double>, 4> image{};
  SymTensor4<double> there;
  for (std::size_t a = 0; a < 4; ++a) {
    Vec4<double> unit{};
    unit[a] = 1.0;
    const std::optional<ChartState> state = image_in(subject, sibling, sample, unit);
    if (!state) return std::nullopt;
    image[a] = state->state.p();
    if (a == 0) there = sibling.inverse_metric(state->state.x());
  }
  SymTensor4<double> out;
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = a; b < 4; ++b) out(a, b) = contract(image[a], raise_index(there, image[b]));
  }
  return out;
}

/// One component where two tensors differ, and how.
struct ComponentGap {
  std::string name;
  double loudest = 0.0;
  std::vector<Disagreement> seen;
};

void note_gaps(const Subject& subject, const Sample& sample, const SymTensor4<double>& found,
               const SymTensor4<double>& expected, const Vec4<double>& unit, const char* stem,
               std::vector<ComponentGap>& gaps) {
  std::size_t slot = 0;
  gaps.resize(10);
  for (std::size_t mu = 0; mu < 4; ++mu) {
    for (std::size_t nu = mu; nu < 4; ++nu, ++slot) {
      const double gap = std::abs(found(mu, nu) - expected(mu, nu)) / (unit[mu] * unit[nu]);
      gaps[slot].name = spell(subject.chart.card(), stem, mu, nu);
      if (!(gap > 1e-7)) continue;
      gaps[slot].loudest = std::max(gaps[slot].loudest, gap);
      gaps[slot].seen.push_back({sample.x, found(mu, nu), expected(mu, nu)});
    }
  }
}

/// Which components of the chart differ from what the sibling implies, in the position of indices in which fewer do;
/// empty where none does by more than 1e-7 of its size.
std::string diagnose(const Subject& subject, const Spacetime& sibling) {
  std::vector<ComponentGap> upper;
  std::vector<ComponentGap> lower;
  for (const Sample& sample : subject.samples) {
    const std::optional<SymTensor4<double>> implied = implied_inverse_metric(subject, sibling, sample);
    if (!implied) continue;
    const Vec4<double> scale = frame_at(subject.chart, sample.x).scale;
    Vec4<double> inverse_scale{};
    for (std::size_t mu = 0; mu < 4; ++mu) inverse_scale[mu] = 1.0 / scale[mu];
    note_gaps(subject, sample, subject.chart.inverse_metric(sample.x), *implied, scale, "g^", upper);
    note_gaps(subject, sample, subject.chart.metric(sample.x), inverse(*implied), inverse_scale, "g_", lower);
  }
  const auto differs = [](const ComponentGap& gap) { return !gap.seen.empty(); };
  const bool by_upper =
      std::count_if(upper.begin(), upper.end(), differs) < std::count_if(lower.begin(), lower.end(), differs);
  const std::vector<ComponentGap>& gaps = by_upper ? upper : lower;
  const auto loudest = std::max_element(
      gaps.begin(), gaps.end(), [](const ComponentGap& a, const ComponentGap& b) { return a.loudest < b.loudest; });
  if (loudest == gaps.end() || loudest->seen.empty()) return {};
  std::string others;
  for (const ComponentGap& gap : gaps) {
    if (differs(gap) && &gap != &*loudest) others += (others.empty() ? "" : ", ") + gap.name;
  }
  return fmt::format("{} {}; expected is what chart {} implies{}", loudest->name,
                     describe_ratio(subject.chart.card(), loudest->seen), sibling.card().chart,
                     others.empty() ? "" : fmt::format("; {} differ too", others));
}

Finding same_metric(const Subject& subject, const Spacetime& sibling) {
  Worst worst;
  for (const Sample& sample : subject.samples) {
    const std::optional<SymTensor4<double>> implied = implied_inverse_metric(subject, sibling, sample);
    if (!implied) continue;
    SymTensor4<double> gap = subject.chart.inverse_metric(sample.x);
    for (std::size_t i = 0; i < gap.c.size(); ++i) gap.c[i] -= implied->c[i];
    const ChartState image = *image_in(subject, sibling, sample, sample.momenta[1]);
    worst.look(largest(in_frame_raised(frame_at(subject.chart, sample.x), gap)) / square(stretch_of(sibling, image)),
               sample.x);
  }
  return finish(subject, fmt::format("same-metric:{}", sibling.card().chart),
                fmt::format("the metric is that of chart {}, carried over as a tensor", sibling.card().chart), worst,
                {1e-10,
                 "round-off, 2e-16 times 1/sin(theta) = 50 near the axis and a few hundred operations; errors "
                 "are in units of the square of the map's stretch"});
}

/// Compares with every sibling. Where this chart agrees with one and not with another, it is the other that is to be
/// looked at; a component and a ratio are named where this chart stands alone.
void check_same_metric(const Subject& subject, std::vector<Finding>& findings) {
  std::vector<Finding> compared;
  for (const Spacetime* sibling : subject.siblings) compared.push_back(same_metric(subject, *sibling));
  const auto agreed = [](const Finding& finding) { return finding.state == FindingState::passed; };
  const auto witness = std::find_if(compared.begin(), compared.end(), agreed);
  for (std::size_t i = 0; i < compared.size(); ++i) {
    if (compared[i].state != FindingState::failed) continue;
    if (witness != compared.end()) {
      const std::size_t agreeing = static_cast<std::size_t>(witness - compared.begin());
      compared[i].message = fmt::format("this chart agrees with {} and not with {}: look at {} ({})",
                                        subject.siblings[agreeing]->card().chart, subject.siblings[i]->card().chart,
                                        subject.siblings[i]->card().chart, compared[i].message);
    } else if (std::string words = diagnose(subject, *subject.siblings[i]); !words.empty()) {
      compared[i].message = std::move(words);
    }
  }
  std::move(compared.begin(), compared.end(), std::back_inserter(findings));
}

}  // namespace

void check_chart_maps(const Subject& subject, std::vector<Finding>& findings) {
  if (subject.siblings.empty()) {
    findings.push_back(
        not_checked("same-metric", "the charts of one spacetime carry one metric", "the spacetime has no other chart"));
  }
  for (const Spacetime* sibling : subject.siblings) {
    check_there_and_back(subject, *sibling, findings);
    check_symplectic(subject, *sibling, findings);
  }
  check_same_metric(subject, findings);
}

}  // namespace xpr::conformance
