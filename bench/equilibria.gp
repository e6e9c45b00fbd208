# Time per element of an equilibrium by method and start:   gnuplot -c equilibria.gp DATA_FOLDER PICTURE
load ARG0[1:strlen(ARG0) - strlen('equilibria.gp')].'style.gp'
data = ARG1.'/equilibria.csv'
set terminal pngcairo size 1000,600 font 'Sans,13' background rgb 'white'
set output ARG2
set title 'an equilibrium of the catenary of 5000 m'
set xlabel 'elements' offset 0,0.6
set ylabel 'processor time per element [µs]'
set xrange [70:1.4e5]
set yrange [0.3:30]
set key outside right center Left reverse nobox spacing 1.3
set format y '%g'
set ytics add (0.5, 2, 5, 20)
of(route) = stringcolumn(1) eq route ? 1 : NaN
routes = 'newton/straight kinsol/straight newton/catenary kinsol/catenary'
array label[4] = ['Newton, from a straight line', 'KINSOL, from a straight line', 'Newton, from the catenary', 'KINSOL, from the catenary']
set style line 1 lc rgb '#1f5fa8' lw 2 pt 5 dt 2
set style line 2 lc rgb '#c0392b' lw 2 pt 5 dt 2
set style line 3 lc rgb '#1f5fa8' lw 2 pt 7
set style line 4 lc rgb '#c0392b' lw 2 pt 7
plot for [i = 1:4] data using ($2*of(word(routes, i))):3 skip 1 with linespoints ls i title label[i]
