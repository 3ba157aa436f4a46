#!/bin/sh
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# The demo: installs the packages that it needs (it says which and why), builds the programs that it needs and a terrain
# database of the earth, flies the stock osgviewer over it with three culling methods, and compares pictures, counts and
# cull times. Asks nothing; the second run only flies and compares.
# Without a display, or with "DISPLAY= sh applications/demo.sh", the viewer draws on a virtual one.
# Exit code: 0 when every step succeeded and all pictures are equal.

set -eu
cd "$(dirname "$0")/.."

build=build/release
demo=demo
size="1280 720"
methods="none sphere quadratic"

step() {
    printf '\n== %s\n' "$*"
}

give_up() {
    printf 'demo.sh: %s\n' "$*" >&2
    exit 1
}

# xkbcomp comes with every X server; it fails when it cannot connect.
display_works() {
    [ -n "${DISPLAY:-}" ] && xkbcomp "$DISPLAY" - >/dev/null 2>&1
}

on_display() {
    if display_works; then
        env OSG_WINDOW="40 40 $size" "$@"
    else
        xvfb-run -a -s "-screen 0 $(echo "$size" | tr ' ' x)x24" env OSG_WINDOW="0 0 $size" "$@"
    fi
}

# One thread, so that drawing does not slow the culling down that is timed. osgviewer always ends with code 0: the
# flight succeeded when it left its table.
fly() {
    rm -rf "${demo:?}/$1"
    on_display env OSG_LIBRARY_PATH="$PWD/$build/lib" LD_LIBRARY_PATH="$PWD/$build/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}" \
        osgviewer --SingleThreaded "$demo/earth.osgb.(method=$1).analyticbin" \
        "$demo/path.csv.(out=$demo/$1).binflight" </dev/null ||
        give_up "osgviewer failed with method $1"
    [ -f "$demo/$1/poses.csv" ] || give_up "the flight with method $1 did not reach its end"
}

case ${1:-} in
    "") ;;
    -h | --help)
        sed -n '5,10s/^# //p' "$0"
        exit 0
        ;;
    *)
        echo "demo.sh: it takes no arguments, see sh applications/demo.sh --help" >&2
        exit 2
        ;;
esac

step "Installing the Debian packages that are missing: what compiles, OpenSceneGraph, GDAL, and elevation data"
sh applications/packages.sh demo

step "Building osgbindem, osgbinbench and the plugins in $build"
[ -f "$build/build.ninja" ] || cmake --preset demo
cmake --build --preset demo

mkdir -p "$demo"
if [ -n "$(find "$demo/earth.done" -newer "$build/bin/osgbindem" 2>/dev/null)" ]; then
    step "The database $demo/earth.osgb is there already"
else
    step "Building the database $demo/earth.osgb from Debian's elevation data"
    rm -f "$demo/earth.done"
    "$build/bin/osgbindem" /usr/share/ferret-vis/data/etopo5.cdf /usr/share/ncarg/data/cdf/trinidad.nc \
        --height-unit m ft --overwrite -o "$demo/earth.osgb"
    touch "$demo/earth.done"
fi

# Both paths have the same columns.
{ cat data/paths/demo.csv && grep '^valley_[1-4],' data/paths/valley.csv; } >"$demo/path.csv"
for method in $methods; do
    step "Flying the stock osgviewer along data/paths/demo.csv and through four valleys of data/paths/valley.csv," \
        "culling method $method; pictures in $demo/$method"
    fly "$method"
done

step "Comparing the pictures and counts; the table is also in $demo/table.txt"
code=0
"$build/bin/osgbinbench" report "$demo/none" "$demo/sphere" "$demo/quadratic" >"$demo/table.txt" || code=$?
cat "$demo/table.txt"
[ "$code" -eq 0 ] || give_up "the report failed (code $code)"

step "Done: every method drew the same pictures"
