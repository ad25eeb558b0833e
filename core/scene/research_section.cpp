// [research] of a scene file: a preset and overrides, one key for every field of ResearchOverrides.
#include <fmt/format.h>

#include <stdexcept>
#include <type_traits>

#include "core/scene/scene_sections.hpp"

namespace xpr::scene_sections {
namespace {

// One overload for each type of a field.
void read(const TomlSection& section, std::string_view key, std::optional<bool>& to) { to = section.flag(key); }
void read(const TomlSection& section, std::string_view key, std::optional<double>& to) { to = section.number(key); }
void read(const TomlSection& section, std::string_view key, std::optional<std::int64_t>& to) {
  to = section.integer(key);
}
void read(const TomlSection& section, std::string_view key, std::optional<std::string>& to) { to = section.text(key); }
void read(const TomlSection& section, std::string_view key, std::optional<ResearchTier>& to) {
  const auto tier = section.integer(key);
  if (!tier) return;
  if (*tier < 0 || *tier > 2) section.place().fail(key, fmt::format("is {}, needs 0, 1 or 2", *tier));
  to = static_cast<ResearchTier>(*tier);
}
void read(const TomlSection& section, std::string_view key, std::optional<TransportModel>& to) {
  // An older name of the last one.
  if (section.find(key) != nullptr && section.text(key) == "Metric_Adapter_EffectiveMedium") {
    to = TransportModel::hybrid_research;
    return;
  }
  to = section.choice<TransportModel>(key, transport_model_names);
}
void read(const TomlSection& section, std::string_view key, std::optional<ResearchSuite>& to) {
  to = section.choice<ResearchSuite>(key, research_suite_names);
}
void read(const TomlSection& section, std::string_view key, std::optional<std::vector<PixelIndex>>& to) {
  const TomlValue* value = section.find(key);
  if (value == nullptr) return;
  constexpr std::string_view needs = "needs pixels [column, row], as in [[320, 180], [10, 20]]";
  const auto* pixels = value->as<TomlArray>();
  if (pixels == nullptr) section.place().fail(key, needs);
  to.emplace();
  for (const TomlValue& pixel : *pixels) {
    const auto* pair = pixel.as<TomlArray>();
    if (pair == nullptr || pair->size() != 2) section.place().fail(key, needs);
    const auto* column = (*pair)[0].as<std::int64_t>();
    const auto* row = (*pair)[1].as<std::int64_t>();
    if (column == nullptr || row == nullptr) section.place().fail(key, needs);
    to->push_back({*column, *row});
  }
}

}  // namespace

Keys research_keys() {
  Keys keys{"preset", "enabled"};
  for_each_research_field([&](std::string_view name, auto, auto) { keys.push_back(name); });
  return keys;
}

SceneResearch research_from(const TomlSection& section) {
  SceneResearch research;
  if (const auto preset = section.text("preset")) research.preset = *preset;
  bool any = research.preset != "off";
  for_each_research_field([&](std::string_view name, auto, auto member) {
    read(section, name, research.overrides.*member);
    any = any || (research.overrides.*member).has_value();
  });
  research.overrides.enabled = section.flag("enabled").value_or(any);
  return research;
}

}  // namespace xpr::scene_sections
