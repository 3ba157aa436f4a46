# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT

# The 128 start tiles and their heights.
set title 'The 128 start tiles, 22.5 degrees each, with their lowest and highest terrain (m)'
set xrange [-180:180]
set yrange [-90:90]
set xtics -180,45,180 out nomirror
set ytics -90,22.5,90 out nomirror
set xlabel 'longitude (deg)'
set ylabel 'latitude (deg)' offset 1,0
set size ratio -1
set cblabel 'height above the ellipsoid (m)' offset 0.5,0
set palette defined (0 '#dbe9f4', 0.0001 '#dbe9f4', 1 '#f4ecd0', 1000 '#d9b872', 3000 '#a06a3c', 6000 '#5a2d14')
set cbrange [0:6000]
set lmargin at screen 0.09
set rmargin at screen 0.85
set tmargin at screen 0.92
set bmargin at screen 0.14
do for [i=1:15] { set arrow from -180+22.5*i,-90 to -180+22.5*i,90 nohead front lw 1.2 lc @blue }
do for [i=1:7] { set arrow from -180,-90+22.5*i to 180,-90+22.5*i nohead front lw 1.2 lc @blue }
plot data index 'heights' using 1:2:3 with image, \
    data index 'tiles' using 1:($2+4):(sprintf('%d',$4)) with labels font ',10', \
    data index 'tiles' using 1:($2-5):(sprintf('%d',$3)) with labels font ',10'
