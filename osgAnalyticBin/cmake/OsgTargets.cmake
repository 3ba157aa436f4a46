# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# OpenSceneGraph installs no CMake package; this wraps CMake's own find modules into imported targets OSG::osg,
# OSG::osgDB, ... and sets OPENSCENEGRAPH_FOUND and OPENSCENEGRAPH_VERSION. Used by the build and, installed beside the
# package config, by consumers.

set(_osganalyticbin_osg_components osgDB osgUtil osgGA osgText osgViewer osgTerrain osgSim)
set(_osganalyticbin_osg_mode REQUIRED)
if(CMAKE_FIND_PACKAGE_NAME STREQUAL "osgAnalyticBin") # the package config reports what is missing
  set(_osganalyticbin_osg_mode QUIET)
endif()
find_package(OpenSceneGraph 3.6 ${_osganalyticbin_osg_mode} COMPONENTS ${_osganalyticbin_osg_components})

foreach(_component IN LISTS _osganalyticbin_osg_components ITEMS osg OpenThreads)
  if(OPENSCENEGRAPH_FOUND AND NOT TARGET OSG::${_component})
    string(TOUPPER ${_component} _upper)
    add_library(OSG::${_component} UNKNOWN IMPORTED)
    set_target_properties(
      OSG::${_component} PROPERTIES IMPORTED_LOCATION "${${_upper}_LIBRARY}"
                                    INTERFACE_INCLUDE_DIRECTORIES "${${_upper}_INCLUDE_DIR}")
    if(${_upper}_LIBRARY_DEBUG AND NOT ${_upper}_LIBRARY)
      set_target_properties(OSG::${_component} PROPERTIES IMPORTED_LOCATION "${${_upper}_LIBRARY_DEBUG}")
    endif()
  endif()
endforeach()
