#include "validation/truth/flow50_slice.hpp"

namespace xpr::flow50_detail {
template Rates50 flow_in_slice<0>(std::string_view, std::string_view, std::span<const NamedValue>);
}  // namespace xpr::flow50_detail
