# xpr_stored_tables(OUTPUT): writes a source that holds the text of every table of reference_data/, for stored_tables().
# Configures anew where a table changes, comes or goes.
function(xpr_stored_tables OUTPUT)
  file(GLOB tables CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/reference_data/*.csv")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${tables})
  set(entries "")
  foreach(table ${tables})
    get_filename_component(name "${table}" NAME_WE)
    file(READ "${table}" text)
    string(APPEND entries "      {\"${name}\", R\"table(${text})table\"},\n")
  endforeach()
  file(CONFIGURE OUTPUT "${OUTPUT}" @ONLY CONTENT [[
// Written by the build.
#include "validation/truth/stored_tables.hpp"

namespace xpr {

const std::vector<StoredTable>& stored_tables() {
  static const std::vector<StoredTable> tables = {
@entries@  };
  return tables;
}

}  // namespace xpr
]])
endfunction()
