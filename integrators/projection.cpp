#include "integrators/projection.hpp"

#include <cstddef>

#include "metrics/scalar/elementary.hpp"

namespace xpr {
namespace {

/// H = 1/2 (a p_t^2 + 2 b p_t + c): the coefficients over the time component.
struct TimeQuadratic {
  double a, b, c;
};

TimeQuadratic time_quadratic(const Spacetime& chart, const PhaseState<double>& y) {
  const SymTensor4<double> g = chart.inverse_metric(y.x());
  const Vec4<double> spatial = {0.0, y[5], y[6], y[7]};
  const Vec4<double> v = raise_index(g, spatial);
  return {g(0, 0), v[0], contract(spatial, v)};
}

}  // namespace

bool restore_energy(const Spacetime& chart, PhaseState<double>& y) {
  const auto [a, b, c] = time_quadratic(chart, y);
  const double time_rate = a * y[4] + b;  // p^t; at the roots it is +-sqrt(b^2 - a c)
  const double discriminant = b * b - a * c;
  if (!(discriminant >= 0.0)) return false;
  const double wanted = time_rate < 0.0 ? -sqrt(discriminant) : sqrt(discriminant);
  // (-b + wanted) / a, or the same without cancellation.
  const double p_t = b * wanted > 0.0 ? -c / (b + wanted) : (wanted - b) / a;
  if (!isfinite(p_t)) return false;
  y[4] = p_t;
  return true;
}

bool restore_momentum(const Spacetime& chart, PhaseState<double>& y) {
  const auto [a, b, c] = time_quadratic(chart, y);
  // c s^2 + 2 B s + A = 0 for the factor s.
  const double A = a * y[4] * y[4];
  const double B = b * y[4];
  const double discriminant = B * B - A * c;
  if (!(discriminant >= 0.0)) return false;
  const double q = B < 0.0 ? sqrt(discriminant) - B : -(sqrt(discriminant) + B);
  const double first = q / c;
  const double second = A / q;
  const bool first_nearer = !isfinite(second) || abs(first - 1.0) < abs(second - 1.0);
  const double factor = first_nearer ? first : second;
  if (!isfinite(factor)) return false;
  for (std::size_t i = 5; i < 8; ++i) y[i] *= factor;
  return true;
}

void Projector::begin(const Spacetime& chart, const PhaseState<double>& start, const std::array<double, 8>& unit) {
  unit_ = unit;
  constants_.clear();
  if (projection_ != Projection::full) return;
  for (const KillingConstant& k : chart.killing_constants(start)) constants_.push_back({k.name, k.value});
}

void Projector::change_chart(const Spacetime& chart, const PhaseState<double>& y, const std::array<double, 8>& unit) {
  unit_ = unit;
  if (projection_ != Projection::full) return;
  const std::vector<Constant> before = constants_;
  constants_.clear();
  for (const KillingConstant& k : chart.killing_constants(y)) {
    double value = k.value;
    for (const Constant& known : before) {
      if (known.name == k.name) value = known.value;
    }
    constants_.push_back({k.name, value});
  }
}

bool Projector::restore(const Spacetime& chart, PhaseState<double>& y) const {
  switch (projection_) {
    case Projection::none:
      return true;
    case Projection::energy:
      return restore_energy(chart, y);
    case Projection::momentum:
      return restore_momentum(chart, y);
    case Projection::full:
      break;
  }
  return restore_all(chart, y);
}

namespace {

using Row = std::array<double, 8>;

/// A condition whose gradient lies within this angle of the others' span carries their round-off, nothing of its own.
constexpr double least_angle = 1e-6;

double dot(const Row& a, const Row& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 8; ++i) sum += a[i] * b[i];
  return sum;
}

/// One linear condition row . u = value on the change u, with the length the row had at first and the length below
/// which it says nothing.
struct Condition {
  Row row;
  double value;
  double length;
  double negligible;
};

/// The shortest u with row . u = value for every condition that does not depend on earlier ones: Gram-Schmidt with
/// pivoting, twice over each row so that the basis stays orthogonal.
Row shortest_solution(std::vector<Condition>& conditions) {
  Row u{};
  for (std::size_t done = 0; done < conditions.size(); ++done) {
    std::size_t pivot = done;
    double largest = -1.0;
    for (std::size_t k = done; k < conditions.size(); ++k) {
      const double rest = sqrt(dot(conditions[k].row, conditions[k].row));
      const bool independent = rest > least_angle * conditions[k].length && rest > conditions[k].negligible;
      const double relative = independent ? rest / conditions[k].length : -1.0;
      if (relative > largest) {
        largest = relative;
        pivot = k;
      }
    }
    if (largest < 0.0) break;
    std::swap(conditions[done], conditions[pivot]);
    Condition& chosen = conditions[done];
    const double length = sqrt(dot(chosen.row, chosen.row));
    for (double& component : chosen.row) component /= length;
    chosen.value /= length;
    for (std::size_t i = 0; i < 8; ++i) u[i] += chosen.value * chosen.row[i];
    for (std::size_t k = done + 1; k < conditions.size(); ++k) {
      for (int pass = 0; pass < 2; ++pass) {
        const double overlap = dot(conditions[k].row, chosen.row);
        for (std::size_t i = 0; i < 8; ++i) conditions[k].row[i] -= overlap * chosen.row[i];
        conditions[k].value -= overlap * chosen.value;
      }
    }
  }
  return u;
}

}  // namespace

bool Projector::restore_all(const Spacetime& chart, PhaseState<double>& y) const {
  // Newton doubles the digits: from any drift worth restoring, four steps reach round-off.
  constexpr int most_steps = 4;
  std::vector<Condition> conditions;
  for (int iteration = 0; iteration < most_steps; ++iteration) {
    const PhaseState<double> rate = chart.flow(y);
    conditions.clear();
    Row gradient{};
    for (std::size_t mu = 0; mu < 4; ++mu) {
      gradient[mu] = -rate[4 + mu] * unit_[mu];     // dH/dx = -dp/dlambda
      gradient[4 + mu] = rate[mu] * unit_[4 + mu];  // dH/dp = dx/dlambda
    }
    conditions.push_back({gradient, -chart.hamiltonian(y), sqrt(dot(gradient, gradient)), 0.0});
    const std::vector<KillingConstant> constants = chart.killing_constants(y);
    for (std::size_t k = 0; k < constants.size(); ++k) {
      for (std::size_t i = 0; i < 8; ++i) gradient[i] = constants[k].gradient[i] * unit_[i];
      // Against the gradient of p_t itself, which is the unit of momentum.
      conditions.push_back(
          {gradient, constants_[k].value - constants[k].value, sqrt(dot(gradient, gradient)), least_angle * unit_[4]});
    }
    const Row u = shortest_solution(conditions);
    double change = 0.0;
    for (std::size_t i = 0; i < 8; ++i) {
      y[i] += unit_[i] * u[i];
      change = abs(u[i]) > change ? abs(u[i]) : change;
    }
    if (!(change < 1.0)) return false;
    if (change < 1e-15) break;
  }
  return true;
}

}  // namespace xpr
