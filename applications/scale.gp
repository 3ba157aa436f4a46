# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# Draws depth, flight, residents and memory from what osgbinbench scale --csv has measured:
#     gnuplot -e "csv='scale.csv'; folder='figures'" applications/scale.gp
set terminal pngcairo size 800,500 noenhanced
set datafile separator ","
set datafile missing NaN
set grid
set yrange [0:*]
set key bottom right

# The values of a column in the rows of one series and method.
of(series, method, column) = \
    strcol("series") eq series && strcol("method") eq method ? column(column) : NaN
methods = "sphere bins oracle"
line = "with linespoints title word(methods, i)"

set output folder."/depth.png"
set title "Cull time for each drawn tile"
set xlabel "levels below the start tiles"
set ylabel "microseconds"
plot for [i=1:words(methods)] csv using (of("depth", word(methods, i), "levels")): \
    (of("depth", word(methods, i), "cull_us_per_drawn_tile")) @line

set output folder."/flight.png"
set title "Cull time of the flight"
set ylabel "milliseconds, one frame at each pose"
plot for [i=1:words(methods)] csv using (of("depth", word(methods, i), "levels")): \
    (of("depth", word(methods, i), "cull_ms")) @line

set output folder."/residents.png"
set title "Cull time of one view"
set xlabel "PagedLODs in memory (logarithmic)"
set logscale x
set rmargin 6
set ylabel "milliseconds"
plot for [i=1:words(methods)] csv using (of("residents", word(methods, i), "paged_lods")): \
    (of("residents", word(methods, i), "cull_ms")) @line

set output folder."/memory.png"
unset logscale x
set title "Memory of a tile"
unset xlabel
set ylabel "KiB"
set style fill solid 0.6
set boxwidth 0.6
unset key
set xtics rotate by 20 right
plot "< sed -n '1p; /^memory,/p' ".csv using 0:(column("bytes_per_tile")/1024):xtic(strcol("method")) with boxes
