// One pass of an inverse Fourier transform (Stockham; Govindaraju et al. 2008), along rows or columns of square blocks; two complex
// numbers a texel. Each texel sums FFT_RADIX texels of the pass before.
uniform sampler2D u_fft_from;
uniform sampler2D u_fft_twiddles; // e^(2 pi i j / 512)
uniform vec3 u_fft;               // binary logarithms of the side of a block and of the product of the radices so far; 0 along rows or 1 along columns
out vec4 o_sum;

void main() {
    int size = 1 << int(u_fft.x);
    int span = 1 << int(u_fft.y);
    int log_whole = int(u_fft.y) + FFT_BITS;
    bool down = u_fft.z > 0.5;
    ivec2 at = ivec2(gl_FragCoord.xy);
    int place = down ? at.y : at.x;
    // All are powers of 2: shifts and masks stand for divisions, which drivers on processors make lane by lane.
    int index = place & (size - 1);
    int block = place - index;
    int whole = span * FFT_RADIX;
    int first = ((index >> log_whole) * span) + (index & (span - 1));
    int turn = (index & (whole - 1)) << (9 - log_whole);
    o_sum = vec4(0.0);
    for (int r = 0; r < FFT_RADIX; ++r) {
        int from = block + first + r * (size >> FFT_BITS);
        vec4 v = texel_at(u_fft_from, down ? ivec2(at.x, from) : ivec2(from, at.y));
        vec2 w = texel_at(u_fft_twiddles, ivec2((r * turn) & 511, 0)).rg;
        o_sum += vec4(w.x * v.x - w.y * v.y, w.x * v.y + w.y * v.x, w.x * v.z - w.y * v.w, w.x * v.w + w.y * v.z);
    }
}
