// The ways back read from their map, bilinear, and how they change along x and z, a unit. By hand: a sampler's 256 steps between
// texels would show as steps of the mask.
uniform sampler2D u_drift_way;

void drift_ways(vec2 q, out vec4 way, out vec4 along_x, out vec4 along_z) {
    float texels = float(DRIFT_SIZE) / (2.0 * u_drift_half);
    vec2 at = clamp((q + u_drift_half) * texels - 0.5, 0.0, float(DRIFT_SIZE - 1));
    ivec2 low = min(ivec2(at), DRIFT_SIZE - 2);
    vec2 t = at - vec2(low);
    vec4 a = texel_at(u_drift_way, low);
    vec4 b = texel_at(u_drift_way, low + ivec2(1, 0));
    vec4 c = texel_at(u_drift_way, low + ivec2(0, 1));
    vec4 d = texel_at(u_drift_way, low + ivec2(1, 1));
    way = bilinear(a, b, c, d, t);
    along_x = mix(b - a, d - c, t.y) * texels;
    along_z = mix(c - a, d - b, t.x) * texels;
}
