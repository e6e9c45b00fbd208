# The look of every chart of this folder.
set encoding utf8
set datafile separator ','
set logscale xy
set format x '10^{%L}'
set format y '10^{%L}'
set grid linecolor rgb '#dddddd' linetype 1 linewidth 1
set border 3 linecolor rgb '#444444'
set tics textcolor rgb '#222222' nomirror
bar = '#c0392b'; cable = '#1f5fa8'; beam = '#2e8b57'; grey = '#888888'
