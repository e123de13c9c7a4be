// Texels that a pass of the transform sums.
const int FFT_RADIX = 4;
