// Light rays with known answers.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>

#include "integrators/tracer.hpp"
#include "metrics/catalogue.hpp"

namespace xpr::test {

/// A null state at (x, y, z) going along (vx, vy, vz), with p_t = -1, in a chart of diagonal isotropic form.
inline PhaseState<double> isotropic_ray(const Spacetime& spacetime, const Vec4<double>& x,
                                        const Vec4<double>& direction) {
  const SymTensor4<double> g = spacetime.inverse_metric(x);
  const double size =
      std::sqrt(direction[1] * direction[1] + direction[2] * direction[2] + direction[3] * direction[3]);
  const double p = std::sqrt(-g(0, 0) / g(1, 1)) / size;
  return {x, {-1.0, p * direction[1], p * direction[2], p * direction[3]}};
}

/// Maxwell's fish-eye with R = 1: every ray is a circle and closes after the optical path t = 2 pi.
inline std::unique_ptr<Spacetime> fisheye() { return make_spacetime("maxwell-fisheye", "cartesian"); }

/// The rays that orders are observed on.
inline std::array<PhaseState<double>, 3> fisheye_rays(const Spacetime& medium) {
  return {isotropic_ray(medium, {0.0, 0.8, 0.1, -0.3}, {0.0, 0.2, 1.0, 0.3}),
          isotropic_ray(medium, {0.0, 0.5, -0.6, 0.2}, {0.0, 1.0, 0.4, -0.5}),
          isotropic_ray(medium, {0.0, -0.3, 0.9, 0.4}, {0.0, 0.1, 0.2, 1.0})};
}

/// Where the ray has gone round once.
inline Event one_turn() {
  return {.name = "one turn",
          .g = [](const Spacetime&, const PhaseState<double>& y, int) { return y[0] - 2.0 * std::numbers::pi; },
          .direction = +1,
          .terminal = true};
}

/// How far from its start a ray is after a turn: root mean square over rays and components but t.
inline double turn_error(const Spacetime& medium, const TraceSettings& settings) {
  const Event turn = one_turn();
  double sum = 0.0;
  for (const PhaseState<double>& start : fisheye_rays(medium)) {
    const RayEnd end = trace_ray(medium, start, 1, settings, std::span(&turn, 1));
    if (end.status != Status::crossed) return std::nan("");
    for (std::size_t i = 1; i < 8; ++i) sum += (end.y[i] - start[i]) * (end.y[i] - start[i]);
  }
  return std::sqrt(sum);
}

}  // namespace xpr::test
