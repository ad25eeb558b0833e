#include "core/io/toml_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/io/angle.hpp"
#include "core/io/names.hpp"

namespace xpr {

TomlSection::TomlSection(std::string file, std::string title, int line, const TomlTable& table,
                         const std::vector<std::string_view>& known)
    : place_{std::move(file), std::move(title), line, {}}, table_(&table) {
  for (const TomlEntry& entry : table) place_.key_line[entry.key] = entry.value.line;
  for (const TomlEntry& entry : table) {
    if (std::find(known.begin(), known.end(), entry.key) != known.end()) continue;
    SourcePlace there = place_;
    there.line = entry.value.line;
    there.fail(unknown_name("key", entry.key, known));
  }
}

const TomlValue* TomlSection::find(std::string_view key) const {
  for (const TomlEntry& entry : *table_) {
    if (entry.key == key) return &entry.value;
  }
  return nullptr;
}

void TomlSection::require(std::string_view key) const {
  if (!has(key)) place_.fail(key, "is missing");
}

std::optional<bool> TomlSection::flag(std::string_view key) const {
  const TomlValue* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (const bool* flag = value->as<bool>()) return *flag;
  place_.fail(key, "needs true or false");
}

std::optional<std::int64_t> TomlSection::integer(std::string_view key) const {
  const TomlValue* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (const auto* number = value->as<std::int64_t>()) return *number;
  place_.fail(key, "needs a whole number");
}

double TomlSection::finite(std::string_view key, const TomlValue& value) const {
  if (const auto* number = value.as<std::int64_t>()) return static_cast<double>(*number);
  const auto* number = value.as<double>();
  if (number == nullptr) place_.fail(key, "needs a number");
  if (!std::isfinite(*number)) place_.fail(key, fmt::format("is {}, needs a finite number", *number));
  return *number;
}

std::optional<double> TomlSection::number(std::string_view key) const {
  const TomlValue* value = find(key);
  if (value == nullptr) return std::nullopt;
  return finite(key, *value);
}

std::optional<double> TomlSection::angle(std::string_view key) const {
  const TomlValue* value = find(key);
  if (value == nullptr) return std::nullopt;
  const auto* word = value->as<std::string>();
  const auto radians = word == nullptr ? std::nullopt : parse_angle(*word);
  if (!radians || !std::isfinite(*radians)) {
    place_.fail(key, "needs an angle with its unit, as in \"42deg\" or \"0.7rad\"");
  }
  return radians;
}

std::optional<std::string> TomlSection::text(std::string_view key) const {
  const TomlValue* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (const auto* word = value->as<std::string>()) return *word;
  place_.fail(key, "needs a text in quotes");
}

std::optional<std::vector<double>> TomlSection::numbers(std::string_view key) const {
  const TomlValue* value = find(key);
  if (value == nullptr) return std::nullopt;
  const auto* array = value->as<TomlArray>();
  if (array == nullptr) place_.fail(key, "needs numbers in brackets");
  std::vector<double> out;
  for (const TomlValue& element : *array) out.push_back(finite(key, element));
  return out;
}

std::optional<std::vector<std::string>> TomlSection::texts(std::string_view key) const {
  const TomlValue* value = find(key);
  if (value == nullptr) return std::nullopt;
  const auto* array = value->as<TomlArray>();
  if (array == nullptr) place_.fail(key, "needs texts in brackets");
  std::vector<std::string> out;
  for (const TomlValue& element : *array) {
    const auto* word = element.as<std::string>();
    if (word == nullptr) place_.fail(key, "needs texts in brackets");
    out.push_back(*word);
  }
  return out;
}

const TomlTable* TomlSection::table(std::string_view key) const {
  const TomlValue* value = find(key);
  if (value == nullptr) return nullptr;
  if (const auto* table = value->as<TomlTable>()) return table;
  place_.fail(key, "needs a table, as in { M = 1.0 }");
}

void TomlSection::check_count(std::string_view key, std::size_t count, std::size_t needed) const {
  if (count != needed) place_.fail(key, fmt::format("has {} numbers, needs {}", count, needed));
}

std::size_t TomlSection::choose(std::string_view key, const std::string& word,
                                const std::vector<std::string_view>& names) const {
  const auto found = std::find(names.begin(), names.end(), word);
  if (found == names.end()) place_.fail(key, "is an " + unknown_name("name", word, names));
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace xpr
