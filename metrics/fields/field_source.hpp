// What an author says of a gradient-index field: plain data, filled from scene files, checked where it is put to use
// (make_field_spacetime). A field bends light by a = -A f(u) rhat per length towards its centre,
//
//   u = (r - r_inner) / (r_outer - r_inner) clamped to [0, 1],   A = beta bend_scale field_strength amplitude,
//
// which is the optics of the index ln n(r) = A (r_outer - r_inner) F(u), F(u) = integral_u^1 f, n = 1 from r_outer on.
// Where r < r_inner f is f(0) and ln n goes on growing at that rate. Several sources add up in ln n, in their order.
//
// Curves, f clamped to [0, 1]:
//   linear       1 - u
//   power        (1 - u)^a, a > -1
//   polynomial   a + b u + c u^2
//   exponential  exp(-a u), a >= 0
//   gaussian     exp(-(u / a)^2), a > 0: what older scenes call "Exponential" with a width
//   custom       linear between the entries of `table`, which stand at equal distances from u = 0 to u = 1
//
// Shapes: `sphere`, r = |q|, q being the point in the source's own frame; `box`, r = r_outer max_i |q_i| / half_size_i,
// whose surfaces of equal index are boxes. Lengths of a source and its amplitude (1 / length) are in its own frame: a
// source that is scaled up bends by the same angles. Boundaries: r < r_outer is inside.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace xpr {

enum class FieldCurve { linear, power, polynomial, exponential, gaussian, custom };
enum class FieldShape { sphere, box };

/// Their names in scene files, in the order of the enumerators.
inline constexpr std::array<std::string_view, 6> field_curve_names{"linear",      "power",    "polynomial",
                                                                   "exponential", "gaussian", "custom"};
inline constexpr std::array<std::string_view, 2> field_shape_names{"sphere", "box"};

/// x_world = origin + q_0 axes[0] + q_1 axes[1] + q_2 axes[2]: any affine map that can be undone.
struct FieldFrame {
  std::array<double, 3> origin{0.0, 0.0, 0.0};
  std::array<std::array<double, 3>, 3> axes{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
};

/// One field.
struct FieldSource {
  std::string name;  ///< for messages
  FieldCurve curve = FieldCurve::linear;
  FieldShape shape = FieldShape::sphere;
  double amplitude = 1.0;                          ///< bending per length at f = 1, any sign
  double r_inner = 0.0;                            ///< 0 <= r_inner < r_outer
  double r_outer = 1.0;                            ///< the edge of the support
  double a = 1.0, b = 0.0, c = 0.0;                ///< coefficients of the curve
  std::array<double, 3> half_size{1.0, 1.0, 1.0};  ///< of a box: its faces are at |q_i| = half_size_i
  std::vector<double> table = {};                  ///< of the custom curve: two to 256 values, each in [0, 1]
  double edge_softness = 0.0;                      ///< e in [0, 1]: f smoothstep(0, e, u) (1 - smoothstep(1 - e, 1, u))
  std::optional<double> beta_scale = {};           ///< multiplies the global beta, or stands for it where that is 0
  bool invert_sign = false;                        ///< repels
  bool absorb = false;                             ///< light that comes to r < r_inner ends there: captured
  FieldFrame world_from_local = {};
};

/// The gains that all sources share.
struct FieldGains {
  double beta = 1.0;
  double bend_scale = 1.0;
  double field_strength = 1.0;
};

/// The fields of a scene, in their stable order.
struct FieldSet {
  std::vector<FieldSource> sources;
  FieldGains gains;
};

/// A of a source: its bending per length at f = 1, sign and gains in it.
[[nodiscard]] inline double bending_of(const FieldSource& source, const FieldGains& gains) {
  constexpr double no_beta = 1e-6;
  double beta = gains.beta;
  if (source.beta_scale) {
    const bool some = beta > no_beta || beta < -no_beta;
    beta = some ? beta * *source.beta_scale : *source.beta_scale;
  }
  const double bending = beta * source.amplitude * gains.bend_scale * gains.field_strength;
  return source.invert_sign ? -bending : bending;
}

}  // namespace xpr
