# Time per element of a Newton iteration against the number of elements:   gnuplot -c newton_iteration.gp DATA_FOLDER PICTURE
load ARG0[1:strlen(ARG0) - strlen('newton_iteration.gp')].'style.gp'
data = ARG1.'/newton.csv'
set terminal pngcairo size 1500,700 font 'Sans,13' background rgb 'white'
set output ARG2
set xlabel 'elements' offset 0,0.6
set ylabel 'processor time per element [µs]'
set xrange [70:3e6]
set key below Left reverse maxcols 3 nobox spacing 1.2
of(solver, kind) = stringcolumn(1) eq solver && stringcolumn(2) eq kind ? 1 : NaN
solvers = 'chain band sundials cholmod umfpack klu'
array colour[6] = ['#1f5fa8', '#c0392b', '#17a2b8', '#2e8b57', '#8e44ad', '#d68910']
array label[6] = ['chain', 'LAPACK band', 'SUNDIALS band', 'CHOLMOD (symmetric part)', 'UMFPACK', 'KLU']

set multiplot layout 1,2
set yrange [0.03:30]
set title 'full: residual, tangent, factorize, solve (beam in water)'
plot for [i = 1:6] data using ($3*of(word(solvers, i), 'full')):4 skip 1 with linespoints pt 7 lw 2 lc rgb colour[i] title label[i]
set title 'reused factorization: residual, solve (beam in water)'
plot for [i = 1:6] data using ($3*of(word(solvers, i), 'reused')):4 skip 1 with linespoints pt 7 lw 2 lc rgb colour[i] title label[i]
unset multiplot
