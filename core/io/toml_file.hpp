// TOML files as plain values that know their lines: the one place that knows toml++.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace xpr {

struct TomlEntry;
struct TomlValue;
using TomlArray = std::vector<TomlValue>;
/// In the order of the file's lines.
using TomlTable = std::vector<TomlEntry>;

/// A date or a time, which nothing here takes.
struct TomlDate {};

struct TomlValue {
  std::variant<TomlDate, bool, std::int64_t, double, std::string, TomlArray, TomlTable> value;
  int line = 0;  ///< where it begins, the first being 1

  template <class T>
  [[nodiscard]] const T* as() const {
    return std::get_if<T>(&value);
  }
};

struct TomlEntry {
  std::string key;
  TomlValue value;
};

/// `name` stands for the text in error messages. Throws InputError for what is no TOML: "name: line 3: ...".
[[nodiscard]] TomlTable parse_toml(std::string_view text, const std::string& name);
/// Throws InputError for a file that cannot be read, and as parse_toml.
[[nodiscard]] TomlTable read_toml(const std::filesystem::path& path);

}  // namespace xpr
