# xprimeray_build.hpp: what a build knows of itself, for provenance. Runs at every build and costs two calls of git; the
# header is only touched where something changed. Holds no path. Included for the target, run as a script for the work.
if(CMAKE_SCRIPT_MODE_FILE)
  set(commit "unknown")
  set(dirty "false")
  execute_process(COMMAND git -C "${SOURCE_DIR}" rev-parse HEAD
    OUTPUT_VARIABLE head RESULT_VARIABLE git_status OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(git_status EQUAL 0)
    set(commit "${head}")
    execute_process(COMMAND git -C "${SOURCE_DIR}" status --porcelain --untracked-files=no
      OUTPUT_VARIABLE changes OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(changes)
      set(dirty "true")
    endif()
  endif()
  file(CONFIGURE OUTPUT "${HEADER}" @ONLY CONTENT [[
// Written by the build.
#pragma once

namespace xpr::build {

inline constexpr const char* version = "@VERSION@";
inline constexpr const char* commit = "@commit@";
inline constexpr bool dirty = @dirty@;
inline constexpr const char* compiler = "@COMPILER@";
inline constexpr const char* build_type = "@BUILD_TYPE@";
inline constexpr const char* flags = "@FLAGS@";
inline constexpr const char* isa = "@ISA@";

}  // namespace xpr::build
]])
  return()
endif()

# The flags that decide about bits: the compiler's defaults for this build type, the ISA level, the determinism options.
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
get_target_property(determinism xpr_determinism INTERFACE_COMPILE_OPTIONS)
set(flags ${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}})
if(NOT XPRIMERAY_ISA_RESOLVED STREQUAL "none")
  list(APPEND flags "-march=${XPRIMERAY_ISA_RESOLVED}")
endif()
if(XPRIMERAY_SANITIZE)
  list(APPEND flags "-fsanitize=${XPRIMERAY_SANITIZE}")
endif()
list(APPEND flags ${determinism})
list(JOIN flags " " flags)
set(XPRIMERAY_BUILD_INFO_DIR "${CMAKE_BINARY_DIR}/generated")
add_custom_target(xpr_build_info
  COMMAND "${CMAKE_COMMAND}"
    "-DSOURCE_DIR=${PROJECT_SOURCE_DIR}" "-DHEADER=${XPRIMERAY_BUILD_INFO_DIR}/xprimeray_build.hpp"
    "-DVERSION=${PROJECT_VERSION}" "-DCOMPILER=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}"
    "-DBUILD_TYPE=${CMAKE_BUILD_TYPE}" "-DFLAGS=${flags}" "-DISA=${XPRIMERAY_ISA_RESOLVED}"
    -P "${CMAKE_CURRENT_LIST_FILE}"
  BYPRODUCTS "${XPRIMERAY_BUILD_INFO_DIR}/xprimeray_build.hpp"
  COMMENT "Noting the commit"
  VERBATIM)
