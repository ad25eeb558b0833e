#include "core/geometry/triangle_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

namespace xpr {
namespace {

/// Whether the least height is within rounding of the corners' coordinates.
[[nodiscard]] bool has_no_plane(const std::array<Vec3, 3>& v) {
  const Vec3 sides[3] = {v[1] - v[0], v[2] - v[1], v[0] - v[2]};
  const double longest = std::max({length(sides[0]), length(sides[1]), length(sides[2])});
  double magnitude = 0.0;
  for (const Vec3& p : v) magnitude = std::max(magnitude, largest_magnitude(p));
  // The corner opposite the longest side is where the cross product loses least.
  const std::size_t opposite = length(sides[0]) == longest ? 2 : length(sides[1]) == longest ? 0 : 1;
  const double area =
      length(cross(v[(opposite + 1) % 3] - v[opposite], v[(opposite + 2) % 3] - v[opposite]));  // twice of it
  constexpr double rounding = 0x1p-50;  // 8 units of rounding: three for each corner's coordinates
  return !(area > longest * rounding * magnitude) || !(area > 0.0);
}

}  // namespace

void TriangleMesh::validate() const {
  const auto fail = [&](const std::string& what) { throw std::invalid_argument(name + ": " + what); };
  constexpr std::size_t most = std::size_t{1} << 31;
  if (triangles.size() > most) fail(fmt::format("{} triangles, at most {} do", triangles.size(), most));
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const std::uint32_t corner : triangles[t]) {
      if (corner >= vertices.size()) {
        fail(fmt::format("triangle {} has the corner {}, vertices are 0 to {}", t, corner,
                         static_cast<std::int64_t>(vertices.size()) - 1));
      }
    }
  }
  if (!normals.empty() && normals.size() != vertices.size()) {
    fail(fmt::format("{} normals for {} vertices", normals.size(), vertices.size()));
  }
  if (!uv.empty() && uv.size() != vertices.size())
    fail(fmt::format("{} uv for {} vertices", uv.size(), vertices.size()));
  if (!materials.empty() && materials.size() != triangles.size()) {
    fail(fmt::format("{} materials for {} triangles", materials.size(), triangles.size()));
  }
}

Box3 TriangleMesh::bounds() const {
  Box3 box;
  for (const auto& t : triangles) {
    for (const std::uint32_t corner : t) box.add(vertices[corner]);
  }
  return box;
}

std::string MeshDefects::text(const std::string& mesh_name) const {
  if (!any()) return "";
  std::string out =
      fmt::format("{}: {} of {} triangles dropped: ", mesh_name, not_finite.size() + degenerate.size(), triangles);
  if (!not_finite.empty()) {
    out += fmt::format("{} with a corner that is not finite (first: triangle {}, vertex {})", not_finite.size(),
                       not_finite.front(), first_bad_vertex);
  }
  if (!not_finite.empty() && !degenerate.empty()) out += ", ";
  if (!degenerate.empty()) {
    out += fmt::format("{} without area (first: triangle {})", degenerate.size(), degenerate.front());
  }
  return out;
}

MeshDefects drop_defects(TriangleMesh& mesh) {
  mesh.validate();
  MeshDefects found;
  found.triangles = mesh.triangles.size();
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::array<Vec3, 3> v = mesh.corners(t);
    const auto bad = std::find_if_not(v.begin(), v.end(), [](const Vec3& p) { return is_finite(p); });
    if (bad != v.end()) {
      if (found.not_finite.empty()) {
        found.first_bad_vertex = mesh.triangles[t][static_cast<std::size_t>(bad - v.begin())];
      }
      found.not_finite.push_back(static_cast<std::uint32_t>(t));
    } else if (has_no_plane(v)) {
      found.degenerate.push_back(static_cast<std::uint32_t>(t));
    } else {
      mesh.triangles[kept] = mesh.triangles[t];
      if (!mesh.materials.empty()) mesh.materials[kept] = mesh.materials[t];
      ++kept;
    }
  }
  mesh.triangles.resize(kept);
  if (!mesh.materials.empty()) mesh.materials.resize(kept);
  return found;
}

std::size_t open_edges(const TriangleMesh& mesh) {
  using Place = std::array<double, 3>;
  // -0 and +0 are one place.
  const auto place = [&](std::uint32_t i) {
    const Vec3& p = mesh.vertices[i];
    return Place{p.x + 0.0, p.y + 0.0, p.z + 0.0};
  };
  std::map<Place, std::uint32_t> known;
  std::vector<std::uint32_t> id(mesh.vertices.size());
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t corner : t) {
      id[corner] = known.try_emplace(place(corner), static_cast<std::uint32_t>(known.size())).first->second;
    }
  }
  // How often an edge is run through from its lesser to its greater end, less how often back.
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = id[t[k]], to = id[t[(k + 1) % 3]];
      if (from != to) balance[{std::min(from, to), std::max(from, to)}] += from < to ? 1 : -1;
    }
  }
  return static_cast<std::size_t>(
      std::count_if(balance.begin(), balance.end(), [](const auto& edge) { return edge.second != 0; }));
}

}  // namespace xpr
