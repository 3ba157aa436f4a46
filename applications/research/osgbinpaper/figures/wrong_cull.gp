# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT

# A visible tile that a method culls: the frustum, and a profile across the side that it was culled by.
set multiplot title heading
frustum = 'with lines lw 2 lc '.green
eye = 'with points pt 7 ps 1 lc '.black
tile = 'with lines lw 1 lc '.grey
edges = 'with lines lw 2 lc '.blue
model = 'with lines lw 1.5 dt 2 lc '.orange
corners = 'with points pt 7 ps 1.1 lc '.dark
witness = 'with points pt 3 ps 2.2 lw 3 lc '.red
layers(n) = sprintf("data index 'tile%d' %s, data index 'edges%d' %s, %s data index 'corners%d' %s, \
data index 'witness%d' %s", n, tile, n, edges, isPaper > 0 ? sprintf("data index 'model%d' %s,", n, model) : '', \
n, corners, n, witness)
in3 = layers(3)
in2 = layers(2)
set xyplane relative 0
set view equal xyz
set view 58,30,1.3
set origin 0.04,0.14
set size 0.46,0.78
set xlabel 'east (km)' offset 0,-0.5
set ylabel 'north (km)' offset 1,-0.5
set zlabel 'up (km)' rotate offset 1,0
set xtics autofreq
set tics 1000
splot data index 'frustum' @frustum, data index 'eye' @eye, @in3
set origin 0,0
set size 1,1
set lmargin at screen 0.62
set rmargin at screen 0.97
set bmargin at screen 0.22
set tmargin at screen 0.92
set xlabel 'along the side of the frustum (km)' offset 0,0
set ylabel 'distance to the side (km), > 0 inside' offset 0,0 rotate
set grid
set ytics autofreq
set object 1 rectangle from graph 0, first 0 to graph 1, graph 1 behind fs solid 0.12 noborder fc @green
set arrow 1 from graph 0, first 0 to graph 1, first 0 nohead lw 2 lc @green
set label 1 'inside the side' at graph 0.02, graph 0.96 textcolor @green
plot @in2
@foot
shown = isPaper > 0 ? "keyentry ".model." title 'the model, box x 1.1'," : 'NaN notitle,'
tested = isPaper > 0 ? 'the 8 corners of its model, all outside' : 'the 8 corners tested'
plot NaN notitle, keyentry @frustum title 'frustum', keyentry @eye title 'eye', keyentry @edges title 'bin of the tile', \
    @shown keyentry @corners title tested, keyentry @witness title 'a point in view'
