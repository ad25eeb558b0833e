// The four fixtures of gradient-index fields, 001 to 004, with a truth: where the light of every pixel goes after the
// field, and so what it meets, without stepping.
//
// Camera at (0, 0, 7), looking along -z, vertical field of view 42 degrees, 480 x 270 pixels. Fields (1 - u)^1.8,
// A = 0.9, r_outer = 5: one at the origin (001, 002), one at (2, 0, 0) (003), two at (-2, 0, 0) and (2, 0, 0) (004).
// Spheres of radius 0.77 at z = -18, x in {-6, -3, 0, 3, 6}, y in {3.5, 0, -3.5} (002: y = 0 alone); a box of
// 28 x 18 x 0.25 at z = -30 behind them. All of it lies outside the fields, where light is straight.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "metrics/fields/grin_exact.hpp"

namespace xpr {

enum class FixtureHit { source, backdrop, escape };

/// What the light of a pixel meets.
struct FixtureTruth {
  grin_exact::Line line;  ///< after the field
  FixtureHit hit = FixtureHit::escape;
  int sphere = -1;      ///< which of the spheres, in the order of GrinFixture::spheres
  double margin = 0.0;  ///< how far, as a length, the light is from meeting something else
};

struct GrinFixture {
  std::string_view id;  ///< "001", ...
  FieldSet fields;
  std::vector<std::array<double, 3>> spheres;

  static constexpr int width = 480, height = 270;
  static constexpr std::array<double, 3> camera{0.0, 0.0, 7.0};
  static constexpr double sphere_radius = 0.77;
  static constexpr std::array<double, 3> backdrop_half{14.0, 9.0, 0.125};
  static constexpr double backdrop_z = -30.0;

  /// Of pixel (column, row), counted from the upper left; unit length.
  [[nodiscard]] std::array<double, 3> direction(int column, int row) const;
  /// The light of a pixel: in closed form for one field, at 50 digits for two. Throws std::runtime_error where it stays
  /// in the field, which none of these does.
  [[nodiscard]] FixtureTruth truth(int column, int row) const;
  /// What a straight ray meets.
  [[nodiscard]] FixtureTruth classified(const grin_exact::Line& line) const;
};

/// 001 to 004.
[[nodiscard]] const std::vector<GrinFixture>& grin_fixtures();

}  // namespace xpr
