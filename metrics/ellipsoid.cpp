#include "metrics/ellipsoid.hpp"

#include "metrics/checks.hpp"
#include "metrics/spacetime_of.hpp"

namespace xpr {

void Spheroid::validate() const {
  require_positive("equatorial radius a_axis", a_axis);
  if (!(f < 1.0 && std::isfinite(f))) throw std::invalid_argument(fmt::format("flattening f = {}, needs f < 1", f));
}

namespace {

bool wants_other_chart(const PhaseState<double>& y) { return std::abs(sin(y[1])) > ellipsoid_switch_sine; }

}  // namespace

EllipsoidTurned EllipsoidGeographic::atlas_partner() const { return {static_cast<const Spheroid&>(*this)}; }

EllipsoidGeographic EllipsoidTurned::atlas_partner() const { return {static_cast<const Spheroid&>(*this)}; }

std::optional<AtlasMove> EllipsoidGeographic::atlas_switch(const PhaseState<double>& y, int sheet) const {
  if (!wants_other_chart(y)) return std::nullopt;
  return AtlasMove{state_from_hub(atlas_partner(), y, sheet), sheet};
}

std::optional<AtlasMove> EllipsoidTurned::atlas_switch(const PhaseState<double>& y, int sheet) const {
  if (!wants_other_chart(y)) return std::nullopt;
  return AtlasMove{state_to_hub(*this, y, sheet), sheet};
}

template class SpacetimeOf<EllipsoidGeographic>;
template class SpacetimeOf<EllipsoidTurned>;

}  // namespace xpr
