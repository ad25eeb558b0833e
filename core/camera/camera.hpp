// Cameras: which ray of light a point of the picture sees. Rays are traced backwards in time, from the camera to what
// it sees: their tangent is past-directed, k = -e_time + direction, of unit frequency for the observer.
//
//   pinhole           straight lines in the observer's frame stay straight
//   fisheye           the angle from the axis grows as the distance from the picture's middle
//   equirectangular   longitude from left to right, latitude from bottom to top: the whole sphere
//   impact-parameter  parallel rays, which start on the plane through the camera: alpha and beta are lengths
#pragma once

#include <array>
#include <optional>

#include "core/camera/tetrad.hpp"

namespace xpr {

/// Where on the picture: u from -1 at the left to +1 at the right, v from -1 at the bottom to +1 at the top.
struct ScreenPoint {
  double u = 0.0;
  double v = 0.0;
};

/// The point (column + dx, row + dy) of a picture of that many pixels; row 0 is the top, pixel centres have dx = dy =
/// 1/2.
[[nodiscard]] ScreenPoint screen_point(const std::array<int, 2>& pixels, double column, double row);

/// A unit direction in the observer's frame.
struct ViewDirection {
  double right = 0.0, up = 0.0, forward = 0.0;
};

/// A camera that stands in a spacetime, in the hands of an observer.
class CameraView {
 public:
  /// Throws std::invalid_argument as make_tetrad does, and for a field of view that the model cannot have, a screen
  /// without size, an event outside the chart's domain.
  CameraView(const Spacetime& chart, const SceneCamera& camera, const SceneObserver& observer, double aspect);

  /// The direction that a point of the picture looks in; nothing where a fisheye's circle ends.
  [[nodiscard]] std::optional<ViewDirection> direction(const ScreenPoint& at) const;
  /// The ray in the scene chart, on the light cone to rounding; nothing where there is none, or where no past-directed
  /// light goes that way.
  [[nodiscard]] std::optional<PhaseState<double>> ray(const ScreenPoint& at) const;

  [[nodiscard]] const Tetrad& tetrad() const { return tetrad_; }
  [[nodiscard]] const SceneCamera& camera() const { return camera_; }

 private:
  const Spacetime& chart_;
  SceneCamera camera_;
  Vec4<double> position_;
  SceneObserver observer_;
  double aspect_;
  Tetrad tetrad_;
  SymTensor4<double> metric_;
};

}  // namespace xpr
