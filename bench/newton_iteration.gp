# Time per element of a Newton iteration against the number of elements:   gnuplot -c newton_iteration.gp BENCHMARK_JSON PICTURE
load ARG0[1:strlen(ARG0) - strlen('newton_iteration.gp')].'style.gp'
set terminal pngcairo size 1500,700 font 'Sans,13' background rgb 'white'
set output ARG2
set xlabel 'elements' offset 0,0.6
set ylabel 'processor time per element [µs]'
set xrange [70:3e6]
set key below Left reverse maxcols 3 nobox spacing 1.2

# Google Benchmark writes one key a line: elements and seconds per element of every benchmark below one name.
rows(name) = sprintf("< awk -F'[\"/:, ]+' '/\"run_name\": \"%s/ {size = $(NF-1)} /\"run_name\"/ && !/%s/ {size = 0} /\"s_per_element\"/ && size {print size \",\" $3*1e6}' %s", \
                     system("printf %s '".name."' | sed 's#/#.#g'"), system("printf %s '".name."' | sed 's#/#.#g'"), ARG1)
solvers = 'chain band cholmod umfpack klu'
array colour[5] = ['#1f5fa8', '#c0392b', '#2e8b57', '#8e44ad', '#d68910']
array label[5] = ['chain', 'LAPACK band', 'CHOLMOD (symmetric part)', 'UMFPACK', 'KLU']

set multiplot layout 1,2
set yrange [0.03:30]
set title 'full: residual, tangent, factorize, solve (beam in water)'
plot for [i = 1:5] rows('newton/full/'.word(solvers, i).'/beam') using 1:2 with linespoints pt 7 lw 2 lc rgb colour[i] title label[i]
set title 'reused factorization: residual, solve (beam in water)'
plot for [i = 1:5] rows('newton/reused/'.word(solvers, i).'/beam') using 1:2 with linespoints pt 7 lw 2 lc rgb colour[i] title label[i]
unset multiplot
