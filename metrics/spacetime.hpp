// A spacetime chart behind one run-time interface: what the command, the tracer and the suite hold when they do not
// care which spacetime it is. `SpacetimeOf<M>` makes one from any metric module; nothing is written per module.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "metrics/card.hpp"
#include "metrics/derived.hpp"
#include "metrics/lane_chart.hpp"
#include "metrics/scalar/dual.hpp"
#include "metrics/tensor.hpp"

namespace xpr {

class Spacetime;

/// A named number, such as a parameter's value or a conserved quantity.
struct NamedValue {
  std::string_view name;
  double value = 0.0;
};

/// A Killing vector K^mu at an event; K^mu p_mu is constant along every geodesic.
struct KillingVector {
  std::string_view name;  ///< of the constant: "E" stands for -p_t, "L_x", "L_y", "L_z", "p_x", ...
  double sign = 1.0;      ///< the constant is sign * K^mu p_mu
  Vec4<double> component{};
};

/// The constant of motion of a Killing vector at a point of phase space, with its gradient over x0..x3, p0..p3.
struct KillingConstant {
  std::string_view name;
  double value = 0.0;
  std::array<double, 8> gradient{};
};

/// What an atlas answers when a ray has left its chart's good region: the chart to go on in and the state there.
struct ChartSwitch {
  const Spacetime* chart = nullptr;
  PhaseState<double> state;
  int sheet = 1;
};

/// A spacetime in one chart, with its parameters set. Immutable; safe to share between threads.
class Spacetime {
 public:
  virtual ~Spacetime() = default;

  [[nodiscard]] virtual const Card& card() const = 0;
  [[nodiscard]] virtual std::vector<NamedValue> parameters() const = 0;

  [[nodiscard]] virtual SymTensor4<double> inverse_metric(const Vec4<double>& x) const = 0;
  [[nodiscard]] virtual SymTensor4<double> metric(const Vec4<double>& x) const = 0;
  [[nodiscard]] virtual double hamiltonian(const PhaseState<double>& y) const = 0;
  /// Hamilton's equations: hand-written where the module has it, else derived.
  [[nodiscard]] virtual PhaseState<double> flow(const PhaseState<double>& y) const = 0;
  [[nodiscard]] virtual PhaseState<double> derived_flow(const PhaseState<double>& y) const = 0;
  /// The same flow carrying derivatives in eight directions of phase space, for Jacobians of whole rays.
  [[nodiscard]] virtual PhaseState<Dual<double, 8>> flow(const PhaseState<Dual<double, 8>>& y) const = 0;
  [[nodiscard]] virtual Connection<double> christoffel(const Vec4<double>& x) const = 0;
  [[nodiscard]] virtual Curvature curvature(const Vec4<double>& x) const = 0;
  /// The Ricci tensor R_{mu nu} that the module claims to have: zero in vacuum, else what it declares; nothing where it
  /// declares nothing. Conformance compares the derived one with it.
  [[nodiscard]] virtual std::optional<SymTensor4<double>> declared_ricci(const Vec4<double>& x) const = 0;
  /// Whether the module claims that there is no curvature at all.
  [[nodiscard]] virtual bool declared_flat() const = 0;
  [[nodiscard]] virtual double null_residual(const PhaseState<double>& y) const = 0;

  /// The radius that stops refer to (DESIGN: Boyer-Lindquist r, areal r where spherical, |x| in flat space and media).
  [[nodiscard]] virtual double radius(const Vec4<double>& x) const = 0;
  /// Outermost event horizon, if there is one.
  [[nodiscard]] virtual std::optional<double> horizon_radius() const = 0;
  /// Default of --r-min: between the horizon and the innermost photon orbit, if there is a horizon.
  [[nodiscard]] virtual std::optional<double> default_r_min() const = 0;
  /// Signed proper distance l from a throat, if there is one; `sheet` is +1 on the near side.
  [[nodiscard]] virtual std::optional<double> proper_distance(const Vec4<double>& x, int sheet) const = 0;
  /// Radius at which derivatives of the metric jump (the rim of a lens), if there is one: a step has to end there.
  [[nodiscard]] virtual std::optional<double> interface_radius() const = 0;
  /// The same where the interface is no surface of the radius: zero on it, negative inside, and never larger in size
  /// than the distance to it in x1, x2, x3. Nothing where there is no such interface, wherever x is.
  [[nodiscard]] virtual std::optional<double> interface_distance(const Vec4<double>& x) const = 0;
  /// The flow of one side of the interface, continued smoothly past it, so that a step may end there at full order; the
  /// flow itself where there is no interface.
  [[nodiscard]] virtual PhaseState<double> flow_of_side(const PhaseState<double>& y, bool inside) const = 0;
  /// Whether physics and chart admit the event.
  [[nodiscard]] virtual bool inside_domain(const Vec4<double>& x) const = 0;
  /// The chart as batches of rays see it, at every width; lives as long as this.
  [[nodiscard]] virtual LaneCharts lane_charts() const = 0;

  /// Whether H = T(p_i) + V(x^i, p_t) with p_t constant: what Stoermer-Verlet needs.
  [[nodiscard]] virtual bool separable() const = 0;

  [[nodiscard]] virtual std::vector<KillingVector> killing_vectors(const Vec4<double>& x) const = 0;
  /// The constants sign * K^mu p_mu of the same vectors, in the same order.
  [[nodiscard]] virtual std::vector<KillingConstant> killing_constants(const PhaseState<double>& y) const = 0;
  /// Carter's constant Q, where the module has a Killing tensor.
  [[nodiscard]] virtual std::optional<double> carter_constant(const PhaseState<double>& y) const = 0;

  /// Charts of one spacetime meet in its hub chart. `sheet` tells the sides of a wormhole apart where the hub does.
  [[nodiscard]] virtual PhaseState<double> to_hub(const PhaseState<double>& y, int sheet) const = 0;
  /// Undoes to_hub; the second member is the sheet on which the state lies.
  [[nodiscard]] virtual std::pair<PhaseState<double>, int> from_hub(const PhaseState<double>& y) const = 0;

  /// The classical chart's azimuth less this chart's own azimuthal angle at x, where the module knows it with all its
  /// turns: maps through the hub give it modulo 2 pi only.
  [[nodiscard]] virtual std::optional<double> azimuth_offset(const Vec4<double>& x) const = 0;

  /// Where to go on if `y` is better described in another chart of the atlas; nothing to do otherwise. The chart lives
  /// as long as this one.
  [[nodiscard]] virtual std::optional<ChartSwitch> atlas_switch(const PhaseState<double>& y, int sheet) const = 0;
};

}  // namespace xpr
