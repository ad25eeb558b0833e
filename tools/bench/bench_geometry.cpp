// Rays and curved paths through a knotted tube of 204,800 triangles, one core, CPU time.
//
//   bench_geometry --benchmark_counters_tabular=true
//
// build               both trees
// straight            rays/s, camera: a pinhole's grid (1), or random chords of a sphere around (0). Where Embree was
// found:
//                     its single-ray rate in the same run (ratio: Embree's over ours), hits that differ, and those
//                     among them that float error does not explain (no edge near, no grazing angle)
// curved              steps/s of degree 7, `length` percent of the mesh's size long
// far                 steps/s of such steps 20 sizes away
// agreement           1,000,000 random curved segments against 500 triangles, by trees and one after the other: hits,
// and
//                     segments on which the two differ in any bit
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>
#include <random>
#include <vector>

#include "core/geometry/mesh_shapes.hpp"
#include "core/geometry/scene_geometry.hpp"

#if defined(XPR_WITH_EMBREE)
#include <embree3/rtcore.h>
#endif

namespace xpr {
namespace {

class Draws {
 public:
  explicit Draws(std::uint64_t seed) : random_(seed) {}
  double uniform(double lo, double hi) { return lo + (hi - lo) * 0x1p-53 * static_cast<double>(random_() >> 11); }
  Vec3 in_cube(double half) { return {uniform(-half, half), uniform(-half, half), uniform(-half, half)}; }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = in_cube(1.0);
      if (dot(v, v) > 0.01 && dot(v, v) <= 1.0) return normalized(v);
    }
  }

 private:
  std::mt19937_64 random_;
};

GeometryModel knot(std::vector<NamedValue> values = {}) {
  GeometryModel model;
  model.meshes.push_back(std::make_shared<TriangleMesh>(generate_mesh("torus-knot", values)));
  model.instances.push_back({.mesh = 0, .to_world = {}, .owner = 0, .material = {}, .solid = false});
  return model;
}

const SceneGeometry& large() {
  static const std::unique_ptr<SceneGeometry> geometry = make_geometry(knot());
  return *geometry;
}

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <class F>
double seconds(const F& f) {
  const double begin = cpu_seconds();
  f();
  return cpu_seconds() - begin;
}

void build(benchmark::State& state) {
  const GeometryModel model = knot();
  double least = 1e300;
  for (auto _ : state) least = std::min(least, seconds([&] { benchmark::DoNotOptimize(make_geometry(model)); }));
  state.counters["triangles"] = static_cast<double>(large().triangle_count());
  state.counters["seconds"] = least;
}
BENCHMARK(build)->Unit(benchmark::kMillisecond);

std::vector<StraightRay> straight_rays(bool camera) {
  std::vector<StraightRay> rays;
  Draws draw(5);
  if (camera) {
    const Vec3 eye{0.5, -3.2, 1.6};
    const Vec3 ahead = normalized(-eye), right = normalized(cross(ahead, Vec3{0, 0, 1})), up = cross(right, ahead);
    for (int row = 0; row < 360; ++row) {
      for (int column = 0; column < 640; ++column) {
        const double u = (column + 0.5) / 320 - 1, v = 1 - (row + 0.5) / 180;
        rays.push_back({eye, normalized(ahead + (0.75 * u) * right + (0.42 * v) * up)});
      }
    }
  } else {
    for (int k = 0; k < 200'000; ++k) {
      const Vec3 from = 2.0 * draw.direction();
      rays.push_back({from, normalized(2.0 * draw.direction() - from)});
    }
  }
  return rays;
}

#if defined(XPR_WITH_EMBREE)
/// The same mesh in Embree, one thread, single rays.
class EmbreeScene {
 public:
  explicit EmbreeScene(const TriangleMesh& mesh)
      : device_(rtcNewDevice("threads=1,set_affinity=0")), scene_(rtcNewScene(device_)) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                 3 * sizeof(float), mesh.vertices.size()));
    for (const Vec3& p : mesh.vertices) {
      for (std::size_t axis = 0; axis < 3; ++axis) *vertices++ = static_cast<float>(p[axis]);
    }
    auto* corners = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                   3 * sizeof(unsigned), mesh.triangles.size()));
    for (const auto& t : mesh.triangles) corners = std::copy(t.begin(), t.end(), corners);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;
  ~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  /// The ray's parameter, infinite for a miss.
  [[nodiscard]] double first(const StraightRay& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{};
    query.ray.org_x = static_cast<float>(ray.origin.x);
    query.ray.org_y = static_cast<float>(ray.origin.y);
    query.ray.org_z = static_cast<float>(ray.origin.z);
    query.ray.dir_x = static_cast<float>(ray.direction.x);
    query.ray.dir_y = static_cast<float>(ray.direction.y);
    query.ray.dir_z = static_cast<float>(ray.direction.z);
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.mask = ~0U;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &query);
    return query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? Box3::infinity : static_cast<double>(query.ray.tfar);
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

void compare_with_embree(benchmark::State& state, const std::vector<StraightRay>& rays) {
  const EmbreeScene embree(*large().model().meshes[0]);
  double least = 1e300;
  for (int repeat = 0; repeat < 5; ++repeat) {
    least = std::min(least, seconds([&] {
                       for (const StraightRay& ray : rays) benchmark::DoNotOptimize(embree.first(ray));
                     }));
  }
  int differ = 0, unexplained = 0;
  for (const StraightRay& ray : rays) {
    const auto hit = large().first_hit(ray);
    const double ours = hit ? hit->theta : Box3::infinity, theirs = embree.first(ray);
    // Coordinates up to 4 in floats: 2.4e-7, over the cosine.
    const double cosine = hit ? std::fabs(dot(hit->geometric_normal, ray.direction)) : 0.0;
    if (ours == theirs || std::fabs(ours - theirs) < 2e-6 / std::max(cosine, 1e-3)) continue;
    ++differ;
    // The triangles' heights are 2e-3 to 1e-2.
    const double edge = hit ? std::min({hit->barycentric[0], hit->barycentric[1], hit->barycentric[2]}) : 0.0;
    if (edge > 1e-3 && cosine > 1e-3) ++unexplained;
  }
  const auto n = static_cast<double>(rays.size());
  state.counters["embree_rays/s"] = n / least;
  state.counters["ratio"] = n / least / state.counters["rays/s"].value;
  state.counters["differ"] = differ;
  state.counters["unexplained"] = unexplained;
}
#else
void compare_with_embree(benchmark::State&, const std::vector<StraightRay>&) {}
#endif

void straight(benchmark::State& state) {
  const std::vector<StraightRay> rays = straight_rays(state.range(0) == 1);
  const SceneGeometry& geometry = large();
  GeometryCounts counts;
  double least = 1e300;
  for (auto _ : state) {
    least = std::min(least, seconds([&] {
                       for (const StraightRay& ray : rays) benchmark::DoNotOptimize(geometry.first_hit(ray, &counts));
                     }));
  }
  const auto n = static_cast<double>(rays.size()), queries = static_cast<double>(counts.paths);
  state.counters["hit"] = static_cast<double>(counts.hits) / queries;
  state.counters["nodes"] = static_cast<double>(counts.nodes) / queries;
  state.counters["triangles"] = static_cast<double>(counts.triangles) / queries;
  state.counters["rays/s"] = n / least;
  compare_with_embree(state, rays);
}
BENCHMARK(straight)->ArgName("camera")->Arg(1)->Arg(0)->Unit(benchmark::kMillisecond);

/// Steps as a tracer takes them: degree 7, bent by a few percent of their length.
std::vector<RayPath> steps(double length, double where) {
  std::vector<RayPath> out;
  Draws draw(6);
  for (int k = 0; k < 50'000; ++k) {
    const Vec3 start = draw.in_cube(1.5) + Vec3{where, 0, 0}, along = length * draw.direction();
    const Vec3 bend = (length * draw.uniform(0.0, 0.05)) * draw.direction();
    RayPath path;
    path.degree = RayPath::max_degree;
    for (int i = 0; i <= path.degree; ++i) {
      const double s = static_cast<double>(i) / path.degree;
      path.control[static_cast<std::size_t>(i)] =
          start + s * along + (4 * s * (1 - s)) * bend + draw.in_cube(1e-3 * length);
    }
    out.push_back(path);
  }
  return out;
}

void count_steps(benchmark::State& state, const std::vector<RayPath>& paths) {
  GeometryCounts counts;
  double least = 1e300;
  for (auto _ : state) {
    least = std::min(least, seconds([&] {
                       for (const RayPath& path : paths) benchmark::DoNotOptimize(large().first_hit(path, &counts));
                     }));
  }
  const auto queries = static_cast<double>(counts.paths);
  state.counters["hit"] = static_cast<double>(counts.hits) / queries;
  state.counters["pieces"] = static_cast<double>(counts.pieces) / queries;
  state.counters["nodes"] = static_cast<double>(counts.nodes) / queries;
  state.counters["triangles"] = static_cast<double>(counts.triangles) / queries;
  state.counters["steps/s"] = static_cast<double>(paths.size()) / least;
}

void curved(benchmark::State& state) { count_steps(state, steps(0.03 * static_cast<double>(state.range(0)), 0.0)); }
BENCHMARK(curved)->ArgName("length")->Arg(1)->Arg(10)->Arg(100)->Unit(benchmark::kMillisecond);
void far(benchmark::State& state) { count_steps(state, steps(1.0, 60.0)); }
BENCHMARK(far)->Unit(benchmark::kMillisecond);

void agreement(benchmark::State& state) {
  const GeometryModel model = knot({{"segments", 50.0}, {"sides", 5.0}, {"tube", 0.2}});
  const auto bvh = make_geometry(model), reference = make_geometry(model, GeometryBackend::reference);
  Draws draw(7);
  int hits = 0, differ = 0;
  for (auto _ : state) {
    for (int k = 0; k < 1'000'000; ++k) {
      RayPath path;
      path.degree = 1 + k % RayPath::max_degree;
      const Vec3 start = draw.in_cube(2.0), along = draw.uniform(0.1, 3.0) * draw.direction();
      const double bend = draw.uniform(0.0, 0.5);
      for (int i = 0; i <= path.degree; ++i) {
        path.control[static_cast<std::size_t>(i)] =
            start + (static_cast<double>(i) / path.degree) * along + draw.in_cube(bend);
      }
      const auto a = bvh->first_hit(path), b = reference->first_hit(path);
      hits += b ? 1 : 0;
      const bool same = a.has_value() == b.has_value() &&
                        (!a || (a->theta == b->theta && a->triangle == b->triangle && a->position == b->position));
      differ += same ? 0 : 1;
    }
  }
  state.counters["hits"] = hits;
  state.counters["differ"] = differ;
}
BENCHMARK(agreement)->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace xpr

BENCHMARK_MAIN();
