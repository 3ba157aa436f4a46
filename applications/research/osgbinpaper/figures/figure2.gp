# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT

# A bin that straddles a side of the frustum, and the ranges of its distances to the sides.
set multiplot
frustum = 'with lines lw 2 lc '.dark
inside = 'with lines lw 1.5 lc '.blue
outside = 'with lines lw 1.5 lc '.red
eye = 'with points pt 7 ps 1.2 lc '.black
set xyplane relative 0
set view equal xyz
set view 66,24,1.4
set origin 0.04,0.10
set size 0.56,0.84
set xlabel 'east (km)' offset 0,-0.5
set ylabel 'north (km)' offset 1,-0.5
set zlabel 'up (km)' rotate offset 1,0
set label 1 'A bin against a frustum' at screen 0.3,0.96 center
set tics 200
splot data index 'frustum' @frustum, data index 'inside' @inside, data index 'outside' @outside, data index 'eye' @eye
set origin 0,0
set size 1,1
unset view
set lmargin at screen 0.71
set rmargin at screen 0.97
set bmargin at screen 0.24
set tmargin at screen 0.92
set label 1 'Its signed distances to the sides' at screen 0.84,0.96 center
set yrange [0.4:4.6]
set ylabel 'side of the frustum' offset -0.5,0 rotate
set xlabel 'distance (km), > 0 inside' offset 0,0
set ytics ('left' 4, 'right' 3, 'bottom' 2, 'top' 1)
set xtics autofreq font ',10'
set grid x
set arrow 1 from 0,0.4 to 0,4.6 nohead lw 2 lc rgb 'black'
plot data index 'ranges' using 2:1:($3-$2):(0) with vectors nohead lw 9 lc @sky, \
    data index 'ranges' using 4:1:($5-$4):(0) with vectors nohead lw 3 lc @dark
@foot
plot NaN notitle, keyentry @frustum title 'frustum', keyentry @eye title 'eye', \
    keyentry @inside title 'bin, inside all sides', keyentry @outside title 'bin, outside of one', \
    keyentry with lines lw 9 lc @sky title 'range by the quadratic bin', \
    keyentry with lines lw 3 lc @dark title 'by eight corners'
