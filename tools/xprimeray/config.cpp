// Configuration files in TOML: the options of a subcommand under their own names; a flag beats the file.
#include <fmt/format.h>

#include <algorithm>

#include "command.hpp"
#include "core/io/csv.hpp"
#include "core/io/errors.hpp"
#include "core/io/toml_file.hpp"

namespace xpr::cli {
namespace {

[[noreturn]] void fail(const std::string& path, const TomlValue& value, const std::string& what) {
  throw InputError(fmt::format("{}: line {}: {}", path, value.line, what));
}

// A value as it would stand on the command line.
std::string argument_text(const std::string& path, const std::string& key, const TomlValue& value) {
  if (const auto* text = value.as<std::string>()) return *text;
  if (const auto* number = value.as<std::int64_t>()) return std::to_string(*number);
  if (const auto* number = value.as<double>()) return number_text(*number);
  if (const auto* flag = value.as<bool>()) return *flag ? "true" : "false";
  fail(path, value, fmt::format("{} needs a number, a text or true or false", key));
}

// The name=value entries of a table, but for the names that the command line gave.
std::vector<std::string> entries_of(const std::string& path, const std::string& key, const TomlTable& table,
                                    const std::vector<std::string>& given) {
  std::vector<std::string> entries;
  for (const auto& [name, value] : table) {
    const std::string prefix = name + "=";
    const std::string entry = prefix + argument_text(path, key, value);
    const auto same = [&](const std::string& other) { return other.starts_with(prefix); };
    if (std::none_of(given.begin(), given.end(), same)) entries.push_back(entry);
  }
  return entries;
}

void apply_key(CLI::App& command, const std::string& path, const std::string& key, const TomlValue& node) {
  CLI::Option* option = command.get_option_no_throw("--" + key);
  if (option == nullptr || key == "config" || key == "help") {
    std::vector<std::string_view> known;
    for (const CLI::Option* candidate : command.get_options()) {
      for (const std::string& name : candidate->get_lnames()) {
        if (name != "config" && name != "help") known.push_back(name);
      }
    }
    fail(path, node, unknown_name("key", key, known));
  }
  std::vector<std::string> values;
  if (const auto* table = node.as<TomlTable>()) {
    values = entries_of(path, key, *table, option->results());
    if (option->get_expected_max() == 1) fail(path, node, key + " is no table");
  } else if (option->count() > 0) {
    return;
  } else if (const auto* array = node.as<TomlArray>()) {
    for (const TomlValue& element : *array) values.push_back(argument_text(path, key, element));
  } else {
    values.push_back(argument_text(path, key, node));
  }
  if (values.empty()) return;
  for (const std::string& value : values) option->add_result(value);
  try {
    option->run_callback();
  } catch (const CLI::Error& error) {
    fail(path, node, error.what());
  }
}

}  // namespace

void apply_config(CLI::App& command, const std::string& path) {
  for (const auto& [key, value] : read_toml(path)) apply_key(command, path, key, value);
}

}  // namespace xpr::cli
