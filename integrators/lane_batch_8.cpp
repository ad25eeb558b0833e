// Batches of 8 rays at a time: compiled apart, so that the widths build side by side.
#include "integrators/lane_batch.hpp"

namespace xpr {

template std::unique_ptr<LaneKernel<8>> make_lane_kernel<8>(const Stepper&);
template class LaneBatch<8>;

}  // namespace xpr
