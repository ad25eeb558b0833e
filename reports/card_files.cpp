#include "reports/card_files.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/io/hdf5_file.hpp"
#include "integrators/status.hpp"
#include "reports/origin.hpp"
#include "reports/text.hpp"

namespace xpr {
namespace {

template <class Value>
std::vector<double> column(const std::vector<RayScore>& scores, const Value& value) {
  std::vector<double> out;
  out.reserve(scores.size());
  for (const RayScore& score : scores) out.push_back(value(score));
  return out;
}

void write_rays(const Examiner& examiner, const ReportCard& card, const std::string& group, Hdf5File& file) {
  std::vector<std::int64_t> ids, families, statuses, outcomes;
  for (std::size_t k = 0; k < card.scores.size(); ++k) {
    ids.push_back(examiner.ray(k).ray.id);
    families.push_back(examiner.ray(k).family);
    statuses.push_back(static_cast<std::int64_t>(card.scores[k].status));
    outcomes.push_back(static_cast<std::int64_t>(card.scores[k].outcome));
  }
  std::vector<std::string_view> names;
  for (const RayFamily& family : examiner.set().families) names.push_back(family.name);
  file.write(group + "/id", ids, {"1", "ray number in the set"});
  file.write_enum(group + "/family", families, names, {"1", "kind of ray"});
  file.write_enum(group + "/status", statuses, status_names, {"1", "how the ray ended, as handed in"});
  file.write_enum(group + "/outcome", outcomes, outcome_names, {"1", "what became of the row"});
  for (std::size_t q = 0; q < quantity_count; ++q) {
    const QuantityCard& quantity = quantity_cards[q];
    file.write(fmt::format("{}/{}", group, quantity.id),
               column(card.scores, [q](const RayScore& s) { return s.error[q]; }),
               {std::string(quantity.unit), fmt::format("error: {}", quantity.meaning)});
    file.write(fmt::format("{}/{}_scaled", group, quantity.id),
               column(card.scores, [q](const RayScore& s) { return s.scaled(q); }),
               {std::string(quantity.unit), "the same with the closed form's own error, over the ray's condition"});
    if (q >= conditioned_quantities) continue;
    file.write(fmt::format("{}/{}_condition", group, quantity.id),
               column(card.scores, [q](const RayScore& s) { return s.condition[q]; }),
               {"1", "change for a length unit in the angular momentum at the start or in the end's radius"});
  }
  file.write(group + "/position", column(card.scores, [](const RayScore& s) { return s.position; }),
             {"1", "distance to the exact end at the same radius, in the unit of the set"});
  file.write(group + "/turns", column(card.scores, [](const RayScore& s) { return s.windings; }),
             {"1", "whole turns of phi too many"});
  file.write(group + "/truth_error", column(card.scores, [](const RayScore& s) { return s.truth_error; }),
             {"radian", "the closed form's own error in direction"});
}

}  // namespace

void write_card_h5(const CardInputs& inputs, const std::filesystem::path& path) {
  const ChallengeSet& set = inputs.examiner->set();
  Hdf5File file = Hdf5File::create(path);
  file.set_attribute("/", "schema", "xprimeray-card");
  file.set_attribute("/", "schema_version", std::int64_t{1});
  file.set_attribute("/", "name", inputs.name);
  file.set_attribute("/", "set", set.id);
  for (std::size_t k = 0; k < inputs.cards.size(); ++k) {
    const ReportCard& card = inputs.cards[k];
    const std::string group = fmt::format("/cards/{}", k);
    write_rays(*inputs.examiner, card, group + "/ray", file);
    file.set_attribute(group, "label", card.label);
    file.set_attribute(group, "file", card.hand_in.file);
    file.set_attribute(group, "chart", card.hand_in.chart);
    file.set_attribute(group, "tolerance", card.tolerance);
    file.set_attribute(group, "work", card.hand_in.work);
    file.set_attribute(group, "work_unit", card.hand_in.work_unit);
    file.set_attribute(group, "grade", to_string(card.as_handed_in.grade));
    file.set_attribute(group, "grade_undone", to_string(card.undone.grade));
    file.set_attribute(group, "main", std::int64_t{&card == &inputs.main_card() ? 1 : 0});
  }
  write_origin(file, {inputs.provenance, inputs.command, inputs.configuration, {}});
  file.set_attribute("/volatile", "seconds", inputs.seconds);
  file.close();
}

std::string badge_svg(std::string_view set, Letter grade) {
  // From green to red; the letter carries the meaning.
  constexpr std::array<std::string_view, 6> colours{"#00664b", "#2b7a2b", "#5f7d12", "#8a6500", "#a84b00", "#b3261e"};
  const auto left = static_cast<int>(7 * set.size() + 20);
  constexpr int right = 34, height = 22;
  const std::string name = xml_escaped(set);
  return fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" role="img" aria-label="{2}: {3}">
<title>{2}: {3}</title>
<rect width="{4}" height="{1}" fill="#3a4049"/><rect x="{4}" width="{5}" height="{1}" fill="{6}"/>
<g fill="#fff" font-family="Verdana,DejaVu Sans,sans-serif" font-size="12" text-anchor="middle">
<text x="{7}" y="15.5">{2}</text><text x="{8}" y="15.5" font-weight="bold">{3}</text></g></svg>
)",
      left + right, height, name, to_string(grade), left, right, colours[static_cast<std::size_t>(grade)], left / 2,
      left + right / 2);
}

}  // namespace xpr
