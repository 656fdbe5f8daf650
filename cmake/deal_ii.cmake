# SPDX-License-Identifier: AGPL-3.0-or-later
#
# Finds deal.II, checks that it has what is used here, and mends the flags that
# Debian's package exports: they hold the packager's -g and -O2 in every build
# type and name a linker that need not be installed.

find_package(deal.II 9.4 QUIET HINTS ${DEAL_II_DIR} $ENV{DEAL_II_DIR})
if(NOT deal.II_FOUND)
  message(FATAL_ERROR
    "deal.II 9.4 or later was not found. Install Debian's package libdeal.ii-dev, "
    "or name the folder of another installation with -DDEAL_II_DIR=...")
endif()
foreach(_feature MPI TRILINOS METIS LAPACK BOOST)
  if(NOT DEAL_II_WITH_${_feature})
    message(FATAL_ERROR
      "The deal.II ${DEAL_II_PACKAGE_VERSION} in ${DEAL_II_PATH} was built without ${_feature}, "
      "which Tetradapt needs. Debian's package libdeal.ii-dev has it.")
  endif()
endforeach()
message(STATUS "deal.II ${DEAL_II_PACKAGE_VERSION} in ${DEAL_II_PATH}")
deal_ii_initialize_cached_variables()

separate_arguments(_flags UNIX_COMMAND "${DEAL_II_CXX_FLAGS}")
list(FILTER _flags EXCLUDE REGEX "^(-g|-O[0-9]|-ffile-prefix-map=.*|-std=.*)$")
if(CMAKE_BUILD_TYPE STREQUAL "Debug")
  # glibc warns about it in builds that are not optimised.
  list(FILTER _flags EXCLUDE REGEX "^-D_FORTIFY_SOURCE=.*$")
endif()
string(JOIN " " DEAL_II_CXX_FLAGS ${_flags})
string(REGEX REPLACE "-O[0-9]" "-O3" DEAL_II_CXX_FLAGS_RELEASE "${DEAL_II_CXX_FLAGS_RELEASE}")

string(REGEX REPLACE "-fuse-ld=[a-z]+" "" DEAL_II_LINKER_FLAGS "${DEAL_II_LINKER_FLAGS}")
if(CMAKE_BUILD_TYPE STREQUAL "Release")
  # A program that exports all its names takes longer to start; only the backtraces of
  # deal.II's exceptions would show them, and the user sees one message instead.
  string(REPLACE "-rdynamic" "" DEAL_II_LINKER_FLAGS "${DEAL_II_LINKER_FLAGS}")
endif()
find_program(TETRADAPT_MOLD mold)
mark_as_advanced(TETRADAPT_MOLD)
if(TETRADAPT_MOLD)
  string(APPEND DEAL_II_LINKER_FLAGS " -fuse-ld=mold")
endif()
