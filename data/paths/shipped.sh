#!/bin/sh
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# Writes camera paths beside itself: nadir, oblique, horizon, rockies, pole, dateline, sensor10, sensor2, stereo and
# turning, and, low among the mountains, nap, hilltop, helicopter, drone and approach; with names of these, only them. A pose is given here by where the eye is, its altitude, the azimuth (degrees
# east of north) and the depression (degrees below the horizontal) of the view, the vertical field of view in degrees,
# and the altitude of the ground that is looked at. From a sphere of 6371 km follow
#   the look point: where the line of sight comes down to that ground, or passes it closest;
#   near, where it says -: a quarter of the altitude above 9000 m, so that no mountain is cut away, and 50 m at least;
#   far: to the horizon, and 450 km on, so that no mountain beyond it is cut away.
# The poses were chosen by where users look, not by what was measured. Every eye is above the ground, and no near plane
# cuts terrain away.
set -eu
cd "$(dirname "$0")"

# poses PATH: its remarks (lines that begin with #), then NAME LAT LON ALT AZ DOWN FOV GROUND NEAR [TIME ROLL | BASE].
poses() {
    case "$1" in
    nadir) cat <<'END'
# Straight down, from the whole globe to a low aeroplane.
10000km_atlantic    20      -60     10000000    0    90   60  0     -
3000km_africa       5        20     3000000     0    90   60  500   -
1000km_europe       47       12     1000000     0    90   60  500   -
300km_himalaya      28.5     86     300000      0    90   60  4000  -
100km_andes        -32.5    -70     100000      0    90   60  3000  -
30km_alps           46.2      9.5   30000       0    90   60  1500  -
12km_rockies        37.5   -105.2   12000       0    90   60  2600  1500
2km_sea             30      -35     2000        0    90   60  0     500
END
        ;;
    oblique) cat <<'END'
# Looking 30 to 50 degrees down: the horizon is out of the picture, or just in it where the eye is very high.
1000km_europe       36        0     1000000    30    50   60  0     -
300km_himalaya      26.5     84     300000     35    45   60  3000  -
100km_alps          45.6      8.5   100000     40    45   60  1500  -
100km_andes        -33      -71.2   100000     60    40   60  3000  -
100km_hawaii        18.9   -156.6   100000     50    45   60  0     -
50km_japan          35      138     50000      60    35   60  500   -
20km_rockies        37.2   -106.0   20000      60    35   60  2800  -
12km_rockies        37.25  -105.7   12000      40    40   60  3000  1500
END
        ;;
    horizon) cat <<'END'
# The horizon in view, from a satellite's height to a ship's helicopter.
3000km_asia         30       80     3000000   330    45   60  0     -
1000km_atlantic     40      -40     1000000    30    28   60  0     -
300km_africa        12        5     300000     90    18   60  300   -
100km_alps          42.5      7     100000     30    10   60  1000  -
30km_brazil        -15      -55     30000     250     6   60  300   -
12km_himalaya       26.5     85.5   12000      15     3   60  3000  500
5km_po              44.9      8.8   5000        5     2   60  1000  200
1km_sea             36      -30     1000       70     1   60  0     50
END
        ;;
    rockies) cat <<'END'
# A low flight over the finer inset of the demo database (37 .. 38 N, 106 .. 104 W): up the San Luis valley, past Blanca
# Peak, over the Sangre de Cristo range and the Spanish Peaks to the plains, 500 m to 5 km above the ground, some 200 m/s.
# Turns are banked. Poses are the corners of the flight; time is in seconds.
valley_low          37.15  -105.85  3000        5     4   60  2300  50     0      0
valley_climb        37.35  -105.82  3400       30     3   60  2600  50   115     15
blanca_west         37.50  -105.66  4700       55     3   60  3600  50   230     20
blanca_north        37.66  -105.55  5600      150     9   60  4200  50   340    -25
range_east          37.60  -105.30  6800      140    12   60  3300  200  460     10
spanish_peaks       37.50  -105.12  5000      140     5   60  3800  50   560      5
spanish_south       37.33  -104.98  4700       60     8   60  3000  50   660    -30
plains_east         37.42  -104.70  3900       80     7   60  1900  100  790    -10
plains_back         37.45  -104.40  6600      265    12   60  2000  300  930     20
END
        ;;
    pole) cat <<'END'
# Over and across both poles, where meridians meet.
north_3000km        90        0     3000000     0    90   60  0     -
north_1000km        84       20     1000000     0    60   60  0     -
north_10km          88     -120     10000       0     3   60  0     200
north_30km_fov10    89      -90     30000       0    12   10  0     -
south_300km        -87      100     300000    180    35   60  2800  -
south_100km        -89.2    -60     100000    180    45   60  2800  -
south_12km         -89      160     12000     180     4   60  2800  500
south_5km          -89.95    30     5000       90     5   60  2800  100
END
        ;;
    dateline) cat <<'END'
# Across the date line, in both directions.
10000km_pacific    -15      179     10000000    0    90   60  0     -
1000km_aleutians    45      175     1000000    25    50   60  0     -
200km_fiji         -18      178.5   200000     70    40   60  0     -
100km_bering        66      178     100000     80    40   60  0     -
50km_wrangel        71     -177.5   50000     285    30   60  0     -
10km_pacific        20      179.5   10000      90     3   60  0     200
10km_ross          -79     -178     10000     250     8   60  0     200
60km_fiji_fov10    -17.3    179     60000     100    25   10  0     -
END
        ;;
    sensor10) cat <<'END'
# A sensor of 10 degrees, swept from below the eye to the horizon: from 30 km over the Rockies, then from 10 and 100 km.
30km_80             37.5   -105.6   30000      80    80   10  2600  -
30km_45             37.5   -105.6   30000      80    45   10  2600  -
30km_25             37.5   -105.6   30000      80    25   10  2000  -
30km_12             37.5   -105.6   30000      80    12   10  1500  -
30km_horizon        37.5   -105.6   30000      80     5   10  500   -
10km_20             37.3   -105.75  10000      50    20   10  3500  1500
10km_horizon        45      8       10000     350     2   10  2000  1500
100km_30            26.5     87     100000      5    30   10  5000  -
100km_horizon       24       84     100000     10     9   10  4000  -
END
        ;;
    sensor2) cat <<'END'
# A sensor of 2 degrees, swept from near to far: from 12 km over the Rockies, then from 30 and 100 km.
12km_60             37.5   -105.7   12000      75    60    2  2800  1500
12km_30             37.5   -105.7   12000      75    30    2  3000  1500
12km_12             37.5   -105.7   12000      75    12    2  2500  1500
12km_horizon        37.5   -105.9   12000     100   3.1    2  1500  1500
30km_20             37.2   -105.9   30000      60    20    2  2500  -
30km_horizon        27.2     82     30000      60   5.2    2  5000  -
100km_45           -32      -71     100000     80    45    2  3000  -
100km_15           -32      -73     100000     80    15    2  3000  -
100km_horizon       43        4     100000     60   9.8    2  1000  -
END
        ;;
    stereo) cat <<'END'
# Pairs for stereo viewing, left and right eye (eyeRight, metres). Near the ground the base is that of a human's eyes
# or of a model twenty times smaller; higher up it is a thirtieth of the distance to the look point.
orbit               47       10     1000000    30    60   60  0     -     38000
alps                45.6      8.5   100000     40    45   60  1500  -     4700
rockies             37.3   -105.75  9000       45    20   60  3000  1000  580
valley              37.45  -105.72  2900       50     2   60  2500  50    1.3
ground              37.30  -105.80  2330       40     1   60  2310  10    0.065
END
        ;;
    turning) cat <<'END'
# Turning on the spot, once around, in steps of 45 degrees, near Blanca Peak.
000                 37.46  -105.60  3600        0     4   60  2600  50
045                 37.46  -105.60  3600       45     4   60  2600  50
090                 37.46  -105.60  3600       90     4   60  2600  50
135                 37.46  -105.60  3600      135     4   60  2600  50
180                 37.46  -105.60  3600      180     4   60  2600  50
225                 37.46  -105.60  3600      225     4   60  2600  50
270                 37.46  -105.60  3600      270     4   60  2600  50
315                 37.46  -105.60  3600      315     4   60  2600  50
END
        ;;
    nap) cat <<'END'
# Nap of the earth: 50 m above the ground in twelve valleys of the Rockies. Terrain hides most of what is in front.
50m_1       37.18006 -105.24673 2914    236  0.5  60  2855  5
50m_2       37.75869 -105.17481 2218     12  0.5  60  2162  5
50m_3       37.36259 -105.12231 2881    312  0.5  60  2803  5
50m_4       37.54687 -105.16155 2731    305  0.5  60  2562  5
50m_5       37.74811 -105.06915 2092    276  0.5  60  2040  5
50m_6       37.51394 -105.06274 2249    102  0.5  60  2193  5
50m_7       37.72623 -104.95371 2000    259  0.5  60  1950  5
50m_8       37.71835 -105.37562 2690     23  0.5  60  2619  5
50m_9       37.15658 -105.00852 2487    189  0.5  60  2376  5
50m_10      37.57391 -105.28784 2706    124  0.5  60  2620  5
50m_11      37.37804 -105.26552 2781    317  0.5  60  2687  5
50m_12      37.30008 -104.86149 2370    122  0.5  60  2315  5
END
        ;;
    hilltop) cat <<'END'
# From twelve hilltops and ridges of the Rockies, 30 m above them: little is hidden behind terrain.
30m_1       37.58316 -105.22083 3198     30    3  60  2500  5
30m_2       37.37644 -104.99352 4145     97    3  60  2500  5
30m_3       37.79534 -105.45395 3625     15    3  60  2500  5
30m_4       37.67702 -105.47840 3747    300    3  60  2500  5
30m_5       37.37270 -105.16796 3625    276    3  60  2500  5
30m_6       37.11144 -105.18138 4235    131    3  60  2500  5
30m_7       37.87607 -105.48640 3930     42    3  60  2500  5
30m_8       37.63954 -105.37184 3747    232    3  60  2500  5
30m_9       37.70656 -105.20582 2894    108    3  60  2500  5
30m_10      37.89323 -105.03194 3686    279    3  60  2500  5
30m_11      37.46644 -105.23129 3259    309    3  60  2500  5
30m_12      37.25662 -105.24294 3686     29    3  60  2500  5
END
        ;;
    helicopter) cat <<'END'
# A helicopter that hovers 150 m above the ground and turns, at two places among the foothills.
a_0         37.65324 -105.41643 3063      0    4  60  2876  5
a_60        37.65324 -105.41643 3063     60    4  60  2876  5
a_120       37.65324 -105.41643 3063    120    4  60  2876  5
a_180       37.65324 -105.41643 3063    180    4  60  2876  5
a_240       37.65324 -105.41643 3063    240    4  60  2876  5
a_300       37.65324 -105.41643 3063    300    4  60  2876  5
b_0         37.72091 -105.01115 2133      0    4  60  1980  5
b_60        37.72091 -105.01115 2133     60    4  60  1980  5
b_120       37.72091 -105.01115 2133    120    4  60  1980  5
b_180       37.72091 -105.01115 2133    180    4  60  1980  5
b_240       37.72091 -105.01115 2133    240    4  60  1980  5
b_300       37.72091 -105.01115 2133    300    4  60  1980  5
END
        ;;
    drone) cat <<'END'
# A drone's camera of 30 degrees, 300 m above the ground, looking 30 degrees down.
300m_1      37.21197 -105.35699 3164    266   30  30  2833  20
300m_2      37.87142 -105.04419 3468    344   30  30  3002  20
300m_3      37.17298 -105.21495 3551    206   30  30  3107  20
300m_4      37.86991 -104.94971 2732    269   30  30  2338  20
300m_5      37.80667 -105.41942 3185    130   30  30  2864  20
300m_6      37.49204 -104.98648 2495     96   30  30  2186  20
300m_7      37.54955 -105.20360 3168     20   30  30  2816  20
300m_8      37.77845 -105.59369 2717    144   30  30  2402  20
300m_9      37.34539 -104.89425 2841    326   30  30  2515  20
300m_10     37.29558 -105.14782 3875    101   30  30  3520  20
300m_11     37.78611 -105.50036 2976     74   30  30  2616  20
300m_12     37.69383 -105.17337 2781    184   30  30  2402  20
END
        ;;
    approach) cat <<'END'
# An airliner's approach to Alamosa: 3 degrees down, over the Sangre de Cristo range and the San Luis valley.
55km        37.26584 -105.28067 5227    290    3  60  2284  20
50km        37.28091 -105.33282 4970    290    3  60  2284  20
45km        37.29598 -105.38497 4713    290    3  60  2284  20
40km        37.31105 -105.43711 4456    290    3  60  2284  20
35km        37.32612 -105.48926 4200    290    3  60  2284  20
30km        37.34119 -105.54141 3943    290    3  60  2284  20
26km        37.35626 -105.59356 3686    290    3  60  2284  20
21km        37.37133 -105.64570 3429    290    3  60  2284  20
16km        37.38640 -105.69785 3172    290    3  60  2284  20
11km        37.40147 -105.75000 2916    290    3  60  2284  20
6km         37.41655 -105.80215 2659    290    3  60  2284  20
1km         37.43162 -105.85429 2402    290    3  60  2284  20
END
        ;;
    *)
        echo "shipped.sh: there is no path \"$1\"" >&2
        return 1
        ;;
    esac
}

table() {
    awk -v path="$1" '
BEGIN {
    pi = atan2(0, -1); deg = pi / 180; R = 6371000
    print "# Made by data/paths/shipped.sh. Degrees; metres above the ellipsoid; near and far are the planes in metres."
    header = "name, eyeLatDeg, eyeLonDeg, eyeAlt, lookLatDeg, lookLonDeg, lookAlt, fovDeg, near, far"
}
function acos(x) { return x >= 1 ? 0 : atan2(sqrt(1 - x * x), x) }
function asin(x) { return x >= 1 ? pi / 2 : x <= -1 ? -pi / 2 : atan2(x, sqrt(1 - x * x)) }
function max(a, b) { return a > b ? a : b }
/^#/ { print; next }
{
    if (header != "") print header (NF == 11 ? ", time, rollDeg" : NF == 10 ? ", eyeRight" : "")
    header = ""
    lat = $2 * deg; lon = $3 * deg; h = $4; az = $5 * deg; down = $6 * deg; ground = R + $8
    closest = (R + h) * cos(down) / ground
    angle = closest < 1 ? down - acos(closest) : max(down, 0.3 * deg)
    lookAlt = closest < 1 ? $8 : (R + h) * cos(down) / cos(angle - down) - R
    sinLat = sin(lat) * cos(angle) + cos(lat) * sin(angle) * cos(az)
    lookLat = asin(sinLat)
    lookLon = lon + atan2(sin(az) * sin(angle) * cos(lat), cos(angle) - sin(lat) * sinLat)
    if (lookLon > pi) lookLon -= 2 * pi
    if (lookLon < -pi) lookLon += 2 * pi
    if ($6 == 90) { lookLat = lat; lookLon = lon }
    near = $9 == "-" ? max(50, (h - 9000) / 4) : $9
    line = sprintf("%s, %s, %.0f, %.6f, %.6f, %.0f, %s, %.0f, %.0f", $2, $3, h, lookLat / deg, lookLon / deg, lookAlt,
        $7, near, sqrt(h * (2 * R + h)) + 450000)
    if (NF == 11) print path "_" $1 ", " line ", " $10 ", " $11
    else if (NF == 10) {
        print path "_" $1 "_left, " line ", " (-$10 / 2)
        print path "_" $1 "_right, " line ", " $10 / 2
    } else print path "_" $1 ", " line
}'
}

[ $# -gt 0 ] || set -- nadir oblique horizon rockies pole dateline sensor10 sensor2 stereo turning \
    nap hilltop helicopter drone approach
for path in "$@"; do
    poses "$path" >/dev/null
    poses "$path" | table "$path" >"$path.csv"
done
