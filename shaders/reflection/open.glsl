// Nothing but the sky stands around. r: unit vector.
vec3 surroundings(vec3 r, vec3 spread) {
    return mirrored_sky(r, spread);
}
