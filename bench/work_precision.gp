# Error against processor time:   gnuplot -c work_precision.gp DATA_FOLDER PICTURE
load ARG0[1:strlen(ARG0) - strlen('work_precision.gp')].'style.gp'
data = ARG1.'/'
set terminal pngcairo size 1650,750 font 'Sans,13' background rgb 'white'
set output ARG2
set xlabel 'processor time of the whole solution [s]'
set key top right Left reverse opaque box linecolor rgb '#cccccc' spacing 1.2

# Lines join the runs on one mesh: along them the step shrinks. Rows of one family (column 1), and of one family on one mesh (column 2).
of(family) = stringcolumn(1) eq family ? 1 : NaN
on(family, elements) = stringcolumn(1) eq family && column(2) == elements ? 1 : NaN

set multiplot layout 1,3
set title "catenary-5000\n10 to 5120 elements" noenhanced
set ylabel 'largest position error [m]'
set yrange [1e-11:1e4]
plot data.'catenary.csv' using ($3*of('bar')):4 skip 1 with linespoints pt 6 lw 2 lc rgb bar title 'bar', \
     '' using ($3*of('cable')):4 skip 1 with linespoints pt 7 lw 2 lc rgb cable title 'cable', \
     [1e-3:6e-3] 1.5e-2*(x/1e-3)**-2 with lines lw 3 lc rgb grey title 'slope -2', \
     [3e-4:2e-3] 3e-6*(x/3e-4)**-4 with lines lw 3 dt 4 lc rgb grey title 'slope -4'

set title "swinging-bob, 10 s\n8 to 128 elements, steps 0.04 to 0.00125 s" noenhanced
set ylabel 'position error of the bob at 10 s [m]'
set yrange [1e-6:10]
plot for [n in '8 16 32 64 128'] data.'bob.csv' using ($4*on('bar', n)):5 skip 1 with linespoints pt 6 lc rgb bar title (n eq '8' ? 'bar' : ''), \
     for [n in '8 16 32 64 128'] '' using ($4*on('cable', n)):5 skip 1 with linespoints pt 7 lc rgb cable title (n eq '8' ? 'cable (no EI)' : ''), \
     for [n in '8 16 32 64 128'] '' using ($4*on('beam', n)):5 skip 1 with linespoints pt 5 lc rgb beam title (n eq '8' ? 'beam' : ''), \
     [0.05:0.4] 2e-3*(x/0.05)**-2 with lines lw 3 lc rgb grey title 'slope -2'

set title "umbilical-heave, 120 s\n25 to 400 elements, steps 0.2 to 0.0125 s" noenhanced
set ylabel 'largest error of the top tension after 60 s [N]'
set yrange [1:3000]
plot for [n in '25 50 100 200 400'] data.'umbilical.csv' using ($4*on('bar', n)):5 skip 1 with linespoints pt 6 lc rgb bar title (n eq '25' ? 'bar' : ''), \
     for [n in '25 50 100 200 400'] '' using ($4*on('cable', n)):5 skip 1 with linespoints pt 7 lc rgb cable title (n eq '25' ? 'cable' : ''), \
     [0.3:2] 150*(x/0.3)**-2 with lines lw 3 lc rgb grey title 'slope -2', \
     41.4 with lines dt 2 lc rgb grey title '0.1 % of the least tension'
unset multiplot
