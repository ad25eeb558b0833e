#include "core/film/dense_path.hpp"

#include <algorithm>
#include <array>

namespace xpr {
namespace {

constexpr int most = RayPath::max_degree;
using Row = std::array<double, most + 1>;
using Basis = std::array<Row, most + 1>;

/// Nodes that are dense at the ends: 0, 1 and, between, 1/2 (1 - cos(k pi / n)) to a few digits, which do.
double node(int k, int n) {
  constexpr std::array<double, 4> of_seven{0.0, 0.05, 0.19, 0.39};
  if (n != most) return static_cast<double>(k) / n;
  return k < 4 ? of_seven[static_cast<std::size_t>(k)] : 1.0 - of_seven[static_cast<std::size_t>(n - k)];
}

/// The Bernstein polynomials of degree n at theta.
Row bernstein(int n, double theta) {
  Row b{};
  b[0] = 1.0;
  for (int j = 1; j <= n; ++j) {
    for (int k = j; k >= 0; --k) {
      const auto at = static_cast<std::size_t>(k);
      b[at] = (k < j ? (1.0 - theta) * b[at] : 0.0) + (k > 0 ? theta * b[at - 1] : 0.0);
    }
  }
  return b;
}

/// From values at the nodes to control points: the inverse of the Bernstein polynomials there, by Gauss-Jordan with
/// pivots.
Basis make_controls(int n) {
  Basis a{}, inverse{};
  const auto size = static_cast<std::size_t>(n) + 1;
  for (std::size_t i = 0; i < size; ++i) {
    a[i] = bernstein(n, node(static_cast<int>(i), n));
    inverse[i][i] = 1.0;
  }
  for (std::size_t c = 0; c < size; ++c) {
    std::size_t pivot = c;
    for (std::size_t i = c; i < size; ++i) {
      if (std::abs(a[i][c]) > std::abs(a[pivot][c])) pivot = i;
    }
    std::swap(a[c], a[pivot]);
    std::swap(inverse[c], inverse[pivot]);
    const double scale = 1.0 / a[c][c];
    for (std::size_t k = 0; k < size; ++k) {
      a[c][k] *= scale;
      inverse[c][k] *= scale;
    }
    for (std::size_t i = 0; i < size; ++i) {
      if (i == c) continue;
      const double factor = a[i][c];
      for (std::size_t k = 0; k < size; ++k) {
        a[i][k] -= factor * a[c][k];
        inverse[i][k] -= factor * inverse[c][k];
      }
    }
  }
  return inverse;
}

const Basis& controls(int n) {
  static const std::array<Basis, 3> known{make_controls(3), make_controls(4), make_controls(most)};
  return known[n == 3 ? 0 : n == 4 ? 1 : 2];
}

Vec3 place(const StepView& step, const SceneMap& map, const PhaseState<double>& y) {
  return map ? map(y.x(), step.sheet) : Vec3{y[1], y[2], y[3]};
}

Vec3 place(const StepView& step, const SceneMap& map, double theta) {
  // The ends are the step's own: pieces of neighbouring steps meet.
  if (theta <= 0.0) return place(step, map, step.begin);
  if (theta >= 1.0) return place(step, map, step.end);
  return place(step, map, step.at(theta));
}

/// The polynomial of degree n through the path's points at the nodes between two fractions of the step.
RayPath through_nodes(const StepView& step, const SceneMap& map, int n, double from, double to) {
  std::array<Vec3, most + 1> value{};
  RayPath path{.degree = n, .control = {}};
  for (int k = 0; k <= n; ++k) {
    const double theta = k == n ? to : from + (to - from) * node(k, n);
    value[static_cast<std::size_t>(k)] = place(step, map, theta);
  }
  const Basis& matrix = controls(n);
  for (std::size_t i = 0; i <= static_cast<std::size_t>(n); ++i) {
    for (std::size_t k = 0; k <= static_cast<std::size_t>(n); ++k) {
      path.control[i] = path.control[i] + matrix[i][k] * value[k];
    }
  }
  path.control[0] = value[0];
  path.control[static_cast<std::size_t>(n)] = value[static_cast<std::size_t>(n)];
  return path;
}

Vec3 point_of(const RayPath& path, double theta) {
  const Row b = bernstein(path.degree, theta);
  Vec3 out;
  for (std::size_t k = 0; k <= static_cast<std::size_t>(path.degree); ++k) out = out + b[k] * path.control[k];
  return out;
}

/// Whether the piece follows the mapped path where it was not made to: between the nodes, where it is farthest off.
bool follows(const StepView& step, const SceneMap& map, const RayPath& path, double from, double to, double accuracy) {
  for (const double theta : {0.02, 0.28, 0.5, 0.72, 0.98}) {
    const Vec3 there = place(step, map, from + (to - from) * theta);
    if (!(length(point_of(path, theta) - there) <= accuracy)) return false;
  }
  return true;
}

}  // namespace

std::vector<RayPath> dense_path(const StepView& step, const SceneMap& map, double accuracy) {
  const int own = std::clamp(step.stepper.card().dense_order, 3, most);
  if (!map) return {through_nodes(step, map, own == 3 || own == 4 ? own : most, 0.0, 1.0)};
  constexpr int most_pieces = 64;
  for (int pieces = 1;; pieces *= 2) {
    std::vector<RayPath> out;
    bool good = true;
    for (int k = 0; k < pieces && (good || pieces == most_pieces); ++k) {
      const double from = static_cast<double>(k) / pieces, to = static_cast<double>(k + 1) / pieces;
      out.push_back(through_nodes(step, map, most, from, to));
      good = good && follows(step, map, out.back(), from, to, accuracy);
    }
    if (good || pieces == most_pieces) return out;
  }
}

}  // namespace xpr
