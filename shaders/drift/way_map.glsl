// The ways back read from their map, and how they change along x and z, a unit, over a texel to each side.
uniform sampler2D u_drift_way;

vec4 drift_way(vec2 q) {
    return textureLod(u_drift_way, 0.5 + 0.5 * q / u_drift_half, 0.0);
}

void drift_ways(vec2 q, out vec4 way, out vec4 along_x, out vec4 along_z) {
    float texel = 2.0 * u_drift_half / float(DRIFT_SIZE);
    way = drift_way(q);
    along_x = (drift_way(q + vec2(texel, 0.0)) - drift_way(q - vec2(texel, 0.0))) / (2.0 * texel);
    along_z = (drift_way(q + vec2(0.0, texel)) - drift_way(q - vec2(0.0, texel))) / (2.0 * texel);
}
