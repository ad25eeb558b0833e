# xpr_folder(NAME SOURCES ... USES ...): one static library for one architecture folder, alias xpr::NAME.
#
# A consumer gets an include path that holds this folder alone, so that `#include "core/..."` from metrics/ does not
# compile: the arrows between folders are enforced by the build, not by custom.
function(xpr_folder NAME)
  cmake_parse_arguments(ARG "" "" "SOURCES;USES" ${ARGN})
  set(gate "${CMAKE_BINARY_DIR}/include/${NAME}")
  file(MAKE_DIRECTORY "${gate}")
  file(CREATE_LINK "${PROJECT_SOURCE_DIR}/${NAME}" "${gate}/${NAME}" SYMBOLIC)
  add_library(xpr_${NAME} STATIC ${ARG_SOURCES})
  add_library(xpr::${NAME} ALIAS xpr_${NAME})
  set_target_properties(xpr_${NAME} PROPERTIES EXPORT_NAME ${NAME} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(xpr_${NAME} PUBLIC
    "$<BUILD_INTERFACE:${gate}>" "$<INSTALL_INTERFACE:include/xprimeray>")
  target_link_libraries(xpr_${NAME} PUBLIC ${ARG_USES} PRIVATE "$<BUILD_INTERFACE:xpr_warnings>")
endfunction()
