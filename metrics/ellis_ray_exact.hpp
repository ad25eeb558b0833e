// Any null ray of the Ellis wormhole between two proper radii, in closed form: which end it goes to, where it ends, how
// far it swept, how long it took. The companion of kerr_ray_exact.hpp.
//   ds^2 = -dt^2 + dl^2 + (l^2 + b0^2) dOmega^2;  E = 1, lambda = L/E, b^2 = p_theta^2 + lambda^2/sin^2 theta.
// With A = max(b, b0), B^2 = |b^2 - b0^2| and q = l (b < b0) or q^2 = l^2 - B^2 (b > b0, which turns at |l| = B):
//   chi = (b/A) q R_F(B^2, B^2 + B^2 q^2/A^2, B^2 + q^2),
//   t = q [A R_F + B^2 q^2/(3 A) R_D(B^2 + B^2 q^2/A^2, B^2 + q^2, B^2)],
// every term positive; t is the affine length too. b = b0, which winds towards the throat for ever, is elementary.
// Plain doubles; B^2 from a Wide difference. Cites: [Ellis1973] [Carlson1995]
#pragma once

#include "metrics/orbital_plane.hpp"
#include "metrics/wide.hpp"

namespace xpr::ellis_exact {

/// Where a ray goes: l -> +infinity, l -> -infinity, or b = b0 and towards the throat.
enum class WormholeEnd { positive, negative, throat };

struct WormholeStart {
  double l = 0.0;
  double theta = 0.0;    ///< in [0, pi]
  double lambda = 0.0;   ///< p_phi/E, a length; 0 on the axis
  double p_theta = 0.0;  ///< p_theta/E, a length, signed
  int radial_sign = -1;  ///< of p_l
};

/// The end of a stretch of a ray. Nothing in it is meaningful unless `reached`.
struct WormholeArrival {
  WormholeEnd end = WormholeEnd::positive;  ///< of the whole ray
  bool reached = false;
  double l = 0.0;
  int radial_sign = 0;
  int radial_turns = 0;
  PlaneEnd direction;  ///< theta, swept phi and their errors
  ExactValue swept;    ///< angle in the ray's plane
  ExactValue time;     ///< elapsed t, and affine length for E = 1
};

class EllisRay {
 public:
  /// Throws std::invalid_argument for b0 <= 0, a sign that is not +-1 or a number that is not finite, std::domain_error
  /// for theta outside [0, pi], lambda != 0 on the axis, |l| below the turning point by more than rounding, or b = b0
  /// at the throat itself.
  EllisRay(double throat_radius, const WormholeStart& start);

  [[nodiscard]] WormholeEnd end() const { return end_; }
  [[nodiscard]] bool turns() const { return turns_; }
  /// At proper radius l after 0 or 1 turning points; l within 4 units in the last place beyond it is the turning point.
  [[nodiscard]] WormholeArrival at(double l, int radial_turns) const;
  /// At |l| = `distance` on the side where it ends.
  [[nodiscard]] WormholeArrival at_end(double distance) const;

 private:
  /// chi and t from q = 0 (b = b0: from l to infinity, up to a constant) to l.
  struct Leg {
    double swept, time;
  };
  [[nodiscard]] Leg leg(double l) const;
  [[nodiscard]] double variable(double l) const;

  double throat_, l0_;
  int sign_;
  OrbitalPlane plane_;
  Wide excess_;    ///< b^2 - b0^2
  double slip_;    ///< its relative error, from the rounding of sin theta
  bool scatters_;  ///< b > b0
  bool critical_;  ///< b = b0
  WormholeEnd end_ = WormholeEnd::positive;
  bool turns_ = false;  ///< a turning point lies ahead
};

}  // namespace xpr::ellis_exact
