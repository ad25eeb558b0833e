#include "metrics/ellis.hpp"

#include "metrics/checks.hpp"
#include "metrics/spacetime_of.hpp"

namespace xpr {

void EllisThroat::validate() const { require_positive("throat radius b0", b0); }

template class SpacetimeOf<EllisIsotropic>;
template class SpacetimeOf<EllisProperDistance>;

}  // namespace xpr
