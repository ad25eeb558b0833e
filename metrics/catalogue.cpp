#include "metrics/catalogue.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "metrics/spacetimes.hpp"

namespace xpr {

namespace {

template <class M>
M with_values(std::span<const NamedValue> values) {
  M module;
  for (const NamedValue& value : values) {
    bool known = false;
    std::vector<std::string_view> names;
    if constexpr (requires { M::parameters; }) {
      for (const auto& parameter : M::parameters) {
        names.push_back(parameter.name);
        if (parameter.name != value.name) continue;
        module.*(parameter.member) = value.value;
        known = true;
      }
    }
    if (known) continue;
    const std::string nearest = nearest_name(value.name, names);
    throw std::invalid_argument(fmt::format("unknown parameter '{}' of metric '{}'{}; it has {}", value.name,
                                            M::card.metric,
                                            nearest.empty() ? "" : fmt::format(": did you mean '{}'?", nearest),
                                            names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
  }
  return module;
}

template <class M>
CatalogueEntry entry() {
  CatalogueEntry out{&M::card, {}, [](std::span<const NamedValue> values) -> std::unique_ptr<Spacetime> {
                       return std::make_unique<SpacetimeOf<M>>(with_values<M>(values));
                     }};
  if constexpr (requires { M::parameters; }) {
    const M defaults;
    for (const auto& parameter : M::parameters) {
      out.parameters.push_back({parameter.name, defaults.*(parameter.member), parameter.meaning});
    }
  }
  return out;
}

/// Edit distance with insertions, deletions, substitutions and swaps of neighbours each counting one.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, substitution});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        now[j] = std::min(now[j], before_last[j - 2] + 1);
      }
    }
    std::swap(before_last, last);
    std::swap(last, now);
  }
  return last[b.size()];
}

/// "unknown metric 'ker': did you mean 'kerr'?", or all that there is where nothing is near.
std::invalid_argument unknown(std::string_view what, std::string_view word,
                              const std::vector<std::string_view>& known) {
  const std::string nearest = nearest_name(word, known);
  return std::invalid_argument(nearest.empty()
                                   ? fmt::format("unknown {} '{}'; there is {}", what, word, fmt::join(known, ", "))
                                   : fmt::format("unknown {} '{}': did you mean '{}'?", what, word, nearest));
}

std::vector<std::string_view> metric_names() {
  std::vector<std::string_view> names;
  for (const CatalogueEntry& known : catalogue()) {
    if (names.empty() || names.back() != known.card->metric) names.push_back(known.card->metric);
  }
  return names;
}

}  // namespace

const std::vector<CatalogueEntry>& catalogue() {
  static const std::vector<CatalogueEntry> entries = {
      entry<MinkowskiCartesian>(),      //
      entry<MinkowskiSpherical>(),      //
      entry<SchwarzschildIngoing>(),    //
      entry<SchwarzschildOutgoing>(),   //
      entry<SchwarzschildIsotropic>(),  //
      entry<SchwarzschildAreal>(),      //
      entry<KerrSchildIngoing>(),       //
      entry<KerrSchildOutgoing>(),      //
      entry<KerrBoyerLindquist>(),      //
      entry<EllisIsotropic>(),          //
      entry<EllisProperDistance>(),     //
      entry<MediumUniform>(),           //
      entry<Luneburg>(),                //
      entry<MaxwellFisheye>(),          //
      entry<EllipsoidGeographic>(),     //
      entry<EllipsoidTurned>(),         //
  };
  return entries;
}

std::unique_ptr<Spacetime> make_spacetime(std::string_view metric, std::string_view chart,
                                          std::span<const NamedValue> values) {
  std::vector<std::string_view> charts;
  for (const CatalogueEntry& known : catalogue()) {
    if (known.card->metric != metric) continue;
    if (chart.empty() || known.card->chart == chart) return known.make(values);
    charts.push_back(known.card->chart);
  }
  if (charts.empty()) throw unknown("metric", metric, metric_names());
  throw unknown(fmt::format("chart of '{}'", metric), chart, charts);
}

std::string_view transport_chart(std::string_view metric, bool future_directed) {
  for (const CatalogueEntry& known : catalogue()) {
    if (known.card->metric != metric) continue;
    if (known.card->chart == KerrSchildIngoing::card.chart && !future_directed) return KerrSchildOutgoing::card.chart;
    return known.card->chart;
  }
  throw unknown("metric", metric, metric_names());
}

std::string nearest_name(std::string_view word, std::span<const std::string_view> known) {
  std::string_view best;
  // A third of the word may be wrong, and one letter of any word of three or more.
  std::size_t allowed = word.size() < 3 ? 0 : std::max<std::size_t>(1, word.size() / 3);
  for (const std::string_view candidate : known) {
    const std::size_t distance = edit_distance(word, candidate);
    const bool closer = best.empty() ? distance <= allowed : distance < allowed;
    if (!closer) continue;
    best = candidate;
    allowed = distance;
  }
  return std::string(best);
}

}  // namespace xpr
