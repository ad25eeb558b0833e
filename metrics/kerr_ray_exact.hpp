// Any null ray of Kerr between two radii outside the horizon, in closed form: where it ends, how far it swept, how long
// it took, and whether it escapes. No stepping: class and turning points follow from the roots of the radial quartic.
//
//   Boyer-Lindquist (t, r, theta, phi), mass M > 0, spin a with |a| <= M about theta = 0 (a = 0: Schwarzschild's areal
//   r); future-directed light, E > 0, lambda = L/E, eta = Q/E^2 (Carter's Q); affine length for E = 1; Mino time tau.
//
// A ray that a camera traces back in time is a RayEvent with p^t < 0, or by its constants: the same lambda and eta,
// signs of the way it goes, and t, phi and the affine length of the answer reversed. Inside the ergosphere light may
// have E <= 0; it is none of these rays. Light that ends at the horizon has no end: phi and t diverge there. A captured
// ray is followed to a given r1 > r+.
//
// How: theta by Jacobi's functions and its integrals by Carlson's; tau by Carlson's R_F where the ray turns; the radial
// integrals of the third kind, whose partial fractions cancel next to extremal horizons, as elementary terms plus a
// smooth rest that is summed to rounding (kerr_radial_exact.cpp). Every root case of both potentials, named where it is
// degenerate: RadialMotion::spherical and ::kind, PolarKind.
//
// Plain doubles, Wide numbers where they cancel. Every answer says how far it may be off (as ExactValue does) at the
// stored doubles of the arguments; that is 1e-15 of the larger of 1 and the number in the median, with bounds some
// thirty times that. Next to the critical curve no digit is lost until 1 - b/b_c is 1e-14 or less. At a = M, where part
// of that curve belongs to the horizon itself, digits go from 1e-8 on, and the bounds grow with them.
// Cites: [Carter1968] [GrallaLupsasca2020Geodesics] [DexterAgol2009] [Carlson1995]
#pragma once

#include <array>

#include "metrics/exact_value.hpp"
#include "metrics/kerr_polar_exact.hpp"

namespace xpr::kerr_exact {

/// What becomes of a ray. `asymptotic`: it winds for ever towards the spherical orbit where two roots coincide, to all
/// of the thirty digits to which the roots are known.
enum class Fate { escaped, captured, asymptotic };

struct RayHole {
  double mass = 1.0;
  double spin = 0.0;  ///< a length
};

/// A start: where, which constants, and which way along r and theta.
struct RayStart {
  double r = 0.0;
  double theta = 0.0;    ///< in [0, pi]
  double lambda = 0.0;   ///< L/E, a length; 0 where theta is on the axis
  double eta = 0.0;      ///< Q/E^2, a length squared
  int radial_sign = -1;  ///< of p_r, +1 or -1
  int polar_sign = 1;    ///< of p_theta, +1 or -1; at a turning point and on the axis either
};

/// The same by its momenta, which fix p_theta where the constants cancel (next to a turning point of theta).
struct RayMomentum {
  double r = 0.0;
  double theta = 0.0;
  double lambda = 0.0;   ///< p_phi/E, a length
  double p_theta = 0.0;  ///< p_theta/E, a length, signed
  int radial_sign = -1;
};

/// The same by an event and its covariant momentum in any scale, as a ray table has them. The ray goes along p,
/// forwards in time (p_t < 0) or backwards (p_t > 0, E = |p_t|): then elapsed t and affine length come out negative.
/// p_r = 0 means a turning point.
struct RayEvent {
  double r = 0.0;
  double theta = 0.0;
  double p_t = -1.0;
  double p_r = 0.0;
  double p_theta = 0.0;
  double p_phi = 0.0;
};

/// The end of a stretch of a ray. Nothing in it is meaningful unless `reached`.
struct Arrival {
  Fate fate = Fate::escaped;  ///< of the whole ray, reached or not
  bool reached = false;       ///< the ray comes to that radius after that many turns
  double r = 0.0;
  int radial_sign = 0;     ///< of p_r at the end
  int polar_sign = 0;      ///< of p_theta at the end
  ExactValue theta;        ///< in [0, pi]
  double cos_theta = 0.0;  ///< both, so that nothing is lost at the poles
  double sin_theta = 0.0;
  ExactValue phi;                ///< swept, unwrapped; for lambda = 0 with pi for each crossing of the axis
  ExactValue time;               ///< elapsed t
  ExactValue mino;               ///< elapsed Mino time, in 1/(length unit)
  ExactValue affine;             ///< affine length for E = 1
  double direction_error = 0.0;  ///< of (theta, phi) as a direction on the sphere: small at a pole where phi is not
  int radial_turns = 0;
  int polar_turns = 0;
  int axis_crossings = 0;  ///< lambda = 0 only

  /// (sin theta cos phi, sin theta sin phi, cos theta) for a ray that began at phi = phi0.
  [[nodiscard]] std::array<double, 3> direction(double phi0 = 0.0) const;
};

struct PreparedStart;

/// One ray. Construction finds the roots; every question afterwards is a few elliptic integrals.
class KerrRay {
 public:
  /// Throws std::invalid_argument for M <= 0, |a| > M, a sign that is not +-1 or a number that is not finite, and
  /// std::domain_error for a start that no light passes: r not outside the horizon, theta outside [0, pi], lambda != 0
  /// on the axis, R(r) < 0 or Theta(theta) < 0 by more than rounding, E <= 0.
  KerrRay(const RayHole& hole, const RayStart& start);
  KerrRay(const RayHole& hole, const RayMomentum& start);
  KerrRay(const RayHole& hole, const RayEvent& start);

  [[nodiscard]] Fate fate() const { return fate_; }
  /// The radius of the turning point ahead, if there is one.
  [[nodiscard]] bool turns() const { return turns_; }
  [[nodiscard]] double turning_radius() const;

  /// At radius r (r+ < r, finite) after 0 or 1 radial turning points. A radius within 4 units in the last place beyond
  /// the turning point counts as it.
  [[nodiscard]] Arrival at_radius(double r, int radial_turns) const;
  /// At r_out going outward if the ray escapes, at r_in going inward if it is captured.
  [[nodiscard]] Arrival at_end(double r_out, double r_in) const;

 private:
  explicit KerrRay(const PreparedStart& prepared);
  void set_fate();
  [[nodiscard]] bool comes_to(Wide& r, int radial_turns) const;
  [[nodiscard]] RadialSums radial_path(const Wide& r, bool via_turn) const;
  void set_sums(Arrival& arrival, const RadialSums& radial, const PolarEnd& polar) const;

  double mass_;
  double orientation_;  ///< sign of a
  double time_sense_;   ///< -1 for a ray traced back in time
  Wide r0_;             ///< in units of the mass from here on
  int radial_sign_;
  RadialMotion radial_;
  PolarMotion polar_;
  Fate fate_ = Fate::escaped;
  bool turns_ = false;
};

}  // namespace xpr::kerr_exact
