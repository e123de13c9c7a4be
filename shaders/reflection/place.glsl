// The place on the water that is looked at along d, metres from the eye's own (x, z): on still water first, then by Newton steps.
uniform float u_mirror_level; // height of still water, m

vec3 mirror_place(vec3 d) {
    // An eye in a trough is under still water's level, and yet looks down on what is before it.
    float over = max(u_eye_height - u_mirror_level, 0.3 * u_eye_height);
    float way = clamp(over / max(-d.y, 1e-4), 0.0, 1e4);
    for (int i = 0; i < 4; ++i) {
        vec3 wave = waves(way * d.xz);
        float rate = d.y - dot(wave.yz, d.xz);
        // Rising along the look or level with it: no place to be found downhill.
        if (rate < -1e-3) {
            float gap = u_eye_height + way * d.y - wave.x;
            way = clamp(way - clamp(gap / rate, -0.1 * way - 0.1, 0.1 * way + 0.1), 0.0, 1e4);
        }
    }
    return vec3(way * d.x, u_eye_height + way * d.y, way * d.z);
}
