#include "integrators/first_integral_widths.hpp"

namespace xpr::first_integrals {
template void trace_lanes<4>(const Batch&);
}  // namespace xpr::first_integrals
