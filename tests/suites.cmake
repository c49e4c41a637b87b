# SPDX-License-Identifier: MIT
# One ctest entry for each suite of a GoogleTest program, where tests of a suite share something
# dear: a device and its pipelines take 3 s of CPU (5 s under sanitizers), a set of pictures 50 s.
# .ci/count_tests.py counts the single tests from the program's output.

# welkin_discover_suites(TARGET [FILTER pattern] [PROPERTIES ...]): as gtest_discover_tests with
# DISCOVERY_MODE PRE_TEST. A FILTER takes suites or, with a leading '-', leaves tests out.
function(welkin_discover_suites target)
  cmake_parse_arguments(PARSE_ARGV 1 SUITES "" "FILTER" "PROPERTIES")
  if(NOT SUITES_FILTER)
    set(SUITES_FILTER "*")
  endif()
  set(script ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
  file(GENERATE OUTPUT ${script} CONTENT
"include([==[${CMAKE_CURRENT_FUNCTION_LIST_FILE}]==])
welkin_add_suites([==[$<TARGET_FILE:${target}>]==] [==[${SUITES_FILTER}]==] ${SUITES_PROPERTIES})
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${script})
endfunction()

# Run by ctest: asks the program for its suites.
function(welkin_add_suites program filter)
  if(NOT EXISTS ${program})
    add_test(${program}_NOT_BUILT ${program})
    return()
  endif()
  execute_process(COMMAND ${program} --gtest_list_tests --gtest_filter=${filter}
                  OUTPUT_VARIABLE list RESULT_VARIABLE failed)
  string(REGEX MATCHALL "(^|\n)[^ \n]+\\.[ \n]" suites "${list}")
  if(failed OR NOT suites)
    message(FATAL_ERROR "${program} does not list its tests: ${failed} ${list}")
  endif()
  set(left_out "")
  if(filter MATCHES "^-")
    set(left_out ${filter})
  endif()
  foreach(suite IN LISTS suites)
    string(REGEX REPLACE "^\n|\\.[ \n]$" "" suite "${suite}")
    add_test(${suite} ${program} --gtest_filter=${suite}.*${left_out})
    set_tests_properties(${suite} PROPERTIES ${ARGN})
  endforeach()
endfunction()
