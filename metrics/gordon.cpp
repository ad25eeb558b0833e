#include "metrics/gordon.hpp"

#include "metrics/checks.hpp"
#include "metrics/spacetime_of.hpp"

namespace xpr {

void GordonVortex::validate() const {
  require_positive("refractive index n", n);
  if (!std::isfinite(W)) throw std::invalid_argument(fmt::format("vortex strength W = {}, needs a finite number", W));
}

template class SpacetimeOf<GordonVortex>;

}  // namespace xpr
