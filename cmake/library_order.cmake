# SPDX-License-Identifier: AGPL-3.0-or-later
#
# Most of the time that a short run takes is the dynamic linker's: it looks up some
# 200 000 names of the 200 libraries that deal.II brings, each in one library after the
# other. It goes through them in the order in which the program names them, so the
# program names those first that have the most to look up. The libraries stay the same.

# tetradapt_order_libraries(<target>)
#
# Links <target> with the libraries that deal.II needs, in the order described above. Does
# nothing where ldd or readelf are missing, or in another build type than Release.
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
  set(_sorted "")
  foreach(_library ${_libraries})
    # (libc, its dynamic linker and the compiler's libraries are looked up by everyone.)
    if(NOT _library MATCHES "/(libc|libm|ld-linux[^/]*|libgcc_s|libpthread)\\.so")
      execute_process(COMMAND ${CMAKE_READELF} -dW ${_library} OUTPUT_VARIABLE _dynamic ERROR_QUIET)
      set(_names 0)
      if(_dynamic MATCHES "\\(RELASZ\\) +([0-9]+)")
        math(EXPR _names "${CMAKE_MATCH_1} / 24")
      endif()
      if(_dynamic MATCHES "\\(RELACOUNT\\) +([0-9]+)")
        math(EXPR _names "${_names} - ${CMAKE_MATCH_1}")
      endif()
      if(_names GREATER 500)
        list(APPEND _sorted "${_names} ${_library}")
      endif()
    endif()
  endforeach()
  list(SORT _sorted COMPARE NATURAL ORDER DESCENDING)
  list(TRANSFORM _sorted REPLACE "^[0-9]+ " "")
  target_link_options(${_target} PRIVATE
    -Wl,--push-state,--no-as-needed ${_deal_ii} ${_sorted} -Wl,--pop-state)
endfunction()
