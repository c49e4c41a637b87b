# SPDX-License-Identifier: MIT
# The static library as one object that defines nothing but wlk*: a host may have its own volk, GLM
# or another Welkin, and links one file, from C too.

# Needs GNU ld's --force-group-allocation: without it the linker drops the C++ instantiations that a
# host has as well, and with them what the archive's now local symbols stand for.
function(welkin_check_archive result)
  if(WELKIN_SANITIZE OR NOT CMAKE_LINKER OR NOT CMAKE_OBJCOPY)
    set(${result} OFF PARENT_SCOPE)
    return()
  endif()
  execute_process(COMMAND ${CMAKE_LINKER} --help OUTPUT_VARIABLE help ERROR_QUIET)
  string(FIND "${help}" "--force-group-allocation" found)
  if(found EQUAL -1)
    set(${result} OFF PARENT_SCOPE)
  else()
    set(${result} ON PARENT_SCOPE)
  endif()
endfunction()

# welkin_add_archive(TARGET OBJECT_LIBRARY...): TARGET is libwelkin.a, made from their objects.
function(welkin_add_archive target)
  set(objects "")
  foreach(part ${ARGN})
    list(APPEND objects $<TARGET_OBJECTS:${part}>)
  endforeach()
  set(joined ${CMAKE_CURRENT_BINARY_DIR}/welkin_joined.o)
  set(merged ${CMAKE_CURRENT_BINARY_DIR}/welkin_merged.o)
  add_custom_command(
    OUTPUT ${merged}
    COMMAND ${CMAKE_LINKER} -r --force-group-allocation -o ${joined} ${objects}
    COMMAND ${CMAKE_OBJCOPY} --wildcard --keep-global-symbol=wlk* ${joined} ${merged}
    COMMAND ${CMAKE_COMMAND} -E rm ${joined}
    DEPENDS ${objects} COMMAND_EXPAND_LISTS COMMENT "One object of libwelkin.a" VERBATIM)
  set_source_files_properties(${merged} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
  add_library(${target} STATIC ${merged})
  # Of a C project CMake must not ask for a C++ linker: the C++ runtime is named instead.
  set(runtime ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
  list(REMOVE_ITEM runtime ${CMAKE_C_IMPLICIT_LINK_LIBRARIES})
  list(APPEND runtime ${CMAKE_DL_LIBS})
  target_link_libraries(${target} INTERFACE ${runtime})
  target_compile_definitions(${target} INTERFACE WELKIN_STATIC)
  set_target_properties(${target} PROPERTIES OUTPUT_NAME welkin LINKER_LANGUAGE C)
  list(TRANSFORM runtime PREPEND -l)
  list(JOIN runtime " " runtime)
  set(WELKIN_PC_RUNTIME "${runtime}" PARENT_SCOPE)
endfunction()
