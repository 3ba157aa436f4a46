# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT

# Bars for each path, one a method, as SVG and as PNG: gnuplot -e "name='drawn'" bars.gp
# NAME.csv has a column for each method, followed by half its spread where there is one;
# name is drawn, files or cull.
# Ratios stand on 1, and equal ratios are equally far apart. Times that differ much have a logarithmic axis, too.
# The colours of Okabe and Ito, which the colour-blind can tell apart; those of OSG's own methods come first.
colours = "#D55E00 #E69F00 #0072B2 #009E73 #CC79A7 #56B4E9 #555555"
look = "size 1000,560 noenhanced font 'sans,12'"
set terminal svg background "white" @look
set output name.".svg"
set datafile separator ","
data = name.".csv"
isRatio = name eq "drawn"
hasSpread = name eq "cull"
heading = isRatio ? "Tiles drawn for each tile needed, sums over the poses of a path" : \
    hasSpread ? "Time of a cull traversal, mean over the poses of a path; whiskers: half the quartile spread either way" : \
    "Files requested on arrival at a pose, mean over the poses of a path"
label = isRatio ? "tiles drawn / tiles needed (logarithmic)" : hasSpread ? "milliseconds a pose" : "files a pose"
names = system("head -n 1 ".data." | tr , '\\n' | grep -v -e '^path$' -e ' half spread$' | tr '\\n' ' '")
methods = words(names)
figure(m) = column(hasSpread ? 2*m : m + 1)
half(m) = column(2*m + 1)

paths = 0
lowest = 1.0
highest = 0.0
stats data skip 1 using (paths = paths + 1, sum [m=1:methods] (v = figure(m), \
    lowest = v < lowest ? v : lowest, highest = v > highest ? v : highest, 0)) nooutput

set title heading
isWide = !isRatio && hasSpread && lowest > 0 && highest > 30*lowest
base = isRatio ? 1 : isWide ? 0.7*lowest : 0
set ylabel isWide ? label." (logarithmic)" : label
set border 3 lc rgb "#444444"
set tics nomirror out
set grid ytics lt 1 lw 0.6 lc rgb "#cccccc"
set key outside center top horizontal samplen 2 maxrows 3
set xrange [-0.6:paths - 0.4]
set xtics scale 0
if (paths > 8) { set xtics rotate by 40 right }
if (isRatio) {
    least = 0.9*lowest
    most = 1.6*highest
    set logscale y 2
    set yrange [least < 0.1 ? 0.1 : least > 0.95 ? 0.95 : least : most > 2 ? most : 2]
    set arrow from graph 0, first 1 to graph 1, first 1 nohead lw 1.2 lc rgb "#222222" front
} else {
    set yrange [base:highest > 0 ? 1.25*highest : 1]
}
if (isWide) { set logscale y }

width = 0.84/methods
left(m) = width*(m - 1) - 0.42
middle(m) = left(m) + width/2
# numbers where bars are wide enough for them
numbered = !hasSpread && paths*methods <= 64 ? methods : 0
plot data skip 1 using 0:(base):xtic(1) with dots lc rgb "white" notitle, \
    for [m=1:methods] data skip 1 \
        using ($0 + middle(m)):(figure(m)):($0 + left(m)):($0 + left(m) + 0.92*width):(base):(figure(m)) \
        with boxxyerror fs solid 0.9 noborder lc rgb word(colours, (m - 1)%7 + 1) title word(names, m), \
    for [m=1:hasSpread ? methods : 0] data skip 1 \
        using ($0 + middle(m)):(figure(m) - half(m)):(0):(2*half(m)) \
        with vectors nohead lw 1.5 lc rgb "#222222" notitle, \
    for [m=1:numbered] data skip 1 \
        using ($0 + middle(m)):(isRatio && figure(m) < 1 ? 1 : figure(m)):(sprintf(isRatio ? "%.2f" : "%.0f", figure(m))) \
        with labels rotate by 90 left offset 0,0.3 notitle
set terminal pngcairo @look
set output name.".png"
replot
unset output
