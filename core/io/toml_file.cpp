#include "core/io/toml_file.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>

#include "core/io/errors.hpp"

namespace xpr {
namespace {

TomlValue value_of(const toml::node& node);

TomlTable table_of(const toml::table& table) {
  TomlTable out;
  for (const auto& [key, node] : table) {
    out.push_back({std::string(key.str()), value_of(node)});
    out.back().value.line = static_cast<int>(key.source().begin.line);
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const TomlEntry& a, const TomlEntry& b) { return a.value.line < b.value.line; });
  return out;
}

TomlValue value_of(const toml::node& node) {
  TomlValue out{TomlDate{}, static_cast<int>(node.source().begin.line)};
  if (const auto* flag = node.as_boolean()) out.value = flag->get();
  if (const auto* number = node.as_integer()) out.value = number->get();
  if (const auto* number = node.as_floating_point()) out.value = number->get();
  if (const auto* text = node.as_string()) out.value = text->get();
  if (const auto* table = node.as_table()) out.value = table_of(*table);
  if (const auto* array = node.as_array()) {
    TomlArray elements;
    for (const toml::node& element : *array) elements.push_back(value_of(element));
    out.value = std::move(elements);
  }
  return out;
}

}  // namespace

TomlTable parse_toml(std::string_view text, const std::string& name) {
  try {
    return table_of(toml::parse(text));
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}: line {}: {}", name, error.source().begin.line, error.description()));
  }
}

TomlTable read_toml(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw_system_error(path, "cannot be read", errno);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (file.bad()) throw_system_error(path, "cannot be read", errno);
  return parse_toml(text, path.string());
}

}  // namespace xpr
