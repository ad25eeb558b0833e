// SpacetimeOf of every module, compiled once in the module's own .cpp.
#pragma once

#include "metrics/modules.hpp"
#include "metrics/spacetime_of.hpp"

namespace xpr {

extern template class SpacetimeOf<MinkowskiCartesian>;
extern template class SpacetimeOf<MinkowskiSpherical>;
extern template class SpacetimeOf<SchwarzschildIngoing>;
extern template class SpacetimeOf<SchwarzschildOutgoing>;
extern template class SpacetimeOf<SchwarzschildIsotropic>;
extern template class SpacetimeOf<SchwarzschildAreal>;
extern template class SpacetimeOf<KerrSchildIngoing>;
extern template class SpacetimeOf<KerrSchildOutgoing>;
extern template class SpacetimeOf<KerrBoyerLindquist>;
extern template class SpacetimeOf<EllisIsotropic>;
extern template class SpacetimeOf<EllisProperDistance>;
extern template class SpacetimeOf<MediumUniform>;
extern template class SpacetimeOf<Luneburg>;
extern template class SpacetimeOf<MaxwellFisheye>;
extern template class SpacetimeOf<EllipsoidGeographic>;
extern template class SpacetimeOf<EllipsoidTurned>;

}  // namespace xpr
