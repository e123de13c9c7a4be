// Drifting foam thins out toward the rim of the circle in its square, over the last two fifths of the radius.
uniform vec2 u_drift_place; // from the square's middle to the eye, m
uniform float u_drift_foam; // saturation of a patch

float drift_rim(vec2 q) {
    return 1.0 - smoothstep(0.6, 1.0, length(q) / u_drift_half);
}
