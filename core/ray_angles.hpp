// Spherical angles that are continuous along a ray, whatever chart its transport ran in.
//
// A chart map gives the azimuth of a ray's end modulo 2 pi, and transport through an axis leaves the polar angle
// outside [0, pi]. What a table wants is the azimuth as swept along the ray, and the polar angle inside [0, pi] with pi
// added to the azimuth at each crossing of the axis.
#pragma once

#include <functional>
#include <optional>

#include "integrators/tracer.hpp"
#include "metrics/chart_map.hpp"
#include "metrics/spacetime.hpp"

namespace xpr {

/// Follows one ray. Three kinds of transport chart:
/// - Cartesian: the polar angle of (x, y) is counted with the tracer's windings; between it and the table's azimuth
///   lies an offset that depends on the radius alone (frame dragging in Kerr) and is exact on the half-plane y = 0;
/// - spherical: the azimuth is continuous as it is, only the polar angle is folded;
/// - an atlas of latitudes (the ellipsoid): the longitude is followed step by step in the sense of rotation.
/// Rays without angular momentum about the axis may turn by pi either way on it.
class RayAngles {
 public:
  /// `table_start` and `start` are one point in the table's chart and in the transport chart; both charts must outlive
  /// this object.
  RayAngles(const Spacetime& table, const Spacetime& transport, const PhaseState<double>& table_start,
            const ChartState& start);

  /// Whether the ray has to be followed step by step, by observer().
  [[nodiscard]] bool follows_steps() const { return latitudes_ && azimuth_; }
  /// To be given to the tracer; empty where nothing needs to be followed. Refers to this object.
  [[nodiscard]] std::function<void(const StepView&)> observer();

  /// `y`, the ray's end in the table's chart, with continuous angles.
  [[nodiscard]] PhaseState<double> continued(const RayEnd& end, PhaseState<double> y) const;

 private:
  [[nodiscard]] double swept_azimuth(const RayEnd& end) const;
  [[nodiscard]] double offset(const PhaseState<double>& y, int sheet) const;

  const Spacetime& table_;
  const Spacetime& transport_;
  PhaseState<double> table_start_;
  ChartState start_;
  std::optional<std::size_t> azimuth_;      // index in the table's chart
  std::optional<std::size_t> polar_angle_;  // index in the table's chart
  bool cartesian_ = false;                  // transport
  bool latitudes_ = false;                  // transport
  double longitude_ = 0.0;                  // followed so far
};

}  // namespace xpr
