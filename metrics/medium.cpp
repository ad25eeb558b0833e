#include "metrics/medium.hpp"

#include "metrics/checks.hpp"
#include "metrics/spacetime_of.hpp"

namespace xpr {

void UniformIndex::validate() const { require_positive("refractive index n", n); }
void LuneburgIndex::validate() const { require_positive("lens radius R", R); }
void FisheyeIndex::validate() const { require_positive("fish-eye radius R", R); }

template class SpacetimeOf<MediumUniform>;
template class SpacetimeOf<Luneburg>;
template class SpacetimeOf<MaxwellFisheye>;

}  // namespace xpr
