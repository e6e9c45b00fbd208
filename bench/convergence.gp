# Error against element length and against step, with guides of slope 4 and 2:   gnuplot -c convergence.gp DATA_FOLDER PICTURE
load ARG0[1:strlen(ARG0) - strlen('convergence.gp')].'style.gp'
data = ARG1.'/'
set terminal pngcairo size 1500,980 font 'Sans,13' background rgb 'white'
set output ARG2
set key below Left reverse maxcols 2 nobox spacing 1.2 noenhanced
of(series) = stringcolumn(1) eq series ? 1 : NaN

set multiplot layout 1,2
set title 'In space: one step, finer meshes'
set xlabel 'element length [m]' offset 0,0.6
set ylabel 'error [m] or [N]'
set xrange [0.3:600]
set yrange [1e-11:1e4]
space = data.'convergence_space.csv'
plot space using ($2*of('catenary-5000 position bar')):3 skip 1 with linespoints pt 6 lw 2 lc rgb bar title 'catenary-5000, bar: position [m]', \
     '' using ($2*of('catenary-5000 position cable')):3 skip 1 with linespoints pt 7 lw 2 lc rgb cable title 'catenary-5000, cable: position [m]', \
     '' using ($2*of('catenary-5000 position beam')):3 skip 1 with linespoints pt 5 lw 2 lc rgb beam title 'catenary-5000, beam: position [m]', \
     '' using ($2*of('swinging-bob position bar')):3 skip 1 with linespoints pt 6 dt 2 lc rgb bar title 'swinging-bob, bar: position [m]', \
     '' using ($2*of('swinging-bob position cable')):3 skip 1 with linespoints pt 7 dt 2 lc rgb cable title 'swinging-bob, cable: position [m]', \
     '' using ($2*of('swinging-bob position beam')):3 skip 1 with linespoints pt 5 dt 2 lc rgb beam title 'swinging-bob, beam: position [m]', \
     '' using ($2*of('umbilical-heave tension bar')):3 skip 1 with linespoints pt 6 dt 3 lc rgb bar title 'umbilical-heave, bar: tension [N]', \
     '' using ($2*of('umbilical-heave tension cable')):3 skip 1 with linespoints pt 7 dt 3 lc rgb cable title 'umbilical-heave, cable: tension [N]', \
     [4:100] 2*(x/4)**2 with lines lw 3 lc rgb grey title 'slope 2', \
     [10:200] 1e-14*x**4 with lines lw 3 dt 4 lc rgb grey title 'slope 4'

set title 'In time: one mesh, smaller steps'
set xlabel 'step [s]' offset 0,0.6
set xrange [1e-3:0.4]
set yrange [1e-6:1e3]
time = data.'convergence_time.csv'
plot time using ($2*of('umbilical-heave tension largest')):3 skip 1 with linespoints pt 7 lw 2 lc rgb cable title 'umbilical-heave, largest after 60 s: tension [N]', \
     '' using ($2*of('umbilical-heave tension rms')):3 skip 1 with linespoints pt 6 lw 2 lc rgb cable title 'umbilical-heave, rms after 60 s: tension [N]', \
     '' using ($2*of('swinging-bob position')):3 skip 1 with linespoints pt 5 lw 2 lc rgb beam title 'swinging-bob at 10 s: position [m]', \
     [2e-3:0.2] 100*x**2 with lines lw 3 lc rgb grey title 'slope 2'
unset multiplot
