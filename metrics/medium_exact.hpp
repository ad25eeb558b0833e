// Exact rays in the media with closed ones: the Luneburg lens and Maxwell's fish-eye. No stepping.
//   ds^2 = -dt^2/n^2 + dx^2,   H = (p^2 - n^2 p_t^2)/2,  p_t = -1:   dx/dlambda = p,  dp/dlambda = grad(n^2)/2,
//   dt/dlambda = n^2,  |p| = n on a ray: lambda grows by (length)/n, and t is the optical path.
// Cartesian x and p; radius R > 0. Every function throws std::invalid_argument for R <= 0 and std::domain_error for an
// argument outside its range. `error` bounds each component; positions in the unit of R.
// Cites: [Luneburg1964] [Maxwell1854] [BornWolf1999]
#pragma once

#include <array>

#include "metrics/exact_value.hpp"

namespace xpr::medium_exact {

using Vector = std::array<double, 3>;

/// A point of a ray. `error` bounds each component of position and momentum.
struct RayPoint {
  Vector position;
  Vector momentum;
  double error = 0.0;
};

struct ExactPoint {
  Vector position;
  double error = 0.0;
};

// Luneburg lens: n^2 = 2 - |x|^2/R^2, for |x| < sqrt2 R (the lens proper ends at |x| = R, where n = 1).

[[nodiscard]] double luneburg_index_squared(double R, const Vector& x);

/// The ray through x0 with momentum p0 at parameter lambda: x = x0 cos(lambda/R) + R p0 sin(lambda/R), which closes
/// after 2 pi R. Exact for any p0, null or not.
[[nodiscard]] RayPoint luneburg_ray(double R, const Vector& x0, const Vector& p0, double lambda);

/// Its optical path t(lambda).
[[nodiscard]] ExactValue luneburg_optical_path(double R, const Vector& x0, const Vector& p0, double lambda);

/// Where all rays that enter along +x meet: (R, 0, 0).
[[nodiscard]] ExactPoint luneburg_focus(double R);

/// Optical path from the entry at height |y| <= R to the focus: pi R/2 + sqrt(R^2 - y^2).
[[nodiscard]] ExactValue luneburg_path_to_focus(double R, double y);

// Maxwell's fish-eye: n = 2/(1 + |x|^2/R^2), the stereographic image of the unit 3-sphere.

[[nodiscard]] double fisheye_index(double R, const Vector& x);

/// The ray through x0 along p0 (|p0| = n(x0); its length is not used) after the optical path t: a great circle of the
/// 3-sphere. Closes after 2 pi R. `error` grows where the ray passes far outside, as |x|^2/R^2.
[[nodiscard]] RayPoint fisheye_ray(double R, const Vector& x0, const Vector& p0, double optical_path);

/// lambda at the optical path t >= 0 on that ray, lambda(0) = 0, by Kepler's equation. Not for a ray through the
/// centre, which takes for ever.
[[nodiscard]] ExactValue fisheye_affine_parameter(double R, const Vector& x0, const Vector& p0, double optical_path);

/// Where all rays from x0 meet after the optical path pi R: -R^2 x0/|x0|^2, x0 != 0.
[[nodiscard]] ExactPoint fisheye_image(double R, const Vector& x0);

/// 2 pi R.
[[nodiscard]] ExactValue fisheye_optical_period(double R);

/// The circle of a ray that does not pass through the centre. `error` bounds the radius and each component of the
/// centre.
struct RayCircle {
  Vector centre;
  double radius;
  double error = 0.0;
};
[[nodiscard]] RayCircle fisheye_circle(double R, const Vector& x0, const Vector& p0);

}  // namespace xpr::medium_exact
