// A table of a TOML file read with types: what has another type, is not finite or is not known ends in one line that
// names file, line and key.
#pragma once

#include <array>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/source_place.hpp"
#include "core/io/toml_file.hpp"

namespace xpr {

/// Every reader returns nothing where the key is not there, and throws InputError for a value of another type.
class TomlSection {
 public:
  /// `title` names the section in errors: "[camera]". Throws InputError for a key that is not in `known`, naming the
  /// nearest one. The table must outlive this.
  TomlSection(std::string file, std::string title, int line, const TomlTable& table,
              const std::vector<std::string_view>& known);

  [[nodiscard]] const SourcePlace& place() const { return place_; }
  [[nodiscard]] const TomlValue* find(std::string_view key) const;
  [[nodiscard]] bool has(std::string_view key) const { return find(key) != nullptr; }
  /// Throws InputError where the key is missing.
  void require(std::string_view key) const;

  [[nodiscard]] std::optional<bool> flag(std::string_view key) const;
  [[nodiscard]] std::optional<std::int64_t> integer(std::string_view key) const;
  [[nodiscard]] std::optional<double> number(std::string_view key) const;  ///< finite
  [[nodiscard]] std::optional<double> angle(std::string_view key) const;   ///< "42deg", in radians, finite
  [[nodiscard]] std::optional<std::string> text(std::string_view key) const;
  [[nodiscard]] std::optional<std::vector<double>> numbers(std::string_view key) const;  ///< finite
  [[nodiscard]] std::optional<std::vector<std::string>> texts(std::string_view key) const;
  [[nodiscard]] const TomlTable* table(std::string_view key) const;

  /// Exactly N finite numbers.
  template <std::size_t N>
  [[nodiscard]] std::optional<std::array<double, N>> numbers_of(std::string_view key) const {
    const auto values = numbers(key);
    if (!values) return std::nullopt;
    check_count(key, values->size(), N);
    std::array<double, N> out{};
    std::copy(values->begin(), values->end(), out.begin());
    return out;
  }

  /// The enumerator whose name is given: names in the order of the enum.
  template <class Enum, std::size_t N>
  [[nodiscard]] std::optional<Enum> choice(std::string_view key, const std::array<std::string_view, N>& names) const {
    const auto word = text(key);
    if (!word) return std::nullopt;
    return static_cast<Enum>(choose(key, *word, {names.begin(), names.end()}));
  }

 private:
  void check_count(std::string_view key, std::size_t count, std::size_t needed) const;
  [[nodiscard]] std::size_t choose(std::string_view key, const std::string& word,
                                   const std::vector<std::string_view>& names) const;
  [[nodiscard]] double finite(std::string_view key, const TomlValue& value) const;

  SourcePlace place_;
  const TomlTable* table_;
};

}  // namespace xpr
