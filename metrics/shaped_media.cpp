#include "metrics/shaped_media.hpp"

#include "metrics/checks.hpp"
#include "metrics/spacetime_of.hpp"

namespace xpr {

void SelfocFibre::validate() const {
  require_positive("index on the axis n0", n0);
  require_positive("strength g", g);
}
void StretchedFisheye::validate() const {
  require_positive("fish-eye radius R", R);
  require_positive("stretch s", s);
}

template class SpacetimeOf<SelfocFibre>;
template class SpacetimeOf<StretchedFisheye>;

}  // namespace xpr
