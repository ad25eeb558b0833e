# Compiler settings: warnings for our own code, the options that make results equal to the bit, sanitizers, the ISA level.

add_library(xpr_warnings INTERFACE)
target_compile_options(xpr_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion)
# Masks of one lane are bool, and templates over the scalar combine them with & and | as they do masks of many lanes.
target_compile_options(xpr_warnings INTERFACE $<$<CXX_COMPILER_ID:Clang>:-Wno-bitwise-instead-of-logical>)
if(XPRIMERAY_WERROR)
  target_compile_options(xpr_warnings INTERFACE -Werror)
endif()

# xpr_determinism: inherited by everything that links xpr::metrics, plugins included. gcc contracts a*b+c into a fused
# multiply-add by default, which changes bits between ISA levels; Eigen's own FMA intrinsics ignore that switch.
# -fno-math-errno only lets sqrt be one instruction: no value changes.
add_library(xpr_determinism INTERFACE)
target_compile_options(xpr_determinism INTERFACE -ffp-contract=off -fno-math-errno)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # gcc 12.2's vectoriser turns pairs such as (r x + a y, r y - a x) into vfmaddsub and vfmsubadd even so. Lanes are
  # explicit vectors and lose nothing; tests/tools/check_no_fma.py looks at the machine code.
  target_compile_options(xpr_determinism INTERFACE -fno-tree-vectorize)
endif()
target_compile_definitions(xpr_determinism INTERFACE EIGEN_DONT_VECTORIZE)

# The ISA level moves speed, never bits. "native" picks the highest x86-64 level that this machine runs.
set(XPRIMERAY_ISA "native" CACHE STRING "x86-64-v2, x86-64-v3, x86-64-v4, native, or none")
set_property(CACHE XPRIMERAY_ISA PROPERTY STRINGS native x86-64-v2 x86-64-v3 x86-64-v4 none)
set(isa "${XPRIMERAY_ISA}")
if(isa STREQUAL "native")
  set(isa "none")
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND EXISTS /proc/cpuinfo)
    file(READ /proc/cpuinfo cpuinfo)
    set(isa "x86-64-v2")
    if(cpuinfo MATCHES "avx2" AND cpuinfo MATCHES "bmi2" AND cpuinfo MATCHES " fma")
      set(isa "x86-64-v3")
      if(cpuinfo MATCHES "avx512f" AND cpuinfo MATCHES "avx512dq" AND cpuinfo MATCHES "avx512vl")
        set(isa "x86-64-v4")
      endif()
    endif()
  endif()
endif()
if(NOT isa STREQUAL "none")
  add_compile_options("-march=${isa}")
endif()
set(XPRIMERAY_ISA_RESOLVED "${isa}")

if(XPRIMERAY_SANITIZE)
  add_compile_options("-fsanitize=${XPRIMERAY_SANITIZE}" -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options("-fsanitize=${XPRIMERAY_SANITIZE}")
endif()

find_program(XPRIMERAY_CCACHE ccache)
if(XPRIMERAY_CCACHE)
  set(CMAKE_C_COMPILER_LAUNCHER "${XPRIMERAY_CCACHE}")
  set(CMAKE_CXX_COMPILER_LAUNCHER "${XPRIMERAY_CCACHE}")
endif()
