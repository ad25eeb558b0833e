#include "validation/grading/challenge_starts.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/camera_screen.hpp"
#include "metrics/scalar/elementary.hpp"

namespace xpr {

std::array<double, 5> even_numbers(std::int64_t k) {
  // The root of x^6 = x + 1.
  constexpr double root = 1.1347241384015194;
  std::array<double, 5> u{};
  double step = 1.0;
  for (double& value : u) {
    step /= root;
    const double along = 0.5 + step * static_cast<double>(k + 1);
    value = along - std::floor(along);
  }
  return u;
}

double even_theta(double u, double most) {
  const double cosine = most * (1.0 - 2.0 * u);
  return atan2(std::sqrt((1.0 - cosine) * (1.0 + cosine)), cosine);
}

double even_phi(double u) { return std::numbers::pi * (2.0 * u - 1.0); }

Departing aimed(double x1, double theta, double phi, double b, double psi) {
  const auto [sine, cosine] = sincos(2.0 * std::numbers::pi * psi);
  return {.x1 = x1, .theta = theta, .phi = phi, .p_theta = b * cosine, .p_phi = b * sine * sin(theta)};
}

PhaseState<double> departed(const Spacetime& home, Departing start) {
  const Vec4<double> x{0.0, start.x1, start.theta, start.phi};
  const SymTensor4<double> g = home.inverse_metric(x);
  for (int attempt = 0; attempt < 60; ++attempt) {
    const bool given = start.radial_sign == 0;
    const double rest = g(0, 0) * square(start.p_t) + 2.0 * g(0, 3) * start.p_t * start.p_phi +
                        g(3, 3) * square(start.p_phi) +
                        (given ? g(1, 1) * square(start.p_r) : g(2, 2) * square(start.p_theta));
    const double momentum_sq = -rest / (given ? g(2, 2) : g(1, 1));
    if (momentum_sq >= 0.0) {
      const double p = std::sqrt(momentum_sq);
      if (given) return {x, {start.p_t, start.p_r, std::copysign(p, start.p_theta), start.p_phi}};
      return {x, {start.p_t, start.radial_sign * p, start.p_theta, start.p_phi}};
    }
    start.p_theta *= 0.5;
    start.p_phi *= 0.5;
  }
  throw std::logic_error("a challenge ray that is no light");
}

PhaseState<double> on_the_cone_again(const Spacetime& chart, PhaseState<double> y) {
  // Where round-off is all there is, the start stays as the map leaves it: at a turning point dr.p = 0.
  constexpr double round_off = 1e-13;
  if (!(chart.null_residual(y) > round_off)) return y;
  const double step = 1e-6 * chart.radius(y.x());
  Vec4<double> dr{};
  for (std::size_t i = 1; i < 4; ++i) {
    Vec4<double> ahead = y.x(), behind = y.x();
    ahead[i] += step;
    behind[i] -= step;
    dr[i] = (chart.radius(ahead) - chart.radius(behind)) / (2.0 * step);
  }
  const double s = -chart.hamiltonian(y) / contract(dr, raise_index(chart.inverse_metric(y.x()), y.p()));
  for (std::size_t i = 1; i < 4; ++i) y[i + 4] += s * dr[i];
  return y;
}

double parameter_of(const Spacetime& spacetime, std::string_view name, double fallback) {
  for (const NamedValue& parameter : spacetime.parameters()) {
    if (parameter.name == name) return parameter.value;
  }
  return fallback;
}

PhaseState<double> camera_ray(const Spacetime& home, double inclination, double phi, double alpha, double beta) {
  CameraScreen screen;
  screen.mass = parameter_of(home, "M", 1.0);
  screen.spin = parameter_of(home, "a", 0.0);
  screen.radius = 50.0 * screen.mass;
  screen.inclination = inclination;
  PhaseState<double> y = screen.ray(alpha, beta).value();
  y[3] = phi;
  return y;
}

PhaseState<double> doubled(PhaseState<double> y) {
  for (std::size_t i = 4; i < 8; ++i) y[i] *= 2.0;
  return y;
}

PhaseState<double> medium_ray(const Spacetime& home, double distance, double theta, double phi, double from_inward,
                              double psi) {
  const auto [sin_theta, cos_theta] = sincos(theta);
  const auto [sin_phi, cos_phi] = sincos(phi);
  const auto [sin_psi, cos_psi] = sincos(2.0 * std::numbers::pi * psi);
  const auto [across, inward] = sincos(from_inward);
  const std::array<double, 3> radial{sin_theta * cos_phi, sin_theta * sin_phi, cos_theta};
  const std::array<double, 3> polar{cos_theta * cos_phi, cos_theta * sin_phi, -sin_theta};
  const std::array<double, 3> azimuthal{-sin_phi, cos_phi, 0.0};
  PhaseState<double> y;
  for (std::size_t i = 0; i < 3; ++i) y[i + 1] = distance * radial[i];
  const double index = std::sqrt(-home.inverse_metric(y.x())(0, 0));
  y[4] = -1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    y[i + 5] = index * (across * (cos_psi * polar[i] + sin_psi * azimuthal[i]) - inward * radial[i]);
  }
  return y;
}

}  // namespace xpr
