# Work per second against work per byte, below what the machine can do:   gnuplot -c roofline.gp DATA_FOLDER PICTURE
load ARG0[1:strlen(ARG0) - strlen('roofline.gp')].'style.gp'
data = ARG1.'/roofline.csv'
roofs = ARG1.'/roofs.csv'
set terminal pngcairo size 1200,750 font 'Sans,13' background rgb 'white'
set output ARG2
roof(name) = real(system(sprintf("awk -F, '$1 == \"%s\" {print $2}' %s", name, roofs)))
peak = roof('peak')
levels = '512 8192 524288'
array place[3] = ['second-level cache', 'third-level cache', 'memory']
array bandwidth[3]
do for [i = 1:3] { bandwidth[i] = roof(word(levels, i)) }
least(a, b) = a < b ? a : b

set title "roofline of one thread: beam in water, chain solver\nlarger symbols: more elements, 10^2 to 10^6"
set xlabel 'operations per byte that must move' offset 0,0.4
set ylabel 'Gflop/s'
set xrange [0.05:20]
set yrange [0.5:200]
set format '%g'
set key outside right center Left reverse nobox spacing 1.3
of(stage) = stringcolumn(1) eq stage ? 1 : NaN
stages = 'residual tangent factorize solve'
array colour[4] = ['#d68910', '#c0392b', '#1f5fa8', '#2e8b57']
plot for [i = 1:3] least(peak, bandwidth[i]*x) with lines lw 2 dt i lc rgb '#666666' title sprintf('%s, %.0f GB/s', place[i], bandwidth[i]), \
     peak with lines lw 2 lc rgb '#222222' title sprintf('peak, %.0f Gflop/s', peak), \
     for [i = 1:4] data using ($3*of(word(stages, i))):4:(0.4*log10($2)) skip 1 with linespoints pt 7 ps variable lc rgb colour[i] title word(stages, i)
