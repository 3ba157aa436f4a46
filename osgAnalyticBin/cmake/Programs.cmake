# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# What programs share: they are installed, and get man pages from what they say of themselves (--help, --version).

include(GNUInstallDirs)

find_program(OSGANALYTICBIN_HELP2MAN help2man DOC "Makes man pages; without it there are none")
find_program(OSGANALYTICBIN_GZIP gzip DOC "Compresses man pages")

# summary: what the program does, for whatis; a verb, no full stop.
function(osganalyticbin_program target summary)
  install(TARGETS ${target} RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT tools)
  if(NOT OSGANALYTICBIN_HELP2MAN OR NOT OSGANALYTICBIN_GZIP OR OSGANALYTICBIN_SANITIZE OR CMAKE_CROSSCOMPILING)
    return()
  endif()
  set(_page "${PROJECT_BINARY_DIR}/man/${target}.1")
  add_custom_command(
    OUTPUT "${_page}.gz"
    COMMAND ${CMAKE_COMMAND} -E make_directory "${PROJECT_BINARY_DIR}/man"
    COMMAND ${CMAKE_COMMAND} -E env LC_ALL=C.UTF-8 "${OSGANALYTICBIN_HELP2MAN}" --no-info --name
            "${summary}" --source osgAnalyticBin --manual "osgAnalyticBin" --output "${_page}" $<TARGET_FILE:${target}>
    COMMAND "${OSGANALYTICBIN_GZIP}" -9nf "${_page}"
    DEPENDS ${target} osgAnalyticBin
    COMMENT "Man page of ${target}"
    VERBATIM)
  add_custom_target(${target}.man ALL DEPENDS "${_page}.gz")
  install(FILES "${_page}.gz" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT tools)
endfunction()
