// The uniform cubic B-spline between the second and the third of four coefficients, t in [0, 1]: weights, and those of its first and
// second derivative.
vec4 spline_weights(float t) {
    float u = 1.0 - t;
    return vec4(u * u * u, (3.0 * t - 6.0) * t * t + 4.0, (3.0 * u - 6.0) * u * u + 4.0, t * t * t) / 6.0;
}

vec4 spline_slopes(float t) {
    float u = 1.0 - t;
    return 0.5 * vec4(-u * u, (3.0 * t - 4.0) * t, (4.0 - 3.0 * u) * u, t * t);
}

vec4 spline_bends(float t) {
    float u = 1.0 - t;
    return vec4(u, 3.0 * t - 2.0, 3.0 * u - 2.0, t);
}
