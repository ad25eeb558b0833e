#include "core/geometry/triangle_contact.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/bernstein.hpp"
#include "core/geometry/path_envelope.hpp"
#include "integrators/root.hpp"

namespace xpr {
namespace {

using Coefficients = std::array<double, bernstein::most_coefficients>;

/// The coordinate that is left out when a triangle is looked at along the axis nearest to its normal, and the sign of
/// the area that is seen then.
struct Facing {
  std::size_t u, v;
  double sign;
};
[[nodiscard]] Facing facing(const Vec3& normal) {
  const double x = std::fabs(normal.x), y = std::fabs(normal.y), z = std::fabs(normal.z);
  if (x >= y && x >= z) return {1, 2, normal.x < 0.0 ? -1.0 : 1.0};
  if (y >= z) return {2, 0, normal.y < 0.0 ? -1.0 : 1.0};
  return {0, 1, normal.z < 0.0 ? -1.0 : 1.0};
}

/// Twice the area of (a, b, p) as seen, positive for p inside of the edge ab.
[[nodiscard]] double edge_value(const Facing& f, const Vec3& a, const Vec3& b, const Vec3& p) {
  return f.sign * ((b[f.u] - a[f.u]) * (p[f.v] - a[f.v]) - (b[f.v] - a[f.v]) * (p[f.u] - a[f.u]));
}

/// A stretch of theta with polynomials written for it.
template <std::size_t N>
struct Stretch {
  double lo, hi;
  std::array<Coefficients, N> c;
};

/// Stretches that are still to be looked at, the first on top: halving puts two back for one, so that a stack as deep
/// as theta has bits never overflows.
template <std::size_t N>
class Stretches {
 public:
  static constexpr double least_width = 0x1p-50;

  Stretches(const Stretch<N>& whole, int degree) : degree_(degree) { stack_[top_++] = whole; }
  [[nodiscard]] bool empty() const { return top_ == 0; }
  [[nodiscard]] Stretch<N> take() { return stack_[--top_]; }
  void put_halves(const Stretch<N>& s) {
    const double middle = 0.5 * (s.lo + s.hi);
    Stretch<N>& second = stack_[top_++];
    Stretch<N>& first = stack_[top_++];
    for (std::size_t i = 0; i < N; ++i) bernstein::split(s.c[i], degree_, 0.5, first.c[i], second.c[i]);
    first.lo = s.lo;
    first.hi = second.lo = middle;
    second.hi = s.hi;
  }

 private:
  std::array<Stretch<N>, 64> stack_;
  std::size_t top_ = 0;
  int degree_;
};

/// A triangle as one path sees it.
class TriangleOnPath {
 public:
  TriangleOnPath(const RayPath& path, const std::array<Vec3, 3>& corners, double rounding)
      : path_(path), v_(corners), rounding_(rounding), count_(static_cast<std::size_t>(path.degree) + 1) {
    const Vec3 e1 = v_[1] - v_[0], e2 = v_[2] - v_[0];
    const Vec3 normal = cross(e1, e2);
    band_ = rounding_ * largest_magnitude(e1) * largest_magnitude(e2);
    for (std::size_t k = 0; k < count_; ++k) plane_[k] = dot(normal, path_.control[k] - v_[0]);
    facing_ = facing(normal);
  }

  [[nodiscard]] std::optional<PathContact> first_contact() {
    if (one_side(plane_)) return std::nullopt;
    if (beyond_an_edge()) return std::nullopt;
    if (within_band(plane_)) {
      const std::optional<double> at = first_inside(0.0, 1.0);
      return at ? std::optional<PathContact>({*at, Contact::in_plane}) : std::nullopt;
    }
    if (crosses_once(plane_)) return at_crossing(0.0, 1.0);
    return among_stretches();
  }

 private:
  [[nodiscard]] bool one_side(const Coefficients& c) const {
    bool above = true, below = true;
    for (std::size_t k = 0; k < count_; ++k) {
      above = above && c[k] > band_;
      below = below && c[k] < -band_;
    }
    return above || below;
  }
  [[nodiscard]] bool within_band(const Coefficients& c) const {
    return std::all_of(c.begin(), c.begin() + static_cast<std::ptrdiff_t>(count_),
                       [&](double value) { return std::fabs(value) <= band_; });
  }
  /// The ends lie clearly on two sides, and coefficients change sign once: one root.
  [[nodiscard]] bool crosses_once(const Coefficients& c) const {
    const double first = c[0], last = c[count_ - 1];
    if (!(std::min(first, last) < -band_ && std::max(first, last) > band_)) return false;
    int changes = 0;
    bool negative = first < 0.0;
    for (std::size_t k = 1; k < count_; ++k) {
      if (c[k] == 0.0 || (c[k] < 0.0) == negative) continue;
      negative = !negative;
      ++changes;
    }
    return changes == 1;
  }

  /// The edges' functions along the path, each with how far it may be below zero; the path as a whole outside of one
  /// misses the triangle.
  [[nodiscard]] bool beyond_an_edge() {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& a = v_[i];
      const Vec3& b = v_[(i + 1) % 3];
      allowance_[i] = rounding_ * (std::fabs(b[facing_.u] - a[facing_.u]) + std::fabs(b[facing_.v] - a[facing_.v]));
      bool outside = true;
      for (std::size_t k = 0; k < count_; ++k) {
        edge_[i][k] = edge_value(facing_, a, b, path_.control[k]);
        outside = outside && edge_[i][k] < -2.0 * allowance_[i];
      }
      if (outside) return true;
    }
    return false;
  }

  [[nodiscard]] double plane_at(double theta) const { return bernstein::value(plane_, path_.degree, theta); }
  [[nodiscard]] double edge_at(std::size_t i, double theta) const {
    return bernstein::value(edge_[i], path_.degree, theta);
  }

  [[nodiscard]] bool inside_at(double theta) const {
    for (std::size_t i = 0; i < 3; ++i) {
      if (edge_at(i, theta) < -allowance_[i]) return false;
    }
    return box().contains(point(path_, theta));
  }
  [[nodiscard]] Box3 box() const {
    Box3 box;
    for (const Vec3& p : v_) box.add(p);
    return box.grown(2.0 * rounding_);
  }

  /// The first parameter in [lo, hi] at which the path is inside of all edges, widened, and of the box.
  [[nodiscard]] std::optional<double> first_inside(double lo, double hi) const {
    Stretch<9> whole{lo, hi, {}};
    const Box3 limits = box();
    for (std::size_t k = 0; k < count_; ++k) {
      for (std::size_t i = 0; i < 3; ++i) {
        whole.c[i][k] = edge_[i][k] + allowance_[i];
        whole.c[3 + i][k] = path_.control[k][i] - limits.lo[i];
        whole.c[6 + i][k] = limits.hi[i] - path_.control[k][i];
      }
    }
    for (Coefficients& c : whole.c) c = bernstein::restricted(c, path_.degree, lo, hi);
    Stretches<9> stretches(whole, path_.degree);
    while (!stretches.empty()) {
      const Stretch<9> s = stretches.take();
      const auto negative = [&](const Coefficients& c) {
        return std::all_of(c.begin(), c.begin() + static_cast<std::ptrdiff_t>(count_),
                           [](double v) { return v < 0.0; });
      };
      if (std::any_of(s.c.begin(), s.c.end(), negative)) continue;
      if (std::all_of(s.c.begin(), s.c.end(), [](const Coefficients& c) { return c[0] >= 0.0; })) return s.lo;
      if (s.hi - s.lo > Stretches<9>::least_width) stretches.put_halves(s);
    }
    return std::nullopt;
  }

  /// The root between lo and hi, where the plane's coefficients change sign once.
  [[nodiscard]] std::optional<PathContact> at_crossing(double lo, double hi) const {
    const double at_lo = plane_at(lo), at_hi = plane_at(hi);
    // The halved coefficients may have told other signs within rounding: the end that is nearer to the plane then.
    const double root = (at_lo < 0.0) != (at_hi < 0.0)
                            ? bracketed_root([&](double theta) { return plane_at(theta); }, lo, hi, at_lo, at_hi)
                        : std::fabs(at_lo) < std::fabs(at_hi) ? lo
                                                              : hi;
    if (inside_at(root)) return PathContact{root, Contact::crossing};
    const auto [first, last] = indistinguishable(root);
    if (last - first < 0x1p-30) {
      // So short that edges' functions, of degree 7 at most, are linear to far below their allowance.
      for (std::size_t i = 0; i < 3; ++i) {
        const double most = std::max({edge_at(i, first), edge_at(i, root), edge_at(i, last)});
        if (most < -2.0 * allowance_[i]) return std::nullopt;
      }
    }
    const std::optional<double> at = first_inside(first, last);
    return at ? std::optional<PathContact>({*at, Contact::crossing}) : std::nullopt;
  }

  /// Around a root: so far the plane's polynomial stays within twice its band (twice, so that beginning at the band's
  /// very edge leads through it).
  [[nodiscard]] std::pair<double, double> indistinguishable(double root) const {
    const double slope = path_.degree == 1
                             ? plane_[1] - plane_[0]
                             : bernstein::value(bernstein::derivative(plane_, path_.degree), path_.degree - 1, root);
    // For a root that is nearly multiple the slope tells nothing: begin at the last place of theta.
    const double limit = 2.0 * band_;
    const double linear = limit / std::fabs(slope) + 0x1p-52;
    const auto reach = [&](double direction) {
      double width = linear < 0x1p-36 ? linear : 0x1p-52;
      while (width < 1.0 && std::fabs(plane_at(std::clamp(root + direction * width, 0.0, 1.0))) <= limit) width *= 2.0;
      return std::clamp(root + direction * width, 0.0, 1.0);
    };
    return {reach(-1.0), reach(1.0)};
  }

  /// Several roots, roots that are not crossings, or an end on the plane.
  [[nodiscard]] std::optional<PathContact> among_stretches() const {
    Stretches<1> stretches({0.0, 1.0, {plane_}}, path_.degree);
    while (!stretches.empty()) {
      const Stretch<1> s = stretches.take();
      if (one_side(s.c[0])) continue;
      if (within_band(s.c[0]) || s.hi - s.lo <= Stretches<1>::least_width) {
        if (const std::optional<PathContact> contact = near_plane(s.lo, s.hi)) return contact;
      } else if (crosses_once(s.c[0])) {
        if (const std::optional<PathContact> contact = at_crossing(s.lo, s.hi)) return contact;
      } else {
        stretches.put_halves(s);
      }
    }
    return std::nullopt;
  }

  /// In and around a stretch within the band: where the path is nearest to the plane.
  [[nodiscard]] std::optional<PathContact> near_plane(double lo, double hi) const {
    const double first = indistinguishable(lo).first, last = indistinguishable(hi).second;
    const double at_first = plane_at(first), at_last = plane_at(last);
    const bool crosses = std::min(at_first, at_last) < -band_ && std::max(at_first, at_last) > band_;
    const Contact kind = crosses ? Contact::crossing : Contact::touching;
    // A point that is only touched lies in the middle; one that the path ends at, at the end.
    double nearest = 0.5 * (first + last);
    if ((at_first < 0.0) != (at_last < 0.0)) {
      nearest = bracketed_root([&](double theta) { return plane_at(theta); }, first, last, at_first, at_last);
    }
    for (const double end : {first, last}) {
      if (std::fabs(plane_at(end)) < std::fabs(plane_at(nearest))) nearest = end;
    }
    if (inside_at(nearest)) return PathContact{nearest, kind};
    const std::optional<double> at = first_inside(first, last);
    return at ? std::optional<PathContact>({*at, kind}) : std::nullopt;
  }

  const RayPath& path_;
  const std::array<Vec3, 3>& v_;
  double rounding_;
  std::size_t count_;
  double band_ = 0.0;
  Coefficients plane_{};
  Facing facing_{};
  std::array<Coefficients, 3> edge_{};
  std::array<double, 3> allowance_{};
};

}  // namespace

std::optional<PathContact> first_contact(const RayPath& path, const std::array<Vec3, 3>& corners, double rounding) {
  return TriangleOnPath(path, corners, rounding).first_contact();
}

std::array<double, 3> barycentric_at(const std::array<Vec3, 3>& corners, const Vec3& p) {
  const Facing f = facing(cross(corners[1] - corners[0], corners[2] - corners[0]));
  std::array<double, 3> b;
  for (std::size_t i = 0; i < 3; ++i) {
    b[i] = std::max(0.0, edge_value(f, corners[(i + 1) % 3], corners[(i + 2) % 3], p));
  }
  const double sum = b[0] + b[1] + b[2];
  return {b[0] / sum, b[1] / sum, b[2] / sum};
}

}  // namespace xpr
