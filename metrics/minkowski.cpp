#include "metrics/minkowski.hpp"

#include "metrics/spacetime_of.hpp"

namespace xpr {

template class SpacetimeOf<MinkowskiCartesian>;
template class SpacetimeOf<MinkowskiSpherical>;

}  // namespace xpr
