// Texels that a pass of the transform sums, and its binary logarithm.
const int FFT_RADIX = 4;
const int FFT_BITS = 2;
