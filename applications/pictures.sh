#!/bin/sh
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# Takes the pictures of osgbinviewer in README and the guide into osgAnalyticBin/doc, on a virtual display:
#     sh applications/pictures.sh [DATABASE]
# DATABASE: that of applications/demo.sh by default, which has to be there; builds what it needs.
# PICTURES_FRAMES: of README's animation; default: 40.

set -eu
cd "$(dirname "$0")/.."

build=build/release
database=${1:-demo/earth.osgb}
doc=osgAnalyticBin/doc

[ -f "$database" ] || { echo "pictures.sh: $database is missing; run \"sh applications/demo.sh\" first" >&2; exit 1; }

sh applications/packages.sh demo imagemagick fonts-dejavu-core
cmake --build "$build" --target osgbinviewer osgbinbench

# Arguments: the window's width and height, the options of the bins, steps.
view() {
    window="0 0 $1 $2"
    options=$3
    shift 3
    # shellcheck disable=SC2086
    xvfb-run -a -s "-screen 0 1280x720x24" env LIBGL_ALWAYS_SOFTWARE=1 \
        LD_LIBRARY_PATH="$PWD/$build/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}" \
        "$build/bin/osgbinviewer" "$database" --options "$options" --window $window \
        --poses "${poses:-applications/osgbinviewer/pictures.csv}" ${near_far:+--COMPUTE_NEAR_FAR_MODE "$near_far"} --steps "$*"
}
near_far=

take() {
    view 900 506 "" "$@"
}

# The guide: without lighting, so that colours are those of the legend
take at=alps press=l press=B picture="$doc/viewer_bins.jpg" \
    press=F at=aside picture="$doc/viewer_frozen.jpg" \
    at=above press=B press=B press=n picture="$doc/viewer_method.jpg" press=N picture="$doc/viewer_with.jpg"
take at=alps press=l press=s press=s frames=25 at=peaks frames=25 at=aside frames=25 at=peaks frames=25 at=alps \
    frames=25 picture="$doc/viewer_stats.jpg" press=s press=s press=s press=h picture="$doc/viewer_help.jpg"

# Terrain behind terrain needs near and far planes that are given.
near_far=DO_NOT_COMPUTE_NEAR_FAR
view 800 450 occlusion=off at=valley press=l press=B press=F at=valley_aside picture="$doc/valley_off.jpg"
view 800 450 occlusion=on at=valley press=l picture="$doc/valley_view.jpg" \
    press=O picture="$doc/viewer_covered.jpg" press=O press=B press=F at=valley_aside picture="$doc/valley_on.jpg"

# README's animation: a flight from Libya to the Alps. Beside the camera's view stands what is drawn for it, seen from
# above, with spheres and with bins; the numbers of tiles are osgbinbench's.
near_far=
frames=$(mktemp -d)
trap 'rm -rf "$frames"' EXIT
awk -v frames="${PICTURES_FRAMES:-40}" 'BEGIN {
    print "name, eyeLatDeg, eyeLonDeg, eyeAlt, lookLatDeg, lookLonDeg, lookAlt, fovDeg, near, far"
    for (i = 0; i < frames; ++i) {
        t = i / (frames - 1)
        t = t * t * (3 - 2 * t)
        latitude = 26 + 16 * t
        longitude = 21 - 8 * t
        printf "f%02d, %.4f, %.4f, %.0f, %.4f, %.4f, 0, 40, 1000, 10000000\n", i, latitude, longitude,
               500000 * 0.3 ^ t, latitude + 8 - 3 * t, longitude - 4 + t
    }
}' >"$frames/flight.csv"
names=$(sed -n 's/^\(f[0-9]*\),.*/\1/p' "$frames/flight.csv")
grep '^over,' applications/osgbinviewer/pictures.csv | cat "$frames/flight.csv" - >"$frames/poses.csv"

for method in sphere quadratic; do
    steps=""
    for name in $names; do
        steps="$steps at=$name picture=$frames/$name.view.png press=F at=over picture=$frames/$name.$method.png press=F"
    done
    poses="$frames/poses.csv" view 660 495 "method=$method" press=l "$steps"
done
xvfb-run -a -s "-screen 0 1280x720x24" env LIBGL_ALWAYS_SOFTWARE=1 "$build/bin/osgbinbench" "$database" \
    --path "$frames/flight.csv" --methods sphere,quadratic+horizon+edges --size 660x495 --repeats 1 --flush 0 \
    --csv "$frames/counts.csv" >"$frames/log" || { cat "$frames/log" >&2; exit 1; }

# Arguments: pose, what the method's name begins with. Prints the number of tiles drawn.
drawn() {
    awk -F, -v pose="$1" -v method="$2" '
        NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "drawn_tiles") column = i }
        $1 == pose && index($2, method) == 1 { print $column }' "$frames/counts.csv"
}

for name in $names; do
    montage -background white -fill black -font DejaVu-Sans -pointsize 15 -tile 3x1 -geometry 328x246+3+3 \
        -label "OSG's spheres: $(drawn "$name" sphere) tiles drawn" "$frames/$name.sphere.png" \
        -label "bins: $(drawn "$name" quadratic) tiles drawn" "$frames/$name.quadratic.png" \
        -label "what the camera sees with both" "$frames/$name.view.png" "$frames/$name.frame.png"
done
convert -delay 12 -loop 0 "$frames"/f*.frame.png -set delay '%[fx:t==0||t==n-1?150:12]' +dither -colors 96 \
    -layers optimize "$doc/flight.gif"
