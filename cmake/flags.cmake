# SPDX-License-Identifier: AGPL-3.0-or-later
#
# What every target of this project is compiled and linked with.

# Precompiled headers and ccache get along when ccache is told not to look for
# __DATE__ and the like, and the compiler to name the headers it used.
find_program(TETRADAPT_CCACHE ccache)
mark_as_advanced(TETRADAPT_CCACHE)
if(TETRADAPT_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER
    ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${TETRADAPT_CCACHE})
endif()

if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 12)
  message(FATAL_ERROR
    "g++ ${CMAKE_CXX_COMPILER_VERSION} is too old: 12 or later is needed (Debian 12 has it). "
    "Name another one with -DCMAKE_CXX_COMPILER=...")
endif()

set(_own_flags -Wall -Wextra)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(APPEND _own_flags $<$<COMPILE_LANGUAGE:CXX>:-fpch-preprocess>)
endif()
if(TETRADAPT_NATIVE)
  list(APPEND _own_flags -march=native)
endif()

# A target that knows nothing of deal.II.
function(tetradapt_plain_settings _target)
  target_include_directories(${_target} PUBLIC ${CMAKE_SOURCE_DIR}/include)
  target_compile_options(${_target} PRIVATE ${_own_flags} $<$<CONFIG:Release>:-O3>
    $<$<CONFIG:Debug>:-g>)
  target_compile_definitions(${_target} PRIVATE $<$<CONFIG:Release>:NDEBUG>)
  if(TETRADAPT_MOLD)
    set_property(TARGET ${_target} APPEND_STRING PROPERTY LINK_FLAGS " -fuse-ld=mold")
  endif()
endfunction()

# A target that uses deal.II.
function(tetradapt_settings _target)
  target_include_directories(${_target} PUBLIC ${CMAKE_SOURCE_DIR}/include)
  deal_ii_setup_target(${_target})
  target_compile_options(${_target} PRIVATE ${_own_flags})
endfunction()

# Lets a target start from the common precompiled headers: light or solver.
function(tetradapt_precompile _target _kind)
  if(TARGET tetradapt_pch_${_kind})
    target_precompile_headers(${_target} REUSE_FROM tetradapt_pch_${_kind})
  endif()
endfunction()
