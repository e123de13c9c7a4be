// Water mirrors what stands over it by rays of its own, and the sky. r: reflected direction, over the horizon; d: from the eye;
// n: normal; unit vectors. Exact to float32.
vec3 reflected_light(vec3 r, vec3 d, vec3 n) {
    vec3 light;
    return mirror_met(mirror_place(d), r, false, light) < 0.0 ? mirrored_sky(r, d, n) : light;
}
