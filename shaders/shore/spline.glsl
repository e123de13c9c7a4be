// Weights of the uniform quadratic B-spline at t in [0, 1) and their derivatives: smooth slopes, and never past the texels.
vec3 bspline_weights(float t) {
    float u = 1.0 - t;
    return vec3(0.5 * u * u, 0.5 + t * u, 0.5 * t * t);
}

vec3 bspline_slopes(float t) {
    return vec3(t - 1.0, 1.0 - 2.0 * t, t);
}
