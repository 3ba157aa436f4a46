#!/bin/sh
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# Remakes the tables and figures of osgAnalyticBin/doc/results.md but those of other programs (sections 5 and 6): builds
# the project, the demo's database and a regional one, flies all camera paths over them, draws flights, jumps from pose
# to pose from disk and over a slow line, repeats the published experiment, and measures how culling scales. 16 to
# 24 minutes on two cores; run it on a quiet machine, for it measures times. Everything goes to the folder figures/.
# Arguments: none, or "commit" to put the tables and pictures of results.md into osgAnalyticBin/doc/results/.
# GTOPO30=FILE in the environment: a raster of 30 arc seconds, for the published experiment.

set -eu
cd "$(dirname "$0")/.."

build=build/release
out=figures
begin=$(date +%s)

step() {
    printf '\n== %s (%s s)\n' "$*" "$(($(date +%s) - begin))"
}

on_display() {
    xvfb-run -a -s "-screen 0 1280x720x24 -noreset" "$@"
}

step "Packages"
sh applications/packages.sh

step "Build"
cmake --preset release >/dev/null
cmake --build --preset release -- osgbinbench osgbindem osgbinpaper osgdb_analyticbin \
    osgdb_serializers_osganalyticbin osgdb_proceduralglobe
mkdir -p "$out"

if [ -n "$(find "$out/earth.done" -newer "$build/bin/osgbindem" 2>/dev/null)" ]; then
    step "The databases are there already"
else
    step "Databases of the earth and of a region"
    rasters="/usr/share/ferret-vis/data/etopo5.cdf /usr/share/ncarg/data/cdf/trinidad.nc --height-unit m ft"
    # shellcheck disable=SC2086
    "$build/bin/osgbindem" $rasters --overwrite -o "$out/earth.osgb"
    # shellcheck disable=SC2086
    "$build/bin/osgbindem" $rasters -te -107 36 -103 39 --overwrite -o "$out/region.osgb"
fi

path_options() {
    for path in "$@"; do printf ' --path data/paths/%s.csv' "$path"; done
}
high=$(path_options nadir oblique horizon rockies pole dateline sensor10 sensor2 stereo turning)
low=$(path_options valley nap hilltop helicopter drone approach)
peers=sphere,cluster,orientedbox+horizon+edges
default=bins
occlusion=sphere,cluster,quadratic+horizon+edges,$default

step "High views"
# shellcheck disable=SC2086
on_display "$build/bin/osgbinbench" "$out/earth.osgb" $high --methods "$peers,exact+horizon+edges,$default,oracle" \
    --size 640x360 --repeats 12 --csv "$out/paths.csv" --json "$out/paths.json" --plot "$out/paths" \
    >"$out/paths.txt"

step "Low views, over the globe and over a region"
# shellcheck disable=SC2086
on_display "$build/bin/osgbinbench" "$out/earth.osgb" $low --size 640x360 --methods "$occlusion" \
    --repeats 12 --csv "$out/low.csv" --json "$out/low.json" >"$out/low.txt"
# shellcheck disable=SC2086
on_display "$build/bin/osgbinbench" "$out/region.osgb" $low --size 640x360 --methods "$occlusion" --repeats 8 \
    --csv "$out/region.csv" --json "$out/region.json" >"$out/region.txt"

step "Frames of flights, whole and with a driver that draws nothing"
draw_frames() { # GALLIUM_NOOP, path, metres a second, frames, threading, name
    on_display env GALLIUM_NOOP="$1" "$build/bin/osgbinbench" "$out/earth.osgb" --path "data/paths/$2.csv" \
        --speed "$3" --frames "$4" --draw --threading "$5" --methods "sphere,cluster,$default" --size 640x360 \
        --json "$out/frames_$2_$6.json" >"$out/frames_$2_$6.txt"
}
for flight in helicopter:50 approach:80; do
    draw_frames 0 "${flight%:*}" "${flight#*:}" 60 SingleThreaded "one thread"
    draw_frames 0 "${flight%:*}" "${flight#*:}" 60 DrawThreadPerContext "draw thread"
done
for flight in helicopter:50 approach:80 valley:100 rockies:250; do
    # Mesa's driver that draws nothing crashes now and then, whatever is drawn
    tries=1
    until draw_frames 1 "${flight%:*}" "${flight#*:}" 120 SingleThreaded "processor"; do
        tries=$((tries + 1))
        [ "$tries" -le 4 ] || { echo "figures.sh: $flight ended in an error four times" >&2; exit 1; }
    done
done

step "Jumps, from disk and over a line of 20 ms"
jumps="--path data/paths/demo.csv --jumps --size 640x360 --methods $peers,quadratic+horizon+edges,$default"
# shellcheck disable=SC2086
on_display "$build/bin/osgbinbench" "$out/earth.osgb" $jumps --json "$out/jumps_disk.json" >"$out/jumps_disk.txt"
# shellcheck disable=SC2086
on_display python3 applications/latency.py "$out" --milliseconds 20 -- \
    "$build/bin/osgbinbench" URL/earth.osgb $jumps --json "$out/jumps_http.json" >"$out/jumps_http.txt"

step "All methods"
on_display "$build/bin/osgbinbench" "$out/earth.osgb" --path data/paths/demo.csv --methods all --size 640x360 \
    --repeats 16 --csv "$out/methods.csv" --json "$out/methods.json" >"$out/methods.txt"

step "The published experiment"
"$build/bin/osgbinpaper" --csv "$out/paper.csv" >"$out/paper.txt"

if [ -n "${GTOPO30:-}" ]; then
    step "The same over 30 arc seconds"
    "$build/bin/osgbinpaper" "$GTOPO30" --levels 8 --cameras 200 --csv "$out/paper_gtopo30.csv" >"$out/paper_gtopo30.txt"
fi

step "Scale"
"$build/bin/osgbinbench" scale --levels 4,8,12,16,20,24 --rounds 6 --csv "$out/scale.csv" --json "$out/scale.json" \
    >"$out/scale.txt"
mkdir -p "$out/scale"
gnuplot -e "csv='$out/scale.csv'; folder='$out/scale'" applications/scale.gp

step "Machine"
{
    sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1
    echo "$(nproc) cores, Linux $(uname -r), g++ $(g++ -dumpfullversion), OpenSceneGraph $(osgversion --version-number 2>/dev/null || echo 3.6.5)"
    date -u +%Y-%m-%d
} | tee "$out/machine.txt"

if [ "${1:-}" = commit ]; then
    step "Tables and pictures for results.md"
    mkdir -p osgAnalyticBin/doc/results
    python3 applications/tables.py "$out" osgAnalyticBin/doc/results
    for picture in paths/drawn paths/files paths/cull; do
        cp "$out/$picture.png" "osgAnalyticBin/doc/results/$(echo "$picture" | tr / _).png"
    done
    for picture in "$out"/scale/*.png; do cp "$picture" "osgAnalyticBin/doc/results/scale_$(basename "$picture")"; done
fi

step "Done: tables in $out/*.txt, figures in $out/*/"
