// Numbers and small functions that every stage shares.
const float PI = 3.14159265358979;
const float TAU = 6.28318530717959;
// The greatest half float: more is infinity in a half-float target, or NaN. Light is white on a screen from 8 on.
const float BRIGHTEST = 65504.0;

// Two-step reduction to [-pi, pi] (Cody and Waite): n * 6.28125 is exact for |n| < 2^15, so only the rounding of x is left.
float wrap_phase(float x) {
    float n = floor(x * 0.159154943091895 + 0.5);
    return (x - n * 6.28125) - n * 1.93530717958648e-3;
}

// Sine and cosine of an angle in [-pi/2, pi/2]: polynomials of least error, within 1e-7 on every driver, and both for less than one.
vec2 sine_cosine(float x) {
    float y = x * x;
    float sine = x * (1.0 + y * (-0.1666665702 + y * (8.333015513e-3 + y * (-1.980649104e-4 + y * 2.599789776e-6))));
    return vec2(sine, 1.0 + y * (-0.4999993201 + y * (4.166398104e-2 + y * (-1.385585915e-3 + y * 2.319275935e-5))));
}

// Sine and cosine of an angle in [-pi, pi], by those of its half: within 3e-7.
vec2 whole_sine_cosine(float x) {
    vec2 of_half = sine_cosine(0.5 * x);
    return vec2(2.0 * of_half.x * of_half.y, 1.0 - 2.0 * of_half.x * of_half.x);
}

// How far the surface point moves, in metres on the (x, z) plane, from one sample to the next.
struct Footprint {
    vec2 x;
    vec2 y;
};

// What a footprint leaves of a wave whose phase turns by q: the sum of its squares over the two sides, rad^2. A Gaussian of the variance
// that the box has, 1/12 of a side's square. docs/formulae.md, section 2.
float wave_kept(float q) {
    return exp(-min(q, 1800.0) / 24.0);
}

// The same of a wave by its wavevector (rad/m), and in the mean over all headings by its wavenumber's square.
float wave_kept(vec2 k, Footprint fp) {
    vec2 turns = vec2(dot(k, fp.x), dot(k, fp.y));
    return wave_kept(dot(turns, turns));
}

float wave_kept(float k2, Footprint fp) {
    return wave_kept(0.5 * k2 * (dot(fp.x, fp.x) + dot(fp.y, fp.y)));
}
