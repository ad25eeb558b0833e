// Batches of 4 rays at a time: compiled apart, so that the widths build side by side.
#include "integrators/lane_batch.hpp"

namespace xpr {

template std::unique_ptr<LaneKernel<4>> make_lane_kernel<4>(const Stepper&);
template class LaneBatch<4>;

}  // namespace xpr
