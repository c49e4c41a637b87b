# SPDX-License-Identifier: MIT
# What is installed, in three components: `runtime` (the shared library), `development` (headers,
# archive, CMake package, pkg-config file, documents) and `tools` (the `welkin` program, in
# samples/cli). Every path is relative to the prefix, so that an installed tree can be moved.
include(CMakePackageConfigHelpers)

set(cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/welkin)
set(shared_target welkin)
if(NOT BUILD_SHARED_LIBS)
  set(shared_target "")
endif()
if(shared_target)
  install(TARGETS welkin EXPORT welkin-shared-targets
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime
                  NAMELINK_COMPONENT development
          INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT welkin-shared-targets NAMESPACE welkin:: DESTINATION ${cmake_dir}
          COMPONENT development)
endif()
if(archive)
  install(TARGETS ${static_target} EXPORT welkin-static-targets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
          INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT welkin-static-targets NAMESPACE welkin:: DESTINATION ${cmake_dir}
          COMPONENT development)
endif()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/welkin-config.cmake.in
                              ${CMAKE_CURRENT_BINARY_DIR}/welkin-config.cmake
                              INSTALL_DESTINATION ${cmake_dir} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/welkin-config-version.cmake
                                 COMPATIBILITY SameMajorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/welkin-config.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/welkin-config-version.cmake
        DESTINATION ${cmake_dir} COMPONENT development)

# Relative also where CMAKE_INSTALL_LIBDIR was given as an absolute path.
foreach(dir LIBDIR INCLUDEDIR)
  file(RELATIVE_PATH pc_${dir} ${CMAKE_INSTALL_PREFIX} ${CMAKE_INSTALL_FULL_${dir}})
endforeach()
file(RELATIVE_PATH pc_prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" pc_prefix "${pc_prefix}")
set(pc_public "")
if(NOT BUILD_SHARED_LIBS)
  set(pc_public " ${WELKIN_PC_RUNTIME}")
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/welkin.pc.in ${CMAKE_CURRENT_BINARY_DIR}/welkin.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/welkin.pc
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/welkin DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        COMPONENT development)
# The models' text, for shaders of the engine's own.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/shaders/model
        DESTINATION ${CMAKE_INSTALL_DATADIR}/welkin/shaders COMPONENT development)
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md
              ${PROJECT_SOURCE_DIR}/LICENSE
        DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT development)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR}
        COMPONENT development)
