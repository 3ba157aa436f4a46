# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# Build layout and compiler settings shared by every target of the project.

include(GNUInstallDirs)

# OpenSceneGraph, of which OsgTargets.cmake found the version, looks for plugins in a folder that bears it.
set(OSGANALYTICBIN_OSG_PLUGIN_DIR "osgPlugins-${OPENSCENEGRAPH_VERSION}"
    CACHE STRING "Folder, below the library folder, in which OpenSceneGraph looks for plugins")

# An installed tree finds its own library wherever it is moved. Packages for /usr set CMAKE_SKIP_INSTALL_RPATH.
file(RELATIVE_PATH _library_from_bin "${CMAKE_INSTALL_FULL_BINDIR}" "${CMAKE_INSTALL_FULL_LIBDIR}")
set(OSGANALYTICBIN_ORIGIN "$ORIGIN")
if(APPLE)
  set(OSGANALYTICBIN_ORIGIN "@loader_path")
endif()
set(CMAKE_INSTALL_RPATH "${OSGANALYTICBIN_ORIGIN}/${_library_from_bin}")

set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib")
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib")
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

# An application that this project is part of chooses for itself.
if(OSGANALYTICBIN_CCACHE AND PROJECT_IS_TOP_LEVEL AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(OSGANALYTICBIN_CCACHE_PROGRAM ccache DOC "Keeps what was compiled")
  if(OSGANALYTICBIN_CCACHE_PROGRAM)
    set(CMAKE_CXX_COMPILER_LAUNCHER "${OSGANALYTICBIN_CCACHE_PROGRAM}")
  endif()
endif()

# Tests are many programs: gold links them in a third of the time.
if(OSGANALYTICBIN_TESTS AND PROJECT_IS_TOP_LEVEL AND NOT MSVC)
  include(CheckLinkerFlag)
  check_linker_flag(CXX -fuse-ld=gold OSGANALYTICBIN_HAS_GOLD)
  if(OSGANALYTICBIN_HAS_GOLD)
    add_link_options(-fuse-ld=gold)
  endif()
endif()

if(OSGANALYTICBIN_SANITIZE STREQUAL "thread")
  set(OSGANALYTICBIN_SANITIZERS thread)
elseif(OSGANALYTICBIN_SANITIZE)
  set(OSGANALYTICBIN_SANITIZERS address,undefined)
else()
  set(OSGANALYTICBIN_SANITIZERS "")
endif()

# Every target calls this once: C++17 and private warnings. Contraction of a*b+c into fused operations is
# switched off because it would let verdicts differ between machines, and fast-math, which an application may use for
# all that it builds, because it drops the tests for NaN and infinity.
function(osganalyticbin_defaults target)
  target_compile_features(${target} PUBLIC cxx_std_17)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF CXX_VISIBILITY_PRESET hidden
                                             VISIBILITY_INLINES_HIDDEN ON)
  if(MSVC)
    target_compile_options(${target} PRIVATE /W4 /permissive- /fp:precise $<$<BOOL:${OSGANALYTICBIN_WERROR}>:/WX>)
    target_compile_definitions(${target} PRIVATE NOMINMAX)
  else()
    target_compile_options(
      ${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -fno-fast-math
                        -ffp-contract=off $<$<BOOL:${OSGANALYTICBIN_WERROR}>:-Werror>)
  endif()
  if(OSGANALYTICBIN_SANITIZERS)
    # What is found ends the program: code that goes on takes up to half longer to compile.
    target_compile_options(${target} PRIVATE -fsanitize=${OSGANALYTICBIN_SANITIZERS} ${OSGANALYTICBIN_NO_SANITIZERS}
                                             -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(${target} PRIVATE -fsanitize=${OSGANALYTICBIN_SANITIZERS})
  endif()
  if(OSGANALYTICBIN_FUZZ)
    target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link)
  endif()
endfunction()

# A module that OpenSceneGraph loads by name: no "lib" prefix, in the plugin folder. OSG puts "mingw_" before the names of
# those that MinGW compiles.
function(osganalyticbin_osg_module target)
  osganalyticbin_defaults(${target})
  set(_prefix "")
  if(MINGW)
    set(_prefix "mingw_")
  endif()
  set(_install_dir "${CMAKE_INSTALL_LIBDIR}")
  if(WIN32)  # beside the programs, as OSG's own
    set(_install_dir "${CMAKE_INSTALL_BINDIR}")
  endif()
  set_target_properties(
    ${target} PROPERTIES PREFIX "${_prefix}"
                         LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib/${OSGANALYTICBIN_OSG_PLUGIN_DIR}"
                         INSTALL_RPATH "${OSGANALYTICBIN_ORIGIN}/..")
  install(TARGETS ${target} LIBRARY DESTINATION "${_install_dir}/${OSGANALYTICBIN_OSG_PLUGIN_DIR}"
                                    COMPONENT plugins)
endfunction()
