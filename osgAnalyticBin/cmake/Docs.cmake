# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# The target "docs": the site, in docs/html of the build folder. Without Doxygen or Python there is none.

find_package(Doxygen 1.9.4 QUIET)
find_package(Python3 3.9 COMPONENTS Interpreter QUIET)
if(NOT DOXYGEN_FOUND OR NOT Python3_FOUND OR NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()
set(_docs_dir "${PROJECT_BINARY_DIR}/docs")
# What documents link to and Doxygen does not read: copied beside the pages.
file(GLOB _linked_files CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/osgAnalyticBin/doc/results/*.csv")
list(APPEND _linked_files "${PROJECT_SOURCE_DIR}/osgAnalyticBin/doc/tutorial.cpp"
     "${PROJECT_SOURCE_DIR}/applications/osgbindem/osgbindem.slurm" "${PROJECT_SOURCE_DIR}/tests/long/mutants/faults.py")
list(JOIN _linked_files "\" \"" _linked_files)
set(_linked_files "\"${_linked_files}\"")
set(OSGANALYTICBIN_DOXYFILE "${_docs_dir}/Doxyfile")
file(MAKE_DIRECTORY "${_docs_dir}")
configure_file("${PROJECT_SOURCE_DIR}/osgAnalyticBin/doc/site/Doxyfile.in" "${OSGANALYTICBIN_DOXYFILE}" @ONLY)
add_custom_target(docs COMMAND ${CMAKE_COMMAND} -E rm -rf "${_docs_dir}/html"
                       COMMAND "${DOXYGEN_EXECUTABLE}" "${OSGANALYTICBIN_DOXYFILE}"
                       COMMAND ${CMAKE_COMMAND} -E echo "The site: ${_docs_dir}/html/index.html" VERBATIM)
