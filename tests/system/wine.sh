#!/bin/sh
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# Builds the core and its tests for Windows with mingw-w64, without vectors, and runs the tests under wine. Needs Debian 12
# and its archive, from which it takes the source of libccd. Everything else goes to build/wine.
#     sh tests/system/wine.sh [ARGUMENTS OF CTEST]
# Left out without arguments:
# - GeodeticBinTest.cpp, because RapidCheck is not built for Windows;
# - IntervalNumber.FunctionsHoldEveryResult, which fails: its truth is the tangent in long double, which mingw-w64 takes
#   from the processor, and which is wrong by 8 units in the last place of a double near multiples of pi;
# - the long trials: "sh tests/system/wine.sh -L soundness".
# Exit code: 0 if all tests passed.
set -eu
cd "$(dirname "$0")/../.."

work=$PWD/build/wine
deps=$work/deps
archive="http://deb.debian.org/debian bookworm main"

step() { echo "== $*"; }

step "packages"
sh applications/packages.sh demo g++-mingw-w64-x86-64-posix wine64 googletest dpkg-dev

mkdir -p "$deps/include" "$deps/lists/partial"
for headers in glm boost; do ln -sfn "/usr/include/$headers" "$deps/include/$headers"; done
cat >"$work/toolchain.cmake" <<END
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
set(CMAKE_FIND_ROOT_PATH "$deps")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(CMAKE_CROSSCOMPILING_EMULATOR /usr/lib/wine/wine64)
set(Boost_NO_BOOST_CMAKE ON)
END
mkdir -p "$deps/lib/cmake/glm"
cat >"$deps/lib/cmake/glm/glmConfig.cmake" <<END
add_library(glm::glm INTERFACE IMPORTED)
set_target_properties(glm::glm PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "$deps/include")
END

# Argument: name, source folder, options.
install_library() {
    name=$1
    source=$2
    shift 2
    step "$name for Windows"
    cmake -S "$source" -B "$work/$name" -G Ninja --toolchain "$work/toolchain.cmake" -DCMAKE_BUILD_TYPE=Release \
        -DBUILD_SHARED_LIBS=OFF -DCMAKE_INSTALL_PREFIX="$deps" "$@" >"$work/$name.log" 2>&1 &&
        cmake --build "$work/$name" --target install >>"$work/$name.log" 2>&1 ||
        { tail -n 40 "$work/$name.log" >&2; exit 1; }
}

[ -e "$deps/lib/libgtest.a" ] || install_library googletest /usr/src/googletest
if [ ! -e "$deps/lib/libccd.a" ]; then
    echo "deb-src $archive" >"$deps/sources.list"
    # A list of packages of its own: the machine's stays as it is.
    lists="-o Dir::Etc::SourceList=$deps/sources.list -o Dir::Etc::SourceParts=/dev/null -o Dir::State::Lists=$deps/lists
           -o Dir::Cache::srcpkgcache= -o Dir::Cache::pkgcache= -o APT::Sandbox::User=root"
    # shellcheck disable=SC2086
    (cd "$deps" && apt-get $lists -qq update && apt-get $lists -qq source libccd)
    install_library ccd "$(find "$deps" -maxdepth 1 -type d -name 'libccd-*')" -DENABLE_DOUBLE_PRECISION=ON
fi

step "core and tests for Windows"
export WINEDEBUG=-all WINEPREFIX="$work/prefix"
cmake -S . -B "$work/build" -G Ninja --toolchain "$work/toolchain.cmake" -DCMAKE_BUILD_TYPE=Release \
    -DOSGANALYTICBIN_KIT=OFF -DOSGANALYTICBIN_SIMD=OFF -DOSGANALYTICBIN_CCACHE=OFF -DCMAKE_PREFIX_PATH="$deps" \
    -DBoost_INCLUDE_DIR="$deps/include"
cmake --build "$work/build"

step "tests under wine"
[ $# -gt 0 ] || set -- -LE soundness -E '^IntervalNumber\.FunctionsHoldEveryResult$'
ctest --test-dir "$work/build" -j "$(nproc)" --no-tests=error --output-on-failure "$@"
