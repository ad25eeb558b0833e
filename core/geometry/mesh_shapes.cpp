#include "core/geometry/mesh_shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "metrics/scalar/elementary.hpp"

namespace xpr {
namespace {

constexpr double pi = 3.141592653589793;
constexpr double most_triangles = 0x1p24;

[[nodiscard]] std::uint32_t index_of(std::size_t i) { return static_cast<std::uint32_t>(i); }

/// The values of one shape's parameters, checked as they are read.
class Values {
 public:
  Values(const MeshShape& shape, std::span<const NamedValue> given) : shape_(shape) {
    for (const ParameterCard& card : shape.parameters) values_.push_back(card.fallback);
    for (const NamedValue& one : given) values_[place(one.name)] = one.value;
  }
  [[nodiscard]] double number(std::string_view name) const {
    const double value = values_[place(name)];
    if (!std::isfinite(value)) fail(name, value, "a finite number");
    return value;
  }
  [[nodiscard]] double size(std::string_view name) const {
    const double value = number(name);
    if (!(value > 0.0)) fail(name, value, "> 0");
    return value;
  }
  [[nodiscard]] std::size_t count(std::string_view name, int least, int most) const {
    const double value = number(name);
    if (!(value >= least && value <= most) || value != std::floor(value)) {
      fail(name, value, fmt::format("a whole number from {} to {}", least, most));
    }
    return static_cast<std::size_t>(value);
  }
  /// Throws where a shape of so many triangles is too large.
  void limit(double triangles) const {
    if (triangles > most_triangles) {
      throw std::invalid_argument(
          fmt::format("{}: {} triangles, at most {} do", shape_.key, triangles, most_triangles));
    }
  }

 private:
  [[nodiscard]] std::size_t place(std::string_view name) const {
    std::vector<std::string_view> known;
    for (const ParameterCard& card : shape_.parameters) known.push_back(card.name);
    const auto at = std::find(known.begin(), known.end(), name);
    if (at != known.end()) return static_cast<std::size_t>(at - known.begin());
    const std::string near = nearest_name(name, known);
    throw std::invalid_argument(fmt::format("{} has no parameter '{}'{}", shape_.key, name,
                                            near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
  }
  [[noreturn]] void fail(std::string_view name, double value, const std::string& needs) const {
    throw std::invalid_argument(fmt::format("{}: {} = {}, needs {}", shape_.key, name, value, needs));
  }

  const MeshShape& shape_;
  std::vector<double> values_;
};

/// Normals at the vertices: those of the triangles around, by area.
void smooth_normals(TriangleMesh& mesh) {
  mesh.normals.assign(mesh.vertices.size(), {});
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.corners(t);
    const Vec3 normal = cross(b - a, c - a);
    for (const std::uint32_t corner : mesh.triangles[t]) mesh.normals[corner] = mesh.normals[corner] + normal;
  }
  for (Vec3& n : mesh.normals) n = normalized(n);
}

/// Two triangles for the patch a b c d, seen counter-clockwise from outside.
void add_patch(TriangleMesh& mesh, std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
  mesh.triangles.push_back({index_of(a), index_of(b), index_of(c)});
  mesh.triangles.push_back({index_of(a), index_of(c), index_of(d)});
}

TriangleMesh plane(const Values& values) {
  const double x = 0.5 * values.size("width"), y = 0.5 * values.size("height");
  TriangleMesh mesh;
  mesh.vertices = {{-x, -y, 0.0}, {x, -y, 0.0}, {x, y, 0.0}, {-x, y, 0.0}};
  mesh.uv = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
  add_patch(mesh, 0, 1, 2, 3);
  return mesh;
}

/// Each face has corners of its own, for uv; faces share places, so that the box is closed.
TriangleMesh box(const Values& values) {
  const Vec3 half{0.5 * values.size("width"), 0.5 * values.size("height"), 0.5 * values.size("depth")};
  TriangleMesh mesh;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const std::size_t first = mesh.vertices.size();
      const std::size_t right = (axis + (side > 0.0 ? 1 : 2)) % 3, up = (axis + (side > 0.0 ? 2 : 1)) % 3;
      for (const auto& [u, v] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) {
        Vec3 p;
        p[axis] = side * half[axis];
        p[right] = (2.0 * u - 1.0) * half[right];
        p[up] = (2.0 * v - 1.0) * half[up];
        mesh.vertices.push_back(p);
        mesh.uv.push_back({u, v});
      }
      add_patch(mesh, first, first + 1, first + 2, first + 3);
    }
  }
  return mesh;
}

/// Poles on the z axis. The seam has its vertices twice, at the same places, for uv.
TriangleMesh uv_sphere(const Values& values) {
  const double radius = values.size("radius");
  const std::size_t rings = values.count("rings", 2, 4096), segments = values.count("segments", 3, 8192);
  values.limit(2.0 * static_cast<double>(rings) * static_cast<double>(segments));
  TriangleMesh mesh;
  for (std::size_t ring = 0; ring <= rings; ++ring) {
    const double v = static_cast<double>(ring) / static_cast<double>(rings);
    const bool pole = ring == 0 || ring == rings;
    const auto [z_sine, z] = sincos(pi * v);
    for (std::size_t segment = 0; segment <= segments; ++segment) {
      const double u = static_cast<double>(segment) / static_cast<double>(segments);
      const auto [sine, cosine] =
          sincos(2.0 * pi * static_cast<double>(segment % segments) / static_cast<double>(segments));
      const Vec3 n = pole ? Vec3{0.0, 0.0, ring == 0 ? 1.0 : -1.0} : Vec3{z_sine * cosine, z_sine * sine, z};
      mesh.normals.push_back(n);
      mesh.vertices.push_back(radius * n);
      mesh.uv.push_back({u, 1.0 - v});
    }
  }
  const std::size_t row = segments + 1;
  for (std::size_t ring = 0; ring < rings; ++ring) {
    for (std::size_t segment = 0; segment < segments; ++segment) {
      const std::size_t a = ring * row + segment, b = a + row;
      if (ring + 1 < rings) mesh.triangles.push_back({index_of(a), index_of(b), index_of(b + 1)});
      if (ring + 1 == rings) mesh.triangles.push_back({index_of(a), index_of(b), index_of(a + 1)});
      if (ring > 0 && ring + 1 < rings) mesh.triangles.push_back({index_of(a), index_of(b + 1), index_of(a + 1)});
    }
  }
  return mesh;
}

/// The unit icosahedron with each triangle parted into four, `level` times.
TriangleMesh unit_ico_sphere(std::size_t level) {
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  TriangleMesh mesh;
  mesh.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (Vec3& p : mesh.vertices) p = normalized(p);
  for (std::size_t step = 0; step < level; ++step) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), index_of(mesh.vertices.size()));
      if (is_new) mesh.vertices.push_back(normalized(mesh.vertices[a] + mesh.vertices[b]));
      return at->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    finer.reserve(4 * mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

TriangleMesh ico_sphere(const Values& values) {
  TriangleMesh mesh = unit_ico_sphere(values.count("level", 0, 9));
  mesh.normals = mesh.vertices;
  const double radius = values.size("radius");
  for (Vec3& p : mesh.vertices) p = radius * p;
  return mesh;
}

/// Waves of three wavelengths; in [-1, 1].
[[nodiscard]] double waves(const Vec3& p) {
  return (sin(3.0 * p.x + 1.0) * sin(3.0 * p.y + 2.0) * sin(3.0 * p.z) +
          0.5 * sin(9.0 * p.x) * sin(9.0 * p.y + 1.0) * sin(9.0 * p.z + 2.0) +
          0.25 * sin(27.0 * p.x + 2.0) * sin(27.0 * p.y) * sin(27.0 * p.z + 1.0)) /
         1.75;
}

TriangleMesh displaced_sphere(const Values& values) {
  const double radius = values.size("radius"), amplitude = values.number("amplitude");
  if (!(std::fabs(amplitude) < 1.0))
    throw std::invalid_argument(fmt::format("displaced-sphere: amplitude = {}, needs |amplitude| < 1", amplitude));
  TriangleMesh mesh = unit_ico_sphere(values.count("level", 0, 9));
  for (Vec3& p : mesh.vertices) p = radius * (1.0 + amplitude * waves(2.0 * p)) * p;
  smooth_normals(mesh);
  return mesh;
}

/// A tube around a curve that winds p times around the z axis and q times around a torus's circle. The torus's own
/// normal stands across the curve everywhere and serves as the tube's frame, which closes of itself.
TriangleMesh torus_knot(const Values& values) {
  const double major = values.size("radius"), minor = values.size("torus"), tube = values.size("tube");
  const auto p = static_cast<double>(values.count("p", 1, 64)), q = static_cast<double>(values.count("q", 1, 64));
  const std::size_t segments = values.count("segments", 3, 65536), sides = values.count("sides", 3, 4096);
  values.limit(2.0 * static_cast<double>(segments) * static_cast<double>(sides));
  TriangleMesh mesh;
  for (std::size_t s = 0; s < segments; ++s) {
    const double t = 2.0 * pi * static_cast<double>(s) / static_cast<double>(segments);
    const auto [sp, cp] = sincos(p * t);
    const auto [sq, cq] = sincos(q * t);
    const double reach = major + minor * cq;
    const Vec3 centre{reach * cp, reach * sp, minor * sq};
    const Vec3 normal{cq * cp, cq * sp, sq};
    const Vec3 tangent{-minor * q * sq * cp - reach * p * sp, -minor * q * sq * sp + reach * p * cp, minor * q * cq};
    const Vec3 across = normalized(cross(tangent, normal));
    for (std::size_t k = 0; k < sides; ++k) {
      const auto [sine, cosine] = sincos(2.0 * pi * static_cast<double>(k) / static_cast<double>(sides));
      const Vec3 out = cosine * normal + sine * across;
      mesh.normals.push_back(out);
      mesh.vertices.push_back(centre + tube * out);
    }
  }
  for (std::size_t s = 0; s < segments; ++s) {
    for (std::size_t k = 0; k < sides; ++k) {
      const std::size_t here = s * sides, there = (s + 1) % segments * sides, next = (k + 1) % sides;
      add_patch(mesh, here + k, here + next, there + next, there + k);
    }
  }
  return mesh;
}

TriangleMesh terrain(const Values& values) {
  const double size = values.size("size"), height = values.number("height");
  const std::size_t cells = values.count("cells", 1, 2896);
  TriangleMesh mesh;
  const std::size_t row = cells + 1;
  for (std::size_t j = 0; j < row; ++j) {
    for (std::size_t i = 0; i < row; ++i) {
      const double u = static_cast<double>(i) / static_cast<double>(cells);
      const double v = static_cast<double>(j) / static_cast<double>(cells);
      mesh.vertices.push_back({size * (u - 0.5), size * (v - 0.5), height * waves({4.0 * u, 4.0 * v, 1.0})});
      mesh.uv.push_back({u, v});
    }
  }
  for (std::size_t j = 0; j < cells; ++j) {
    for (std::size_t i = 0; i < cells; ++i) {
      const std::size_t a = j * row + i;
      add_patch(mesh, a, a + 1, a + row + 1, a + row);
    }
  }
  smooth_normals(mesh);
  return mesh;
}

/// A shape's card beside the function that makes it.
struct Maker {
  MeshShape shape;
  TriangleMesh (*make)(const Values&);
};

const std::vector<Maker>& makers() {
  static const std::vector<Maker> list{
      {{"plane", "a rectangle in z = 0, outside towards +z", {{"width", 1.0, "along x"}, {"height", 1.0, "along y"}}},
       plane},
      {{"box",
        "a box around the origin",
        {{"width", 1.0, "along x"}, {"height", 1.0, "along y"}, {"depth", 1.0, "along z"}}},
       box},
      {{"uv-sphere",
        "a sphere by latitude and longitude, poles on the z axis",
        {{"radius", 1.0, "of the vertices"}, {"rings", 32.0, "from pole to pole"}, {"segments", 64.0, "around"}}},
       uv_sphere},
      {{"ico-sphere",
        "a sphere of nearly equal triangles, 20 x 4^level of them",
        {{"radius", 1.0, "of the vertices"}, {"level", 3.0, "0 to 9"}}},
       ico_sphere},
      {{"displaced-sphere",
        "a sphere with hills, 327,680 triangles at level 7",
        {{"radius", 1.0, "before the hills"},
         {"amplitude", 0.15, "of the hills, relative to the radius"},
         {"level", 7.0, "20 x 4^level triangles, 0 to 9"}}},
       displaced_sphere},
      {{"torus-knot",
        "a closed tube on a torus, 204,800 triangles",
        {{"radius", 1.0, "of the torus's circle"},
         {"torus", 0.4, "radius of the torus's tube, that the knot lies on"},
         {"tube", 0.12, "radius of the knot's own tube"},
         {"p", 2.0, "turns around the z axis"},
         {"q", 3.0, "turns around the circle"},
         {"segments", 1600.0, "along the knot"},
         {"sides", 64.0, "around it"}}},
       torus_knot},
      {{"terrain",
        "hills over a square in z = 0, 204,800 triangles",
        {{"size", 1.0, "of the square"}, {"height", 0.1, "of the hills"}, {"cells", 320.0, "along a side"}}},
       terrain},
  };
  return list;
}

}  // namespace

const std::vector<MeshShape>& mesh_shapes() {
  static const std::vector<MeshShape> shapes = [] {
    std::vector<MeshShape> out;
    for (const Maker& maker : makers()) out.push_back(maker.shape);
    return out;
  }();
  return shapes;
}

TriangleMesh generate_mesh(std::string_view key, std::span<const NamedValue> values) {
  std::vector<std::string_view> known;
  for (const Maker& maker : makers()) {
    known.push_back(maker.shape.key);
    if (maker.shape.key != key) continue;
    TriangleMesh mesh = maker.make(Values(maker.shape, values));
    mesh.name = key;
    return mesh;
  }
  const std::string near = nearest_name(key, known);
  throw std::invalid_argument(
      fmt::format("no shape is called '{}'{}", key, near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
}

}  // namespace xpr
