# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT

# What all figures share. The colours of Okabe and Ito, which the colour-blind can tell apart.
data = name.'.csv'
set datafile separator ','
set encoding utf8
blue = 'rgb "#0072B2"'
sky = 'rgb "#56B4E9"'
orange = 'rgb "#E69F00"'
red = 'rgb "#D55E00"'
green = 'rgb "#009E73"'
grey = 'rgb "#B8B8B8"'
dark = 'rgb "#404040"'
pale = 'rgb "#E8E8E8"'
black = 'rgb "#000000"'
# The key of a multiplot across its foot: plot NaN, keyentry STYLE title TITLE ...
foot = "unset label; unset arrow; unset object; unset tics; unset border; unset grid; unset title; unset xlabel; \
unset ylabel; set origin 0,0; set size 1,0.11; set lmargin at screen 0.01; set rmargin at screen 0.99; \
set bmargin at screen 0; set tmargin at screen 0.11; set xrange [0:1]; set yrange [0:1]; \
set key center center horizontal samplen 2"
unset key
