# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT

# A line for each method along the path, in three logarithmic diagrams. Less than their base line is drawn on it.
# The colours of Okabe and Ito, which the colour-blind can tell apart; those of OSG's own methods come first.
colours = "#D55E00 #E69F00 #0072B2 #009E73 #CC79A7 #56B4E9 #555555"
points = "4 6 8 10 12 1 2"
set datafile separator ","
methods = words(names)
heading = "Pose by pose along the path (logarithmic; what is on the base line is less, or none)"
labels = "'tiles drawn' 'triangles drawn' 'files requested'"
least(chart) = chart == 1 ? 500.0 : 0.5
shown(i, chart) = column(i) > least(chart) ? column(i) : least(chart)

set border 3 lc rgb "#444444"
set tics nomirror out
set grid ytics lt 1 lw 0.6 lc rgb "#cccccc"
set key outside center top horizontal samplen 2 maxrows 3
set xrange [-0.6:poses - 0.4]
set logscale y
set format y "%.0s%c"
set lmargin 10
set macros
set xtics @turned scale 0 (@tics)
do for [i=1:words(borders)] {
    x = real(word(borders, i))
    set arrow from first x, graph 0 to first x, graph 1 nohead lt 1 lw 0.8 lc rgb "#999999" back
}

lines = 'for [m=1:methods] "poses.csv" skip 1 using 0:(shown(2 + chart*methods + m, chart)) \
    with linespoints lw 1.4 ps 0.8 pt int(word(points, (m - 1)%7 + 1)) lc rgb word(colours, (m - 1)%7 + 1) \
    title word(names, m)'
needed = '"poses.csv" skip 1 using 0:(shown(2, chart)) with lines lw 2.5 lc rgb "#000000" title "tiles needed"'
do for [kind=1:2] {
    if (kind == 1) {
        set terminal svg size 1000,1200 noenhanced font "sans-serif,14" background rgb "white"
        set output "poses.svg"
    } else {
        set terminal pngcairo size 1000,1200 noenhanced font "sans,11"
        set output "poses.png"
    }
    set multiplot layout 3,1
    do for [chart=0:2] {
        set yrange [least(chart):*]
        set ylabel word(labels, chart + 1)
        if (chart == 0) {
            set title heading
            set key on
            plot @needed, @lines
        } else {
            unset title
            set key off
            plot @lines
        }
    }
    unset multiplot
    unset output
}
