// Batches of 8 rays at a time: compiled apart, so that the widths build side by side.
#include "integrators/lane_batch.hpp"

namespace xpr {

template class LaneBatch<8>;

}  // namespace xpr
