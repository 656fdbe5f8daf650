# SPDX-License-Identifier: AGPL-3.0-or-later
#
# Most of the time that a short run takes is the dynamic linker's: it looks up some
# 200 000 names of the 200 libraries that deal.II brings, each in one library after the
# other. It goes through them in the order in which the program names them, so the
# program names those first that have the most to look up.
#
# Only libraries of C++ names are moved. Several of C and Fortran define the same names
# (SCOTCH and PT-SCOTCH, COLAMD and SuperLU), and which one comes first must stay.

# tetradapt_order_libraries(<target>)
#
# Links <target> with libraries that deal.II needs, in the order described above. Does
# nothing where ldd or readelf are missing, where a library lies in a folder that the
# dynamic linker does not search by itself, or in another build type than Release.
function(tetradapt_order_libraries _target)
  find_program(TETRADAPT_LDD ldd)
  mark_as_advanced(TETRADAPT_LDD)
  if(NOT TETRADAPT_LDD OR NOT CMAKE_READELF OR NOT CMAKE_BUILD_TYPE STREQUAL "Release"
     OR NOT DEAL_II_TARGET_RELEASE)
    return()
  endif()
  get_target_property(_deal_ii ${DEAL_II_TARGET_RELEASE} LOCATION)
  execute_process(COMMAND ${TETRADAPT_LDD} ${_deal_ii} RESULT_VARIABLE _failed
                  OUTPUT_VARIABLE _output ERROR_QUIET)
  if(_failed)
    return()
  endif()
  string(REGEX MATCHALL "=> /[^ \n]+" _libraries "${_output}")
  string(REPLACE "=> " "" _libraries "${_libraries}")
  list(FILTER _libraries INCLUDE REGEX "/lib(TK|trilinos_|stdc\\+\\+|gmsh|alglib|assimp|draco)")
  set(_sorted "")
  foreach(_library ${_libraries})
    if(NOT _library MATCHES "^(/usr)?/lib/")
      return()
    endif()
    execute_process(COMMAND ${CMAKE_READELF} -dW ${_library} OUTPUT_VARIABLE _dynamic ERROR_QUIET)
    set(_names 0)
    if(_dynamic MATCHES "\\(RELASZ\\) +([0-9]+)")
      math(EXPR _names "${CMAKE_MATCH_1} / 24")
    endif()
    if(_dynamic MATCHES "\\(RELACOUNT\\) +([0-9]+)")
      math(EXPR _names "${_names} - ${CMAKE_MATCH_1}")
    endif()
    if(_names GREATER 500)
      math(EXPR _key "1000000000 + ${_names}") # as many digits for all, to sort by
      list(APPEND _sorted "${_key} ${_library}")
    endif()
  endforeach()
  list(SORT _sorted)
  list(REVERSE _sorted)
  list(TRANSFORM _sorted REPLACE "^[0-9]+ " "")
  target_link_options(${_target} PRIVATE
    -Wl,--push-state,--no-as-needed ${_deal_ii} ${_sorted} -Wl,--pop-state)
endfunction()
