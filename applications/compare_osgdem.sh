#!/bin/sh
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# Builds the same globes with VirtualPlanetBuilder's osgdem and with osgbindem, and compares time, memory, bytes and
# pictures; "Against osgdem" in osgAnalyticBin/doc/results.md says how osgdem was built.
#     sh applications/compare_osgdem.sh OSGDEM [ROUNDS [more]]
# OSGDEM: the program; its libraries have to be found (LD_LIBRARY_PATH). Without it nothing is done.
# ROUNDS: how often every program runs, one after the other in turn (default 3); the table has the medians. With "more"
# they are added to those of the runs before.
# Everything goes to the folder figures/osgdem; the table to figures/osgdem/table.txt.

set -eu
cd "$(dirname "$0")/.."

osgdem=${1:-}
rounds=${2:-3}
if [ ! -x "$osgdem" ]; then
    echo "compare_osgdem.sh: no osgdem at \"$osgdem\", so there is nothing to compare with; give its path" >&2
    exit 0
fi
[ -x /usr/bin/time ] || { echo "compare_osgdem.sh: /usr/bin/time is missing; install the package time" >&2; exit 1; }

build=$PWD/build/release
out=$PWD/figures/osgdem
mkdir -p "$out"
export OSG_LIBRARY_PATH="$build/lib"
export LD_LIBRARY_PATH="$build/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"

# osgdem compresses textures with OpenGL, and asks for a display even without any; pictures need one too.
if [ -z "${COMPARE_ON_DISPLAY:-}" ]; then
    COMPARE_ON_DISPLAY=1 exec xvfb-run -a -s "-screen 0 1280x720x24 -noreset" sh "$0" "$@"
fi

make_synthetic() {
    awk 'BEGIN {
        pi = atan2(0, -1); w = 3600; h = 1800; terms = 8
        print "ncols 3600\nnrows 1800\nxllcorner -180\nyllcorner -90\ncellsize 0.1"
        for (k = 0; k < terms; k++) f[k] = 1 + int(3 * 2.1 ^ k)
        for (j = 0; j < w; j++) for (k = 0; k < terms; k++) c[j, k] = cos(f[k] * (j + 0.5) * 2 * pi / w + k)
        for (i = 0; i < h; i++) {
            latitude = pi / 2 - (i + 0.5) * pi / h
            for (k = 0; k < terms; k++) a[k] = 2500 / 1.6 ^ k * cos(latitude) * cos(f[k] * latitude * 1.1 + 2 * k)
            line = ""
            for (j = 0; j < w; j++) { s = 0; for (k = 0; k < terms; k++) s += a[k] * c[j, k]; line = line int(s) " " }
            print line
        }
    }' >"$out/synthetic.asc"
    gdal_translate -q -ot Float32 -a_srs EPSG:4326 "$out/synthetic.asc" "$out/synthetic.tif"
    rm "$out/synthetic.asc"
}

# ETOPO5 counts longitudes from 0; both programs get it cut in two and joined again.
make_real() {
    source=/usr/share/ferret-vis/data/etopo5.cdf
    gdal_translate -q -a_srs EPSG:4326 -srcwin 2160 0 2160 2160 -a_ullr -180 90 0 -90 "$source" "$out/west.tif"
    gdal_translate -q -a_srs EPSG:4326 -srcwin 0 0 2160 2160 -a_ullr 0 90 180 -90 "$source" "$out/east.tif"
    gdalbuildvrt -q "$out/real.vrt" "$out/west.tif" "$out/east.tif"
    gdal_translate -q -ot Float32 -a_nodata none "$out/real.vrt" "$out/real.tif"
    rm "$out/west.tif" "$out/east.tif" "$out/real.vrt"
}

make_image() {
    printf '%s\n' "-11000 8 16 60" "-3000 30 82 156" "-1 160 206 232" "0 92 142 84" "1000 202 190 128" \
        "3000 142 108 82" "6500 250 250 250" >"$out/ramp.txt"
    gdaldem color-relief -q "$1" "$out/ramp.txt" "$2"
}

# NAME COMMAND...: runs the command in a folder of that name and adds a line to NAME.runs:
# wall seconds, processor seconds, KiB at most, files, bytes
run() {
    name=$1
    shift
    rm -rf "${out:?}/$name"
    mkdir "$out/$name"
    (cd "$out/$name" && /usr/bin/time -o ../time -f "%e %U %S %M" "$@" >../log 2>&1) ||
        { cat "$out/log" >&2; echo "compare_osgdem.sh: $1 failed for $name" >&2; exit 1; }
    files=$(find "$out/$name" -name '*.osgb' | wc -l)
    bytes=$(find "$out/$name" -name '*.osgb' -printf '%s\n' | awk '{ s += $1 } END { print s }')
    awk -v files="$files" -v bytes="$bytes" 'END { print $1, $2 + $3, $4, files, bytes }' "$out/time" >>"$out/$name.runs"
}

dem() {
    name=$1
    shift
    run "$name" "$osgdem" --geocentric "$@" -o earth.osgb
}

bindem() {
    name=$1
    shift
    run "$name" "$build/bin/osgbindem" "$@" --cells 64 --threads 1 --quiet -o earth.osgb
}

# The tiles follow from the files: each has four, but osgdem's first two have one and two, and osgbindem's first 128.
# Each number is the median of its column.
line() {
    sort -n -k2,2 "$out/$1.runs" | awk -v name="$1" -v first="$2" '
        { wall[NR] = $1; cpu[NR] = $2; kib[NR] = $3; files = $4; bytes = $5 }
        function median(a, i, j, t) {
            for (i = 1; i <= NR; i++) for (j = i + 1; j <= NR; j++) if (a[j] < a[i]) { t = a[i]; a[i] = a[j]; a[j] = t }
            return a[int((NR + 1) / 2)]
        }
        END {
            tiles = first == 128 ? 128 + 4 * (files - 1) : 3 + 4 * (files - 2)
            c = median(cpu)
            printf "%-34s %7.2f %7.2f %6d %8.0f %8.0f %10.0f %6d\n", name, median(wall), c, tiles, tiles / c,
                median(kib) / 1024, bytes / tiles, files
        }'
}

machine() {
    sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1
    echo "$(nproc) cores, Linux $(uname -r), g++ $(g++ -dumpfullversion); $(wc -l <"$out/real_osgbindem_mesh.runs") rounds, load $(cut -d' ' -f1 /proc/loadavg)"
}

[ -f "$out/synthetic.tif" ] || make_synthetic
[ -f "$out/real.tif" ] || make_real
for globe in synthetic real; do
    [ -f "$out/${globe}_image.tif" ] || make_image "$out/$globe.tif" "$out/${globe}_image.tif"
done
[ "${3:-}" = more ] || rm -f "$out"/*.runs

# Both go down to the same tiles of 2.8 degrees (terrain) and 5.6 degrees (polygonal): osgdem's seventh and sixth level
# are osgbindem's second and first below its start tiles.
for round in $(seq "$rounds"); do
    echo "round $round" >&2
    for globe in synthetic real; do
        source=$out/$globe.tif
        image=$out/${globe}_image.tif
        dem "${globe}_osgdem_terrain" -d "$source" -l 7 --TERRAIN
        bindem "${globe}_osgbindem_packed" --packed "$source" --levels 2
        dem "${globe}_osgdem_terrain_image" -d "$source" -t "$image" -l 7 --TERRAIN --tile-image-size 128
        bindem "${globe}_osgbindem_packed_image" --packed "$source" --levels 2 --image "$image"
        dem "${globe}_osgdem_polygonal" -d "$source" -l 6 --POLYGONAL --no-terrain-simplification
        bindem "${globe}_osgbindem_mesh" "$source" --levels 1
    done
done

{
    machine
    printf '%-34s %7s %7s %6s %8s %8s %10s %6s\n' "" "wall s" "cpu s" tiles "/cpu s" MiB B/tile files
    for globe in synthetic real; do
        line "${globe}_osgdem_terrain" 1
        line "${globe}_osgbindem_packed" 128
        line "${globe}_osgdem_terrain_image" 1
        line "${globe}_osgbindem_packed_image" 128
        line "${globe}_osgdem_polygonal" 1
        line "${globe}_osgbindem_mesh" 128
    done
} | tee "$out/table.txt"

# One camera, the horizon in view; the stock viewer takes the pictures.
cat >"$out/pose.csv" <<'END'
name,  eyeLatDeg, eyeLonDeg, eyeAlt,  lookLatDeg, lookLonDeg, lookAlt, fovDeg, near,  far
tibet, 20,        84,        400000,  29,         86,         0,       45,     20000, 6000000
END
for name in real_osgdem_terrain_image real_osgbindem_packed_image; do
    [ -f "$build/lib/osgPlugins-3.6.5/osgdb_binflight.so" ] || break
    rm -rf "${out:?}/picture_$name"
    OSG_WINDOW="0 0 1280 720" osgviewer --SingleThreaded "$out/$name/earth.osgb" \
        "$out/pose.csv.(out=$out/picture_$name).binflight" </dev/null >/dev/null 2>&1 || true
    find "$out/picture_$name" -name '*.png' 2>/dev/null || true
done
