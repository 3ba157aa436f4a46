# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT

# The recursion on a map.
set multiplot
tile = 'fs solid 1 border lc rgb "#404040" lw 0.6 fc '
box = 'using (0.5*($1+$3)):(0.5*($2+$4)):1:3:2:4 with boxxyerror fs solid 1 border lc rgb "#404040" lw 0.6 fc '
border = 'with lines lw 2.5 lc '.black
eye = 'with points pt 7 ps 1.3 lc '.black
draw = "plot data index 'outside' @box @pale, data index 'straddling' @box @orange, data index 'inside' @box @blue, \
data index 'within' @box @sky, data index 'footprint' using 1:2 @border, '+' using (east):(north) every ::0::0 @eye"
set xlabel 'longitude (deg)'
set ylabel 'latitude (deg)' offset 1,0
set tics out nomirror
set lmargin at screen 0.07
set rmargin at screen 0.53
set bmargin at screen 0.23
set tmargin at screen 0.91
set xrange [-180:180]
set yrange [-90:90]
set xtics 90
set ytics 45
set title 'The recursion on the whole globe'
@draw
set lmargin at screen 0.60
set rmargin at screen 0.98
set xtics 5
set ytics 5
set title 'About the eye'
set xrange [east-14:east+18]
set yrange [north-6:north+20]
@draw
@foot
plot NaN notitle, keyentry with boxes @tile @pale title 'outside', keyentry with boxes @tile @orange title 'straddling', \
    keyentry with boxes @tile @blue title 'inside', keyentry with boxes @tile @sky title 'within inside: not tested', \
    keyentry @border title 'border of the picture', keyentry @eye title 'eye'
