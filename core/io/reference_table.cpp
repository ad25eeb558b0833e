#include "core/io/reference_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "core/io/csv.hpp"
#include "core/io/errors.hpp"
#include "core/io/hash.hpp"

namespace xpr {

namespace {

constexpr std::string_view first_line = "# xprimeray reference table 1\n";
constexpr std::string_view hash_start = "# hash: xxh3-128 ";

/// The texts of the header in their order, by name.
template <class Table>
auto header_of(Table& table) {
  using Text = std::conditional_t<std::is_const_v<Table>, const std::string, std::string>;
  return std::array<std::pair<std::string_view, Text*>, 8>{{{"name", &table.name},
                                                            {"quantity", &table.quantity},
                                                            {"units", &table.units},
                                                            {"origin", &table.origin},
                                                            {"method", &table.method},
                                                            {"rank", &table.rank},
                                                            {"cites", &table.cites},
                                                            {"maker", &table.maker}}};
}

std::string hash_of(std::string_view before, std::string_view after) {
  CanonicalHash hash;
  hash.dataset("before").add(before);
  hash.dataset("after").add(after);
  return hash.hex();
}

std::string record(const std::vector<std::string>& fields) {
  for (const std::string& field : fields) {
    if (field.find_first_of(",\"\r\n") != std::string::npos) {
      throw std::invalid_argument(fmt::format("reference table: '{}' is no text for a column", field));
    }
  }
  return fmt::format("{}\n", fmt::join(fields, ","));
}

/// Takes lines off a text and knows where it is.
class Lines {
 public:
  Lines(std::string_view text, const std::string& place) : text_(text), place_(place) {}
  [[nodiscard]] bool empty() const { return text_.empty(); }
  std::string_view next() {
    const std::size_t end = text_.find('\n');
    if (end == std::string_view::npos) fail("ends early: needs a line break at its end");
    const std::string_view line = text_.substr(0, end);
    text_.remove_prefix(end + 1);
    ++number_;
    return line;
  }
  std::string value(std::string_view name) {
    const std::string_view line = empty() ? std::string_view() : next();
    const std::string start = fmt::format("# {}: ", name);
    if (!line.starts_with(start) || line.size() == start.size()) {
      fail(fmt::format("needs '{}...' here, has '{}'", start, line));
    }
    return std::string(line.substr(start.size()));
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}, line {}: {}", place_, number_, what));
  }

 private:
  std::string_view text_;
  const std::string& place_;
  int number_ = 0;
};

std::vector<std::string> fields_of(std::string_view line) {
  std::vector<std::string> fields;
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.emplace_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

void check_hash(std::string_view text, const std::string& place) {
  const std::size_t line = text.find(hash_start);
  const std::size_t end = line == std::string_view::npos ? line : text.find('\n', line);
  if (end == std::string_view::npos) throw InputError(place + ": needs a line '# hash: xxh3-128 ...' in its header");
  const std::string_view stated = text.substr(line + hash_start.size(), end - line - hash_start.size());
  const std::string found = hash_of(text.substr(0, line), text.substr(end + 1));
  if (stated == found) return;
  throw InputError(
      fmt::format("{}: hash mismatch: the content has {}, the header says {}: the file was changed by hand; "
                  "its line 'maker' says what writes it anew",
                  place, found, stated));
}

}  // namespace

std::string reference_text(const ReferenceTable& table) {
  std::string before(first_line);
  for (const auto& [name, text] : header_of(table)) {
    if (text->empty() || text->find_first_of("\r\n") != std::string::npos) {
      throw std::invalid_argument(fmt::format("reference table '{}': its {} has to be one line", table.name, name));
    }
    before += fmt::format("# {}: {}\n", name, *text);
    if (name == "method") before += fmt::format("# digits: {}\n", table.digits);
  }
  std::string after = record(table.columns);
  for (const std::vector<std::string>& row : table.rows) {
    if (row.size() != table.columns.size()) {
      throw std::invalid_argument(fmt::format("reference table '{}': a row has {} values for {} columns", table.name,
                                              row.size(), table.columns.size()));
    }
    after += record(row);
  }
  return fmt::format("{}{}{}\n{}", before, hash_start, hash_of(before, after), after);
}

ReferenceTable parse_reference(std::string_view text, const std::string& place) {
  if (!text.starts_with(first_line)) {
    throw InputError(fmt::format("{}: is no reference table: needs '{}' as its first line", place,
                                 first_line.substr(0, first_line.size() - 1)));
  }
  check_hash(text, place);
  Lines lines(text, place);
  lines.next();
  ReferenceTable table;
  for (const auto& [name, value] : header_of(table)) {
    *value = lines.value(name);
    if (name != "method") continue;
    std::int64_t digits = 0;
    if (parse_number(lines.value("digits"), digits) != NumberFault::none) lines.fail("digits has to be a whole number");
    table.digits = static_cast<int>(digits);
  }
  (void)lines.value("hash");
  if (lines.empty()) lines.fail("ends early: needs the names of its columns");
  table.columns = fields_of(lines.next());
  while (!lines.empty()) {
    table.rows.push_back(fields_of(lines.next()));
    if (table.rows.back().size() != table.columns.size()) {
      lines.fail(fmt::format("has {} values, needs {}", table.rows.back().size(), table.columns.size()));
    }
  }
  return table;
}

ReferenceTable read_reference(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw_system_error(path, "open", errno);
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  ReferenceTable table = parse_reference(text, path.string());
  if (table.name != path.stem().string()) {
    throw InputError(
        fmt::format("{}: holds the table '{}', which belongs into {}.csv", path.string(), table.name, table.name));
  }
  return table;
}

std::vector<std::filesystem::path> reference_files(const std::filesystem::path& folder) {
  std::error_code problem;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder, problem)) {
    if (entry.path().extension() == ".csv") files.push_back(entry.path());
  }
  if (problem) throw_system_error(folder, "read the folder", problem.value());
  std::sort(files.begin(), files.end());
  return files;
}

std::size_t column_index(const ReferenceTable& table, std::string_view name) {
  const auto found = std::find(table.columns.begin(), table.columns.end(), name);
  if (found == table.columns.end()) {
    throw std::out_of_range(fmt::format("reference table '{}' has no column '{}'", table.name, name));
  }
  return static_cast<std::size_t>(found - table.columns.begin());
}

}  // namespace xpr
