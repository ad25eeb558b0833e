// Diagnosis in words, for someone with a typo: which component, at which event, off by what.
//
// A chart without siblings is diagnosed by repair: each component in turn is divided by the factors that typos make
// (2, -1, sin theta, ...), and the repair that makes the Ricci tensor what it should be names the typo. The curvature
// of a repaired metric is taken by differences, since its source cannot be run over duals.
#include <fmt/format.h>

#include "metrics/conformance_kit.hpp"
#include "metrics/scalar/elementary.hpp"

namespace xpr::conformance {

namespace {

/// A factor that a component may be off by, found / right: a constant times powers of sin theta and of x^1.
struct Factor {
  double constant;
  int sine_power;
  int radius_power;

  [[nodiscard]] double at(const Vec4<double>& x) const {
    return constant * whole_power(sin(x[2]), sine_power) * whole_power(x[1], radius_power);
  }
};

constexpr std::array<Factor, 16> polar_factors{{{2.0, 0, 0},
                                                {0.5, 0, 0},
                                                {-1.0, 0, 0},
                                                {4.0, 0, 0},
                                                {0.25, 0, 0},
                                                {3.0, 0, 0},
                                                {1.0 / 3.0, 0, 0},
                                                {-2.0, 0, 0},
                                                {1.0, 1, 0},
                                                {1.0, -1, 0},
                                                {1.0, 2, 0},
                                                {1.0, -2, 0},
                                                {1.0, 0, 1},
                                                {1.0, 0, -1},
                                                {1.0, 0, 2},
                                                {1.0, 0, -2}}};
constexpr std::size_t constant_factors = 8;

std::string word_for(const Factor& factor, const Card& card) {
  const auto power = [](const std::string& base, int n) {
    const std::string raised = std::abs(n) == 2 ? (base == "sin θ" ? "sin² θ" : base + "²") : base;
    return n < 0 ? "1/" + raised : raised;
  };
  if (factor.sine_power != 0) return power("sin θ", factor.sine_power);
  if (factor.radius_power != 0) return power(pretty(card.coordinates[1].name), factor.radius_power);
  return fmt::format("{:.3f}", factor.constant);
}

using Components = std::array<double, 10>;

Components combine(const Components& a, double u, const Components& b, double v) {
  Components out;
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = u * a[i] + v * b[i];
  return out;
}

/// g_{mu nu} with first and second derivatives, by central differences of steps h and 2h, extrapolated.
struct Jet {
  SymTensor4<double> value;
  std::array<SymTensor4<double>, 4> first;
  std::array<std::array<SymTensor4<double>, 4>, 4> second;
};

template <class Metric>
Jet jet_of(const Metric& metric, const Vec4<double>& x, const Vec4<double>& step) {
  Jet jet;
  jet.value = metric(x);
  const auto at = [&](std::size_t mu, double s, std::size_t nu, double t) {
    Vec4<double> moved = x;
    moved[mu] += s;
    moved[nu] += t;
    return metric(moved).c;
  };
  for (std::size_t mu = 0; mu < 4; ++mu) {
    std::array<Components, 2> slope;
    std::array<Components, 2> bend;
    for (std::size_t k = 0; k < 2; ++k) {
      const double h = step[mu] * static_cast<double>(k + 1);
      const Components above = at(mu, h, mu, 0.0);
      const Components below = at(mu, -h, mu, 0.0);
      slope[k] = combine(above, 0.5 / h, below, -0.5 / h);
      bend[k] = combine(combine(above, 1.0, below, 1.0), 1.0 / (h * h), jet.value.c, -2.0 / (h * h));
    }
    jet.first[mu].c = combine(slope[0], 4.0 / 3.0, slope[1], -1.0 / 3.0);
    jet.second[mu][mu].c = combine(bend[0], 4.0 / 3.0, bend[1], -1.0 / 3.0);
    for (std::size_t nu = 0; nu < mu; ++nu) {
      std::array<Components, 2> mixed;
      for (std::size_t k = 0; k < 2; ++k) {
        const double h = step[mu] * static_cast<double>(k + 1);
        const double l = step[nu] * static_cast<double>(k + 1);
        const double weight = 0.25 / (h * l);
        mixed[k] = combine(combine(at(mu, h, nu, l), weight, at(mu, -h, nu, -l), weight), 1.0,
                           combine(at(mu, h, nu, -l), weight, at(mu, -h, nu, l), weight), -1.0);
      }
      jet.second[mu][nu].c = combine(mixed[0], 4.0 / 3.0, mixed[1], -1.0 / 3.0);
      jet.second[nu][mu] = jet.second[mu][nu];
    }
  }
  return jet;
}

/// The Ricci tensor from a jet, and the largest |R_{rsmn}| in units of the frame.
struct JetCurvature {
  SymTensor4<double> ricci{};
  double riemann = 0.0;
};

JetCurvature curvature_of(const Jet& jet, const SymTensor4<double>& upper, const Vec4<double>& scale) {
  // Gamma_{s,mn} at [s](m, n).
  std::array<SymTensor4<double>, 4> gamma;
  for (std::size_t s = 0; s < 4; ++s) {
    for (std::size_t m = 0; m < 4; ++m) {
      for (std::size_t n = m; n < 4; ++n) {
        gamma[s](m, n) = 0.5 * (jet.first[m](s, n) + jet.first[n](s, m) - jet.first[s](m, n));
      }
    }
  }
  const auto product = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t l = 0; l < 4; ++l) sum += upper(k, l) * gamma[k](a, b) * gamma[l](c, d);
    }
    return sum;
  };
  JetCurvature out;
  for (std::size_t r = 0; r < 4; ++r) {
    for (std::size_t s = 0; s < 4; ++s) {
      for (std::size_t m = 0; m < 4; ++m) {
        for (std::size_t n = s; n < 4; ++n) {
          const double riemann = 0.5 * (jet.second[s][m](r, n) + jet.second[r][n](s, m) - jet.second[r][m](s, n) -
                                        jet.second[s][n](r, m)) +
                                 product(s, m, r, n) - product(s, n, r, m);
          out.ricci(s, n) += upper(r, m) * riemann;
          out.riemann = std::max(out.riemann, std::abs(riemann) * scale[r] * scale[s] * scale[m] * scale[n]);
        }
      }
    }
  }
  return out;
}

/// A component to be repaired: which, and whether of the covariant or of the contravariant metric.
struct Slot {
  std::size_t mu;
  std::size_t nu;
  bool upper;
};

/// |Ricci - declared| / |Riemann| at x once the component is divided by the factor.
double residual_after(const Subject& subject, const Vec4<double>& x, const Slot& slot, const Factor& factor) {
  const auto repaired = [&](const Vec4<double>& at) {
    SymTensor4<double> g = slot.upper ? subject.chart.inverse_metric(at) : subject.chart.metric(at);
    g(slot.mu, slot.nu) /= factor.at(at);
    return slot.upper ? inverse(g) : g;
  };
  Vec4<double> step{};
  for (std::size_t mu = 0; mu < 4; ++mu) step[mu] = 0.25 * smooth_step(subject, x, mu);
  const Jet jet = jet_of(repaired, x, step);
  const SymTensor4<double> upper = inverse(jet.value);
  const Frame frame = frame_of(jet.value, upper);
  if (frame.negative != 1) return std::numeric_limits<double>::infinity();
  JetCurvature curvature = curvature_of(jet, upper, frame.scale);
  const SymTensor4<double> declared = subject.chart.declared_ricci(x).value_or(SymTensor4<double>{});
  for (std::size_t i = 0; i < declared.c.size(); ++i) curvature.ricci.c[i] -= declared.c[i];
  const double residual = largest(in_frame(frame, curvature.ricci)) / curvature.riemann;
  return std::isfinite(residual) ? residual : std::numeric_limits<double>::infinity();
}

/// Three events in the middle of things: off axis and horizon, where differences are good.
std::vector<Vec4<double>> quiet_events(const Subject& subject) {
  std::vector<Vec4<double>> out;
  const double unit = subject.chart.horizon_radius().value_or(subject.length);
  for (const auto& [factor, theta] : {std::pair{2.3, 1.1}, std::pair{4.1, 0.7}, std::pair{3.1, 2.0}}) {
    const std::optional<Vec4<double>> x = event_at(subject.chart.card(), factor * unit, theta, 0.5);
    if (x && subject.chart.inside_domain(*x)) out.push_back(*x);
  }
  return out;
}

bool nearly(double a, double b) { return std::abs(a - b) <= 1e-4 * std::abs(b); }

}  // namespace

std::string single_component_repair(const Subject& subject) {
  const std::vector<Vec4<double>> events = quiet_events(subject);
  if (events.empty()) return {};
  const bool polar = layout_of(subject.chart.card()) == Layout::polar;
  // Differences leave about 1e-5; a wrong factor leaves a residual of order one.
  double best = 1e-3;
  std::string words;
  for (const bool upper : {false, true}) {
    const char* stem = upper ? "g^" : "g_";
    for (std::size_t mu = 0; mu < 4; ++mu) {
      for (std::size_t nu = mu; nu < 4; ++nu) {
        const auto component = [&](const Vec4<double>& x) {
          return upper ? subject.chart.inverse_metric(x)(mu, nu) : subject.chart.metric(x)(mu, nu);
        };
        if (component(events[0]) == 0.0) continue;
        for (std::size_t k = 0; k < (polar ? polar_factors.size() : constant_factors); ++k) {
          double residual = 0.0;
          for (const Vec4<double>& x : events) {
            residual = std::max(residual, residual_after(subject, x, {mu, nu, upper}, polar_factors[k]));
            if (!(residual < best)) break;
          }
          if (!(residual < best)) continue;
          best = residual;
          const double found = component(events[0]);
          words = fmt::format("{} at {}: the field equations imply {:.4g}, found {:.4g}: a ratio of {}",
                              spell(subject.chart.card(), stem, mu, nu), spell(subject.chart.card(), events[0]),
                              found / polar_factors[k].at(events[0]), found,
                              word_for(polar_factors[k], subject.chart.card()));
        }
      }
    }
  }
  return words;
}

std::string describe_ratio(const Card& card, const std::vector<Disagreement>& seen) {
  const auto loudest = std::max_element(seen.begin(), seen.end(), [](const Disagreement& a, const Disagreement& b) {
    return std::abs(a.found - a.expected) / std::abs(a.expected) <
           std::abs(b.found - b.expected) / std::abs(b.expected);
  });
  const std::string numbers =
      fmt::format("at {}: expected {:.4g}, found {:.4g}", spell(card, loudest->x), loudest->expected, loudest->found);
  const auto always = [&](const auto& ratio_at) {
    return std::all_of(seen.begin(), seen.end(),
                       [&](const Disagreement& one) { return nearly(one.found / one.expected, ratio_at(one.x)); });
  };
  const double first = seen.front().found / seen.front().expected;
  if (always([&](const Vec4<double>&) { return first; })) {
    return fmt::format("{}: a ratio of {:.3f} at every event{}", numbers, first,
                       nearly(first, -1.0) ? ", the sign is flipped" : "");
  }
  if (layout_of(card) == Layout::polar) {
    for (std::size_t k = constant_factors; k < polar_factors.size(); ++k) {
      const Factor& factor = polar_factors[k];
      if (always([&](const Vec4<double>& x) { return factor.at(x); })) {
        return fmt::format("{}: a ratio of {} at every event", numbers, word_for(factor, card));
      }
    }
  }
  return fmt::format("{}: a ratio of {:.4g} there, another elsewhere", numbers, loudest->found / loudest->expected);
}

}  // namespace xpr::conformance
