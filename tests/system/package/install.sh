#!/bin/sh
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# Installs a build, moves the installed tree, and uses it there as others would: by CMake, by pkg-config, from the shell
# and from the stock osgconv; then installs and uninstalls, after which nothing may be left.
# Arguments: source folder, build folder, scratch folder (emptied), library folder below a prefix.
set -eu

source=$1
build=$2
scratch=$3
libdir=$4
moved="$scratch/moved"
unset OSG_LIBRARY_PATH LD_LIBRARY_PATH CMAKE_PREFIX_PATH PKG_CONFIG_PATH || true

fail() {
    echo "install.sh: $*" >&2
    exit 1
}

quietly() { # runs a command and shows what it said only when it fails
    "$@" >"$scratch/log" 2>&1 || {
        cat "$scratch/log" >&2
        fail "failed: $*"
    }
}

consumer() { # name of a build folder, then more arguments of cmake
    folder="$scratch/$1"
    shift
    cmake -S "$source/tests/system/consumer" -B "$folder" -G Ninja -DCMAKE_PREFIX_PATH="$moved" "$@"
}

rm -rf "$scratch"
mkdir -p "$scratch"
quietly cmake --install "$build" --prefix "$scratch/first"
mv "$scratch/first" "$moved"
export LD_LIBRARY_PATH=

echo "== no installed text names a folder of the build"
! grep -rIlF -e "$source" -e "$build" -e "$scratch" "$moved" || fail "the files above do"

echo "== find_package, all components, as C++17"
quietly consumer build
quietly cmake --build "$scratch/build"
ctest --test-dir "$scratch/build" --output-on-failure --no-tests=error

# Component viewer is compiled as C++20 below.
echo "== without Boost all but mappings, as C++20; component core without OpenSceneGraph; the others say what they need"
quietly consumer viewer "-DCONSUMER_COMPONENTS=kit;viewer" -DCMAKE_DISABLE_FIND_PACKAGE_Boost=ON -DCMAKE_CXX_STANDARD=20
quietly cmake --build "$scratch/viewer" --target uses_kit
! consumer mappings -DCMAKE_DISABLE_FIND_PACKAGE_Boost=ON >"$scratch/log" 2>&1 || fail "mappings was found without Boost"
quietly consumer core -DCONSUMER_COMPONENTS=core -DCMAKE_DISABLE_FIND_PACKAGE_OpenSceneGraph=ON -DCMAKE_DISABLE_FIND_PACKAGE_Boost=ON
quietly cmake --build "$scratch/core"
! consumer kit -DCMAKE_DISABLE_FIND_PACKAGE_OpenSceneGraph=ON >"$scratch/log" 2>&1 || fail "kit was found without OSG"
tr '\n' ' ' <"$scratch/log" | tr -s ' ' | grep -q "components kit, viewer and mappings need OpenSceneGraph" || {
    cat "$scratch/log" >&2
    fail "no clear word about OpenSceneGraph"
}

# viewer and mappings were compiled as C++17 above
echo "== pkg-config: viewer and mappings as C++20, the others as C++17"
export PKG_CONFIG_PATH="$moved/$libdir/pkgconfig"
for case in core:osgAnalyticBinCore:17 kit:osgAnalyticBin:17 viewer:osgAnalyticBinViewer:20 mappings:osgAnalyticBinMappings:20; do
    program=uses_${case%%:*}
    standard=${case##*:}
    package=${case#*:}
    flags=$(pkg-config --cflags --libs "${package%:*}")
    case $flags in *-std=*) fail "pkg-config chooses the application's standard: $flags" ;; esac
    # shellcheck disable=SC2086
    quietly "${CXX:-c++}" "-std=c++$standard" "$source/tests/system/consumer/$program.cpp" -o "$scratch/$program" $flags
    LD_LIBRARY_PATH="$moved/$libdir" "$scratch/$program" || fail "$program by pkg-config failed"
done

echo "== programs find their library where they are, tell their version, and have man pages where help2man is"
for program in "$moved"/bin/*; do
    name=$(basename "$program")
    quietly "$program" --help
    quietly "$program" --version
    grep -Eq "^$name \(osgAnalyticBin\) [0-9]+\.[0-9]+\.[0-9]+$" "$scratch/log" || fail "$name --version says something else"
    command -v help2man >/dev/null || continue
    zcat "$moved/share/man/man1/$name.1.gz" | grep -q '^\.SH OPTIONS' || fail "no man page of $name, or one without options"
done

echo "== the stock osgconv finds the plugins"
for format in analyticbin binflight proceduralglobe; do
    OSG_LIBRARY_PATH="$moved/$libdir" osgconv --format "$format" 2>&1 | grep -q "=" || fail "no plugin $format"
done

echo "== the stock osgconv reads the packed tiles of an installed osgbindem"
printf '%s\n' "ncols 4" "nrows 2" "xllcorner -180" "yllcorner -90" "cellsize 90" "0 1 2 3" "4 5 6 7" >"$scratch/heights.asc"
quietly "$moved/bin/osgbindem" "$scratch/heights.asc" --packed --levels 0 --cells 4 --quiet -o "$scratch/earth.osgb"
quietly env OSG_LIBRARY_PATH="$moved/$libdir" osgconv "$scratch/earth.osgb" "$scratch/earth.osgt"
grep -q "osg::Vec3Array" "$scratch/earth.osgt" || fail "no meshes of packed tiles"

echo "== uninstall leaves nothing"
quietly cmake --install "$build" --prefix "$scratch/second/deeper"
quietly cmake --build "$build" --target uninstall
[ -z "$(find "$scratch/second" -not -type d 2>/dev/null)" ] || fail "files are left in $scratch/second"
[ ! -e "$scratch/second/deeper" ] || fail "folders are left in $scratch/second"
