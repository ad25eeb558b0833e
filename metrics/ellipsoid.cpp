#include "metrics/ellipsoid.hpp"

#include "metrics/checks.hpp"
#include "metrics/spacetime_of.hpp"

namespace xpr {

void Spheroid::validate() const {
  require_positive("equatorial radius a_axis", a_axis);
  if (!(f < 1.0 && std::isfinite(f))) throw std::invalid_argument(fmt::format("flattening f = {}, needs f < 1", f));
}

namespace {

// Near a pole, or beyond it: along a meridian a chart knows of no pole, and a long step may pass it.
bool wants_other_chart(const PhaseState<double>& y) {
  const auto [sine, cosine] = sincos(y[1]);
  return std::abs(sine) > ellipsoid_switch_sine || cosine < 0.0;
}

// The same point and ray with its latitude within +-90 degrees, as the chart maps have it: beyond a pole the latitude
// runs backwards, half a turn of longitude away.
PhaseState<double> within_poles(PhaseState<double> y) {
  if (cos(y[1]) >= 0.0) return y;
  const double half_turns = std::nearbyint(y[1] / pi<double>());
  y[1] = half_turns * pi<double>() - y[1];
  y[2] += pi<double>();
  y[5] = -y[5];
  return y;
}

}  // namespace

EllipsoidTurned EllipsoidGeographic::atlas_partner() const { return {static_cast<const Spheroid&>(*this)}; }

EllipsoidGeographic EllipsoidTurned::atlas_partner() const { return {static_cast<const Spheroid&>(*this)}; }

std::optional<AtlasMove> EllipsoidGeographic::atlas_switch(const PhaseState<double>& y, int sheet) const {
  if (!wants_other_chart(y)) return std::nullopt;
  return AtlasMove{state_from_hub(atlas_partner(), within_poles(y), sheet), sheet};
}

std::optional<AtlasMove> EllipsoidTurned::atlas_switch(const PhaseState<double>& y, int sheet) const {
  if (!wants_other_chart(y)) return std::nullopt;
  return AtlasMove{state_to_hub(*this, within_poles(y), sheet), sheet};
}

template class SpacetimeOf<EllipsoidGeographic>;
template class SpacetimeOf<EllipsoidTurned>;

}  // namespace xpr
