#include "core/ray_angles.hpp"

#include <cmath>
#include <numbers>

#include "core/polar_fold.hpp"
#include "metrics/scalar/elementary.hpp"

namespace xpr {
namespace {

constexpr double half_turn = std::numbers::pi;
constexpr double turn = 2.0 * half_turn;

std::optional<std::size_t> index_of(const Card& card, CoordinateKind kind) {
  for (std::size_t mu = 0; mu < 4; ++mu) {
    if (card.coordinates[mu].kind == kind) return mu;
  }
  return std::nullopt;
}

}  // namespace

RayAngles::RayAngles(const Spacetime& table, const Spacetime& transport, const PhaseState<double>& table_start,
                     const ChartState& start)
    : table_(table),
      transport_(transport),
      table_start_(table_start),
      start_(start),
      azimuth_(index_of(table.card(), CoordinateKind::azimuth)),
      polar_angle_(index_of(table.card(), CoordinateKind::polar_angle)),
      cartesian_(!index_of(transport.card(), CoordinateKind::azimuth)),
      latitudes_(index_of(transport.card(), CoordinateKind::latitude).has_value()) {
  if (azimuth_) longitude_ = table_start[*azimuth_];
}

std::function<void(const StepView&)> RayAngles::observer() {
  if (!follows_steps()) return {};
  // No step turns a ray once around, and a surface of revolution keeps the sense of rotation: that of p_lon.
  return [this](const StepView& step) {
    const PhaseState<double> y = change_chart(step.chart, table_, step.end, step.sheet).state;
    const double sense = table_start_[4 + *azimuth_] < 0.0 ? -1.0 : 1.0;
    const double turns = sense * (y[*azimuth_] - longitude_) / turn;
    // Round-off may move a meridian's longitude against the sense: not by a hundredth of a turn.
    longitude_ = y[*azimuth_] - sense * turn * std::floor(turns + 0.01);
  };
}

// The table's azimuth less the polar angle of (x, y), of a Cartesian transport chart: as the chart knows it, else from
// the chart map where the latter is zero, so that no branch of an arctangent is near.
double RayAngles::offset(const PhaseState<double>& y, int sheet) const {
  if (const std::optional<double> known = transport_.azimuth_offset(y.x())) return *known;
  const double in_plane = std::sqrt(y[1] * y[1] + y[2] * y[2]);
  const PhaseState<double> turned({y[0], in_plane, 0.0, y[3]}, {-1.0, 0.0, 0.0, 0.0});
  return change_chart(transport_, table_, turned, sheet).state[*azimuth_];
}

double RayAngles::swept_azimuth(const RayEnd& end) const {
  if (latitudes_) return longitude_ - table_start_[*azimuth_];
  const double begin = xpr::atan2(start_.state[2], start_.state[1]);
  const double finish = xpr::atan2(end.y[2], end.y[1]) + turn * end.windings;
  return finish - begin + (offset(end.y, end.sheet) - offset(start_.state, start_.sheet));
}

PhaseState<double> RayAngles::continued(const RayEnd& end, PhaseState<double> y) const {
  if (!azimuth_) return y;
  if (cartesian_ || latitudes_) {
    // The map's own azimuth, moved by whole turns: prediction errors do not enter.
    const double expected = table_start_[*azimuth_] + swept_azimuth(end);
    const double turns = std::nearbyint((expected - y[*azimuth_]) / turn);
    if (turns != 0.0 && std::isfinite(turns)) y[*azimuth_] += turn * turns;
  }
  if (polar_angle_) fold_polar_angle(y, *polar_angle_, *azimuth_);
  return y;
}

}  // namespace xpr
