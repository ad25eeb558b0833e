#include "core/camera_screen.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "metrics/kerr.hpp"
#include "metrics/scalar/elementary.hpp"

namespace xpr {

void CameraScreen::validate() const {
  KerrParameters kerr;
  kerr.M = mass;
  kerr.a = spin;
  kerr.validate();
  const auto need = [](bool good, const std::string& what) {
    if (!good) throw std::invalid_argument(what);
  };
  need(sin(inclination) > 0.0 && inclination > 0.0,
       fmt::format("inclination {} rad, needs to be between 0 and pi: on the axis a screen has no horizontal",
                   inclination));
  // A static observer needs g_tt < 0.
  const double ergosphere = mass + std::sqrt(mass * mass - square(spin * cos(inclination)));
  need(std::isfinite(radius) && radius > ergosphere,
       fmt::format("observer at r = {}: nothing stands still at or inside the ergosphere, which at this inclination "
                   "reaches to r = {:.6g}{}; needs a larger r",
                   radius, ergosphere,
                   radius > kerr.horizon_radius() ? " (an observer that turns with the hole could be here)"
                                                  : ", inside the horizon"));
  need(std::isfinite(half_width) && half_width > 0.0,
       fmt::format("screen of half-width {}, needs more than 0", half_width));
  need(pixels[0] > 0 && pixels[1] > 0, fmt::format("{}x{} pixels, needs at least 1x1", pixels[0], pixels[1]));
}

std::array<double, 2> CameraScreen::point(int column, int row) const {
  return {half_width * (2.0 * (column + 0.5) / pixels[0] - 1.0), half_width * (2.0 * (row + 0.5) / pixels[1] - 1.0)};
}

kerr_exact::RayConstants<double> CameraScreen::constants(double alpha, double beta) const {
  const double cosine = cos(inclination);
  return {1.0, -alpha * sin(inclination), (alpha * alpha - spin * spin) * cosine * cosine + beta * beta};
}

std::optional<PhaseState<double>> CameraScreen::ray(double alpha, double beta) const {
  const kerr_exact::RayConstants<double> light = constants(alpha, beta);
  const double potential = kerr_exact::radial_potential(mass, spin, light, radius);
  if (!(potential >= 0.0)) return std::nullopt;
  KerrParameters kerr;
  kerr.M = mass;
  kerr.a = spin;
  // Theta at the observer is beta^2: going back along light from above, theta falls.
  return PhaseState<double>{{0.0, radius, inclination, 0.0},
                            {1.0, -std::sqrt(potential) / kerr.delta(radius), -beta, -light.angular_momentum}};
}

}  // namespace xpr
