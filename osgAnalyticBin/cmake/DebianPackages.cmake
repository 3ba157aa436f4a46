# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# CPack's .deb packages, one for each component: libosganalyticbin0 (runtime), libosganalyticbin-dev (development) and
# osganalyticbin-tools (tools). Configured for /usr, with the preset "package"; applications/package.sh does everything.

set(OSGANALYTICBIN_MAINTAINER "osgAnalyticBin contributors <contributors@osganalyticbin.invalid>"
    CACHE STRING "Maintainer of the packages, NAME <ADDRESS>")
if(NOT OSGANALYTICBIN_DEBIAN)
  return()
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME osganalyticbin)
set(CPACK_PACKAGE_CONTACT "${OSGANALYTICBIN_MAINTAINER}")
set(CPACK_PACKAGING_INSTALL_PREFIX "${CMAKE_INSTALL_PREFIX}")
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
                                                WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL runtime development tools)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")
set(_debian_version "${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}")
set(_same_library "libosganalyticbin0 (= ${_debian_version})")

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME libosganalyticbin0)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA "${CMAKE_CURRENT_LIST_DIR}/debian/triggers")
set(CPACK_DEBIAN_RUNTIME_DESCRIPTION
    "analytic-bin culling of paged terrain for OpenSceneGraph, shared library
Culls each tile of a paged terrain database by its box in latitude, longitude
and altitude in place of a bounding sphere. A tile is culled only when it is
proven to be out of view.
.
This package has the library, statistics for viewers, and the plugins that
osgviewer and every other application of OpenSceneGraph find by themselves:
\"osgviewer earth.ive.analyticbin\".")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libosganalyticbin-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "${_same_library}, libopenscenegraph-dev (>= 3.6), libglm-dev")
if(OSGANALYTICBIN_SIMD)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libhwy-dev")
endif()
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS "libboost-dev (>= 1.74)")  # component mappings
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION
    "analytic-bin culling of paged terrain for OpenSceneGraph, development files
Headers, the mathematics as a static library that does not need
OpenSceneGraph, and files for CMake and pkg-config.")

set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME osganalyticbin-tools)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_TOOLS_PACKAGE_DEPENDS "${_same_library}")
set(CPACK_DEBIAN_TOOLS_PACKAGE_RECOMMENDS openscenegraph)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SUGGESTS "gnuplot-nox | gnuplot, ferret-datasets, xvfb")
set(CPACK_DEBIAN_TOOLS_DESCRIPTION
    "analytic-bin culling of paged terrain for OpenSceneGraph, programs
Programs that show what culling does (osgbinviewer), make paged globes from
elevation rasters (osgbindem), find the bins of databases made by others
(osgbinconv), and measure and compare culling (osgbinbench), with camera
paths.")

# What Debian wants in every package's folder of documents.
string(TIMESTAMP _changelog_date "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file("${CMAKE_CURRENT_LIST_DIR}/debian/changelog.in" "${PROJECT_BINARY_DIR}/debian/changelog.Debian" @ONLY)
execute_process(COMMAND gzip -9nf "${PROJECT_BINARY_DIR}/debian/changelog.Debian" COMMAND_ERROR_IS_FATAL ANY)
foreach(_component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${_component} _upper)
  install(FILES "${PROJECT_BINARY_DIR}/debian/changelog.Debian.gz" "${CMAKE_CURRENT_LIST_DIR}/debian/copyright"
          DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${_upper}_PACKAGE_NAME}" COMPONENT ${_component})
endforeach()

include(CPack)
