# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT

# The terrain of the tiles drawn, in the camera's perspective, with their outlines.
set multiplot
set label 1 heading at screen 0.5,0.965 center
unset tics
unset border
set view map
set lmargin at screen 0.01
set rmargin at screen 0.99
set bmargin at screen 0.01
set tmargin at screen 0.93
set xrange [-aspect:aspect]
set yrange [-1:1]
set pm3d depthorder clip1in
set object 1 rectangle from graph 0,graph 0 to graph 1,graph 1 behind fc rgb '#D6E4F0' fs noborder
# quads that stick out
set object 2 rectangle from screen 0,screen 0 to screen 0.01,screen 1 front fc rgb 'white' fs solid noborder
set object 3 rectangle from screen 0.99,screen 0 to screen 1,screen 1 front fc rgb 'white' fs solid noborder
set object 4 rectangle from screen 0,screen 0 to screen 1,screen 0.01 front fc rgb 'white' fs solid noborder
splot data index 0:int(tiles)-1 using 1:2:3:4 with pm3d fillcolor rgb variable
unset object 1
unset label
plot data index 'outlines' using 1:2 with lines lw 1 lc rgb '#1e1e1e'
