# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# The target "uninstall": removes what the last `cmake --install` of this build folder wrote, and the folders that are
# empty then. Run as a script it does so for the build folder BUILD_DIR.

if(NOT CMAKE_SCRIPT_MODE_FILE)
  if(PROJECT_IS_TOP_LEVEL)
    add_custom_target(uninstall COMMAND ${CMAKE_COMMAND} "-DBUILD_DIR=${PROJECT_BINARY_DIR}" -P
                                        "${CMAKE_CURRENT_LIST_FILE}")
  endif()
  return()
endif()

set(_manifest "${BUILD_DIR}/install_manifest.txt")
if(NOT EXISTS "${_manifest}")
  message(FATAL_ERROR "uninstall: nothing was installed from ${BUILD_DIR}; run cmake --install first")
endif()
file(STRINGS "${_manifest}" _files)
file(REMOVE ${_files})
foreach(_file IN LISTS _files)
  if(EXISTS "${_file}" OR IS_SYMLINK "${_file}")
    message(FATAL_ERROR "uninstall: ${_file} cannot be removed; run it as the user who installed")
  endif()
  # Upwards, folder by folder, as long as they are empty and not the system's own.
  get_filename_component(_folder "${_file}" DIRECTORY)
  while(EXISTS "${_folder}" AND NOT _folder MATCHES "^/[^/]*$|^/usr/[^/]*$|^/usr/local/[^/]*$")
    file(GLOB _content LIST_DIRECTORIES true "${_folder}/*" "${_folder}/.*")
    if(_content)
      break()
    endif()
    file(REMOVE_RECURSE "${_folder}")
    get_filename_component(_folder "${_folder}" DIRECTORY)
  endwhile()
endforeach()
file(REMOVE "${_manifest}")
