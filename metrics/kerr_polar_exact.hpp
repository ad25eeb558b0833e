// The polar half of a null ray of Kerr, in closed form and in units of the mass. With c = cos theta, E = 1:
//   (dc/dtau)^2 = a^2 (u+ - c^2)(c^2 - u-),      a^2 u+ u- = -eta,  u+ + u- = (a^2 - lambda^2 - eta)/a^2
// eta > 0, light that meets the equator: c = sqrt(u+) sin psi;  eta < 0 (vortical): c^2 = u- + (u+ - u-) sin^2 psi;
//   (dpsi/dtau)^2 = w^2 + mu sin^2 psi,      sin^2 theta = q0 (1 - n sin^2 psi).
// Phases psi are counted from the equator (the least |c|), where every integral is a sum of Carlson's R_F, R_D and R_J
// with positive terms, near the axis too. By name: theta at rest (radial, equatorial and principal rays), and eta = 0
// off the equator with |lambda| < a, which needs for ever to reach the equator.
// Included by the closed forms of Kerr only. Cites: [GrallaLupsasca2020Geodesics] [Carlson1995]
#pragma once

#include "metrics/kerr_radial_exact.hpp"

namespace xpr::kerr_exact {

enum class PolarKind { at_rest, through_equator, one_side, to_equator };

/// Where theta starts: its cosine and sine, (dc/dtau)^2 with its absolute error, and the sign of dc/dtau.
struct PolarStart {
  double cosine;
  double sine;
  double rate_squared;
  double rate_squared_error;
  int direction;
};

/// theta after tau, and what accumulated on the way.
struct PolarEnd {
  double cosine = 0.0;
  double sine = 0.0;
  double azimuth = 0.0;         ///< lambda/sin^2 theta dtau; for lambda = 0: pi for each crossing of the axis
  double cosine_squared = 0.0;  ///< cos^2 theta dtau
  double rate = 0.0;            ///< |dtheta/dtau| at the end
  int direction = 1;            ///< of dc/dtau at the end
  int turns = 0;
  int axis_crossings = 0;
  // How far each may be off, tau being off by the mino_error given.
  double theta_error = 0.0;
  double azimuth_error = 0.0;
  double cosine_squared_error = 0.0;
};

class PolarMotion {
 public:
  PolarMotion(const UnitConstants& constants, const PolarStart& start);
  [[nodiscard]] PolarEnd after(double mino, double mino_error) const;
  [[nodiscard]] PolarKind kind() const { return kind_; }
  /// From one turning point to the next; infinite where there is none.
  [[nodiscard]] double half_period() const;

 private:
  /// tau, and the integrals of sin^2 psi dtau and dtau/(1 - n sin^2 psi), from psi = 0.
  template <class T>
  struct Integrals {
    T tau{}, sine_squared{}, pole{};
  };
  /// The start as a phase: both squares, since either may be small; `falling`: on the way back to psi = pi.
  struct Phase {
    double sine_squared = 0.0, cosine_squared = 0.0;
    double sine_squared_error = 0.0, cosine_squared_error = 0.0;
    double sign = 1.0;
    bool falling = false;
  };
  template <class T>
  [[nodiscard]] Integrals<T> from_equator(const T& sine, const T& cosine_squared, const T& pole_factor) const;
  /// The phase after some Mino time: halves pi plus an angle between -pi/2 and pi/2.
  struct Reached {
    double phase, halves;
    double sine, cosine_squared;  ///< of that angle
  };
  [[nodiscard]] PolarEnd to_equator(double mino, double mino_error) const;
  [[nodiscard]] PolarEnd at_rest(double mino, double mino_error) const;
  void set_place(PolarEnd& end, const Reached& at) const;
  void set_turns(PolarEnd& end, const Reached& at) const;
  void set_errors(PolarEnd& end, const Reached& at, double mino, double mino_error, double pole_size) const;
  void set_through_equator(const UnitConstants& constants);
  void set_one_side(const UnitConstants& constants);
  void set_phase(const Phase& given);

  PolarKind kind_ = PolarKind::at_rest;
  PolarStart start_;
  double lambda_;
  double u_plus_ = 0.0;              ///< greatest c^2
  double least_sine_squared_ = 0.0;  ///< 1 - u+
  double w_squared_ = 0.0, mu_ = 0.0, n_ = 0.0, q0_ = 1.0;
  double base_ = 0.0, swing_ = 0.0;  ///< c^2 = base + swing sin^2 psi
  Integrals<double> quarter_;        ///< from psi = 0 to pi/2
  Integrals<double> begin_;          ///< from psi = 0 to the start
  double begin_error_ = 0.0;         ///< of begin_.tau, from the start's cancellation
};

}  // namespace xpr::kerr_exact
