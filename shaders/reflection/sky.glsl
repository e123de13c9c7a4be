// Water mirrors the sky alone. r: reflected direction, over the horizon, a unit vector.
// place: where on the water, from under the eye, y over still water, m.
vec3 reflected_light(vec3 place, vec3 r, vec3 spread) {
    return mirrored_sky(r, spread);
}
