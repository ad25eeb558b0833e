// How charts of one spacetime hand a ray over to each other while it is traced.
#pragma once

#include "metrics/tensor.hpp"

namespace xpr {

/// What a module answers when a ray has left its chart's good region: the state in the chart that goes on, which is the
/// module's `atlas_partner()` if it has one, else the same chart on another sheet.
struct AtlasMove {
  PhaseState<double> state;
  int sheet = 1;
};

}  // namespace xpr
