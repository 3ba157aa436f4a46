#!/bin/sh
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# Makes build/windows/osganalyticbin-windows.zip, on Debian 12, with mingw-w64: OpenSceneGraph with osgviewer and osgconv,
# the node kit, its plugins and osgbinviewer. Then unpacks it and tries it under wine. Needs Debian's archive, from which
# it takes the sources of OpenSceneGraph, freetype, libjpeg-turbo and libpng; what was built of them stays for the next run.
#     sh applications/windows.sh
# Left out: osgbindem, osgbinconv and osgbinbench, which need POSIX; vectors (Highway); PROJ; http, GDAL and the formats
# of other programs in OpenSceneGraph.
# Exit code: 0 if the zip was made and passed the trial.
set -eu
cd "$(dirname "$0")/.."

work=$PWD/build/windows
. applications/mingw.sh

archive=osganalyticbin-windows
stage=$work/$archive
osg_version=3.6.5
# Folders of OpenSceneGraph, and its plugins, that are built.
osg_parts="src/OpenThreads src/osg src/osgUtil src/osgDB src/osgGA src/osgText src/osgViewer src/osgTerrain src/osgSim
    src/osgFX src/osgVolume applications/osgviewer applications/osgconv applications/osgversion"
osg_serializers="osg osgFX osgGA osgSim osgTerrain osgText osgUtil osgViewer osgVolume"
osg_plugins="osg ive osga rot scale trans terrain rgb bmp dds tga png jpeg freetype gz obj"

install_openscenegraph() {
    from=$(source_of openscenegraph)
    step "OpenSceneGraph for Windows, half an hour"
    build=$work/openscenegraph
    parts=$osg_parts
    switches=""
    for part in $osg_serializers; do parts="$parts src/osgWrappers/serializers/$part"; done
    for part in $osg_plugins; do
        parts="$parts src/osgPlugins/$part"
        switches="$switches -DBUILD_OSG_PLUGIN_$(echo "$part" | tr '[:lower:]' '[:upper:]')=ON"
    done
    # CMake would test atomics by running programs. The compiler is GCC, whose builtins work.
    for kind in MIPOSPRO_BUILTINS SUN WIN32_INTERLOCKED BSD_ATOMIC; do
        switches="$switches -D_OPENTHREADS_ATOMIC_USE_$kind=OFF"
    done
    # shellcheck disable=SC2086
    logged openscenegraph configure "$from" "$build" -D_OPENTHREADS_ATOMIC_USE_GCC_BUILTINS=ON \
        -DBUILD_OSG_PLUGINS_BY_DEFAULT=OFF -DBUILD_OSG_DEPRECATED_SERIALIZERS=OFF -DOSG_USE_LOCAL_LUA_SOURCE=OFF \
        -DOSG_DETERMINE_WIN_VERSION=OFF -DOSG_AGGRESSIVE_WARNINGS=OFF -DCMAKE_CXX_FLAGS="-w -std=gnu++11 -fpermissive" \
        -DCMAKE_CXX_FLAGS_RELEASE="-O2 -DNDEBUG" $switches
    # shellcheck disable=SC2046,SC2086
    logged openscenegraph cmake --build "$build" --target $(printf '%s/all ' $parts)
    for part in $parts; do logged openscenegraph cmake --install "$build/$part"; done
    touch "$deps/openscenegraph.done"
}

# Copies the libraries of mingw-w64 that programs need and that Windows has not. Arguments: programs and libraries.
add_runtime() {
    for library in $(x86_64-w64-mingw32-objdump -p "$@" | sed -n 's/.*DLL Name: //p' | sort -u); do
        found=$(x86_64-w64-mingw32-g++-posix -print-file-name="$library")
        if [ "$found" = "$library" ] || [ -e "$stage/bin/$library" ]; then continue; fi
        cp "$found" "$stage/bin/"
        add_runtime "$stage/bin/$library"
    done
}

step "packages"
# shellcheck disable=SC2086
sh applications/packages.sh demo libz-mingw-w64-dev $mingw_packages

use_headers glm glm glm::glm
use_headers CLI CLI11 CLI11::CLI11
[ -e "$deps/lib/libjpeg.a" ] ||
    install_library libjpeg "$(source_of libjpeg-turbo)" -DENABLE_SHARED=OFF -DWITH_SIMD=OFF -DWITH_TURBOJPEG=OFF
[ -e "$deps/lib/libpng.a" ] ||
    install_library libpng "$(source_of libpng1.6)" -DPNG_SHARED=OFF -DPNG_TESTS=OFF -DPNG_EXECUTABLES=OFF
[ -e "$deps/lib/libfreetype.a" ] ||
    install_library freetype "$(source_of freetype)" -DFT_DISABLE_BROTLI=ON -DFT_DISABLE_BZIP2=ON \
        -DFT_DISABLE_HARFBUZZ=ON -DFT_DISABLE_PNG=ON -DFT_DISABLE_ZLIB=ON
[ -e "$deps/openscenegraph.done" ] || install_openscenegraph

step "node kit, plugins and osgbinviewer for Windows"
configure . "$work/build" -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=12 -DOSGANALYTICBIN_TESTS=OFF \
    -DOSGANALYTICBIN_SIMD=OFF -DOSGANALYTICBIN_MAPPINGS=OFF -DOSGANALYTICBIN_RESEARCH=OFF -DOSGANALYTICBIN_CCACHE=OFF
cmake --build "$work/build" --target install

step "$archive.zip"
rm -rf "$stage" "$stage.zip"
mkdir -p "$stage/bin" "$stage/licences"
for program in osgviewer osgconv osgversion osgbinviewer; do cp "$deps/bin/$program.exe" "$stage/bin/"; done
cp "$deps"/bin/lib*.dll "$stage/bin/"
cp -r "$deps"/bin/osgPlugins-* "$stage/bin/"
# shellcheck disable=SC2046
add_runtime $(find "$stage/bin" -type f)
find "$stage/bin" -type f -exec x86_64-w64-mingw32-strip --strip-unneeded {} +
cp LICENSE "$stage/licences/osgAnalyticBin.txt"
cp "$work"/source/openscenegraph-*/LICENSE.txt "$stage/licences/OpenSceneGraph.txt"
cp "$work"/source/freetype-*/docs/FTL.TXT "$stage/licences/freetype.txt"
cp "$work"/source/libjpeg-turbo-*/LICENSE.md "$stage/licences/libjpeg-turbo.txt"
cp "$work"/source/libpng1.6-*/LICENSE "$stage/licences/libpng.txt"
cp /usr/share/doc/libz-mingw-w64/copyright "$stage/licences/zlib.txt"
cp /usr/share/doc/gcc-mingw-w64-x86-64-posix-runtime/copyright "$stage/licences/gcc.txt"
cp /usr/share/doc/mingw-w64-x86-64-dev/copyright "$stage/licences/mingw-w64.txt"
sed 's/$/\r/' >"$stage/README.txt" <<END_OF_README
osgAnalyticBin $(sed -n 's/^ *VERSION \([0-9.]*\)$/\1/p' CMakeLists.txt) with OpenSceneGraph $osg_version for 64-bit Windows

osgAnalyticBin culls the tiles of terrain databases with tighter bounds than spheres, behind the horizon, and behind
other terrain. Unpack this folder anywhere, open a command prompt in bin, and type

    osgviewer.exe 12.proceduralglobe.analyticbin
    osgviewer.exe earth.osgb.analyticbin
    osgbinviewer.exe earth.osgb

The first opens a globe that is made by a formula and needs no files. The others open your own database: name its root
file, with .analyticbin added for osgviewer. osgbinviewer shows what culling does; press h for its keys.

To use it in a program of your own, that program and OpenSceneGraph have to be compiled by the same compiler as the
kit, here GCC (mingw-w64, POSIX threads, Debian 12). Builds of OpenSceneGraph by Visual Studio cannot load these
libraries: there, compile osgAnalyticBin with Visual Studio, too.

Here OpenSceneGraph reads .osgb, .osgt, .osgx, .ive, .osga and .obj, images in bmp, dds, jpeg, png, rgb and tga, and
files compressed with zlib. It does not read from web servers.

Licences, in the folder licences: osgAnalyticBin: MIT. OpenSceneGraph: OSGPL, that is LGPL with exceptions. Its sources
are those of Debian 12's package openscenegraph. The others are libraries that they need.
END_OF_README
(cd "$work" && cmake -E tar cf "$archive.zip" --format=zip "$archive")

trial=$work/trial
rm -rf "$trial" "$work/trial.log"
mkdir -p "$trial/data"
(cd "$trial" && cmake -E tar xf "$stage.zip")
logged trial configure tests/system/windows "$work/trial-build"
logged trial cmake --build "$work/trial-build"
cp "$work/trial-build/osganalyticbin_windows_trial.exe" "$trial/$archive/bin/"
grep -E '^name|^nadir|_alps' data/paths/demo.csv >"$trial/flight.csv"
cd "$trial"

# Runs a program of the zip. OSG would take the number of the X display for that of a screen of Windows.
display=""
on_windows() {
    printf '@set DISPLAY=\r\n@%s\\bin\\%s\r\n' "$archive" "$*" >run.bat
    $display /usr/lib/wine/wine64 cmd /c run.bat
    /usr/lib/wine/wineserver64 -w # it would give its display to the next program
}

step "trial under wine: a database, an index, files"
on_windows osganalyticbin_windows_trial.exe data
on_windows osgconv.exe data/globe.osgb.analyticbin data/converted.osgt
echo "bins in converted.osgt: $(grep -c 'osgAnalyticBin::AnalyticBinCullCallback ' data/converted.osgt)"

step "trial under wine: osgviewer on a virtual display, without culling and with bins"
display="xvfb-run -a"
export OSG_WINDOW="0 0 640 480"
for method in none quadratic; do
    on_windows osgviewer.exe --SingleThreaded "3.proceduralglobe.(method=$method).analyticbin" \
        "flight.csv.(out=$method).binflight"
done
for picture in none/*.png; do
    cmp "$picture" "quadratic/${picture#none/}"
    echo "$picture: equal"
done
cut -d, -f1-8 none/poses.csv quadratic/poses.csv
echo "$stage.zip: $(stat -c %s "$stage.zip") bytes"
