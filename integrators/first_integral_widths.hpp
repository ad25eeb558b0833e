// The lane loop of each width, compiled in a source of its own.
#pragma once

#include "integrators/first_integral_lanes.hpp"

namespace xpr::first_integrals {

template <int W>
void trace_lanes(const Batch& batch);

extern template void trace_lanes<1>(const Batch&);
extern template void trace_lanes<2>(const Batch&);
extern template void trace_lanes<4>(const Batch&);
extern template void trace_lanes<8>(const Batch&);

/// The order that costs least for a tolerance grows as its logarithm [JorbaZou2005]; these two were measured.
template <int W>
void trace_lanes(const Batch& batch) {
  const auto with_order = [&]<int N>() {
    if (batch.settings.timed) {
      Lanes<Pack<W>, N, true>(batch).run();
    } else {
      Lanes<Pack<W>, N, false>(batch).run();
    }
  };
  if (batch.settings.tol >= 1e-9) {
    with_order.template operator()<14>();
  } else {
    with_order.template operator()<18>();
  }
}

}  // namespace xpr::first_integrals
