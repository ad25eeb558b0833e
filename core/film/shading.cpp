#include "core/film/shading.hpp"

#include <cmath>

#include "core/film/sky.hpp"

namespace xpr {
namespace {

constexpr Colour black{0.0, 0.0, 0.0};
constexpr Colour out_of_budget{0.8, 0.0, 0.8};
constexpr Colour not_understood{1.0, 0.4, 0.0};

Colour scaled(double by, const Colour& colour) { return {by * colour[0], by * colour[1], by * colour[2]}; }

/// What faces the camera is bright, what is seen along its surface dim.
double light_from_camera(const RayRecord& ray) {
  return 0.15 + 0.85 * std::abs(dot(ray.hit.shading_normal, ray.direction));
}

Colour of_surface(const SceneMaterials& materials, const RayRecord& ray) {
  const std::size_t k = ray.hit.material;
  if (k >= materials.size()) return scaled(light_from_camera(ray), {0.8, 0.8, 0.8});
  switch (materials.kind[k]) {
    case MaterialKind::flat:
      return materials.colour_a[k];
    case MaterialKind::lit:
      return scaled(light_from_camera(ray), materials.colour_a[k]);
    case MaterialKind::checker: {
      const auto along = [&](std::size_t axis) {
        return static_cast<long>(std::floor(ray.hit.uv[axis] * static_cast<double>(materials.squares[k][axis])));
      };
      const bool other = ((along(0) + along(1)) & 1L) != 0;
      return scaled(light_from_camera(ray), other ? materials.colour_b[k] : materials.colour_a[k]);
    }
    case MaterialKind::absorber:
      break;
  }
  return black;
}

}  // namespace

Colour colour_of(const SceneSnapshot& scene, const RayRecord& ray) {
  switch (ray.film_class) {
    case FilmClass::geom_hit:
      return of_surface(scene.materials, ray);
    case FilmClass::background_hit:
      return sky_colour(scene.sky, ray.direction);
    case FilmClass::budget_exhausted:
      return out_of_budget;
    case FilmClass::unclassified:
      return not_understood;
    default:
      return black;
  }
}

}  // namespace xpr
