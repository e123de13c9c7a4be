// The map's means over 4 x 4 texels, for places that are far away.
uniform sampler2D u_drift_map;
out vec4 o_drift;

void main() {
    ivec2 base = 4 * ivec2(gl_FragCoord.xy);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 16; ++i) {
        sum += texel_at(u_drift_map, base + ivec2(i & 3, i >> 2));
    }
    o_drift = sum / 16.0;
}
