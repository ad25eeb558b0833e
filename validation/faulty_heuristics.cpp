// Laws that turn a ray towards the centre by a curve somebody liked, without a metric: what an earlier renderer called
// metric transport. With h the step, w the strength, R = 5 M the reach of the source, rho = r / R and b = r |d_perp| /
// R:
//   CurrentEnvelope:       w h  8 [b / (b + 0.35)] [1 - exp(-(rho / 0.5)^2)] / (1 + 0.6 rho^2)
//   ImpactParameterApprox: w h 12 / (1 + ((b - 0.95) / 0.55)^4) (1 - exp(-(b / 0.22)^2)) / ((1 + 0.18 b^2)(1 + 0.18
//   rho^2))
// clamped to 0.08 rad in a step of at most 0.05. They stand here at their best, as flows, free of the steps' own error,
// and at a strength at which one deflection comes out right, as somebody would tune them by eye.
#include "metrics/schwarzschild.hpp"
#include "validation/faulty_metrics.hpp"

namespace xpr {

namespace {

struct CurrentEnvelope {
  static constexpr double strength = 0.0057;  // right to one percent at b = 20 b_c
  template <class T>
  [[nodiscard]] static T turn_rate(const T& b, const T& rho) {
    return 8.0 * (b / (b + 0.35)) * (1.0 - exp(-square(rho / 0.5))) / (1.0 + 0.6 * square(rho));
  }
};

struct ImpactParameterApprox {
  static constexpr double strength = 0.0031;  // right to a few percent at b = 1.5 b_c
  template <class T>
  [[nodiscard]] static T turn_rate(const T& b, const T& rho) {
    const T window = 1.0 + square(square((b - 0.95) / 0.55));
    return 12.0 / window * (1.0 - exp(-square(b / 0.22))) / ((1.0 + 0.18 * square(b)) * (1.0 + 0.18 * square(rho)));
  }
};

/// The Cartesian chart M with a law in place of its light's flow: the direction of p turns, its size stays.
template <class M, class Law>
struct Steered : M {
  template <Scalar T>
  [[nodiscard]] PhaseState<T> flow(const PhaseState<T>& y) const {
    const T reach = T(5.0 * this->M);
    const T r = euclidean_radius(y.x());
    const T size = sqrt(square(y[5]) + square(y[6]) + square(y[7]));
    const T along = (y[1] * y[5] + y[2] * y[6] + y[3] * y[7]) / size;
    // x less its part along the direction: away from the centre, as long as the ray's distance from it.
    const Vec4<T> off{T(0.0), y[1] - along * y[5] / size, y[2] - along * y[6] / size, y[3] - along * y[7] / size};
    const T distance = euclidean_radius(off);
    const T wanted = Law::strength * Law::turn_rate(T(distance / reach), T(r / reach)) / this->M;
    const T most = T(0.08 / 0.05);
    const T pull = -select(wanted < most, wanted, most) * square(size) / distance;
    return {{-y[4], y[5], y[6], y[7]}, {T(0.0), pull * off[1], pull * off[2], pull * off[3]}};
  }
};

template <class M, class Law>
std::unique_ptr<Spacetime> steered_chart(std::string_view metric, std::string_view chart,
                                         std::span<const NamedValue> values) {
  if (metric != M::card.metric || chart != M::card.chart) return nullptr;
  Steered<M, Law> module;
  for (const NamedValue& value : values) {
    if (value.name == "M") module.M = value.value;
  }
  return std::make_unique<SpacetimeOf<Steered<M, Law>>>(module);
}

template <class Law>
std::unique_ptr<Spacetime> steered(std::string_view metric, std::string_view chart,
                                   std::span<const NamedValue> values) {
  if (auto ingoing = steered_chart<SchwarzschildIngoing, Law>(metric, chart, values)) return ingoing;
  return steered_chart<SchwarzschildIsotropic, Law>(metric, chart, values);
}

}  // namespace

std::vector<Fault> heuristic_faults() {
  const std::string deflection = "schwarzschild/deflection";
  return {{.id = "heuristic-current-envelope",
           .description = "no metric at all: rays steered by the turn law CurrentEnvelope of an earlier renderer",
           .case_id = deflection,
           .spacetime = steered<CurrentEnvelope>},
          {.id = "heuristic-impact-parameter",
           .description = "no metric at all: rays steered by the turn law ImpactParameterApprox of an earlier renderer",
           .case_id = deflection,
           .spacetime = steered<ImpactParameterApprox>}};
}

}  // namespace xpr
