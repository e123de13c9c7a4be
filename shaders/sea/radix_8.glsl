const int FFT_RADIX = 8;
