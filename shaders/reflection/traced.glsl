// Water mirrors what stands over it by rays of its own, and the sky. Exact to float32. r: reflected direction, over the horizon, a unit
// vector.
// place: where on the water, from under the eye, y over still water, m.
vec3 reflected_light(vec3 place, vec3 r, vec3 spread) {
    vec3 light;
    return mirror_met(place, r, false, light) < 0.0 ? mirrored_sky(r, spread) : light;
}
