# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
# shellcheck shell=sh disable=SC2016,SC2034,SC2154
#
# Functions that build for 64-bit Windows on Debian 12, for applications/windows.sh and tests/system/wine.sh, which read
# this file in the project's folder. Variable `work`: the folder for everything that is made.

deps=$work/deps  # libraries for Windows
mingw=/usr/x86_64-w64-mingw32  # and those of Debian
mingw_packages="g++-mingw-w64-x86-64-posix wine64 dpkg-dev"
export WINEDEBUG=-all WINEPREFIX="$work/prefix" PKG_CONFIG_LIBDIR="$deps/lib/pkgconfig"

step() { echo "== $*"; }

# Arguments: name of the log, command. Shows the end of the log if the command fails.
logged() {
    log=$work/$1.log
    shift
    "$@" >>"$log" 2>&1 || {
        tail -n 40 "$log" >&2
        echo "$log: $1 failed" >&2
        exit 1
    }
}

# Arguments: source folder, build folder, options.
configure() {
    from=$1
    build=$2
    shift 2
    cmake -S "$from" -B "$build" -G Ninja --toolchain "$PWD/osgAnalyticBin/cmake/mingw.cmake" \
        -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$deps" -DCMAKE_PREFIX_PATH="$deps" \
        -DCMAKE_FIND_ROOT_PATH="$deps;$mingw" "$@"
}

# Arguments: name, source folder, options. Static, where the library asks CMake.
install_library() {
    name=$1
    from=$2
    shift 2
    step "$name for Windows"
    rm -f "$work/$name.log"
    logged "$name" configure "$from" "$work/$name" -DBUILD_SHARED_LIBS=OFF "$@"
    logged "$name" cmake --build "$work/$name" --target install
}

# Headers of this system that are the same everywhere. Arguments: headers, and, where CMake does not find them by
# itself, the name of the CMake package and its target.
use_headers() {
    mkdir -p "$deps/include"
    ln -sfn "/usr/include/$1" "$deps/include/$1"
    [ $# -eq 3 ] || return 0
    mkdir -p "$deps/lib/cmake/$2"
    cat >"$deps/lib/cmake/$2/$2Config.cmake" <<END
add_library($3 INTERFACE IMPORTED)
set_target_properties($3 PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "$deps/include")
END
}

# Prints the folder of a Debian package's source, which it takes from the archive that this machine installs from.
# Argument: source package.
source_of() {
    sources=$work/source
    mkdir -p "$sources/lists/partial"
    if [ -z "$(find "$sources" -maxdepth 1 -type d -name "$1-*")" ]; then
        apt-get indextargets --format 'deb-src $(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' \
            'Origin: Debian' | sort -u >"$sources/sources.list"
        # A list of packages of its own: the machine's stays as it is.
        lists="-o Dir::Etc::SourceList=$sources/sources.list -o Dir::Etc::SourceParts=/dev/null
               -o Dir::State::Lists=$sources/lists -o Dir::Cache::srcpkgcache= -o Dir::Cache::pkgcache=
               -o APT::Sandbox::User=root"
        # A mirror may not have the source of an update yet: that of the release is there.
        # shellcheck disable=SC2086
        (cd "$sources" && apt-get $lists -qq update && {
            apt-get $lists -qq source "$1" || apt-get $lists -qq source "$1/bookworm"
        }) >"$sources/$1.log" 2>&1 || { cat "$sources/$1.log" >&2; exit 1; }
    fi
    find "$sources" -maxdepth 1 -type d -name "$1-*"
}
