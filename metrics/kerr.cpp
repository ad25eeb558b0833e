#include "metrics/kerr.hpp"

#include "metrics/checks.hpp"
#include "metrics/spacetime_of.hpp"

namespace xpr {

void KerrParameters::validate() const {
  require_positive("mass M", M);
  if (!(std::abs(a) <= M)) throw std::invalid_argument(fmt::format("spin a = {}, needs |a| <= M = {}", a, M));
}

template class SpacetimeOf<KerrSchildIngoing>;
template class SpacetimeOf<KerrSchildOutgoing>;
template class SpacetimeOf<KerrBoyerLindquist>;

}  // namespace xpr
