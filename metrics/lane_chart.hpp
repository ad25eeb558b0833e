// A chart as a batch of rays sees it: W points at once, one ray in each lane.
//
// Kernels that step rays are compiled once a width and call the chart through this interface; one virtual call serves W
// flows, so nothing but these few functions is compiled for each metric and width.
#pragma once

#include <array>
#include <limits>
#include <new>
#include <type_traits>

#include "metrics/derived.hpp"
#include "metrics/scalar/pack.hpp"

namespace xpr {

/// What a step's end has to be looked at for, in every lane.
template <int W>
struct LaneProbe {
  Pack<W> radius;          ///< as Spacetime::radius
  Pack<W> radial_rate;     ///< d radius / d lambda
  Pack<W> null_residual;   ///< as Spacetime::null_residual; NaN where g^{tt} >= 0
  Mask<W> inside;          ///< as Spacetime::inside_domain
  Mask<W> stays;           ///< the atlas leaves the ray in this chart
  Pack<W> interface = {};  ///< as Spacetime::interface_distance, where there is such an interface
};

template <int W>
class LaneChart {
 public:
  virtual ~LaneChart() = default;
  /// Hamilton's equations, the bits of Spacetime::flow in every lane. Where the metric has an interface: the flow of
  /// the side on which `inside` says that the lane's ray is.
  virtual void flow(const PhaseState<Pack<W>>& y, const Mask<W>& inside, PhaseState<Pack<W>>& rate) const = 0;
  /// Looks at y, where `rate` is the flow. Lanes that hold no ray may hold anything.
  [[nodiscard]] virtual LaneProbe<W> probe(const PhaseState<Pack<W>>& y, const PhaseState<Pack<W>>& rate,
                                           const std::array<int, static_cast<std::size_t>(W)>& sheet) const = 0;
};

/// A chart at every width of this build; null where the chart is not made for lanes.
struct LaneCharts {
  const LaneChart<1>* one = nullptr;
  const LaneChart<2>* two = nullptr;
  const LaneChart<4>* four = nullptr;
  const LaneChart<8>* eight = nullptr;

  template <int W>
  [[nodiscard]] const LaneChart<W>* of_width() const {
    if constexpr (W == 1) return one;
    if constexpr (W == 2) return two;
    if constexpr (W == 4) return four;
    if constexpr (W == 8) return eight;
  }
};

/// Lane i of W points of phase space.
template <int W>
[[nodiscard]] PhaseState<double> lane_of(const PhaseState<Pack<W>>& y, int i) {
  PhaseState<double> out;
  for (std::size_t k = 0; k < 8; ++k) out[k] = lane(y[k], i);
  return out;
}

template <int W>
void set_lane_of(PhaseState<Pack<W>>& y, int i, const PhaseState<double>& value) {
  for (std::size_t k = 0; k < 8; ++k) set_lane(y[k], i, value[k]);
}

/// LaneChart of a metric module.
template <MetricModule M, int W>
class LaneChartOf final : public LaneChart<W> {
 public:
  using T = Pack<W>;

  explicit LaneChartOf(const M& module) : module_(module) {}

  // Flattened: duals that cross a call go through memory, which doubles the time.
  [[gnu::flatten]] void flow(const PhaseState<T>& y, [[maybe_unused]] const Mask<W>& inside,
                             PhaseState<T>& rate) const override {
    if constexpr (requires { module_.interface_distance(y.x()); }) {
      rate = module_.flow_of_side(y, inside);
    } else if constexpr (requires { module_.interface_radius(); }) {
      const PhaseState<T> within = module_.flow_of_side(y, true);
      const PhaseState<T> without = module_.flow_of_side(y, false);
      for (std::size_t k = 0; k < 8; ++k) rate[k] = select(inside, within[k], without[k]);
    } else {
      // In place: a copy would be as long as the flow's own stores.
      ::new (static_cast<void*>(&rate)) PhaseState<T>(xpr::flow(module_, y));
    }
  }

  [[nodiscard, gnu::flatten]] LaneProbe<W> probe(
      const PhaseState<T>& y, const PhaseState<T>& rate,
      [[maybe_unused]] const std::array<int, static_cast<std::size_t>(W)>& sheet) const override {
    using D = Dual<T, 1>;
    // Copies: what is written to memory between two uses of y may not have changed it.
    const Vec4<T> x = y.x(), p = y.p();
    const auto along = [&](std::size_t mu) __attribute__((always_inline)) { return D(x[mu], {rate[mu]}); };
    const D radius = module_.radius(Vec4<D>{along(0), along(1), along(2), along(3)});
    const SymTensor4<T> g = module_.inverse_metric(x);
    LaneProbe<W> out{
        .radius = radius.value,
        .radial_rate = radius.derivative[0],
        .null_residual = select(g(0, 0) < 0.0, xpr::null_residual(g, p), T(std::numeric_limits<double>::quiet_NaN())),
        .inside = inside_domain(module_, x),
        .stays = Mask<W>(true)};
    if constexpr (requires { module_.interface_distance(x); }) out.interface = module_.interface_distance(x);
    if constexpr (requires { module_.atlas_switch(PhaseState<double>{}, 1); }) {
      for (int i = 0; i < W; ++i) {
        set_lane(out.stays, i, !module_.atlas_switch(lane_of<W>(y, i), sheet[static_cast<std::size_t>(i)]));
      }
    }
    return out;
  }

 private:
  const M& module_;
};

/// Whether batches trace rays of M in lanes: unless the module says otherwise.
template <class M>
inline constexpr bool for_lanes = [] {
  if constexpr (requires { M::for_lanes; }) return M::for_lanes;
  return true;
}();

/// A module's lane charts of all widths.
template <MetricModule M, bool = for_lanes<M>>
class LanesOf {
 public:
  explicit LanesOf(const M& module) : one_(module), two_(module), four_(module), eight_(module) {}
  [[nodiscard]] LaneCharts charts() const { return {&one_, &two_, &four_, &eight_}; }

 private:
  LaneChartOf<M, 1> one_;
  LaneChartOf<M, 2> two_;
  LaneChartOf<M, 4> four_;
  LaneChartOf<M, 8> eight_;
};
template <MetricModule M>
class LanesOf<M, false> {
 public:
  explicit LanesOf(const M&) {}
};

}  // namespace xpr
