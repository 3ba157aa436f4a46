#!/bin/sh
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# Remakes every table and figure of osgAnalyticBin/doc/results.md: builds the project and the demo's database, flies all
# shipped camera paths, repeats the published experiment, and measures how culling scales. Some ten minutes on two cores;
# run it on a quiet machine, for it measures times. Everything goes to the folder figures/.
# Arguments: none, or "commit" to put the pictures that results.md shows into osgAnalyticBin/doc/results/.

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
    step "The database is there already"
else
    step "Database of the earth"
    "$build/bin/osgbindem" /usr/share/ferret-vis/data/etopo5.cdf /usr/share/ncarg/data/cdf/trinidad.nc --height-unit m ft \
        --overwrite -o "$out/earth.osgb"
fi

paths=""
for path in nadir oblique horizon rockies pole dateline sensor10 sensor2 stereo turning; do
    paths="$paths --path data/paths/$path.csv"
done

step "All shipped camera paths"
# shellcheck disable=SC2086
on_display "$build/bin/osgbinbench" "$out/earth.osgb" $paths --size 640x360 --csv "$out/paths.csv" \
    --json "$out/paths.json" --plot "$out/paths" >"$out/paths.txt"

step "All methods"
on_display "$build/bin/osgbinbench" "$out/earth.osgb" --path data/paths/demo.csv --methods all --size 640x360 --live 0 \
    --csv "$out/methods.csv" --json "$out/methods.json" >"$out/methods.txt"

step "The published experiment"
"$build/bin/osgbinpaper" --csv "$out/paper.csv" --json "$out/paper.json" --plot "$out/paper" >"$out/paper.txt"

step "Scale"
"$build/bin/osgbinbench" scale --csv "$out/scale.csv" --json "$out/scale.json" --plot "$out/scale" >"$out/scale.txt"

step "Machine"
{
    sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1
    echo "$(nproc) cores, Linux $(uname -r), g++ $(g++ -dumpfullversion), OpenSceneGraph $(osgversion --version-number 2>/dev/null || echo 3.6.5)"
    date -u +%Y-%m-%d
} | tee "$out/machine.txt"

if [ "${1:-}" = commit ]; then
    step "Pictures for results.md"
    mkdir -p osgAnalyticBin/doc/results
    for picture in paths/drawn paths/files paths/cull paper/figure1 paper/figure2 paper/figure3 \
        paper/figure4 paper/figure5 paper/wrong_cull_corners paper/wrong_cull_paper; do
        cp "$out/$picture.png" "osgAnalyticBin/doc/results/$(echo "$picture" | tr / _).png"
    done
    for picture in "$out"/scale/*.png; do cp "$picture" "osgAnalyticBin/doc/results/scale_$(basename "$picture")"; done
fi

step "Done: tables in $out/*.txt, figures in $out/*/"
