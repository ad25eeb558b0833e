// Configuration files in TOML: the options of a subcommand under their own names; a flag beats the file.
#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>

#include "command.hpp"
#include "core/io/csv.hpp"
#include "core/io/errors.hpp"

namespace xpr::cli {
namespace {

[[noreturn]] void fail(const std::string& path, const toml::node& node, const std::string& what) {
  throw InputError(fmt::format("{}: line {}: {}", path, node.source().begin.line, what));
}

// A value as it would stand on the command line.
std::string argument_text(const std::string& path, const std::string& key, const toml::node& node) {
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* number = node.as_integer()) return std::to_string(number->get());
  if (const auto* number = node.as_floating_point()) return number_text(number->get());
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  fail(path, node, fmt::format("{} needs a number, a text or true or false", key));
}

// The name=value entries of a table, but for the names that the command line gave.
std::vector<std::string> entries_of(const std::string& path, const std::string& key, const toml::table& table,
                                    const std::vector<std::string>& given) {
  std::vector<std::string> entries;
  for (const auto& [name, value] : table) {
    const std::string prefix = std::string(name.str()) + "=";
    const std::string entry = prefix + argument_text(path, key, value);
    const auto same = [&](const std::string& other) { return other.starts_with(prefix); };
    if (std::none_of(given.begin(), given.end(), same)) entries.push_back(entry);
  }
  return entries;
}

void apply_key(CLI::App& command, const std::string& path, const std::string& key, const toml::node& node) {
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
  if (const auto* table = node.as_table()) {
    values = entries_of(path, key, *table, option->results());
    if (option->get_expected_max() == 1) fail(path, node, key + " is no table");
  } else if (option->count() > 0) {
    return;
  } else if (const auto* array = node.as_array()) {
    for (const auto& element : *array) values.push_back(argument_text(path, key, element));
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
  std::ifstream file(path, std::ios::binary);
  if (!file) throw_system_error(path, "cannot be read", errno);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (file.bad()) throw_system_error(path, "cannot be read", errno);
  try {
    for (const toml::table table = toml::parse(text); const auto& [key, node] : table) {
      apply_key(command, path, std::string(key.str()), node);
    }
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}: line {}: {}", path, error.source().begin.line, error.description()));
  }
}

}  // namespace xpr::cli
