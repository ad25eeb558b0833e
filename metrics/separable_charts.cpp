#include "metrics/separable_charts.hpp"

#include "metrics/kerr.hpp"

namespace xpr {
namespace {

using Kind = SeparatedChart::Kind;

double direction_of(Kind kind) { return kind == Kind::kerr_schild_ingoing ? 1.0 : -1.0; }

KerrParameters hole(const SeparatedLight& light) { return {.M = light.mass, .a = light.spin}; }

/// Two numbers in the plane of the equator.
struct Plane {
  double x, y;
};
Plane operator*(const Plane& u, const Plane& v) { return {u.x * v.x - u.y * v.y, u.x * v.y + u.y * v.x}; }
Plane operator*(double s, const Plane& v) { return {s * v.x, s * v.y}; }
Plane operator+(const Plane& u, const Plane& v) { return {u.x + v.x, u.y + v.y}; }
Plane conj(const Plane& v) { return {v.x, -v.y}; }
Plane turn(double angle) {
  const auto [sine, cosine] = sincos(angle);
  return {cosine, sine};
}

SeparatedState from_kerr_schild(const SeparatedChart& chart, const PhaseState<double>& y) {
  const double s = direction_of(chart.kind), spin = s * chart.light.spin, mass = chart.light.mass;
  const double energy = abs(y[4]);
  const double r = spheroidal_radius(y.x(), spin).r;
  const double long_axis_sq = r * r + spin * spin;
  const Plane place{y[1], y[2]};
  const Plane momentum = (1.0 / energy) * Plane{y[5], y[6]};
  const double p_z = y[7] / energy, p_t = y[4] / energy;

  const Plane n = (1.0 / long_axis_sq) * (Plane{r, -spin} * place);
  const double n_z = y[3] / r;
  const Plane along = conj(place) * momentum;  // with L as its second part
  const double p_r = (conj(n) * momentum).x + n_z * p_z;
  const double b = along.x + y[3] * p_z;
  const double r_rate = hole(chart.light).delta(r) * p_r + s * (2.0 * mass * r * p_t + chart.light.spin * along.y);
  const Plane n_rate = Plane{r, -spin} * momentum + -b * n;
  const double n_z_rate = r * p_z - n_z * b;

  const KerrShift<double> shift = kerr_shift(hole(chart.light), r);
  const Plane back = turn(-s * shift.azimuth);
  const Plane n_bl = back * n, rate_bl = back * n_rate;
  SeparatedState state;
  state.energy_sign = p_t < 0.0 ? 1.0 : -1.0;
  state.lambda = state.energy_sign * along.y;
  state.t = y[0] - s * shift.time;
  state.u = 1.0 / r;
  state.u_rate = -r_rate / (r * r);
  state.n = {n_bl.x, n_bl.y, n_z};
  state.n_rate = {rate_bl.x, rate_bl.y, n_z_rate};
  return state;
}

SeparatedState from_boyer_lindquist(const SeparatedChart& chart, const PhaseState<double>& y) {
  const double energy = abs(y[4]), r = y[1];
  const auto [sine, cosine] = sincos(y[2]);
  const Plane along = turn(y[3]);
  const double theta_rate = y[6] / energy, across = over_sine(y[7] / energy, sine);
  const Plane rate = along * Plane{cosine * theta_rate, across};
  SeparatedState state;
  state.energy_sign = y[4] < 0.0 ? 1.0 : -1.0;
  state.lambda = state.energy_sign * y[7] / energy;
  state.t = y[0];
  state.u = 1.0 / r;
  state.u_rate = -hole(chart.light).delta(r) * (y[5] / energy) / (r * r);
  state.n = {sine * along.x, sine * along.y, cosine};
  state.n_rate = {rate.x, rate.y, -sine * theta_rate};
  return state;
}

PhaseState<double> to_kerr_schild(const SeparatedChart& chart, const SeparatedState& state, double energy) {
  const double s = direction_of(chart.kind), spin = s * chart.light.spin, mass = chart.light.mass;
  const double r = 1.0 / state.u, r_sq = r * r, long_axis_sq = r_sq + spin * spin;
  const double p_t = -state.energy_sign, l = state.energy_sign * state.lambda;
  const KerrShift<double> shift = kerr_shift(hole(chart.light), r);
  const Plane forward = turn(s * shift.azimuth);
  const Plane n = forward * Plane{state.n[0], state.n[1]};
  const Plane n_rate = forward * Plane{state.n_rate[0], state.n_rate[1]};
  const double n_z = state.n[2];

  const double r_rate = -state.u_rate * r_sq;
  const double p_r = (r_rate - s * (2.0 * mass * r * p_t + chart.light.spin * l)) / hole(chart.light).delta(r);
  // With A + iC = conj(n) P: p_r = A + n_z p_z, r C - s a A = L and n_z' = r p_z - n_z B, B = r p_r + s a C.
  const double p_z = (r * state.n_rate[2] + n_z * (long_axis_sq * p_r + spin * l)) / (r_sq + square(spin * n_z));
  const double a_part = p_r - n_z * p_z;
  const double c_part = (l + spin * a_part) / r;
  const double b = r * p_r + spin * c_part;
  const Plane momentum = (1.0 / long_axis_sq) * (Plane{r, spin} * (n_rate + b * n));
  const Plane place = Plane{r, spin} * n;
  return {{state.t + s * shift.time, place.x, place.y, r * n_z},
          {energy * p_t, energy * momentum.x, energy * momentum.y, energy * p_z}};
}

PhaseState<double> to_boyer_lindquist(const SeparatedChart& chart, const SeparatedState& state, double energy) {
  const double r = 1.0 / state.u;
  const double sine = sqrt(square(state.n[0]) + square(state.n[1]));
  const double across = sine > 0.0 ? sine : 1.0;
  // On the axis the plane of motion gives the azimuth.
  const Plane out = sine > 0.0 ? Plane{state.n[0], state.n[1]} : Plane{state.n_rate[0], state.n_rate[1]};
  const double meridional = sine > 0.0 ? (state.n[0] * state.n_rate[0] + state.n[1] * state.n_rate[1]) / across
                                       : sqrt(square(out.x) + square(out.y));
  const double theta_rate = state.n[2] * meridional - sine * state.n_rate[2];
  return {{state.t, r, atan2(sine, state.n[2]), atan2(out.y, out.x)},
          {-energy * state.energy_sign, -energy * state.u_rate * r * r / hole(chart.light).delta(r),
           energy * theta_rate, energy * state.energy_sign * state.lambda}};
}

}  // namespace

std::optional<SeparatedChart> separated_chart(const Spacetime& spacetime) {
  const Card& card = spacetime.card();
  if (card.metric != "kerr" && card.metric != "schwarzschild") return std::nullopt;
  SeparatedChart chart;
  if (card.chart == "kerr-schild") {
    chart.kind = Kind::kerr_schild_ingoing;
  } else if (card.chart == "kerr-schild-outgoing") {
    chart.kind = Kind::kerr_schild_outgoing;
  } else if (card.chart != "boyer-lindquist" && card.chart != "areal") {
    return std::nullopt;
  }
  KerrParameters parameters{.M = 1.0, .a = 0.0};
  for (const NamedValue& parameter : spacetime.parameters()) {
    if (parameter.name == "M") parameters.M = parameter.value;
    if (parameter.name == "a") parameters.a = parameter.value;
  }
  chart.light = parameters.separated();
  return chart;
}

SeparatedState separated_state(const SeparatedChart& chart, const PhaseState<double>& y) {
  SeparatedState state =
      chart.kind == Kind::boyer_lindquist ? from_boyer_lindquist(chart, y) : from_kerr_schild(chart, y);
  // eta from n'^2 = eta + lambda^2 + a^2 n_z^2: a sum where it is large, and no division by sin theta.
  state.eta = square(state.n_rate[0]) + square(state.n_rate[1]) + square(state.n_rate[2]) - square(state.lambda) -
              square(chart.light.spin * state.n[2]);
  return state;
}

PhaseState<double> phase_state(const SeparatedChart& chart, const SeparatedState& state, double energy) {
  return chart.kind == Kind::boyer_lindquist ? to_boyer_lindquist(chart, state, energy)
                                             : to_kerr_schild(chart, state, energy);
}

}  // namespace xpr
