#!/bin/sh
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# Takes the pictures of osgbinviewer in README and the guide into osgAnalyticBin/doc, on a virtual display:
#     sh applications/pictures.sh [DATABASE]
# DATABASE: that of applications/demo.sh by default, which has to be there; the project has to be built.

set -eu
cd "$(dirname "$0")/.."

build=build/release
database=${1:-demo/earth.osgb}
doc=osgAnalyticBin/doc

[ -f "$database" ] || { echo "pictures.sh: $database is missing; run \"sh applications/demo.sh\" first" >&2; exit 1; }

# The screen has room for two windows beside each other. Arguments: the window's width and height, the options of the
# bins, steps.
view() {
    window="0 0 $1 $2"
    options=$3
    shift 3
    # shellcheck disable=SC2086
    xvfb-run -a -s "-screen 0 2560x720x24" env LIBGL_ALWAYS_SOFTWARE=1 \
        LD_LIBRARY_PATH="$PWD/$build/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}" \
        "$build/bin/osgbinviewer" "$database" --options "$options" --window $window \
        --poses applications/osgbinviewer/pictures.csv ${near_far:+--COMPUTE_NEAR_FAR_MODE "$near_far"} --steps "$*"
}
near_far=

take() {
    view 1200 675 "" "$@"
}

# README: what the camera sees, and what is drawn for it. l: without lighting
view 800 450 method=sphere at=italy press=l press=F at=drawn picture="$doc/drawn_spheres.jpg"
view 800 450 method=quadratic at=italy press=l picture="$doc/drawn_view.jpg" \
    press=F at=drawn picture="$doc/drawn_bins.jpg"

# The guide: without lighting, so that colours are those of the legend
take at=alps press=l press=B picture="$doc/viewer_bins.jpg" \
    press=F at=aside picture="$doc/viewer_frozen.jpg" \
    at=above press=Q picture="$doc/viewer_quadratic.jpg" \
    press=B press=B press=n picture="$doc/viewer_method.jpg" press=N picture="$doc/viewer_with.jpg"
take at=alps press=l press=B press=y spy=65,38,3 spypicture="$doc/viewer_spy.jpg"
take at=alps press=l press=s press=s frames=25 at=peaks frames=25 at=aside frames=25 at=peaks frames=25 at=alps \
    frames=25 picture="$doc/viewer_stats.jpg" press=s press=s press=s press=h picture="$doc/viewer_help.jpg"

# Terrain behind terrain needs near and far planes that are given.
near_far=DO_NOT_COMPUTE_NEAR_FAR
view 800 450 occlusion=off at=valley press=l press=B press=F at=valley_aside picture="$doc/valley_off.jpg"
view 800 450 occlusion=on at=valley press=l picture="$doc/valley_view.jpg" \
    press=O picture="$doc/viewer_covered.jpg" press=O press=B press=F at=valley_aside picture="$doc/valley_on.jpg"
