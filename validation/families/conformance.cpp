#include "validation/families.hpp"

namespace xpr {

std::vector<Case> conformance_cases() { return {}; }

}  // namespace xpr
