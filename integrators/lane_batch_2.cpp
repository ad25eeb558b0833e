// Batches of 2 rays at a time: compiled apart, so that the widths build side by side.
#include "integrators/lane_batch.hpp"

namespace xpr {

template std::unique_ptr<LaneKernel<2>> make_lane_kernel<2>(const Stepper&);
template class LaneBatch<2>;

}  // namespace xpr
