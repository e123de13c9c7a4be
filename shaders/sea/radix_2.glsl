const int FFT_RADIX = 2;
