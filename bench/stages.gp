# Time per element of every stage against the number of elements:   gnuplot -c stages.gp DATA_FOLDER PICTURE
load ARG0[1:strlen(ARG0) - strlen('stages.gp')].'style.gp'
data = ARG1.'/stages.csv'
set terminal pngcairo size 1000,700 font 'Sans,13' background rgb 'white'
set output ARG2
set title 'every stage of a Newton iteration (beam in water, chain solver)'
set xlabel 'elements' offset 0,0.6
set ylabel 'processor time per element [µs]'
set xrange [70:2e6]
set yrange [0.01:1]
set key outside right center Left reverse nobox spacing 1.3
set format y '%g'
set ytics add (0.02, 0.05, 0.2, 0.5)
of(stage) = stringcolumn(1) eq stage ? 1 : NaN
stages = '"full iteration" tangent factorize reused residual solve'
array colour[6] = ['#222222', '#c0392b', '#1f5fa8', '#888888', '#d68910', '#2e8b57']
array label[6] = ['full iteration', 'residual + tangent', 'factorize', 'iteration that reuses factors', 'residual', 'solve']
plot for [i = 1:6] data using ($2*of(word(stages, i))):3 skip 1 with linespoints pt 7 lw 2 lc rgb colour[i] title label[i]
