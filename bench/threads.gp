# What a second thread gains, stage by stage:   gnuplot -c threads.gp DATA_FOLDER PICTURE
load ARG0[1:strlen(ARG0) - strlen('threads.gp')].'style.gp'
data = ARG1.'/threads.csv'
set terminal pngcairo size 1000,600 font 'Sans,13' background rgb 'white'
set output ARG2
unset logscale
set format '%g'
set title 'wall time of one thread over that of two (beam in water, chain solver)'
set ylabel 'gain'
set yrange [0:2.6]
set style data histogram
set style histogram clustered gap 1.5
set style fill solid 0.9 border rgb '#444444'
set key top left horizontal nobox
set grid noxtics
set xtics scale 0
set arrow 1 from graph 0, first 1 to graph 1, first 1 nohead dt 2 lc rgb grey
set arrow 2 from graph 0, first 1.6 to graph 1, first 1.6 nohead dt 3 lc rgb grey
array colour[3] = ['#9ec5e8', '#1f5fa8', '#153e6e']
plot for [i = 1:3] data skip 1 using (column(2*i)/column(2*i + 1)):xtic(1) lc rgb colour[i] title sprintf('10^%d elements', i + 2)
