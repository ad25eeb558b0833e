// Domain, signature, inverse, derivatives, and the flow: what needs no physics to be wrong.
#include <fmt/format.h>

#include "metrics/conformance_kit.hpp"

namespace xpr::conformance {

namespace {

const Limit counted{0.5, "a count, which must be 0"};

bool all_finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

void check_domain(const Subject& subject, std::vector<Finding>& findings) {
  const Spacetime& chart = subject.chart;
  const Card& card = chart.card();
  Worst worst;
  for (const Sample& sample : subject.samples) {
    const PhaseState<double> rate = chart.flow({sample.x, sample.momenta[0]});
    double broken = 0.0;
    std::string what;
    const auto require = [&](bool good, std::string_view name) {
      if (good) return;
      broken += 1.0;
      what = fmt::format("{} not finite", name);
    };
    require(all_finite(chart.inverse_metric(sample.x).c), "inverse metric");
    require(all_finite(chart.metric(sample.x).c), "metric");
    require(all_finite(rate.c), "flow");
    for (const SymTensor4<double>& plane : chart.christoffel(sample.x)) require(all_finite(plane.c), "connection");
    // What is no event must be refused: NaN, infinity, and lengths beyond the chart's range.
    for (std::size_t mu = 0; mu < 4; ++mu) {
      const Coordinate& c = card.coordinates[mu];
      const auto refused = [&](double value) {
        Vec4<double> x = sample.x;
        x[mu] = value;
        if (!chart.inside_domain(x)) return;
        broken += 1.0;
        what = fmt::format("{} = {} accepted", c.name, value);
      };
      refused(std::numeric_limits<double>::quiet_NaN());
      refused(std::numeric_limits<double>::infinity());
      if (c.kind == CoordinateKind::length && std::isfinite(c.lower)) refused(c.lower - 0.1 * subject.length);
      if (c.kind == CoordinateKind::length && std::isfinite(c.upper)) refused(c.upper + 0.1 * subject.length);
    }
    worst.look(broken, sample.x, what);
  }
  findings.push_back(finish(
      subject, "domain", "everything is finite inside the domain, and what is no event is outside it", worst, counted));
}

void check_signature(const Subject& subject, std::vector<Finding>& findings) {
  Worst worst;
  for (const Sample& sample : subject.samples) {
    const Frame frame = frame_of(subject.chart.metric(sample.x), subject.chart.inverse_metric(sample.x));
    worst.look(std::abs(frame.negative - 1.0), sample.x, fmt::format("{} negative directions", frame.negative));
  }
  findings.push_back(finish(subject, "signature", "the metric has signature (-+++)", worst, counted));
}

void check_inverse(const Subject& subject, std::vector<Finding>& findings) {
  Worst worst;
  for (const Sample& sample : subject.samples) {
    const SymTensor4<double> lower = subject.chart.metric(sample.x);
    const SymTensor4<double> upper = subject.chart.inverse_metric(sample.x);
    for (std::size_t mu = 0; mu < 4; ++mu) {
      for (std::size_t nu = 0; nu < 4; ++nu) {
        double sum = mu == nu ? -1.0 : 0.0;
        double size = 1.0;
        for (std::size_t a = 0; a < 4; ++a) {
          sum += lower(mu, a) * upper(a, nu);
          size += std::abs(lower(mu, a) * upper(a, nu));
        }
        // Off the diagonal the product carries units: the row's own size is what it may be wrong by.
        if (mu != nu) size = std::abs(lower(mu, mu) * upper(mu, nu)) + std::abs(lower(mu, nu) * upper(nu, nu)) + size;
        worst.look(std::abs(sum) / size, sample.x, spell(subject.chart.card(), "(g g⁻¹)_", mu, nu));
      }
    }
  }
  findings.push_back(finish(subject, "inverse", "g_{mu a} g^{a nu} is the unit matrix", worst,
                            {1e-12,
                             "round-off of an inverse by minors, 2e-16 times the metric's condition number, "
                             "which reaches 1e4 at 1.02 horizon radii"}));
}

/// d_mu g^{ab} by duals, read off the derived flow at p = e_a and p = e_a + e_b, since dp_mu = -1/2 d_mu g^{ab} p_a
/// p_b.
std::array<SymTensor4<double>, 4> dual_derivatives(const Spacetime& chart, const Vec4<double>& x) {
  std::array<SymTensor4<double>, 4> out{};
  const auto contraction = [&](const Vec4<double>& p) { return chart.derived_flow({x, p}).p(); };
  for (std::size_t a = 0; a < 4; ++a) {
    Vec4<double> p{};
    p[a] = 1.0;
    const Vec4<double> rate = contraction(p);
    for (std::size_t mu = 0; mu < 4; ++mu) out[mu](a, a) = -2.0 * rate[mu];
  }
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = a + 1; b < 4; ++b) {
      Vec4<double> p{};
      p[a] = p[b] = 1.0;
      const Vec4<double> rate = contraction(p);
      for (std::size_t mu = 0; mu < 4; ++mu) {
        out[mu](a, b) = -rate[mu] - 0.5 * (out[mu](a, a) + out[mu](b, b));
      }
    }
  }
  return out;
}

void check_derivatives(const Subject& subject, std::vector<Finding>& findings) {
  const Spacetime& chart = subject.chart;
  Worst worst;
  for (const Sample& sample : subject.samples) {
    const SymTensor4<double> upper = chart.inverse_metric(sample.x);
    const Vec4<double> scale = frame_of(chart.metric(sample.x), upper).scale;
    const std::array<SymTensor4<double>, 4> by_duals = dual_derivatives(chart, sample.x);
    for (std::size_t mu = 0; mu < 4; ++mu) {
      const double step = smooth_step(subject, sample.x, mu);
      const std::array<double, 10> by_differences = differentiate<10>(
          [&](double s) {
            Vec4<double> x = sample.x;
            x[mu] += s;
            return chart.inverse_metric(x).c;
          },
          step);
      for (std::size_t a = 0; a < 4; ++a) {
        for (std::size_t b = a; b < 4; ++b) {
          const double difference = by_duals[mu](a, b) - by_differences[SymTensor4<double>::slot(a, b)];
          worst.look(
              std::abs(difference) * step / (scale[a] * scale[b]), sample.x,
              fmt::format("∂_{} {}", pretty(chart.card().coordinates[mu].name), spell(chart.card(), "g^", a, b)));
        }
      }
    }
  }
  findings.push_back(finish(subject, "derivatives", "derivatives by dual numbers equal those by differences", worst,
                            {1e-10,
                             "Ridders' differences of a function of size 1 over the step in which it is smooth "
                             "are good to about 1e-12, ten times less 0.02 M off an extremal horizon"}));
}

/// Largest difference of two rates, each component in units of the frame and of what may change over a smooth step.
void compare_rates(const Subject& subject, const Vec4<double>& x, const Vec4<double>& scale,
                   const PhaseState<double>& one, const PhaseState<double>& other, Worst& worst) {
  for (std::size_t mu = 0; mu < 4; ++mu) {
    const std::string name = pretty(subject.chart.card().coordinates[mu].name);
    worst.look(std::abs(one[mu] - other[mu]) / scale[mu], x, fmt::format("d{}/dλ", name));
    worst.look(std::abs(one[4 + mu] - other[4 + mu]) * smooth_step(subject, x, mu), x, fmt::format("dp_{}/dλ", name));
  }
}

void check_flow(const Subject& subject, std::vector<Finding>& findings) {
  const Spacetime& chart = subject.chart;
  Worst worst;
  for (const Sample& sample : subject.samples) {
    const Vec4<double> scale = frame_of(chart.metric(sample.x), chart.inverse_metric(sample.x)).scale;
    for (const Vec4<double>& p : sample.momenta) {
      const PhaseState<double> y{sample.x, p};
      compare_rates(subject, sample.x, scale, chart.flow(y), chart.derived_flow(y), worst);
    }
  }
  findings.push_back(finish(subject, "flow", "the flow that transport uses is Hamilton's equations of g", worst,
                            {1e-12,
                             "round-off of two orders of evaluation, 2e-16 times a few hundred operations and "
                             "the cancellations near horizon and axis"}));
}

void check_flow_jacobian(const Subject& subject, std::vector<Finding>& findings) {
  const Spacetime& chart = subject.chart;
  Worst worst;
  for (const Sample& sample : subject.samples) {
    const Vec4<double> scale = frame_of(chart.metric(sample.x), chart.inverse_metric(sample.x)).scale;
    PhaseState<double> direction;
    PhaseState<Dual<double, 8>> seeded;
    const PhaseState<double> y{sample.x, sample.momenta[0]};
    for (std::size_t mu = 0; mu < 4; ++mu) {
      direction[mu] = (0.9 - 0.2 * static_cast<double>(mu)) * smooth_step(subject, sample.x, mu);
      direction[4 + mu] = 0.02 * sample.momenta[1][mu];
    }
    for (std::size_t i = 0; i < 8; ++i) seeded[i] = variable<8>(y[i], static_cast<int>(i));
    const PhaseState<Dual<double, 8>> rate = chart.flow(seeded);
    PhaseState<double> along;
    for (std::size_t i = 0; i < 8; ++i) {
      for (std::size_t k = 0; k < 8; ++k) along[i] += rate[i].derivative[k] * direction[k];
    }
    PhaseState<double> by_differences;
    by_differences.c = differentiate<8>(
        [&](double s) {
          PhaseState<double> moved = y;
          for (std::size_t i = 0; i < 8; ++i) moved[i] += s * direction[i];
          return chart.flow(moved).c;
        },
        1.0);
    compare_rates(subject, sample.x, scale, along, by_differences, worst);
  }
  findings.push_back(finish(subject, "flow-jacobian", "the flow's dual derivatives equal its differences", worst,
                            {1e-10, "Ridders' differences, as for the metric's own derivatives"}));
}

}  // namespace

void check_algebra(const Subject& subject, std::vector<Finding>& findings) {
  check_domain(subject, findings);
  check_signature(subject, findings);
  check_inverse(subject, findings);
  check_derivatives(subject, findings);
  check_flow(subject, findings);
  check_flow_jacobian(subject, findings);
}

}  // namespace xpr::conformance
