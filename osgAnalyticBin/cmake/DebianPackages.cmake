# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# CPack's .deb packages, one for each component: libosganalyticbin0 (runtime), openscenegraph-plugin-analyticbin (plugins),
# libosganalyticbin-dev (development), osganalyticbin-tools (tools), osganalyticbin-mpi (mpi) and osganalyticbin-doc
# (documents). Configured for /usr, with the preset "package"; applications/package.sh does everything.

if(NOT OSGANALYTICBIN_DEBIAN)
  return()
endif()
set(OSGANALYTICBIN_MAINTAINER "" CACHE STRING "Who makes the packages, NAME <ADDRESS>")
if(NOT OSGANALYTICBIN_MAINTAINER MATCHES "^[^<>]+ <[^<>@ ]+@[^<>@ ]+>$")
  message(FATAL_ERROR "OSGANALYTICBIN_MAINTAINER is \"${OSGANALYTICBIN_MAINTAINER}\", not NAME <ADDRESS>")
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME osganalyticbin)
# CPack makes semicolons of quotation marks in descriptions.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # would stand before the first line of each description
set(CPACK_PACKAGE_CONTACT "${OSGANALYTICBIN_MAINTAINER}")
set(CPACK_PACKAGING_INSTALL_PREFIX "${CMAKE_INSTALL_PREFIX}")
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
                                                WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL runtime plugins development tools documents)
if(TARGET osgbindem_mpi)
  list(APPEND CPACK_COMPONENTS_ALL mpi)
endif()
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
    "culling of paged terrain for OpenSceneGraph - shared libraries
Culls each tile of a paged terrain database by its box in latitude, longitude
and altitude in place of a bounding sphere. A tile is culled only when it is
proven to be out of view.
.
This package has the libraries: the culling, and statistics for viewers.")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "openscenegraph-plugin-analyticbin")  # scenes saved with bins

set(CPACK_DEBIAN_PLUGINS_PACKAGE_NAME openscenegraph-plugin-analyticbin)
set(CPACK_DEBIAN_PLUGINS_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_PLUGINS_PACKAGE_DEPENDS "${_same_library}")
set(CPACK_DEBIAN_PLUGINS_PACKAGE_ENHANCES openscenegraph)
set(CPACK_DEBIAN_PLUGINS_DESCRIPTION
    "culling of paged terrain for OpenSceneGraph - plugins
With these plugins osgviewer and all other applications of OpenSceneGraph cull
the tiles of a terrain database by their boxes in latitude, longitude and
altitude, as in osgviewer earth.ive.analyticbin. They also read scenes that
were saved with such boxes, packed tiles, camera paths and procedural globes.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libosganalyticbin-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "${_same_library}, libopenscenegraph-dev (>= 3.6), libglm-dev")
if(OSGANALYTICBIN_SIMD)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libhwy-dev")
endif()
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS "libboost-dev (>= 1.74)")  # component mappings
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION
    "culling of paged terrain for OpenSceneGraph - development files
Headers, the mathematics as a static library that does not need
OpenSceneGraph, and files for CMake and pkg-config.")

set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME osganalyticbin-tools)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_TOOLS_PACKAGE_DEPENDS "${_same_library}, openscenegraph-plugin-analyticbin (= ${_debian_version})")
set(CPACK_DEBIAN_TOOLS_PACKAGE_RECOMMENDS openscenegraph)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SUGGESTS "gnuplot-nox | gnuplot, ferret-datasets, osganalyticbin-doc, osganalyticbin-mpi, xvfb")
set(CPACK_DEBIAN_TOOLS_DESCRIPTION
    "culling of paged terrain for OpenSceneGraph - programs
Programs that show what culling does (osgbinviewer), make paged globes from
elevation rasters (osgbindem), find the bins of databases made by others
(osgbinconv), and measure and compare culling (osgbinbench), with camera
paths.")

set(CPACK_DEBIAN_MPI_PACKAGE_NAME osganalyticbin-mpi)
set(CPACK_DEBIAN_MPI_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_MPI_PACKAGE_DEPENDS "osganalyticbin-tools (= ${_debian_version})")
set(CPACK_DEBIAN_MPI_DESCRIPTION
    "culling of paged terrain for OpenSceneGraph - osgbindem under mpirun
With this module the processes of mpirun osgbindem share the work on one
database, on one machine or several.")

set(CPACK_DEBIAN_DOCUMENTS_PACKAGE_NAME osganalyticbin-doc)
set(CPACK_DEBIAN_DOCUMENTS_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOCUMENTS_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOCUMENTS_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DOCUMENTS_DESCRIPTION
    "culling of paged terrain for OpenSceneGraph - documents
Tutorial and guide, how databases are made, limits, measurements, and the
mathematics of the bins.")
set(_documents "${CMAKE_INSTALL_DATADIR}/doc/osganalyticbin-doc")
install(FILES "${PROJECT_SOURCE_DIR}/README.md" DESTINATION "${_documents}" COMPONENT documents)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/osgAnalyticBin/doc" DESTINATION "${_documents}/osgAnalyticBin" COMPONENT documents
        PATTERN site EXCLUDE)

# What Debian wants in every package's folder of documents.
string(TIMESTAMP _changelog_date "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file("${CMAKE_CURRENT_LIST_DIR}/debian/changelog.in" "${PROJECT_BINARY_DIR}/debian/changelog.Debian" @ONLY)
configure_file("${PROJECT_SOURCE_DIR}/CHANGELOG.md" "${PROJECT_BINARY_DIR}/debian/changelog" COPYONLY)
execute_process(COMMAND gzip -9nf "${PROJECT_BINARY_DIR}/debian/changelog.Debian" "${PROJECT_BINARY_DIR}/debian/changelog"
                COMMAND_ERROR_IS_FATAL ANY)
foreach(_component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${_component} _upper)
  install(FILES "${PROJECT_BINARY_DIR}/debian/changelog.Debian.gz" "${PROJECT_BINARY_DIR}/debian/changelog.gz" "${CMAKE_CURRENT_LIST_DIR}/debian/copyright"
          DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${_upper}_PACKAGE_NAME}" COMPONENT ${_component})
endforeach()
install(FILES "${CMAKE_CURRENT_LIST_DIR}/debian/libosganalyticbin0.lintian-overrides"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/lintian/overrides" RENAME libosganalyticbin0 COMPONENT runtime)

include(CPack)
