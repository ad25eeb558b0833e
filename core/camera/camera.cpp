#include "core/camera/camera.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "metrics/null_cone.hpp"
#include "metrics/scalar/elementary.hpp"

namespace xpr {
namespace {

void check(const SceneCamera& camera, double aspect) {
  const double pi_ = pi<double>();
  const double most = camera.model == CameraModel::pinhole ? pi_ : 2.0 * pi_;
  const bool has_fov = camera.model == CameraModel::pinhole || camera.model == CameraModel::fisheye;
  const bool fits = camera.model == CameraModel::pinhole ? camera.fov < most : camera.fov <= most;
  if (has_fov && !(camera.fov > 0.0 && fits)) {
    throw std::invalid_argument(
        fmt::format("camera: a field of view of {} degrees; a {} needs more than 0 and {} {}", camera.fov * 180.0 / pi_,
                    camera_model_names[static_cast<std::size_t>(camera.model)],
                    camera.model == CameraModel::pinhole ? "less than" : "at most", most * 180.0 / pi_));
  }
  if (camera.model == CameraModel::impact_parameter && !(camera.half_width > 0.0)) {
    throw std::invalid_argument(fmt::format("camera: half_width {}, needs a positive length", camera.half_width));
  }
  if (!(aspect > 0.0)) throw std::invalid_argument("camera: a picture without width or height");
}

}  // namespace

ScreenPoint screen_point(const std::array<int, 2>& pixels, double column, double row) {
  return {2.0 * column / pixels[0] - 1.0, 1.0 - 2.0 * row / pixels[1]};
}

CameraView::CameraView(const Spacetime& chart, const SceneCamera& camera, const SceneObserver& observer, double aspect)
    : chart_(chart),
      camera_(camera),
      position_{camera.time, camera.position.x, camera.position.y, camera.position.z},
      observer_(observer),
      aspect_(aspect),
      metric_(chart.metric(position_)) {
  check(camera, aspect);
  if (!chart.inside_domain(position_)) {
    throw std::invalid_argument(fmt::format("camera at ({}, {}, {}) is outside the domain of {} ({})",
                                            camera.position.x, camera.position.y, camera.position.z,
                                            chart.card().metric, chart.card().chart));
  }
  tetrad_ = make_tetrad(chart, position_, observer, camera.forward, camera.up);
}

std::optional<ViewDirection> CameraView::direction(const ScreenPoint& at) const {
  const double x = at.u * aspect_, y = at.v;
  switch (camera_.model) {
    case CameraModel::pinhole: {
      const auto [sine, cosine] = sincos(0.5 * camera_.fov);
      const double right = x * sine, up = y * sine;
      const double scale = 1.0 / std::sqrt(right * right + up * up + cosine * cosine);
      return ViewDirection{scale * right, scale * up, scale * cosine};
    }
    case CameraModel::fisheye: {
      const double distance = std::sqrt(x * x + y * y);
      const double angle = 0.5 * camera_.fov * distance;
      if (angle > pi<double>()) return std::nullopt;
      if (distance == 0.0) return ViewDirection{0.0, 0.0, 1.0};
      const auto [sine, cosine] = sincos(angle);
      return ViewDirection{sine * x / distance, sine * y / distance, cosine};
    }
    case CameraModel::equirectangular: {
      const auto [sin_longitude, cos_longitude] = sincos(pi<double>() * at.u);
      const auto [sin_latitude, cos_latitude] = sincos(0.5 * pi<double>() * at.v);
      return ViewDirection{cos_latitude * sin_longitude, sin_latitude, cos_latitude * cos_longitude};
    }
    case CameraModel::impact_parameter:
      break;
  }
  return ViewDirection{0.0, 0.0, 1.0};
}

std::optional<PhaseState<double>> CameraView::ray(const ScreenPoint& at) const {
  const std::optional<ViewDirection> seen = direction(at);
  if (!seen) return std::nullopt;
  Tetrad frame = tetrad_;
  SymTensor4<double> metric = metric_;
  Vec4<double> x = position_;
  if (camera_.model == CameraModel::impact_parameter) {
    const Vec3 ahead = normalized(camera_.forward);
    const Vec3 right = normalized(cross(ahead, camera_.up));
    const Vec3 up = cross(right, ahead);
    const Vec3 offset = (camera_.half_width * at.u) * right + (camera_.half_width * at.v / aspect_) * up;
    for (std::size_t i = 0; i < 3; ++i) x[i + 1] += offset[i];
    if (!chart_.inside_domain(x)) return std::nullopt;
    metric = chart_.metric(x);
    frame = make_tetrad(chart_, x, observer_, camera_.forward, camera_.up);
  }
  Vec4<double> tangent;
  for (std::size_t mu = 0; mu < 4; ++mu) {
    tangent[mu] =
        -frame.time[mu] + seen->right * frame.right[mu] + seen->up * frame.up[mu] + seen->forward * frame.forward[mu];
  }
  const std::optional<Vec4<double>> p = null_momentum(chart_, x, raise_index(metric, tangent), -1.0);
  if (!p) return std::nullopt;
  return PhaseState<double>(x, *p);
}

}  // namespace xpr
