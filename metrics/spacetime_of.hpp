// SpacetimeOf<M>: the run-time interface made from a metric module. A module must model MetricModule; it may add
//
//   static constexpr std::array<Parameter<Geometry>, n> parameters   its numbers, by name
//   void validate() const                                            throws std::invalid_argument: value, allowed range
//   PhaseState<T> flow(const PhaseState<T>&) const                   a hand-written flow
//   std::array<KillingVectorOf<T>, n> killing_vectors(const Vec4<T>&) const
//                                                                    beyond the ignorable coordinates' own
//   T carter_constant(const PhaseState<T>&) const
//   static constexpr bool separable                                    H = T(p_i) + V(x^i, p_t): Stoermer-Verlet works
//   SymTensor4<double> declared_ricci(const Vec4<double>&) const     R_{mu nu} where it is known and not zero
//   static constexpr bool flat                                       true: no curvature at all
//   double horizon_radius() const, double default_r_min() const
//   double proper_distance(const Vec4<double>&, int sheet) const
//   double interface_radius() const                                  where derivatives of the metric jump
//   PhaseState<T> flow_of_side(const PhaseState<T>&, bool inside)   goes with it: the flow of either side, past it too
//   T interface_distance(const Vec4<T>&) const                       in its place, for interfaces of any shape: < 0
//   inside,
//                                                                    |g(x) - g(y)| at most the distance in x1..x3; its
//                                                                    flow_of_side takes a MaskOf<T>
//   MaskOf<T> inside_domain(const Vec4<T>&) const
//   static constexpr bool for_lanes                                  false: one ray at a time, less to compile
//   to_hub, from_hub                                                 the map to the chart in which all charts meet:
//     Vec4<T> to_hub(const Vec4<T>&, int sheet) const                as a point map, momenta by its Jacobian,
//     PhaseState<T> to_hub(const PhaseState<T>&, int sheet) const    or on phase space, written out
//   int hub_sheet(const Vec4<double>&) const                         the sheet on which a point of the hub lies
//   double azimuth_offset(const Vec4<double>&) const                 classical azimuth less that of (x, y), in full:
//                                                                    needed where maps through the hub lose turns
//   std::optional<AtlasMove> atlas_switch(const PhaseState<double>&, int sheet) const
//   Partner atlas_partner() const                                    the chart that atlas_switch goes to, if another
#pragma once

#include <memory>
#include <utility>

#include "metrics/atlas.hpp"
#include "metrics/killing.hpp"
#include "metrics/lane_chart.hpp"
#include "metrics/spacetime.hpp"

namespace xpr {

/// The Killing vectors of M at x: those it lists, else one for each ignorable coordinate.
template <MetricModule M, class T>
[[nodiscard]] auto killing_vectors_of(const M& module, const Vec4<T>& x) {
  if constexpr (requires { module.killing_vectors(x); }) {
    return module.killing_vectors(x);
  } else {
    std::array<KillingVectorOf<T>, 4 - dependent_coordinates<M>> out{};
    for (std::size_t mu = 0, k = 0; mu < 4; ++mu) {
      if (!M::card.ignorable[mu]) continue;
      out[k].name = mu == 0 ? std::string_view("E") : M::card.coordinates[mu].name;
      out[k].sign = mu == 0 ? -1.0 : 1.0;
      out[k].component[mu] = T(1.0);
      ++k;
    }
    return out;
  }
}

template <MetricModule M>
class SpacetimeOf final : public Spacetime {
 public:
  /// Throws std::invalid_argument where the module's own validate() does.
  explicit SpacetimeOf(M module) : SpacetimeOf(std::move(module), nullptr) {
    if constexpr (has_partner) {
      using Partner = decltype(module_.atlas_partner());
      owned_partner_.reset(new SpacetimeOf<Partner>(module_.atlas_partner(), this));
      partner_ = owned_partner_.get();
    }
  }
  SpacetimeOf(const SpacetimeOf&) = delete;  // charts of an atlas point to each other
  SpacetimeOf& operator=(const SpacetimeOf&) = delete;

  [[nodiscard]] const M& module() const { return module_; }
  [[nodiscard]] const Card& card() const override { return M::card; }

  [[nodiscard]] std::vector<NamedValue> parameters() const override {
    std::vector<NamedValue> out;
    if constexpr (requires { M::parameters; }) {
      for (const auto& parameter : M::parameters) out.push_back({parameter.name, module_.*(parameter.member)});
    }
    return out;
  }

  [[nodiscard]] SymTensor4<double> inverse_metric(const Vec4<double>& x) const override {
    return module_.inverse_metric(x);
  }
  [[nodiscard]] SymTensor4<double> metric(const Vec4<double>& x) const override { return covariant_metric(module_, x); }
  [[nodiscard]] double hamiltonian(const PhaseState<double>& y) const override { return xpr::hamiltonian(module_, y); }
  [[nodiscard]] PhaseState<double> flow(const PhaseState<double>& y) const override { return xpr::flow(module_, y); }
  [[nodiscard]] PhaseState<double> derived_flow(const PhaseState<double>& y) const override {
    return xpr::derived_flow(module_, y);
  }
  [[nodiscard]] PhaseState<Dual<double, 8>> flow(const PhaseState<Dual<double, 8>>& y) const override {
    return xpr::flow(module_, y);
  }
  [[nodiscard]] Connection<double> christoffel(const Vec4<double>& x) const override {
    return xpr::christoffel(module_, x);
  }
  [[nodiscard]] Curvature curvature(const Vec4<double>& x) const override { return xpr::curvature(module_, x); }
  [[nodiscard]] std::optional<SymTensor4<double>> declared_ricci(
      [[maybe_unused]] const Vec4<double>& x) const override {
    if constexpr (requires { module_.declared_ricci(x); }) return module_.declared_ricci(x);
    if (M::card.vacuum) return SymTensor4<double>{};
    return std::nullopt;
  }
  [[nodiscard]] bool declared_flat() const override {
    if constexpr (requires { M::flat; }) return M::flat;
    return false;
  }
  [[nodiscard]] double null_residual(const PhaseState<double>& y) const override {
    return xpr::null_residual(module_, y);
  }

  [[nodiscard]] double radius(const Vec4<double>& x) const override { return module_.radius(x); }
  [[nodiscard]] std::optional<double> horizon_radius() const override {
    if constexpr (requires { module_.horizon_radius(); }) return module_.horizon_radius();
    return std::nullopt;
  }
  [[nodiscard]] std::optional<double> default_r_min() const override {
    if constexpr (requires { module_.default_r_min(); }) return module_.default_r_min();
    return std::nullopt;
  }
  [[nodiscard]] std::optional<double> proper_distance([[maybe_unused]] const Vec4<double>& x,
                                                      [[maybe_unused]] int sheet) const override {
    if constexpr (requires { module_.proper_distance(x, sheet); }) return module_.proper_distance(x, sheet);
    return std::nullopt;
  }
  [[nodiscard]] bool inside_domain(const Vec4<double>& x) const override { return xpr::inside_domain(module_, x); }
  [[nodiscard]] LaneCharts lane_charts() const override {
    if constexpr (for_lanes<M>) return lanes_.charts();
    return {};
  }

  [[nodiscard]] bool separable() const override {
    if constexpr (requires { M::separable; }) return M::separable;
    return false;
  }

  [[nodiscard]] std::vector<KillingVector> killing_vectors(const Vec4<double>& x) const override {
    std::vector<KillingVector> out;
    for (const auto& k : killing_vectors_of(module_, x)) out.push_back({k.name, k.sign, k.component});
    return out;
  }
  [[nodiscard]] std::vector<KillingConstant> killing_constants(const PhaseState<double>& y) const override {
    const Vec4<double> p = y.p();
    std::vector<KillingConstant> out;
    for (const auto& k : killing_vectors_of(module_, variables(y.x()))) {
      KillingConstant constant{k.name};
      for (std::size_t mu = 0; mu < 4; ++mu) {
        constant.value += k.sign * (k.component[mu].value * p[mu]);
        constant.gradient[4 + mu] = k.sign * k.component[mu].value;
        for (std::size_t nu = 0; nu < 4; ++nu) {
          constant.gradient[nu] += k.sign * (k.component[mu].derivative[nu] * p[mu]);
        }
      }
      out.push_back(constant);
    }
    return out;
  }
  [[nodiscard]] std::optional<double> carter_constant([[maybe_unused]] const PhaseState<double>& y) const override {
    if constexpr (requires { module_.carter_constant(y); }) return module_.carter_constant(y);
    return std::nullopt;
  }

  [[nodiscard]] std::optional<double> interface_radius() const override {
    if constexpr (requires { module_.interface_radius(); }) return module_.interface_radius();
    return std::nullopt;
  }
  [[nodiscard]] std::optional<double> interface_distance([[maybe_unused]] const Vec4<double>& x) const override {
    if constexpr (requires { module_.interface_distance(x); }) return module_.interface_distance(x);
    return std::nullopt;
  }
  [[nodiscard]] PhaseState<double> flow_of_side(const PhaseState<double>& y,
                                                [[maybe_unused]] bool inside) const override {
    if constexpr (requires { module_.flow_of_side(y, inside); }) return module_.flow_of_side(y, inside);
    return xpr::flow(module_, y);
  }

  [[nodiscard]] PhaseState<double> to_hub(const PhaseState<double>& y, int sheet) const override {
    return state_to_hub(module_, y, sheet);
  }
  [[nodiscard]] std::pair<PhaseState<double>, int> from_hub(const PhaseState<double>& y) const override {
    const int sheet = sheet_at_hub(module_, y.x());
    return {state_from_hub(module_, y, sheet), sheet};
  }

  [[nodiscard]] std::optional<double> azimuth_offset([[maybe_unused]] const Vec4<double>& x) const override {
    if constexpr (requires { module_.azimuth_offset(x); }) return module_.azimuth_offset(x);
    return std::nullopt;
  }

  [[nodiscard]] std::optional<ChartSwitch> atlas_switch([[maybe_unused]] const PhaseState<double>& y,
                                                        [[maybe_unused]] int sheet) const override {
    if constexpr (requires { module_.atlas_switch(y, sheet); }) {
      if (const std::optional<AtlasMove> move = module_.atlas_switch(y, sheet)) {
        return ChartSwitch{has_partner ? partner_ : this, move->state, move->sheet};
      }
    }
    return std::nullopt;
  }

 private:
  template <MetricModule>
  friend class SpacetimeOf;

  static constexpr bool has_partner = requires(const M& module) { module.atlas_partner(); };

  /// A chart of an atlas: `partner`, which owns this one, is where it hands rays over to.
  SpacetimeOf(M module, const Spacetime* partner) : module_(std::move(module)), partner_(partner) {
    if constexpr (requires { module_.validate(); }) module_.validate();
  }

  M module_;
  [[no_unique_address]] LanesOf<M> lanes_{module_};
  const Spacetime* partner_ = nullptr;
  std::unique_ptr<const Spacetime> owned_partner_;
};

}  // namespace xpr
