// Drifting foam ends at the rim of its square: smoothly over the last fifth on each side.
uniform vec2 u_drift_place; // from the square's middle to the eye, m
uniform float u_drift_foam; // saturation of a patch

float drift_rim(vec2 q) {
    vec2 t = 1.0 - smoothstep(vec2(0.8), vec2(1.0), abs(q) / u_drift_half);
    return t.x * t.y;
}
