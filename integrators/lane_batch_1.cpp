// Batches of 1 ray at a time: compiled apart, so that the widths build side by side.
#include "integrators/lane_batch.hpp"

namespace xpr {

template class LaneBatch<1>;

}  // namespace xpr
