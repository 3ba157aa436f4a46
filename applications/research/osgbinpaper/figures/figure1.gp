# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT

# A bin in both of its coordinate systems.
set multiplot
grid = 'with lines lw 1 lc '.grey
edges = 'with lines lw 2.5 lc '.blue
point = 'with points pt 7 ps 1.3 lc '.red
set xyplane at 0
set origin 0.02,0.08
set size 0.48,0.84
set view 62,32,1.05
set xtics 5 offset 0,-0.3
set ytics 5
set ztics 2
set xlabel 'longitude (deg)' offset 0,-0.5
set ylabel 'latitude (deg)' offset 1,-0.5
set zlabel 'altitude (km)' rotate offset 1,0
set label 1 'The bin as it is given: a box' at screen 0.26,0.95 center
set zrange [lowest:highest]
splot data index 'boxGrid' @grid, data index 'boxEdges' @edges, data index 'center' @point
set origin 0.52,0.08
set view equal xyz
set autoscale z
set xyplane relative 0
set tics 1
set xlabel 'x (1000 km)'
set ylabel 'y (1000 km)'
set zlabel 'z (1000 km)'
set view 68,turn,1.15
set label 1 'Mapped to ECEF: a curved slab (altitude x 100)' at screen 0.76,0.95 center
splot data index 'slabGrid' @grid, data index 'slabEdges' @edges, data index 'slabCenter' @point
@foot
plot NaN notitle, keyentry @edges title 'the bin', keyentry @point title 'its centre'
