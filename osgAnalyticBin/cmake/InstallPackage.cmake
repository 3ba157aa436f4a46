# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# What projects build with: the libraries, headers, CMake package and pkg-config files. Components: runtime, development.
# All paths in these files are relative to the files themselves, so that an installed tree may be moved.

include(CMakePackageConfigHelpers)

set(_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/osgAnalyticBin")

install(
  TARGETS osgAnalyticBinCore EXPORT osgAnalyticBinCoreTargets
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development)
install(
  TARGETS osgAnalyticBin EXPORT osgAnalyticBinKitTargets
  RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT runtime
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT runtime NAMELINK_COMPONENT development
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development)
install(
  TARGETS osgAnalyticBinViewer EXPORT osgAnalyticBinViewerTargets
  RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT runtime
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT runtime NAMELINK_COMPONENT development
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development)
set(_headers_left_out PATTERN mappings EXCLUDE)
set(_parts Core Kit Viewer)
set(_pkgconfig_files osgAnalyticBinCore osgAnalyticBin osgAnalyticBinViewer)
if(TARGET osgAnalyticBinMappings)
  set(_headers_left_out "")
  install(TARGETS osgAnalyticBinMappings EXPORT osgAnalyticBinMappingsTargets
          ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development)
  list(APPEND _parts Mappings)
  list(APPEND _pkgconfig_files osgAnalyticBinMappings)
endif()
install(DIRECTORY include/osgAnalyticBin DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT development
        ${_headers_left_out})

# The same in the build folder: find_package finds it there as soon as the folder of the programs is on PATH.
foreach(_part IN LISTS _parts)
  install(EXPORT osgAnalyticBin${_part}Targets NAMESPACE osgAnalyticBin:: DESTINATION "${_package_dir}"
          COMPONENT development)
  export(EXPORT osgAnalyticBin${_part}Targets NAMESPACE osgAnalyticBin::
         FILE "${CMAKE_CURRENT_BINARY_DIR}/osgAnalyticBin${_part}Targets.cmake")
endforeach()
configure_file(cmake/OsgTargets.cmake OsgTargets.cmake COPYONLY)
configure_package_config_file(cmake/osgAnalyticBinConfig.cmake.in osgAnalyticBinConfig.cmake
                              INSTALL_DESTINATION "${_package_dir}")
write_basic_package_version_file(osgAnalyticBinConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/osgAnalyticBinConfig.cmake"
              "${CMAKE_CURRENT_BINARY_DIR}/osgAnalyticBinConfigVersion.cmake" cmake/OsgTargets.cmake
        DESTINATION "${_package_dir}" COMPONENT development)

set(_pkgconfig_dir "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
file(RELATIVE_PATH _prefix_from_pkgconfig "${CMAKE_INSTALL_PREFIX}/${_pkgconfig_dir}" "${CMAKE_INSTALL_PREFIX}/")
string(REGEX REPLACE "/$" "" _prefix_from_pkgconfig "${_prefix_from_pkgconfig}")
set(_simd_package "")
if(OSGANALYTICBIN_SIMD)
  set(_simd_package "libhwy")
endif()
foreach(_name IN LISTS _pkgconfig_files)
  configure_file(cmake/${_name}.pc.in ${_name}.pc @ONLY)
  install(FILES "${CMAKE_CURRENT_BINARY_DIR}/${_name}.pc" DESTINATION "${_pkgconfig_dir}" COMPONENT development)
endforeach()
