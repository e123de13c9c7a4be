// Foam lines along the wind (Langmuir 1938): cos^16 across it. p: m from the camera; returns a saturation in [0, 1].
uniform vec2 u_windrow_k;         // across the wind, rad/m
uniform float u_windrow_phase[1]; // k . camera position, rad
uniform float u_windrow_strength;

float windrow_saturation(vec2 p, float height, Footprint fp) {
    float psi = 0.5 * wrap_phase(u_windrow_phase[0] + dot(u_windrow_k, p));
    return u_windrow_strength * pow(cos(psi) * cos(psi), 8.0);
}
