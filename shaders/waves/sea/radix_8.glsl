// Texels that a pass of the transform sums, and its binary logarithm.
const int FFT_RADIX = 8;
const int FFT_BITS = 3;
