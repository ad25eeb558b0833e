#include "core/geometry/path_envelope.hpp"

#include <algorithm>
#include <cstddef>

#include "core/geometry/bernstein.hpp"

namespace xpr {

Vec3 point(const RayPath& path, double theta) { return bernstein::value(path.control, path.degree, theta); }

Vec3 velocity(const RayPath& path, double theta) {
  return path.degree == 1 ? path.control[1] - path.control[0]
                          : bernstein::value(bernstein::derivative(path.control, path.degree), path.degree - 1, theta);
}

std::pair<RayPath, RayPath> halves(const RayPath& path) {
  std::pair<RayPath, RayPath> out;
  out.first.degree = out.second.degree = path.degree;
  bernstein::split(path.control, path.degree, 0.5, out.first.control, out.second.control);
  return out;
}

RayPath mapped(const RayPath& path, const Affine3& map) {
  RayPath out;
  out.degree = path.degree;
  for (std::size_t k = 0; k <= static_cast<std::size_t>(path.degree); ++k) out.control[k] = map.point(path.control[k]);
  return out;
}

Box3 control_box(const RayPath& path) {
  Box3 box;
  for (std::size_t k = 0; k <= static_cast<std::size_t>(path.degree); ++k) box.add(path.control[k]);
  return box;
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double squared = dot(along, along);
  const double s = squared > 0.0 ? std::clamp(dot(p - a, along) / squared, 0.0, 1.0) : 0.0;
  return length(p - (a + s * along));
}

RaySegment enclosing_segment(const RayPath& path, double travelled) {
  constexpr double rounding = 0x1p-47;
  const auto last = static_cast<std::size_t>(path.degree);
  RaySegment out{.a = path.control[0], .b = path.control[last]};
  out.travelled = travelled + length(out.b - out.a);
  for (std::size_t k = 1; k < last; ++k) {
    out.radius = std::max(out.radius, distance_to_segment(path.control[k], out.a, out.b));
  }
  out.radius += rounding * control_box(path).magnitude();
  return out;
}

double slack(const RayPath& path, const RaySegment& segment, int samples) {
  double largest = 0.0;
  for (int k = 0; k <= samples; ++k) {
    const Vec3 p = point(path, static_cast<double>(k) / samples);
    largest = std::max(largest, distance_to_segment(p, segment.a, segment.b));
  }
  return segment.radius / largest;
}

}  // namespace xpr
