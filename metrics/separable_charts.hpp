// Rays (x, p) of Kerr's and Schwarzschild's charts as states of separated light, and back.
//
// In the Kerr-Schild chart of direction s, with X = x + iy = (r + i s a) e^{i phi_s} sin theta and P = p_x + i p_y,
//   n_plane = X / (r + i s a),   p_r = Re(conj(n_plane) P) + n_z p_z,   B = Re(conj(X) P) + z p_z,
//   n_plane' = (r - i s a) P - n_plane B,   n_z' = r p_z - n_z B,   r' = Delta p_r + s (2 M r p_t + a L),
// then n_plane and its rate turn from phi_s to Boyer-Lindquist phi. No division by sin theta anywhere: the axis is like
// any other place. Cites: [Carter1968]
#pragma once

#include "metrics/separable.hpp"
#include "metrics/spacetime.hpp"

namespace xpr {

/// How the light of a spacetime separates, and in which of its charts states can be given.
struct SeparatedChart {
  enum class Kind { kerr_schild_ingoing, kerr_schild_outgoing, boyer_lindquist };
  SeparatedLight light;
  Kind kind = Kind::boyer_lindquist;
};

/// `kerr` and `schwarzschild` in `kerr-schild`, `kerr-schild-outgoing`, `boyer-lindquist` and `areal`; nothing for
/// other spacetimes and charts.
[[nodiscard]] std::optional<SeparatedChart> separated_chart(const Spacetime& spacetime);

/// The separated state of a null (x, p) outside the horizon with E = -p_t != 0; components are not finite otherwise.
[[nodiscard]] SeparatedState separated_state(const SeparatedChart& chart, const PhaseState<double>& y);

/// Undoes separated_state: (x, p) for |p_t| = `energy`. Boyer-Lindquist azimuths come out in (-pi, pi].
[[nodiscard]] PhaseState<double> phase_state(const SeparatedChart& chart, const SeparatedState& state,
                                             double energy = 1.0);

}  // namespace xpr
