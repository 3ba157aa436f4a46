#!/bin/sh
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# Builds the core and its tests for Windows with mingw-w64, without vectors, and runs the tests under wine. Needs Debian 12
# and its archive, from which it takes the source of libccd. Everything else goes to build/wine.
#     sh tests/system/wine.sh [ARGUMENTS OF CTEST]
# Left out without arguments:
# - GeodeticBinTest.cpp, because RapidCheck is not built for Windows;
# - the long trials: "sh tests/system/wine.sh -L soundness".
# Exit code: 0 if all tests passed.
set -eu
cd "$(dirname "$0")/../.."

work=$PWD/build/wine
. applications/mingw.sh

step "packages"
# shellcheck disable=SC2086
sh applications/packages.sh demo googletest $mingw_packages

use_headers glm glm glm::glm
[ -e "$deps/lib/libgtest.a" ] || install_library googletest /usr/src/googletest
[ -e "$deps/lib/libccd.a" ] || install_library ccd "$(source_of libccd)" -DENABLE_DOUBLE_PRECISION=ON

step "core and tests for Windows"
configure . "$work/build" -DOSGANALYTICBIN_KIT=OFF -DOSGANALYTICBIN_SIMD=OFF -DOSGANALYTICBIN_CCACHE=OFF \
    -DCMAKE_EXE_LINKER_FLAGS=-static
cmake --build "$work/build"

step "tests under wine"
[ $# -gt 0 ] || set -- -LE soundness
ctest --test-dir "$work/build" -j "$(nproc)" --no-tests=error --output-on-failure "$@"
