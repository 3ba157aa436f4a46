# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# The target "docs": the site, in docs/html of the build folder. Without Doxygen there is none.

find_package(Doxygen 1.9.4 QUIET)
if(NOT DOXYGEN_FOUND OR NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()
set(_docs_dir "${PROJECT_BINARY_DIR}/docs")
set(OSGANALYTICBIN_DOXYFILE "${_docs_dir}/Doxyfile")
file(MAKE_DIRECTORY "${_docs_dir}")
configure_file("${PROJECT_SOURCE_DIR}/osgAnalyticBin/doc/Doxyfile.in" "${OSGANALYTICBIN_DOXYFILE}" @ONLY)
add_custom_target(docs COMMAND "${DOXYGEN_EXECUTABLE}" "${OSGANALYTICBIN_DOXYFILE}"
                       COMMAND ${CMAKE_COMMAND} -E echo "The site: ${_docs_dir}/html/index.html" VERBATIM)
