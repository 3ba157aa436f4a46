# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# OpenSceneGraph 3.6 installs no CMake package; this wraps CMake's own find modules into imported targets
# OSG::osg, OSG::osgDB, ... Used by the build and, installed beside the package config, by consumers.

set(_osganalyticbin_osg_components osg osgDB osgUtil osgGA osgText osgViewer osgTerrain osgSim OpenThreads)
find_package(OpenSceneGraph 3.6 REQUIRED COMPONENTS osgDB osgUtil osgGA osgText osgViewer osgTerrain osgSim)

foreach(_component IN LISTS _osganalyticbin_osg_components)
  if(NOT TARGET OSG::${_component})
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
