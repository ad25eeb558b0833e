#include "metrics/schwarzschild.hpp"

#include "metrics/checks.hpp"
#include "metrics/spacetime_of.hpp"

namespace xpr {

void SchwarzschildMass::validate() const { require_positive("mass M", M); }

template class SpacetimeOf<SchwarzschildIngoing>;
template class SpacetimeOf<SchwarzschildOutgoing>;
template class SpacetimeOf<SchwarzschildIsotropic>;
template class SpacetimeOf<SchwarzschildAreal>;

}  // namespace xpr
