#include "integrators/first_integrals.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "integrators/first_integral_widths.hpp"

namespace xpr {

void trace_first_integrals(const SeparatedLight& light, std::span<const SeparatedState> rays,
                           std::span<FirstIntegralEnd> ends, const FirstIntegralSettings& settings) {
  const auto refuse = [](const std::string& what) { throw std::invalid_argument(what); };
  if (rays.size() != ends.size()) refuse(fmt::format("{} rays, but {} ends", rays.size(), ends.size()));
  if (!(settings.tol >= 1e-15 && settings.tol <= 1e-2)) {
    refuse(fmt::format("tol = {}, needs 1e-15 <= tol <= 1e-2", settings.tol));
  }
  if (!(light.half_gap_squared() >= 0.0)) {
    refuse(fmt::format("mass {}, spin {}, charge squared {}: needs a^2 + charge^2 <= M^2", light.mass, light.spin,
                       light.charge_squared));
  }
  if (!(settings.mino_max > 0.0)) refuse(fmt::format("mino_max = {}, needs > 0", settings.mino_max));
  const first_integrals::Batch batch{.light = light,
                                     .rays = rays,
                                     .ends = ends,
                                     .settings = settings,
                                     .u_escape = 1.0 / settings.r_max,
                                     .u_capture = 1.0 / settings.r_min};
  if (!(batch.u_escape < batch.u_capture && light.mass * batch.u_capture < 1.0 && light.d(batch.u_capture) > 0.0)) {
    refuse(fmt::format("r_min = {}, r_max = {}: needs horizon < r_min < r_max", settings.r_min, settings.r_max));
  }
  switch (settings.lanes) {
    case 1:
      return first_integrals::trace_lanes<1>(batch);
    case 2:
      return first_integrals::trace_lanes<2>(batch);
    case 4:
      return first_integrals::trace_lanes<4>(batch);
    case 8:
      return first_integrals::trace_lanes<8>(batch);
    default:
      refuse(fmt::format("lanes = {}, needs 1, 2, 4 or 8", settings.lanes));
  }
}

}  // namespace xpr
