// Light of one lamp that clear air scatters: polynomials, fitted for each scene to an integral over a round earth.
// docs/formulae.md, section 9. x: 1 at the horizon, 0.09 at the zenith; s: toward the lamp's azimuth. Coefficients: of x^0 those of
// s^0, s^1 and so on, then of x^1.
uniform vec3 u_glow_lamp;         // toward it
uniform vec2 u_glow_level;        // its azimuth, a unit vector
uniform float u_glow_even[18];    // green of molecules and of all that was scattered more than once, log2
uniform vec2 u_glow_even_tint[11];// what red and blue add
uniform float u_glow_haze[8];     // of haze over its phase function
uniform vec2 u_glow_haze_tint[3];
uniform float u_glow_even_rim[4]; // the same along the horizon, powers of s
uniform vec2 u_glow_even_tint_rim[3];
uniform float u_glow_haze_rim[3];
uniform vec2 u_glow_haze_tint_rim[2];

// green: logarithms of both parts; tints: what red and blue add to them.
vec3 glow_light(vec2 green, vec2 even_tint, vec2 haze_tint, float gamma) {
    vec3 even = exp2(green.x + vec3(even_tint.x, 0.0, even_tint.y));
    return even + exp2(green.y + vec3(haze_tint.x, 0.0, haze_tint.y)) * mie_phase(gamma);
}

vec3 glow(vec3 d) {
    float x = 0.1 / (max(d.y, 0.0) + 0.1);
    float s = dot(d.xz, u_glow_level);
    float even = u_glow_even[15] + s * u_glow_even[16] + x * u_glow_even[17];
    even = x * even + (u_glow_even[12] + s * (u_glow_even[13] + s * u_glow_even[14]));
    even = x * even + (u_glow_even[8] + s * (u_glow_even[9] + s * (u_glow_even[10] + s * u_glow_even[11])));
    even = x * even + (u_glow_even[4] + s * (u_glow_even[5] + s * (u_glow_even[6] + s * u_glow_even[7])));
    even = x * even + (u_glow_even[0] + s * (u_glow_even[1] + s * (u_glow_even[2] + s * u_glow_even[3])));
    vec2 tint = u_glow_even_tint[9] + s * u_glow_even_tint[10];
    tint = x * tint + (u_glow_even_tint[6] + s * (u_glow_even_tint[7] + s * u_glow_even_tint[8]));
    tint = x * tint + (u_glow_even_tint[3] + s * (u_glow_even_tint[4] + s * u_glow_even_tint[5]));
    tint = x * tint + (u_glow_even_tint[0] + s * (u_glow_even_tint[1] + s * u_glow_even_tint[2]));
    float haze = u_glow_haze[6] + s * u_glow_haze[7];
    haze = x * haze + (u_glow_haze[3] + s * (u_glow_haze[4] + s * u_glow_haze[5]));
    haze = x * haze + (u_glow_haze[0] + s * (u_glow_haze[1] + s * u_glow_haze[2]));
    vec2 haze_tint = u_glow_haze_tint[0] + s * u_glow_haze_tint[1] + x * u_glow_haze_tint[2];
    return glow_light(vec2(even, haze), tint, haze_tint, dot(d, u_glow_lamp));
}

// Along the horizon. level: a unit vector, or 0; d: the look, which haze before the horizon scatters toward.
vec3 glow_rim(vec2 level, vec3 d) {
    float s = dot(level, u_glow_level);
    float even = u_glow_even_rim[2] + s * u_glow_even_rim[3];
    even = u_glow_even_rim[0] + s * (u_glow_even_rim[1] + s * even);
    vec2 tint = u_glow_even_tint_rim[0] + s * (u_glow_even_tint_rim[1] + s * u_glow_even_tint_rim[2]);
    float haze = u_glow_haze_rim[0] + s * (u_glow_haze_rim[1] + s * u_glow_haze_rim[2]);
    vec2 haze_tint = u_glow_haze_tint_rim[0] + s * u_glow_haze_tint_rim[1];
    return glow_light(vec2(even, haze), tint, haze_tint, dot(d, u_glow_lamp));
}
