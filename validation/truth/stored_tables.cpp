#include "validation/truth/stored_tables.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace xpr {

ReferenceTable stored_table(std::string_view name) {
  for (const StoredTable& table : stored_tables()) {
    if (table.name == name) return parse_reference(table.text, fmt::format("built-in table {}", name));
  }
  throw std::out_of_range(fmt::format("no table '{}' is built in", name));
}

}  // namespace xpr
