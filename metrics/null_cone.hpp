// Putting a covector on the light cone by its time component.
#pragma once

#include <optional>

#include "metrics/spacetime.hpp"

namespace xpr {

/// p with p_0 replaced by the root of H = 0 for which p^t has the sign of `sign`; the spatial p_i stay. Of the two
/// forms of the root the one that does not cancel is taken, so that the residual is round-off wherever g^{tt} is.
/// Nothing where no real root exists or a number is not finite.
[[nodiscard]] std::optional<Vec4<double>> null_momentum(const Spacetime& spacetime, const Vec4<double>& x,
                                                        const Vec4<double>& p, double sign);

}  // namespace xpr
