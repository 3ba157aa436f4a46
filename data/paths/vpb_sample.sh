#!/bin/sh
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# Prints the camera path data/paths/vpb_sample.csv. A pose is given here by where the eye is, how high in metres, the
# azimuth (degrees east of north) and the depression (degrees below the horizontal) of the view, and the vertical field
# of view in degrees. From a sphere of 6371 km follow
#   the look point: where the line of sight comes down on it, or passes it closest;
#   near: a quarter of the height above 9000 m, so that no mountain is cut away, and 50 m at least;
#   far: to the horizon, and 450 km on, so that no mountain beyond it is cut away.
set -eu

awk '
BEGIN {
    pi = atan2(0, -1); deg = pi / 180; R = 6371000
    print "# Made by data/paths/vpb_sample.sh. Degrees; metres above the ellipsoid; near and far are the planes in metres."
    print "name, eyeLatDeg, eyeLonDeg, eyeAlt, lookLatDeg, lookLonDeg, lookAlt, fovDeg, near, far"
}
function acos(x) { return x >= 1 ? 0 : atan2(sqrt(1 - x * x), x) }
function asin(x) { return atan2(x, sqrt(1 - x * x)) }
function max(a, b) { return a > b ? a : b }
$1 ~ /^#/ || NF < 7 { next }
{
    lat = $2 * deg; lon = $3 * deg; h = $4; az = $5 * deg; down = $6 * deg
    closest = (R + h) * cos(down) / R
    angle = closest < 1 ? down - acos(closest) : max(down, 0.3 * deg)
    lookAlt = closest < 1 ? 0 : R * (closest / cos(angle - down) - 1)
    sinLat = sin(lat) * cos(angle) + cos(lat) * sin(angle) * cos(az)
    lookLat = asin(sinLat > 1 ? 1 : sinLat)
    lookLon = lon + atan2(sin(az) * sin(angle) * cos(lat), cos(angle) - sin(lat) * sinLat)
    if (lookLon > pi) lookLon -= 2 * pi
    if (lookLon < -pi) lookLon += 2 * pi
    if ($6 == 90) { lookLat = lat; lookLon = lon }
    printf "%s, %.6f, %.6f, %.0f, %.6f, %.6f, %.0f, %s, %.0f, %.0f\n", $1, $2, $3, h, lookLat / deg, lookLon / deg,
        lookAlt, $7, max(50, (h - 9000) / 4), sqrt(h * (2 * R + h)) + 450000
}' <<'POSES'
# name                          lat    lon     height    az   down  fov
# Straight down
fov60_nadir_10000km_atlantic    20    -60    10000000     0   90    60
fov60_nadir_10000km_pacific    -15    170    10000000     0   90    60
fov60_nadir_3000km_inset        58    -20     3000000     0   90    60
fov60_nadir_1000km_inset        60    -20     1000000     0   90    60
fov60_nadir_300km_andes        -10    -75      300000     0   90    60
fov60_nadir_100km_inset         59    -19      100000     0   90    60
fov60_nadir_30km_inset          61    -18       30000     0   90    60
fov60_nadir_2km_atlantic        30    -35        2000     0   90    60
# Oblique
fov60_oblique_1000km_atlantic   45    -40     1000000    40   50    60
fov60_oblique_300km_inset       55    -25      300000    30   40    60
fov60_oblique_300km_africa       5     20      300000   120   45    60
fov60_oblique_100km_inset       57    -22      100000    30   45    60
fov60_oblique_100km_indochina   10    100      100000   200   35    60
fov60_oblique_30km_inset        58.5  -21       30000    40   30    60
fov60_oblique_12km_inset        60    -20       12000   300   25    60
# The horizon in view
fov60_horizon_3000km_asia       30     80     3000000   330   45    60
fov60_horizon_1000km_atlantic   40    -40     1000000    30   28    60
fov60_horizon_100km_atlantic    45    -20      100000     0   10    60
fov60_horizon_30km_brazil      -15    -55       30000   250    6    60
fov60_horizon_12km_inset        57    -24       12000    40    3    60
fov60_horizon_4km_inset         52    -21        4000    15    1    60
fov60_horizon_2km_atlantic      30    -35        2000    10    2    60
# Poles and the date line
fov60_pole_3000km_north         90      0     3000000     0   90    60
fov60_pole_1000km_north         84     20     1000000     0   60    60
fov60_pole_300km_south         -87    100      300000   180   35    60
fov60_pole_10km_north           88   -120       10000     0    3    60
fov60_dateline_200km_fiji      -18    178.5    200000    70   40    60
fov60_dateline_100km_bering     66    178      100000    80   40    60
fov60_dateline_10km_pacific     20    179.5     10000    90    3    60
# Ten degrees
fov10_nadir_10000km_atlantic    20    -60    10000000     0   90    10
fov10_nadir_1000km_inset        60    -20     1000000     0   90    10
fov10_nadir_100km_inset         59    -19      100000     0   90    10
fov10_oblique_1000km_atlantic   50    -30     1000000    35   55    10
fov10_oblique_300km_himalaya    25     85      300000    10   40    10
fov10_oblique_100km_inset       57    -22      100000    30   30    10
fov10_oblique_30km_inset        57    -20       30000    10   15    10
fov10_oblique_30km_australia   -25    135       30000   290   20    10
fov10_horizon_1000km_atlantic   40    -40     1000000    30   29    10
fov10_horizon_100km_atlantic    45    -20      100000     0    9    10
fov10_horizon_12km_inset        54    -20       12000     0    2    10
fov10_horizon_4km_inset         52    -21        4000    15    0.5  10
fov10_horizon_2km_atlantic      30    -35        2000   190    1    10
fov10_pole_300km_south         -87    100      300000   180   40    10
fov10_pole_30km_north           89    -90       30000     0   12    10
fov10_dateline_100km_bering     66    178      100000    80   30    10
# Two degrees
fov2_nadir_10000km_inset        60    -20    10000000     0   90     2
fov2_nadir_1000km_inset         60    -20     1000000     0   90     2
fov2_nadir_100km_inset          59    -19      100000     0   90     2
fov2_oblique_3000km_atlantic    40    -50     3000000    40   60     2
fov2_oblique_300km_inset        52    -25      300000    20   25     2
fov2_oblique_100km_andes       -30    -75      100000    60   20     2
fov2_oblique_30km_inset         57    -20       30000    10   10     2
fov2_horizon_1000km_atlantic    40    -40     1000000    30   30     2
fov2_horizon_100km_atlantic     48    -20      100000     0    9.5   2
fov2_horizon_12km_inset         54    -20       12000     0    2     2
fov2_horizon_4km_inset          52    -21        4000    15    1     2
fov2_horizon_2km_atlantic       30    -35        2000    10    1     2
fov2_pole_100km_north           87     40      100000   350   12     2
fov2_dateline_100km_fiji       -18    178.5    100000    70   20     2
POSES
