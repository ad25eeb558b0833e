// A Kerr hole in units of its mass, its spin taken as positive, in the wide numbers of the closed forms. Included by
// their sources only. Cites: [BardeenPressTeukolsky1972]
#pragma once

#include "metrics/bounded.hpp"
#include "metrics/kerr_exact.hpp"

namespace xpr::kerr_exact {

struct Hole {
  Quad mass;
  Quad spin;  ///< |a|/M
  int sign;   ///< of a; +1 at a = 0

  /// Throws std::invalid_argument for M <= 0 or |a| > M.
  Hole(double mass_in, double spin_in);

  [[nodiscard]] bool extremal() const { return spin == 1; }
  [[nodiscard]] Quad outer_horizon() const { return 1 + sqrt((1 - spin) * (1 + spin)); }
  /// Prograde: 1 at the extremal hole.
  [[nodiscard]] Quad photon_orbit(Sense sense) const;
  [[nodiscard]] Quad polar_photon_orbit() const;
};

}  // namespace xpr::kerr_exact
