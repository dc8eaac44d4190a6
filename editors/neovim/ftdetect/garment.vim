autocmd BufRead,BufNewFile *.garment setfiletype garment
