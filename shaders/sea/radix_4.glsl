const int FFT_RADIX = 4;
