// Batches of 1 ray at a time: compiled apart, so that the widths build side by side.
#include "integrators/lane_batch.hpp"

namespace xpr {

template std::unique_ptr<LaneKernel<1>> make_lane_kernel<1>(const Stepper&);
template class LaneBatch<1>;

}  // namespace xpr
