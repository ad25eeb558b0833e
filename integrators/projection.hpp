// Constraint projection: puts a state that drifted back on the light cone, and with `full` back on the surfaces of its
// Killing constants too.
//
// - energy:   p_t is solved for from H = 0; of the two roots the one with the sign that p^t has.
// - momentum: the spatial p_i are rescaled by the factor nearest to 1 that gives H = 0.
// - full:     the least change of (x, p), lengths and momenta measured in their own units, that gives H = 0 and the
//             Killing constants their values at the ray's start: Newton's method with minimal-norm steps.
//             Constraints whose gradients depend on others' are dropped (a radial ray has no angular momentum to keep).
// Cites: [HairerLubichWanner2006]
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "integrators/tracer.hpp"
#include "metrics/spacetime.hpp"

namespace xpr {

/// Solves H = 0 for p_t, keeping the sign of p^t. False where there is no such root; y is left alone then.
[[nodiscard]] bool restore_energy(const Spacetime& chart, PhaseState<double>& y);

/// Rescales the spatial momentum so that H = 0. False where that cannot be done; y is left alone then.
[[nodiscard]] bool restore_momentum(const Spacetime& chart, PhaseState<double>& y);

/// Restores what a trace has asked to be restored.
class Projector {
 public:
  explicit Projector(Projection projection) : projection_(projection) {}
  /// Notes the Killing constants of the ray at its start. `unit` measures changes of the eight components.
  void begin(const Spacetime& chart, const PhaseState<double>& start, const std::array<double, 8>& unit);

  /// Goes on in another chart: constants known by the same name keep their values.
  void change_chart(const Spacetime& chart, const PhaseState<double>& y, const std::array<double, 8>& unit);

  /// False where the constraints cannot be restored.
  [[nodiscard]] bool restore(const Spacetime& chart, PhaseState<double>& y) const;

 private:
  struct Constant {
    std::string_view name;
    double value;
  };
  [[nodiscard]] bool restore_all(const Spacetime& chart, PhaseState<double>& y) const;

  Projection projection_;
  std::vector<Constant> constants_;
  std::array<double, 8> unit_{};
};

}  // namespace xpr
