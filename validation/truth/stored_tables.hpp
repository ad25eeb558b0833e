// The tables of reference_data/ as they were when this was built: what cases take as truth, wherever the program runs.
#pragma once

#include <string_view>
#include <vector>

#include "core/io/reference_table.hpp"

namespace xpr {

/// A file built in, unread.
struct StoredTable {
  std::string_view name;
  std::string_view text;
};

/// All of them, in alphabetical order.
[[nodiscard]] const std::vector<StoredTable>& stored_tables();

/// One of them, read and its hash checked. Throws std::out_of_range for a name that is not there.
[[nodiscard]] ReferenceTable stored_table(std::string_view name);

}  // namespace xpr
