#include "core/camera_screen.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "metrics/catalogue.hpp"

namespace xpr {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

CameraScreen screen_at(double radius, double inclination) {
  return {.spin = 0.9, .radius = radius, .inclination = inclination, .half_width = 12.0, .pixels = {8, 6}};
}

TEST(CameraScreen, makes_rays_with_the_constants_of_their_point) {
  const auto kerr = make_spacetime("kerr", "boyer-lindquist", std::array{NamedValue{"a", 0.9}});
  for (const double inclination : {17.0 * degree, 60.0 * degree, 90.0 * degree, 150.0 * degree}) {
    const CameraScreen screen = screen_at(40.0, inclination);
    for (int row = 0; row < 6; ++row) {
      for (int column = 0; column < 8; ++column) {
        const auto [alpha, beta] = screen.point(column, row);
        const PhaseState<double> ray = screen.ray(alpha, beta).value();
        const double lambda = -alpha * std::sin(inclination);
        const double eta = (alpha * alpha - 0.81) * std::pow(std::cos(inclination), 2) + beta * beta;
        // R loses a few digits where its terms, of size r^4, cancel: not here.
        EXPECT_LT(kerr->null_residual(ray), 1e-14);
        // Past-directed: the constants of the light are those of minus the tangent.
        EXPECT_EQ(ray[4], 1.0);
        EXPECT_DOUBLE_EQ(-ray[7], lambda);
        // Rounding of terms of size alpha^2 + beta^2 < 300.
        EXPECT_NEAR(kerr->carter_constant(ray).value(), eta, 1e-12);
        // It goes inward, away from the camera; up on the screen is towards theta = 0, right is along +phi for who
        // looks inward.
        const PhaseState<double> rate = kerr->flow(ray);
        EXPECT_LT(rate[1], 0.0);
        EXPECT_EQ(rate[2]<0.0, beta> 0.0);
      }
    }
  }
}

TEST(CameraScreen, has_its_corners_half_a_pixel_inside) {
  const CameraScreen screen = screen_at(1000.0, 1.0);
  EXPECT_DOUBLE_EQ(screen.point(0, 0)[0], -12.0 * 7.0 / 8.0);
  EXPECT_DOUBLE_EQ(screen.point(7, 5)[0], 12.0 * 7.0 / 8.0);
  EXPECT_DOUBLE_EQ(screen.point(0, 5)[1], 12.0 * 5.0 / 6.0);
}

TEST(CameraScreen, says_where_an_observer_can_be) {
  const auto refused = [](const CameraScreen& screen) {
    try {
      screen.validate();
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused(screen_at(2.1, 90.0 * degree)), "");
  // In the equator the ergosphere reaches to 2 M, at 60 degrees to M + sqrt(M^2 - a^2/4) = 1.893 M.
  EXPECT_NE(refused(screen_at(1.99, 90.0 * degree)).find("ergosphere"), std::string::npos);
  EXPECT_NE(refused(screen_at(1.99, 90.0 * degree)).find("turns with the hole"), std::string::npos);
  EXPECT_NE(refused(screen_at(1.8, 60.0 * degree)).find("reaches to r = 1.893"), std::string::npos);
  EXPECT_NE(refused(screen_at(1.2, 60.0 * degree)).find("inside the horizon"), std::string::npos);
  EXPECT_NE(refused(screen_at(100.0, 0.0)).find("axis"), std::string::npos);
  CameraScreen none = screen_at(100.0, 1.0);
  none.pixels = {0, 4};
  EXPECT_NE(refused(none).find("0x4 pixels"), std::string::npos);
}

}  // namespace
}  // namespace xpr
