// Every spacetime chart that this build knows, by id: the list that `xprimeray list` prints and `--metric` selects
// from.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "metrics/spacetime.hpp"

namespace xpr {

/// A parameter as the catalogue describes it.
struct ParameterCard {
  std::string_view name;
  double fallback;  ///< value when not set
  std::string_view meaning;
};

/// One chart in the catalogue, and how to make it.
struct CatalogueEntry {
  const Card* card;
  std::vector<ParameterCard> parameters;
  /// Values not named keep their defaults. Throws std::invalid_argument for an unknown name or a value out of range.
  std::unique_ptr<Spacetime> (*make)(std::span<const NamedValue> values);
};

/// All charts, in the order in which they are listed; the first chart of a metric is its default for transport.
[[nodiscard]] const std::vector<CatalogueEntry>& catalogue();

/// Makes a spacetime by its ids. An empty chart id means the metric's first. Throws std::invalid_argument: unknown
/// metric or chart or parameter (names the nearest known one), value out of range.
[[nodiscard]] std::unique_ptr<Spacetime> make_spacetime(std::string_view metric, std::string_view chart,
                                                        std::span<const NamedValue> values = {});

/// The chart of `metric` in which transport runs by default: regular where light goes. `future_directed` is the sign of
/// p^t: camera rays traced back in time want Kerr-Schild's outgoing chart, rays that fall in the ingoing one.
[[nodiscard]] std::string_view transport_chart(std::string_view metric, bool future_directed);

/// The known word nearest to `word` by edit distance, or empty if none is near: for "did you mean".
[[nodiscard]] std::string nearest_name(std::string_view word, std::span<const std::string_view> known);

}  // namespace xpr
